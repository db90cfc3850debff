// SPDX-License-Identifier: MIT
#include "2d/shared_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

#include "common/patch.hpp"
#include "common/plane_subdivision.hpp"

namespace encase {
namespace {

/// With so few curves alive a box is a leaf: their roots are isolated from here.
constexpr std::size_t kFew = 2;
/// So many halvings in a row that took no curve away: twice across either axis.
constexpr int kInVain = 4;
constexpr int kDeepest = 20;  // levels of halvings
constexpr int kMostBoxes = 200000;
/// A part with both widths above this fraction of the whole's is treated as the whole.
constexpr double kHardlySmaller = 0.6;

/// A curve in a box where it may have zeros, with its patch there if it has one already.
struct Alive {
  int curve = -1;
  int expanded_at = -1;  ///< the level of the box that the patch was made for; -1: no patch
  Patch patch;
};

class SharedSubdivision {
 public:
  SharedSubdivision(std::vector<TiledPolynomial>& curves, const std::vector<Line>& half_planes,
                    const std::function<bool()>& stop, Kernel& kernel)
      : curves_(curves),
        half_planes_(half_planes),
        stop_(stop),
        kernel_(kernel),
        lower_(kDeepest + 1) {}

  SharedLeaves run() {
    result_.cover.root = curves_.front().box();
    std::vector<Alive> all(curves_.size());
    for (std::size_t c = 0; c < curves_.size(); ++c) all[c].curve = static_cast<int>(c);
    visit(result_.cover.root, 0, 0, false, all);
    return std::move(result_);
  }

 private:
  void visit(const Box<2>& box, int level, int in_vain, bool inside, std::vector<Alive>& alive);
  bool provide_patch(const Box<2>& box, int level, Alive* alive);

  std::vector<TiledPolynomial>& curves_;
  const std::vector<Line>& half_planes_;
  const std::function<bool()>& stop_;
  Kernel& kernel_;
  SharedLeaves result_;
  bool stopped_ = false;
  /// The curves of the lower halves, by level. (Those of an upper half take their parent's place.)
  std::vector<std::vector<Alive>> lower_;
};

/// Makes the patch where it is missing or has become coarse. False if there is none, or none that
/// tells much: then a smaller box may.
bool SharedSubdivision::provide_patch(const Box<2>& box, int level, Alive* alive) {
  const auto coarse = [&] { return !(alive->patch.radius <= 0x1p-4 * alive->patch.magnitude()); };
  const bool known = alive->expanded_at >= 0;
  if (known && (alive->expanded_at + 2 > level || !coarse())) return !coarse();
  TiledPolynomial& f = curves_[static_cast<std::size_t>(alive->curve)];
  const Tile& tile = f.at(box.center());
  for (int axis = 0; axis < 2; ++axis)
    if (0.5 * box.width(axis) > 1.01 * tile.half[axis]) return false;
  expand(tile, box, patch_count(f.polynomial().degree()), &alive->patch);
  alive->expanded_at = level;
  return !coarse();
}

void SharedSubdivision::visit(const Box<2>& box, int level, int in_vain, bool inside,
                              std::vector<Alive>& alive) {
  SharedCover& cover = result_.cover;
  if (result_.visited++ % 64 == 0 && !stopped_) stopped_ = stop_ && stop_();
  if (stopped_) {
    cover.tokens.push_back(cover::kUnresolved);
    result_.unresolved.push_back(box);
    return;
  }
  if (!inside) {
    const std::optional<bool> where = lies_inside(box, half_planes_);
    if (where == false) {
      cover.tokens.push_back(cover::kOutside);
      return;
    }
    inside = where.has_value();
  }
  std::size_t left = 0;
  bool sharp = true;
  for (std::size_t k = 0; k < alive.size(); ++k) {
    const bool tells = provide_patch(box, level, &alive[k]);
    if (alive[k].expanded_at >= 0 && alive[k].patch.sign()) {
      kernel_.count(Kernel::kDoubleBits);
      continue;
    }
    sharp = sharp && tells;
    if (left < k) alive[left] = alive[k];
    ++left;
  }
  in_vain = left < alive.size() || !sharp ? 0 : in_vain + 1;
  alive.resize(left);
  Box<2> lower, upper;
  const int axis = cover::kSplitX - wider_axis(box);
  if (alive.size() <= kFew || in_vain >= kInVain || level == kDeepest ||
      result_.visited >= kMostBoxes || !halve_box(box, axis, &lower, &upper)) {
    cover.tokens.push_back(static_cast<int>(cover.alive.size()));
    auto& names = cover.alive.emplace_back();
    for (const Alive& a : alive) names.push_back(a.curve);
    result_.boxes.push_back(box);
    return;
  }
  cover.tokens.push_back(cover::kSplitX - axis);
  std::vector<Alive>& of_lower = lower_[static_cast<std::size_t>(level)];
  of_lower.resize(alive.size());
  for (std::size_t k = 0; k < alive.size(); ++k) {
    of_lower[k].curve = alive[k].curve;
    of_lower[k].expanded_at = alive[k].expanded_at;
    if (alive[k].expanded_at >= 0)
      halve(alive[k].patch, axis, false, &of_lower[k].patch, &alive[k].patch);
  }
  visit(lower, level + 1, in_vain, inside, of_lower);
  visit(upper, level + 1, in_vain, inside, alive);
}

constexpr Box<2> kNothing{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

}  // namespace

SharedLeaves share_leaves(std::vector<TiledPolynomial>& curves,
                          const std::vector<Line>& half_planes, const std::function<bool()>& stop,
                          Kernel& kernel) {
  return SharedSubdivision(curves, half_planes, stop, kernel).run();
}

std::vector<MeetingPair> meeting_pairs(const SharedLeaves& leaves) {
  std::unordered_map<std::uint64_t, Box<2>> hulls;
  for (std::size_t k = 0; k < leaves.boxes.size(); ++k) {
    const std::vector<int>& alive = leaves.cover.alive[k];
    for (std::size_t i = 0; i < alive.size(); ++i)
      for (std::size_t j = i + 1; j < alive.size(); ++j) {
        const std::uint64_t pair =
            (static_cast<std::uint64_t>(alive[i]) << 32) | static_cast<std::uint64_t>(alive[j]);
        Box<2>& box = hulls.try_emplace(pair, kNothing).first->second;
        box = hull(box, leaves.boxes[k]);
      }
  }
  std::vector<MeetingPair> pairs;
  pairs.reserve(hulls.size());
  for (const auto& [pair, box] : hulls)
    pairs.push_back({{static_cast<int>(pair >> 32), static_cast<int>(pair & 0xffffffff)}, box});
  std::sort(pairs.begin(), pairs.end(),
            [](const MeetingPair& a, const MeetingPair& b) { return a.curves < b.curves; });
  return pairs;
}

std::vector<Box<2>> hulls_of_curves(const SharedLeaves& leaves, int count) {
  std::vector<Box<2>> hulls(static_cast<std::size_t>(count), kNothing);
  for (std::size_t k = 0; k < leaves.boxes.size(); ++k)
    for (const int c : leaves.cover.alive[k]) {
      Box<2>& box = hulls[static_cast<std::size_t>(c)];
      box = hull(box, leaves.boxes[k]);
    }
  return hulls;
}

Box<2> root_around(const Box<2>& part, const Box<2>& whole) {
  if (part.width(0) > kHardlySmaller * whole.width(0) &&
      part.width(1) > kHardlySmaller * whole.width(1))
    return whole;
  Box<2> root = subdivision_root(part);
  for (int i = 0; i < 2; ++i) {
    root.lo[i] = std::max(root.lo[i], whole.lo[i]);
    root.hi[i] = std::min(root.hi[i], whole.hi[i]);
  }
  return root;
}

}  // namespace encase
