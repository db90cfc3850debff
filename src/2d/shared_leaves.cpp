// SPDX-License-Identifier: MIT
#include "2d/shared_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "common/analytic_gaps.hpp"
#include "common/patch.hpp"
#include "common/plane_subdivision.hpp"

namespace encase {
namespace {

/// With so few curves alive a box is a leaf.
constexpr std::size_t kFew = 2;
/// So many halvings in a row that took no curve away: twice across either axis.
constexpr int kInVain = 4;
/// With more curves a halving counts as long as it takes some away from the other half.
constexpr std::size_t kSeveral = 8;
constexpr int kDeepest = 40;  // levels of halvings
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
  SharedSubdivision(NestedTiles& curves, const std::vector<Line>& half_planes,
                    const std::function<bool()>& stop, Kernel& kernel)
      : curves_(curves),
        half_planes_(half_planes),
        stop_(stop),
        kernel_(kernel),
        lower_(kDeepest + 1) {}

  SharedLeaves run() {
    // What takes too many boxes is begun again, with leaves of more curves everywhere.
    int visited = 0;
    for (few_ = kFew; !subdivide(); few_ *= 2) visited += result_.visited;
    result_.visited += visited;
    return std::move(result_);
  }

 private:
  /// False if it takes too many boxes.
  bool subdivide() {
    result_ = {};
    result_.cover.root = curves_.box();
    Part whole{result_.cover.root, false, {}};
    whole.alive.resize(static_cast<std::size_t>(curves_.size()));
    for (std::size_t c = 0; c < whole.alive.size(); ++c) whole.alive[c].curve = static_cast<int>(c);
    look_at(0, &whole);
    visit(0, 0, whole);
    return stopped_ || result_.visited < kMostBoxes;
  }

  /// A box, whether it is known to lie in all half planes, and the curves that may have zeros
  /// there.
  struct Part {
    Box<2> box;
    bool inside = false;
    std::vector<Alive> alive;
  };
  /// What looking at a part has brought.
  enum class Look { Outside, Gained, Nothing };

  Look look_at(int level, Part* part);
  void visit(int level, int in_vain, Part& part);
  bool provide_patch(const Box<2>& box, int level, Alive* alive);

  NestedTiles& curves_;
  const std::vector<Line>& half_planes_;
  const std::function<bool()>& stop_;
  Kernel& kernel_;
  SharedLeaves result_;
  bool stopped_ = false;
  std::size_t few_ = kFew;
  /// The lower halves, by level. (An upper half takes its parent's place.)
  std::vector<Part> lower_;
};

/// Makes the patch where it is missing or has become coarse. False if there is none, or none that
/// tells much: then a smaller box may.
bool SharedSubdivision::provide_patch(const Box<2>& box, int level, Alive* alive) {
  const auto coarse = [&] { return !(alive->patch.radius <= 0x1p-4 * alive->patch.magnitude()); };
  const bool known = alive->expanded_at >= 0;
  if (known && (alive->expanded_at + 2 > level || !coarse())) return !coarse();
  TiledFunction& f = curves_.about(alive->curve, box);
  if (!f.gaps().empty()) {
    // Nothing more can be told within a gap.
    const Relation here = relation(box, f.gaps());
    if (here != Relation::Apart) return here == Relation::Within;
  }
  const Tile& tile = f.at(box.center());
  for (int axis = 0; axis < 2; ++axis)
    if (0.5 * box.width(axis) > 1.01 * tile.half[axis]) return false;
  expand(tile, box, patch_count(f.polynomial().degree()), &alive->patch);
  alive->expanded_at = level;
  return !coarse();
}

/// Takes away the curves that are proved to have no zero in the part. A patch that tells little yet
/// counts as a gain: those of smaller boxes may tell more.
SharedSubdivision::Look SharedSubdivision::look_at(int level, Part* part) {
  if (!part->inside) {
    const std::optional<bool> where = lies_inside(part->box, half_planes_);
    if (where == false) return Look::Outside;
    part->inside = where.has_value();
  }
  std::vector<Alive>& alive = part->alive;
  std::size_t left = 0;
  bool sharp = true;
  for (std::size_t k = 0; k < alive.size(); ++k) {
    const bool tells = provide_patch(part->box, level, &alive[k]);
    if (alive[k].expanded_at >= 0 && alive[k].patch.sign()) {
      kernel_.count(Kernel::kDoubleBits);
      continue;
    }
    sharp = sharp && tells;
    if (left < k) alive[left] = alive[k];
    ++left;
  }
  const bool gained = left < alive.size() || !sharp;
  alive.resize(left);
  return gained ? Look::Gained : Look::Nothing;
}

/// Subdivides a part that has been looked at. (In a wide region most curves pass the middle, and
/// what leads there are boxes that all of them meet beside others that few do: a halving that takes
/// curves from one half is not in vain for the other, as long as they are several.)
void SharedSubdivision::visit(int level, int in_vain, Part& part) {
  SharedCover& cover = result_.cover;
  if (result_.visited++ % 64 == 0 && !stopped_) stopped_ = stop_ && stop_();
  if (stopped_) {
    cover.tokens.push_back(cover::kUnresolved);
    result_.unresolved.push_back(part.box);
    return;
  }
  Part& lower = lower_[static_cast<std::size_t>(level)];
  Part& upper = part;
  const Box<2> box = part.box;
  const int axis = cover::kSplitX - wider_axis(box);
  if (part.alive.size() <= few_ || in_vain >= kInVain || level == kDeepest ||
      result_.visited >= kMostBoxes || !halve_box(box, axis, &lower.box, &upper.box)) {
    cover.tokens.push_back(static_cast<int>(cover.alive.size()));
    auto& names = cover.alive.emplace_back();
    names.reserve(part.alive.size());
    for (const Alive& a : part.alive) names.push_back(a.curve);
    result_.boxes.push_back(box);
    return;
  }
  cover.tokens.push_back(cover::kSplitX - axis);
  lower.inside = upper.inside;
  lower.alive.resize(upper.alive.size());
  for (std::size_t k = 0; k < upper.alive.size(); ++k) {
    Alive &below = lower.alive[k], &above = upper.alive[k];
    below.curve = above.curve;
    below.expanded_at = above.expanded_at;
    if (above.expanded_at >= 0) halve(above.patch, axis, false, &below.patch, &above.patch);
  }
  const std::size_t before = upper.alive.size();
  const std::array<Part*, 2> halves{&lower, &upper};
  const std::array<Look, 2> looks{look_at(level + 1, &lower), look_at(level + 1, &upper)};
  const bool several = before > kSeveral;
  for (int k = 0; k < 2; ++k) {
    const bool gained = looks[k] == Look::Gained || (several && looks[1 - k] == Look::Gained);
    if (looks[k] == Look::Outside) {
      ++result_.visited;
      cover.tokens.push_back(cover::kOutside);
      continue;
    }
    visit(level + 1, gained ? 0 : in_vain + 1, *halves[k]);
  }
}

constexpr Box<2> kNothing{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

}  // namespace

SharedLeaves share_leaves(NestedTiles& curves, const std::vector<Line>& half_planes,
                          const std::function<bool()>& stop, Kernel& kernel) {
  return SharedSubdivision(curves, half_planes, stop, kernel).run();
}

std::vector<MeetingPair> meeting_pairs(const SharedLeaves& leaves) {
  struct Meeting {
    int first, second, leaf;
  };
  std::vector<Meeting> meetings;
  for (std::size_t k = 0; k < leaves.boxes.size(); ++k) {
    const std::vector<int>& alive = leaves.cover.alive[k];
    for (std::size_t i = 0; i < alive.size(); ++i)
      for (std::size_t j = i + 1; j < alive.size(); ++j)
        meetings.push_back({alive[i], alive[j], static_cast<int>(k)});
  }
  std::sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) {
    return std::tie(a.first, a.second, a.leaf) < std::tie(b.first, b.second, b.leaf);
  });
  std::vector<MeetingPair> pairs;
  for (const Meeting& m : meetings) {
    const std::array<int, 2> curves{m.first, m.second};
    if (pairs.empty() || pairs.back().curves != curves) pairs.push_back({curves, {}, kNothing});
    MeetingPair& pair = pairs.back();
    const Box<2>& leaf = leaves.boxes[static_cast<std::size_t>(m.leaf)];
    pair.leaves.push_back(leaf);
    pair.hull = hull(pair.hull, leaf);
  }
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
