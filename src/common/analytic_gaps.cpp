// SPDX-License-Identifier: MIT
#include "common/analytic_gaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/interval.hpp"
#include "common/numerator.hpp"
#include "common/subdivision.hpp"

namespace encase {
namespace {

constexpr int kDegree = 3;         // of the models that tell
constexpr std::size_t kFew = 128;  // boxes along a line are not halved beyond this number
constexpr std::size_t kFewOfQuotients = 1024;  // likewise; most will vanish
constexpr std::size_t kMany = 4096;            // nor are any others
constexpr int kSlices = 64;
constexpr double kLineGrowth = 1.7;    // by which there are more of them on an area
constexpr double kSmallest = 0x1p-30;  // part of the root's width
constexpr double kThin = 0x1p-11;      // likewise, of strips
constexpr double kLong = 0x1p-4;       // likewise: such strips are not cut into pieces
// Boxes narrower than this part need a model with a relative error that is of use: near essential
// singularities there is none, and nothing would be found.
constexpr double kNarrow = 0x1p-5;
constexpr double kUseful = 0x1p-6;
constexpr double kWide = 0x1p-6;  // part of its coordinates above which a gap is wide
constexpr std::size_t kFewGathered = 40;
constexpr int kGrid = 16;

bool overlap(const Box<2>& a, const Box<2>& b) {
  for (int i = 0; i < 2; ++i)
    if (!(a.lo[i] < b.hi[i] && b.lo[i] < a.hi[i])) return false;
  return true;
}

/// Joins boxes the union of which is a box.
void join_neighbours(std::vector<Box<2>>* boxes) {
  for (std::size_t before = 0; before != boxes->size();) {
    before = boxes->size();
    for (int axis = 0; axis < 2; ++axis) {
      const int other = 1 - axis;
      std::sort(boxes->begin(), boxes->end(), [&](const Box<2>& a, const Box<2>& b) {
        if (a.lo[other] != b.lo[other]) return a.lo[other] < b.lo[other];
        if (a.hi[other] != b.hi[other]) return a.hi[other] < b.hi[other];
        return a.lo[axis] < b.lo[axis];
      });
      std::vector<Box<2>> joined;
      for (const Box<2>& box : *boxes) {
        if (!joined.empty()) {
          Box<2>& last = joined.back();
          if (last.lo[other] == box.lo[other] && last.hi[other] == box.hi[other] &&
              last.hi[axis] >= box.lo[axis]) {
            last.hi[axis] = std::max(last.hi[axis], box.hi[axis]);
            continue;
          }
        }
        joined.push_back(box);
      }
      *boxes = std::move(joined);
    }
  }
}

/// Halves what has no model, breadth first, along the axis along which more comes of it.
class GapFinder {
 public:
  GapFinder(const FilteredFunction<2>& f, const Box<2>& root, Kernel& kernel)
      : f_(f), root_(root), kernel_(kernel) {}

  std::vector<Box<2>> run() {
    sort_out(root_, content(root_));
    if (open_.empty()) return std::move(gaps_);
    easier_axis_ = easier_axis();
    const bool quotient =
        f_.is_expression() && !numerator_of(f_.expression().exact()).divisors.empty();
    const std::size_t few = quotient ? kFewOfQuotients : kFew;
    for (std::size_t before = 1; !open_.empty();) {
      const std::vector<Box<2>> level = std::exchange(open_, {});
      const bool along_line =
          static_cast<double>(level.size()) < kLineGrowth * static_cast<double>(before);
      const bool ends = level.size() > kMany || (level.size() > few && along_line);
      for (const Box<2>& box : level)
        if (ends || !halve(box)) gaps_.push_back(box);
      before = level.size();
    }
    join_neighbours(&gaps_);
    return std::move(gaps_);
  }

 private:
  enum class Content { Model, Nothing, Open };

  Content content(const Box<2>& box) const {
    Point<2> center, half;
    for (int i = 0; i < 2; ++i) {
      const Centered chart = centered(box.lo[i], box.hi[i]);
      center[i] = chart.center;
      half[i] = chart.half;
    }
    const auto& model = f_.model(center, half, kDegree, Kernel::kDoubleBits, kernel_);
    if (model.undefined) return Content::Nothing;
    const bool narrow = std::min(part(box, 0), part(box, 1)) < kNarrow;
    const bool serves =
        model.exists() && (!narrow || model.error <= kUseful * model.polynomial_norm());
    return serves ? Content::Model : Content::Open;
  }

  void sort_out(const Box<2>& box, Content here) {
    if (here == Content::Open) open_.push_back(box);
    if (here == Content::Nothing) gaps_.push_back(box);
  }

  /// The axis such that many more slices across it have models; -1 if there is none.
  int easier_axis() const {
    std::array<int, 2> slices{};
    for (int axis = 0; axis < 2; ++axis)
      for (int k = 0; k < kSlices; ++k) {
        Box<2> slice = root_;
        slice.lo[axis] += root_.width(axis) * k / kSlices;
        slice.hi[axis] = root_.lo[axis] + root_.width(axis) * (k + 1) / kSlices;
        slices[axis] += content(slice) != Content::Open;
      }
    return slices[0] > 2 * slices[1] ? 0 : slices[1] > 2 * slices[0] ? 1 : -1;
  }

  bool is_preferred(const Box<2>& box, int axis) const {
    if (easier_axis_ >= 0) return axis == easier_axis_;
    return part(box, axis) > part(box, 1 - axis);
  }

  double part(const Box<2>& box, int axis) const { return box.width(axis) / root_.width(axis); }

  /// Strips are made no thinner than they need be; points get boxes as small as can be.
  bool may_halve(const Box<2>& box, int axis) const {
    const double here = part(box, axis);
    return here > kThin || (here > kSmallest && here >= 0.5 * part(box, 1 - axis));
  }

  bool halve(const Box<2>& box) {
    struct Halving {
      std::array<Box<2>, 2> half;
      std::array<Content, 2> content{};
      double value = -1;
    };
    std::array<Halving, 2> halvings;
    for (int axis = 0; axis < 2; ++axis) {
      Halving& h = halvings[axis];
      if (!may_halve(box, axis) || !halve_box(box, axis, &h.half[0], &h.half[1])) continue;
      h.value = is_preferred(box, axis) ? 0.5 : 0;
      for (int k = 0; k < 2; ++k) {
        h.content[k] = content(h.half[k]);
        h.value += h.content[k] != Content::Open;
      }
    }
    const Halving& best = halvings[halvings[1].value > halvings[0].value ? 1 : 0];
    // A strip along a line is kept as it is.
    const double a = part(box, 0), b = part(box, 1);
    const bool strip = std::min(a, b) <= kThin && std::max(a, b) > kLong;
    if (best.value < (strip ? 1 : 0)) return false;
    for (int k = 0; k < 2; ++k) sort_out(best.half[k], best.content[k]);
    return true;
  }

  const FilteredFunction<2>& f_;
  const Box<2>& root_;
  Kernel& kernel_;
  int easier_axis_ = -1;
  std::vector<Box<2>> gaps_, open_;
};

/// By a part of its width, of a wide one a small part of its coordinates, and by `tiny` of these.
Box<2> grown(const Box<2>& gap, double part, double tiny) {
  Box<2> result = gap;
  for (int i = 0; i < 2; ++i) {
    const double reach = std::max(std::fabs(gap.lo[i]), std::fabs(gap.hi[i]));
    const double margin = part * std::min(gap.width(i), kWide * reach) + tiny * reach;
    result.lo[i] -= margin;
    result.hi[i] += margin;
  }
  return result;
}

}  // namespace

std::vector<Box<2>> find_gaps(const FilteredFunction<2>& f, const Box<2>& root, Kernel& kernel) {
  return GapFinder(f, root, kernel).run();
}

Box<2> left_out_at(const Box<2>& gap) { return grown(gap, 0x1p-6, 0x1p-42); }
Box<2> zone_of(const Box<2>& gap) { return grown(gap, 0x1p-5, 0x1p-41); }

Relation relation(const Box<2>& box, const std::vector<Box<2>>& gaps) {
  Relation result = Relation::Apart;
  for (const Box<2>& gap : gaps) {
    if (!overlap(box, gap)) continue;
    if (left_out_at(gap).contains(box)) return Relation::Within;
    result = Relation::Partly;
  }
  return result;
}

std::vector<Box<2>> gathered(std::vector<Box<2>> boxes, const Box<2>& root) {
  if (boxes.size() <= kFewGathered) return boxes;
  // By the parts of a grid in which their centres lie, but for large ones.
  std::vector<Box<2>> result;
  std::map<std::array<int, 2>, Box<2>> parts;
  for (const Box<2>& box : boxes) {
    std::array<int, 2> part;
    bool large = false;
    for (int i = 0; i < 2; ++i) {
      large = large || box.width(i) > root.width(i) / kGrid;
      part[i] =
          static_cast<int>(std::floor((box.center()[i] - root.lo[i]) / root.width(i) * kGrid));
    }
    if (large) {
      result.push_back(box);
      continue;
    }
    const auto [entry, is_new] = parts.try_emplace(part, box);
    if (!is_new) entry->second = hull(entry->second, box);
  }
  for (const auto& [part, box] : parts) result.push_back(box);
  return result;
}

}  // namespace encase
