// SPDX-License-Identifier: MIT
#include "common/analytic_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/interval.hpp"
#include "common/subdivision.hpp"

namespace encase {
namespace {

constexpr int kDegree = 3;             // of the models that tell
constexpr std::size_t kFew = 128;      // boxes along a line are not halved beyond this number
constexpr std::size_t kMany = 4096;    // nor are any others
constexpr double kLineGrowth = 2.6;    // by which there are more of them on an area
constexpr double kSmallest = 0x1p-30;  // part of the root's width
constexpr double kThin = 0x1p-11;      // likewise: boxes are made no thinner by cutting off parts
constexpr double kWide = 0x1p-6;       // part of its coordinates above which a gap is wide
constexpr double kUseful = 0x1p-6;     // relative error of a model for which a part is cut off
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

const TaylorModel<2, double>& model_on(const Box<2>& box, const FilteredExpression<2>& f,
                                       Kernel& kernel) {
  Point<2> center, half;
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    center[i] = chart.center;
    half[i] = chart.half;
  }
  return f.model(center, half, kDegree, Kernel::kDoubleBits, kernel);
}

/// Cuts parts off the sides of a box, ever smaller ones, where f has a model that is of use.
Box<2> thinned(Box<2> box, const FilteredExpression<2>& f, const Box<2>& root, Kernel& kernel) {
  for (int i = 0; i < 2; ++i)
    for (const bool upper : {false, true})
      for (double part = 0.5 * box.width(i); part > 0.5 * kThin * root.width(i); part *= 0.5) {
        Box<2> slab = box;
        (upper ? slab.lo[i] : slab.hi[i]) = upper ? box.hi[i] - part : box.lo[i] + part;
        const auto& model = model_on(slab, f, kernel);
        if (model.exists() && model.error <= kUseful * model.polynomial_norm())
          (upper ? box.hi[i] : box.lo[i]) = upper ? slab.lo[i] : slab.hi[i];
      }
  return box;
}

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

std::vector<Box<2>> find_gaps(const FilteredExpression<2>& f, const Box<2>& root, Kernel& kernel) {
  std::vector<Box<2>> gaps, level{root}, open;
  for (std::size_t before = 1; !level.empty(); before = open.size()) {
    open.clear();
    for (const Box<2>& box : level) {
      const auto& model = model_on(box, f, kernel);
      if (model.exists()) continue;
      (model.undefined ? gaps : open).push_back(box);
    }
    level.clear();
    const bool along_line =
        static_cast<double>(open.size()) < kLineGrowth * static_cast<double>(before);
    const bool ends = open.size() > kMany || (open.size() > kFew && along_line);
    for (const Box<2>& box : open) {
      Box<2> lower, upper;
      if (ends || box.largest_width() < kSmallest * root.largest_width() ||
          !halve_box(box, 0, &lower, &upper)) {
        gaps.push_back(box);
        continue;
      }
      for (const Box<2>& part : {lower, upper}) {
        Box<2> below, above;
        if (!halve_box(part, 1, &below, &above)) {
          gaps.push_back(part);
          continue;
        }
        level.push_back(below);
        level.push_back(above);
      }
    }
  }
  join_neighbours(&gaps);
  if (gaps.size() <= kFewGathered)
    for (Box<2>& gap : gaps) gap = thinned(gap, f, root, kernel);
  return gaps;
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
