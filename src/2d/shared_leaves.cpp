// SPDX-License-Identifier: MIT
#include "2d/shared_leaves.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "common/analytic_gaps.hpp"
#include "common/patch.hpp"
#include "common/plane_subdivision.hpp"
#include "common/strip.hpp"

namespace encase {
namespace {

/// With so few curves alive, or so few pairs of several that may meet, a box is a leaf.
constexpr std::size_t kFew = 2;
constexpr int kFewPairs = 2;
/// So many halvings in a row that took no curve away: four times across either axis.
constexpr int kInVain = 8;
/// With more curves a halving counts as long as it takes some away from the other half, and it is
/// not asked which pairs may meet.
constexpr std::size_t kSeveral = 8;
constexpr int kDeepest = 40;  // levels of halvings
constexpr int kMostBoxes = 200000, kMostBoxesPerCurve = 4000;
/// A part with both widths above this fraction of the whole's is treated as the whole.
constexpr double kHardlySmaller = 0.6;
/// So many leaves in which two curves are apart may be excluded with what is between them: a
/// checker has to tell them apart again.
constexpr std::size_t kMostTogether = 256;
constexpr std::size_t kTokensPerLeaf = 8;  // of what is sought in leaves, about

/// A curve in a box where it may have zeros, with its patch there if it has one already.
struct Alive {
  Alive() {}  // the patch is not set: most of it is overwritten soon

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
        most_boxes_(std::min(kMostBoxes, kMostBoxesPerCurve * curves.size())),
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
    Part whole;
    whole.box = result_.cover.root;
    path_ = {};
    whole.hold(static_cast<std::size_t>(curves_.size()));
    for (std::size_t c = 0; c < whole.size(); ++c) whole.alive(c).curve = static_cast<int>(c);
    look_at(0, &whole);
    visit(0, 0, whole);
    return stopped_ || result_.visited < most_boxes_;
  }

  /// A box, whether it is known to lie in all half planes, and the curves that may have zeros
  /// there.
  struct Part {
    Box<2> box;
    bool inside = false;
    bool sharp = true;        ///< all their patches tell much
    std::vector<Alive> held;  ///< what `places` names, and others that do not count
    std::vector<int> places;

    std::size_t size() const { return places.size(); }
    Alive& alive(std::size_t k) { return held[static_cast<std::size_t>(places[k])]; }
    const Alive& alive(std::size_t k) const { return held[static_cast<std::size_t>(places[k])]; }
    /// So many, the first ones held.
    void hold(std::size_t count) {
      if (held.size() < count) held.resize(count);
      places.resize(count);
      std::iota(places.begin(), places.end(), 0);
    }
  };
  /// What looking at a part has brought.
  enum class Look { Outside, Gained, Nothing };

  Look look_at(int level, Part* part);
  void visit(int level, int in_vain, Part& part);
  int find_open_pairs(const Part& part, int most);
  void add_leaf(const Part& part);
  bool provide_patch(const Box<2>& box, int level, Alive* alive);

  NestedTiles& curves_;
  const std::vector<Line>& half_planes_;
  const std::function<bool()>& stop_;
  Kernel& kernel_;
  SharedLeaves result_;
  SharedLeaves::Path path_;  ///< to the box at hand
  std::vector<Strip> strips_;
  std::vector<char> open_;
  bool stopped_ = false;
  const int most_boxes_;
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
  if (const auto& gaps = curves_.about(alive->curve, box).gaps(); !gaps.empty()) {
    // Nothing more can be told within a gap.
    const Relation here = relation(box, gaps);
    if (here != Relation::Apart) return here == Relation::Within;
  }
  // (The tiles around the middle are not halves of the same box; this one may reach beyond.)
  for (TiledFunction* f : {&curves_.about(alive->curve, box), &curves_.whole(alive->curve)}) {
    const Tile& tile = f->at(box.center());
    if (!holds(tile, box)) continue;
    expand(tile, box, patch_count(f->polynomial().degree()), &alive->patch);
    alive->expanded_at = level;
    return !coarse();
  }
  return false;
}

/// Takes away the curves that are proved to have no zero in the part. A patch that tells little yet
/// counts as a gain: those of smaller boxes may tell more.
SharedSubdivision::Look SharedSubdivision::look_at(int level, Part* part) {
  if (!part->inside) {
    const std::optional<bool> where = lies_inside(part->box, half_planes_);
    if (where == false) return Look::Outside;
    part->inside = where.has_value();
  }
  std::vector<int>& places = part->places;
  std::size_t left = 0;
  part->sharp = true;
  for (const int place : places) {
    Alive& alive = part->held[static_cast<std::size_t>(place)];
    const bool tells = provide_patch(part->box, level, &alive);
    if (alive.expanded_at >= 0 && alive.patch.sign()) {
      kernel_.count(Kernel::kDoubleBits);
      continue;
    }
    part->sharp = part->sharp && tells;
    places[left++] = place;
  }
  const bool gained = left < places.size() || !part->sharp;
  places.resize(left);
  return gained ? Look::Gained : Look::Nothing;
}

/// The pairs of curves that may have common zeros in the part: their number, and in `open_`, by the
/// second and then the first one's place among those alive. Ends with the first beyond `most`.
int SharedSubdivision::find_open_pairs(const Part& part, int most) {
  strips_.resize(part.size());
  open_.clear();
  int count = 0;
  for (std::size_t j = 0; j < part.size(); ++j) {
    const Alive& second = part.alive(j);
    if (second.expanded_at >= 0) strips_[j] = strip_of(second.patch);
    for (std::size_t i = 0; i < j; ++i) {
      const Alive& first = part.alive(i);
      const bool open = first.expanded_at < 0 || second.expanded_at < 0 ||
                        !apart(first.patch, strips_[i], second.patch, strips_[j]);
      open_.push_back(open);
      count += open;
      if (count > most) return count;
    }
  }
  return count;
}

/// Makes a part a leaf; its open pairs have been found.
void SharedSubdivision::add_leaf(const Part& part) {
  const int leaf = static_cast<int>(result_.boxes.size());
  result_.cover.tokens.push_back(leaf);
  auto& names = result_.cover.alive.emplace_back();
  names.reserve(part.size());
  for (std::size_t k = 0; k < part.size(); ++k) names.push_back(part.alive(k).curve);
  result_.boxes.push_back(part.box);
  result_.paths.push_back(path_);
  std::size_t pair = 0;
  for (std::size_t j = 0; j < names.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      result_.meetings.push_back({names[i], names[j], leaf, !open_[pair++]});
  for (const char open : open_)
    if (!open) kernel_.count(Kernel::kDoubleBits);
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
  const bool several = part.size() > kSeveral;
  const bool few_open = !several && part.sharp && find_open_pairs(part, kFewPairs) <= kFewPairs;
  if (part.size() <= few_ || few_open || in_vain >= kInVain || level == kDeepest ||
      result_.visited >= most_boxes_ || !halve_box(box, axis, &lower.box, &upper.box)) {
    if (!few_open) find_open_pairs(part, std::numeric_limits<int>::max());
    path_.length = level;
    add_leaf(part);
    return;
  }
  cover.tokens.push_back(cover::kSplitX - axis);
  const std::uint64_t bit = std::uint64_t{1} << level;
  path_.across_y = axis == 1 ? path_.across_y | bit : path_.across_y & ~bit;
  lower.inside = upper.inside;
  lower.hold(upper.size());
  for (std::size_t k = 0; k < upper.size(); ++k) {
    Alive &below = lower.alive(k), &above = upper.alive(k);
    below.curve = above.curve;
    below.expanded_at = above.expanded_at;
    if (above.expanded_at >= 0) halve(above.patch, axis, false, &below.patch, &above.patch);
  }
  const std::array<Part*, 2> halves{&lower, &upper};
  const std::array<Look, 2> looks{look_at(level + 1, &lower), look_at(level + 1, &upper)};
  for (int k = 0; k < 2; ++k) {
    path_.upper = k == 1 ? path_.upper | bit : path_.upper & ~bit;
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

bool bit(std::uint64_t bits, int k) { return (bits >> k & 1) != 0; }

/// Of the way to the smallest box in which both leaves are.
int common_length(const SharedLeaves::Path& a, const SharedLeaves::Path& b) {
  return std::min({std::countr_zero(a.upper ^ b.upper), a.length, b.length});
}

/// Writes a part of the subdivision as tokens: the ways to some of its leaves, in preorder. What
/// else is there is excluded.
class Pruning {
 public:
  /// Of a box that all leaves are in, at the end of so much of their paths.
  explicit Pruning(int top) : top_(top) {}

  int top() const { return top_; }
  /// The next token is to be the leaf's.
  void go_to(const SharedLeaves::Path& leaf, std::vector<int>* tokens) {
    int level = top_;
    if (at_) {
      // The box that both are in has been halved.
      level = common_length(*at_, leaf) + 1;
      leave(level, tokens);
    }
    for (; level < leaf.length; ++level) {
      tokens->push_back(bit(leaf.across_y, level) ? cover::kSplitY : cover::kSplitX);
      if (bit(leaf.upper, level)) tokens->push_back(cover::kExcluded);
    }
    at_ = &leaf;
  }
  void finish(std::vector<int>* tokens) const { leave(top_, tokens); }

 private:
  void leave(int level, std::vector<int>* tokens) const {
    for (int k = at_->length - 1; k >= level; --k)
      if (!bit(at_->upper, k)) tokens->push_back(cover::kExcluded);
  }

  int top_;
  const SharedLeaves::Path* at_ = nullptr;
};

/// By curves; what is of the same curves stays in its order.
void sort_meetings(int curves, std::vector<Meeting>* meetings) {
  std::vector<Meeting> sorted(meetings->size());
  for (const auto curve : {&Meeting::second, &Meeting::first}) {
    std::vector<std::size_t> place(static_cast<std::size_t>(curves) + 1, 0);
    for (const Meeting& m : *meetings) ++place[static_cast<std::size_t>(m.*curve) + 1];
    std::partial_sum(place.begin(), place.end(), place.begin());
    for (const Meeting& m : *meetings) sorted[place[static_cast<std::size_t>(m.*curve)]++] = m;
    meetings->swap(sorted);
  }
}

}  // namespace

SharedLeaves share_leaves(NestedTiles& curves, const std::vector<Line>& half_planes,
                          const std::function<bool()>& stop, Kernel& kernel) {
  SharedLeaves leaves = SharedSubdivision(curves, half_planes, stop, kernel).run();
  sort_meetings(curves.size(), &leaves.meetings);
  return leaves;
}

std::vector<MeetingPair> meeting_pairs(const SharedLeaves& leaves) {
  std::vector<MeetingPair> pairs;
  const std::vector<Meeting>& all = leaves.meetings;
  for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
    const Meeting& m = all[from];
    while (to < all.size() && all[to].first == m.first && all[to].second == m.second) ++to;
    pairs.push_back({{m.first, m.second}, {&m, to - from}});
  }
  return pairs;
}

Box<2> hull(const SharedLeaves& leaves, const MeetingPair& pair) {
  Box<2> box = kNothing;
  for (const Meeting& m : pair.meetings)
    box = hull(box, leaves.boxes[static_cast<std::size_t>(m.leaf)]);
  return box;
}

Sought<2> sought_in(const SharedLeaves& leaves, const MeetingPair& pair, NestedTiles& curves) {
  const auto path = [&](const Meeting& m) -> const SharedLeaves::Path& {
    return leaves.paths[static_cast<std::size_t>(m.leaf)];
  };
  const bool together = pair.meetings.size() <= kMostTogether;
  Sought<2> sought;
  if (together && pair.open() == 0) {
    sought.root = hull(leaves, pair);
    sought.tokens = {cover::kExcluded};
    return sought;
  }
  const SharedLeaves::Path &first = path(pair.meetings.front()), &last = path(pair.meetings.back());
  Pruning pruning(common_length(first, last));
  sought.root = leaves.cover.root;
  for (int level = 0; level < pruning.top(); ++level) {
    Box<2> lower, upper;
    halve_box(sought.root, bit(first.across_y, level) ? 1 : 0, &lower, &upper);
    sought.root = bit(first.upper, level) ? upper : lower;
  }
  sought.tokens.reserve(kTokensPerLeaf * pair.meetings.size());
  sought.leaves.reserve(pair.open());
  for (const Meeting& m : pair.meetings) {
    if (m.apart && together) continue;
    pruning.go_to(path(m), &sought.tokens);
    sought.tokens.push_back(m.apart ? cover::kExcluded : Sought<2>::kLeaf);
    if (m.apart) continue;
    const Box<2>& box = leaves.boxes[static_cast<std::size_t>(m.leaf)];
    sought.leaves.push_back({box, {&curves.about(m.first, box), &curves.about(m.second, box)}});
  }
  pruning.finish(&sought.tokens);
  return sought;
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
