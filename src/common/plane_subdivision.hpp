// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/analytic_gaps.hpp"
#include "common/box_tests.hpp"
#include "common/patch_source.hpp"
#include "common/sought.hpp"
#include "common/subdivision.hpp"
#include "common/system_net.hpp"

namespace encase {

/// The token that halves a box across its longer side.
inline int wider_axis(const Box<2>& box) {
  return box.width(1) > box.width(0) ? cover::kSplitY : cover::kSplitX;
}

/// Whether the centre of the box is a double: then its coordinates, and those of its halves, are
/// what patches have.
inline bool halves_exactly(const Box<2>& box) {
  return centered(box.lo[0], box.hi[0]).exact && centered(box.lo[1], box.hi[1]).exact;
}

/// Whether a box is proved to lie in all half planes, or outside of one (on its positive side).
inline std::optional<bool> lies_inside(const Box<2>& box, const std::vector<Line>& half_planes) {
  bool inside = true;
  for (const Line& line : half_planes) {
    double least = line.offset, most = line.offset, magnitude = std::fabs(line.offset);
    for (int i = 0; i < 2; ++i) {
      const double a = line.normal[i] * box.lo[i], b = line.normal[i] * box.hi[i];
      least += std::min(a, b);
      most += std::max(a, b);
      magnitude += std::max(std::fabs(a), std::fabs(b));
    }
    // Six roundings, and what underflows; and rational coefficients are within an ulp of the
    // doubles, also below the normal range.
    double slack = 0x1p-49 * magnitude + 0x1p-1000;
    if (line.rational)
      for (int i = 0; i < 2; ++i)
        slack += 0x1p-1000 * (1 + std::max(std::fabs(box.lo[i]), std::fabs(box.hi[i])));
    if (least > slack) return false;
    inside = inside && most < -slack;
  }
  if (inside) return true;
  return std::nullopt;
}

/// The subdivision of a box of the plane, with a patch of one polynomial on the boxes, or with
/// nets of two: then their common zeros are sought, and a box on which one keeps a sign is
/// excluded.
///
/// Depth first, so that what is at hand stays in the cache, but in bands: what is not settled at
/// the end of one band of widths waits until everything else has come as far, so that a budget is
/// not spent on one place. Nothing is allocated per box.
template <int N>
class PlaneSubdivision {
 public:
  /// A node but for its nets.
  struct Place {
    Box<2> box;
    /// The tiles that the nets come from. Their rectangles contain the box.
    std::array<const Tile*, N> tile{};
    /// The part, in the box's coordinates, outside of which nothing that is sought lies. A visitor
    /// may set it; halves that do not meet it are settled as excluded.
    Box<2> part;
    int expanded_at = 0;    ///< the level of the box that they were made on
    int level = 0;          ///< number of halvings
    int splits = 0;         ///< that led here from the first box of the band
    std::int8_t opens = 0;  ///< the token of a half of which this is the first quarter, or kNone
    bool inside = false;    ///< known to lie in all half planes
    bool has_net = false;
    bool excluded = false;
  };
  /// What `visit` is given.
  struct Node : Place {
    /// The patch; or where the nets are. Valid if `has_net` is set.
    std::conditional_t<N == 1, Patch, SystemNet*> net;
  };
  /// The token with which a visitor splits a box across both axes.
  static constexpr int kQuarter = Sought<N>::kLeaf - 1;

  PlaneSubdivision(Sought<N> sought, const std::vector<Line>& half_planes,
                   const SubdivisionLimits& limits, Kernel& kernel)
      : sought_(std::move(sought)),
        half_planes_(half_planes),
        limits_(limits),
        kernel_(kernel),
        stack_(taken_over(&spare_stack(), 3 * kLevelsPerBand + 2)) {
    for (const auto& leaf : sought_.leaves)
      for (const TiledFunction* f : leaf.polynomials) has_gaps_ = has_gaps_ || !f->gaps().empty();
    if (N == 2) nets_ = taken_over(&spare_nets(), 4 * (kLevelsPerBand + 1));
  }
  PlaneSubdivision(const PlaneSubdivision&) = delete;
  PlaneSubdivision& operator=(const PlaneSubdivision&) = delete;
  ~PlaneSubdivision() {
    spare_stack() = std::move(stack_);
    spare_nets() = std::move(nets_);
  }
  /// Of a whole box.
  PlaneSubdivision(const std::array<TiledFunction*, N>& polynomials, const Box<2>& root,
                   const std::vector<Line>& half_planes, const SubdivisionLimits& limits,
                   Kernel& kernel)
      : PlaneSubdivision(sought_in<N>(root, polynomials), half_planes, limits, kernel) {}

  /// `visit(node)` returns the token that settles the box, or a split token. Returns the tokens in
  /// preorder (encase/cover.hpp).
  template <class Visit>
  std::vector<int> run(Visit visit);

  /// The polynomials with the tiles that serve the box that is visited.
  const std::array<TiledFunction*, N>& polynomials() const { return polynomials_; }

  /// Whether a box stayed unresolved.
  bool unresolved() const { return unresolved_; }

 private:
  static constexpr Box<2> kWhole{{-1, -1}, {1, 1}};
  static constexpr int kWaiting = Sought<N>::kLeaf;
  static constexpr int kNone = 0;  // no split token
  static constexpr int kLevelsPerBand = 18;

  // The arrays of one subdivision serve the thread's next one: else what many pairs leave behind
  // lies between, and memory ends up in pieces.
  static std::unique_ptr<Node[]>& spare_stack() {
    static thread_local std::unique_ptr<Node[]> spare;
    return spare;
  }
  static std::unique_ptr<SystemNet[]>& spare_nets() {
    static thread_local std::unique_ptr<SystemNet[]> spare;
    return spare;
  }
  template <class T>
  static std::unique_ptr<T[]> taken_over(std::unique_ptr<T[]>* spare, int size) {
    if (*spare) return std::move(*spare);
    return std::make_unique_for_overwrite<T[]>(static_cast<std::size_t>(size));
  }

  template <class Visit>
  void descend(const Box<2>& box, int level, int leaf, int budget, Visit visit);
  template <class Visit>
  int token_of(Node& node, Visit visit);
  std::optional<int> token_at_gap(const Node& node);
  bool provide_net(Node& node);
  static void go_down(Place* place, const Box<2>& box, int levels);
  void split_into_halves(int axis, const Box<2>* halves);
  void restrict_net(const SystemNet& from, const Box<2>& box, Node* node);
  bool split_into_quarters(int axis, const Box<2>* halves);
  static int first_axis(const Node& node);
  int try_smaller(const Box<2>& box) const { return N == 1 ? wider_axis(box) : kQuarter; }
  bool outside(Node& node) const;
  void settle(int token, const Node& node);

  const Sought<N> sought_;
  std::array<TiledFunction*, N> polynomials_{};
  const std::vector<Line>& half_planes_;
  const SubdivisionLimits& limits_;
  Kernel& kernel_;
  std::vector<int> tokens_;
  struct Waiting {
    Box<2> box;
    int level;  ///< number of halvings of the leaf that was sought
    int leaf;   ///< that one
  };
  std::vector<Waiting> waiting_;
  std::unique_ptr<Node[]> stack_;
  int top_ = 0;  ///< of the stack
  std::array<PatchSource, N> sources_;
  /// Those of the first box, then up to four for the children of each of a node's ancestors.
  std::unique_ptr<SystemNet[]> nets_;
  SystemNet fresh_net_;
  int boxes_ = 0;          ///< visited; those that had to wait twice
  int deepest_ = 0;        ///< the level beyond which nothing is halved
  bool has_gaps_ = false;  ///< some function is not analytic everywhere
  bool stopped_ = false;
  bool unresolved_ = false;
};

template <int N>
template <class Visit>
std::vector<int> PlaneSubdivision<N>::run(Visit visit) {
  deepest_ = 2 * static_cast<int>(std::floor(-std::log2(std::max(limits_.smallest, 0x1p-500))));
  tokens_ = sought_.tokens;
  for (std::size_t k = 0; k < sought_.leaves.size(); ++k)
    waiting_.push_back({sought_.leaves[k].box, 0, static_cast<int>(k)});
  while (!waiting_.empty()) {
    const std::vector<Waiting> band = std::move(waiting_);
    const std::vector<int> before = std::move(tokens_);
    waiting_.clear();
    tokens_.clear();
    tokens_.reserve(before.size());
    std::size_t next = 0;
    for (const int token : before) {
      if (token != kWaiting) {
        tokens_.push_back(token);
        continue;
      }
      const Waiting& at = band[next];
      const int budget = (limits_.max_boxes - boxes_) / static_cast<int>(band.size() - next);
      ++next;
      if (stopped_ || budget <= 0 || at.level >= deepest_) {
        tokens_.push_back(cover::kUnresolved);
        unresolved_ = true;
        ++kernel_.decisions.undecided;
      } else {
        descend(at.box, at.level, at.leaf, budget, visit);
      }
    }
  }
  return std::move(tokens_);
}

template <int N>
template <class Visit>
void PlaneSubdivision<N>::descend(const Box<2>& box, int level, int leaf, int budget, Visit visit) {
  polynomials_ = sought_.leaves[static_cast<std::size_t>(leaf)].polynomials;
  int count = 0;
  for (const TiledFunction* f : polynomials_)
    count = std::max(count, patch_count(f->polynomial().degree()));
  for (int i = 0; i < N; ++i) sources_[i] = PatchSource(polynomials_[i], count, N > 1, &kernel_);
  const int last_level = std::min(level + kLevelsPerBand, deepest_);
  Node& first = stack_[0];
  first.box = box;
  first.level = level;
  first.splits = 0;
  first.opens = kNone;
  first.inside = first.has_net = first.excluded = false;
  first.part = kWhole;
  first.tile = {};
  if constexpr (N == 2) first.net = &nets_[0];
  top_ = 0;
  int here = 0;
  while (top_ >= 0) {
    Node& node = stack_[top_];
    if (node.opens != kNone) tokens_.push_back(node.opens);
    for (PatchSource& source : sources_) source.leave(node.level);
    ++here;
    if (++boxes_ % 64 == 0 && !stopped_) stopped_ = limits_.stop && limits_.stop();
    const int token = stopped_ ? cover::kUnresolved : token_of(node, visit);
    const bool is_split = token == kQuarter || (token <= cover::kSplitX && token >= cover::kSplitZ);
    if (!is_split) {
      settle(token, node);
      --top_;
      continue;
    }
    const int axis = token == kQuarter ? first_axis(node) : cover::kSplitX - token;
    Box<2> halves[2];
    const bool divisible = halve_box(node.box, axis, &halves[0], &halves[1]) &&
                           node.box.width(axis) > limits_.smallest * sought_.root.width(axis);
    if (!divisible || node.level >= last_level || here > budget) {
      tokens_.push_back(kWaiting);
      waiting_.push_back({node.box, divisible ? node.level : deepest_, leaf});
      --top_;
      continue;
    }
    tokens_.push_back(cover::kSplitX - axis);
    if constexpr (N == 2)
      if (token == kQuarter && node.level + 2 <= last_level && split_into_quarters(axis, halves))
        continue;
    split_into_halves(axis, halves);
  }
}

/// A place in one of the halves of another, or in a quarter, which are `levels` halvings below.
template <int N>
void PlaneSubdivision<N>::go_down(Place* place, const Box<2>& box, int levels) {
  place->box = box;
  place->level += levels;
  ++place->splits;
  place->opens = kNone;
}

/// The node becomes its upper half, the lower one goes on top of it.
template <int N>
void PlaneSubdivision<N>::split_into_halves(int axis, const Box<2>* halves) {
  Node &upper = stack_[top_], &lower = stack_[++top_];
  const Box<2> box = upper.box;
  const std::array<bool, 2> missed{upper.part.lo[axis] > 0, upper.part.hi[axis] < 0};
  static_cast<Place&>(lower) = upper;
  Node* const child[2] = {&lower, &upper};
  for (int k = 0; k < 2; ++k) {
    go_down(child[k], halves[k], 1);
    child[k]->excluded = missed[k];
    // After one halving across an axis the patches tell more than the part.
    child[k]->part.lo[axis] = -1;
    child[k]->part.hi[axis] = 1;
  }
  if constexpr (N == 1) {
    if (upper.has_net) halve(upper.net, axis, true, &lower.net, &upper.net);
  } else {
    const SystemNet* from = upper.net;
    for (int k = 0; k < 2; ++k) {
      child[k]->net = &nets_[4 * child[k]->splits + k];
      if (upper.has_net && !missed[k]) restrict_net(*from, box, child[k]);
    }
  }
}

/// The nets on a part of a box that has nets.
template <>
inline void PlaneSubdivision<2>::restrict_net(const SystemNet& from, const Box<2>& box,
                                              Node* node) {
  restrict_to(from, part_of(chart_of(box), node->box), node->net);
  node->excluded = node->net->excluded();
}

/// Across which axis a box is halved first, of two.
template <>
inline int PlaneSubdivision<1>::first_axis(const Node& node) {
  return cover::kSplitX - wider_axis(node.box);
}
template <>
inline int PlaneSubdivision<2>::first_axis(const Node& node) {
  // Across the rows of the nets, unless the halves would still be wider that way.
  const double x = node.box.width(0), y = node.box.width(1);
  const bool either = x < 1.9 * y && y < 1.9 * x;
  return either && node.has_net ? node.net->of[0].rows_axis : cover::kSplitX - wider_axis(node.box);
}

/// The node becomes its quarters, in the order of their tokens; but a half that is excluded stays
/// whole. False if they would be thin or are not divisible.
template <>
inline bool PlaneSubdivision<2>::split_into_quarters(int axis, const Box<2>* halves) {
  const int other = 1 - axis;
  const Place place = stack_[top_];
  const SystemNet* from = place.has_net ? stack_[top_].net : nullptr;
  if (wider_axis(halves[0]) != cover::kSplitX - other || (from && from->of[0].rows_axis != axis))
    return false;
  Box<2> boxes[2][2];
  for (int k = 0; k < 2; ++k)
    if (!halve_box(halves[k], other, &boxes[k][0], &boxes[k][1])) return false;
  const auto misses = [&](int a) {
    return std::array<bool, 2>{place.part.lo[a] > 0, place.part.hi[a] < 0};
  };
  std::array<bool, 2> empty = misses(axis);
  const std::array<bool, 2> missed = misses(other);
  SystemNet* const nets = &nets_[4 * (place.splits + 1)];
  const bool several = empty[0] == empty[1] || missed[0] == missed[1];
  std::array<bool, 4> excluded{};
  if (from && several) excluded = quarter(*from, &empty, nets);
  // The last one comes lowest on the stack.
  for (int k = 1; k >= 0; --k) {
    if (empty[k]) {
      Node& half = stack_[top_++];
      static_cast<Place&>(half) = place;
      go_down(&half, halves[k], 1);
      half.excluded = true;
      continue;
    }
    for (int m = 1; m >= 0; --m) {
      Node& node = stack_[top_++];
      static_cast<Place&>(node) = place;
      go_down(&node, boxes[k][m], 2);
      if (m == 0) node.opens = static_cast<std::int8_t>(cover::kSplitX - other);
      node.part = kWhole;
      node.net = nets + k + 2 * m;
      node.excluded = missed[m] || excluded[k + 2 * m];
      if (from && !several && !node.excluded) restrict_net(*from, place.box, &node);
    }
  }
  --top_;
  return true;
}

template <int N>
void PlaneSubdivision<N>::settle(int token, const Node& node) {
  tokens_.push_back(token);
  if (token == cover::kUnresolved) {
    unresolved_ = true;
    ++kernel_.decisions.undecided;
    return;
  }
  int bits = Kernel::kDoubleBits;
  if (node.has_net)
    for (const Tile* tile : node.tile) bits = std::max(bits, tile->bits);
  kernel_.count(bits);
}

template <int N>
template <class Visit>
int PlaneSubdivision<N>::token_of(Node& node, Visit visit) {
  if (node.excluded) return cover::kExcluded;
  // A half that is free need not be asked about.
  if (node.has_net)
    for (int axis = 0; axis < 2; ++axis)
      if ((node.part.hi[axis] < 0 || node.part.lo[axis] > 0) &&
          node.box.width(axis) > 0.3 * node.box.width(1 - axis))
        return cover::kSplitX - axis;
  node.part = kWhole;
  if (!node.inside && outside(node)) return cover::kOutside;
  if (has_gaps_)
    if (const auto token = token_at_gap(node)) return *token;
  if (!provide_net(node)) return node.excluded ? cover::kExcluded : try_smaller(node.box);
  if (has_gaps_)
    for (int i = 0; i < N; ++i)
      if (polynomials_[i]->wants_smaller(*node.tile[i]) && !tells(node.net, i))
        return try_smaller(node.box);
  return visit(node);
}

/// What becomes of a box where a function is not analytic, or of one that such a place meets:
/// another function may exclude it, else it stays unresolved, or is halved.
template <int N>
std::optional<int> PlaneSubdivision<N>::token_at_gap(const Node& node) {
  Relation most = Relation::Apart;
  std::array<bool, N> is_free;
  for (int i = 0; i < N; ++i) {
    const Relation here = relation(node.box, polynomials_[i]->gaps());
    is_free[i] = here == Relation::Apart;
    if (most != Relation::Within && here != Relation::Apart) most = here;
  }
  if (most == Relation::Apart) return std::nullopt;
  if (N > 1)
    for (int i = 0; i < N; ++i)
      if (is_free[i] && sign_on_box(polynomials_[i]->polynomial(), node.box, kernel_))
        return cover::kExcluded;
  return most == Relation::Within ? cover::kUnresolved : wider_axis(node.box);
}

/// Whether the box lies outside one of the half planes; notes if it lies in all of them.
template <int N>
bool PlaneSubdivision<N>::outside(Node& node) const {
  const std::optional<bool> where = lies_inside(node.box, half_planes_);
  node.inside = where == true;
  return where == false;
}

/// Whether a net says anything of a function.
inline bool tells(const Patch& patch, int = 0) { return patch.radius < 0.25 * patch.magnitude(); }
inline bool tells(const SystemNet* net, int i) { return tells(net->of[i]); }

/// Makes the node's net where it is missing or too coarse; false if there is none, because the box
/// is too large or excluded at once.
template <>
inline bool PlaneSubdivision<1>::provide_net(Node& node) {
  if (node.has_net && (node.expanded_at + 2 > node.level || !coarse(node.net, node.level)))
    return true;
  if (!sources_[0].make(node.box, node.level, &node.net, &node.tile[0])) return false;
  node.expanded_at = node.level;
  node.has_net = true;
  return true;
}

template <>
inline bool PlaneSubdivision<2>::provide_net(Node& node) {
  if (node.has_net && !coarse(*node.net, node.level)) return true;
  // From the tiles, unless that was done on a box that is hardly larger.
  const int between = node.level <= kUsualLevels ? 2 : 1;
  if (node.has_net && node.expanded_at + between > node.level) return true;
  SystemNet& net = fresh_net_;
  std::array<const Tile*, 2> tiles = node.tile;
  for (int i = 0; i < 2; ++i) {
    net.of[i].radius = node.has_net ? node.net->of[i].radius : HUGE_VAL;
    if (!sources_[i].make(node.box, node.level, &net.of[i], &tiles[i])) return false;
    node.excluded = net.of[i].sign().has_value();
    if (node.excluded) return false;
  }
  node.tile = tiles;
  node.expanded_at = node.level;
  *node.net = net;
  node.has_net = true;
  return true;
}

}  // namespace encase
