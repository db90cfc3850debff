// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/analytic_gaps.hpp"
#include "common/box_tests.hpp"
#include "common/cubic_source.hpp"
#include "common/patch.hpp"
#include "common/sought.hpp"
#include "common/subdivision.hpp"
#include "common/tile.hpp"

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

/// Two polynomials on one box, from which the cubic nets on boxes within it are made.
struct CubicBase {
  std::array<CubicSource, 2> source;
  std::array<const Tile*, 2> tile;  ///< that they come from; their rectangles contain the box
  Chart chart;                      ///< of the box
  int expanded_at;                  ///< the level of the box that was expanded from the tiles
};

/// The subdivision of a box of the plane, with a patch of one polynomial on the boxes, or with
/// cubic nets of two: then their common zeros are sought, and a box on which one keeps a sign is
/// excluded.
///
/// Depth first, so that what is at hand stays in the cache, but in bands: what is not settled at
/// the end of one band of widths waits until everything else has come as far, so that a budget is
/// not spent on one place. Nothing is allocated per box.
template <int N>
class PlaneSubdivision {
 public:
  /// What `visit` is given: a box and the patches on it.
  struct Node {
    Box<2> box;
    std::conditional_t<N == 1, Patch, CubicSystem> net;
    /// The tiles that the net comes from. Their rectangles contain the box.
    std::array<const Tile*, N> tile{};
    int expanded_at = 0;                   ///< the level of the box that the patch was made for
    const CubicBase* base = nullptr;       ///< on a box that contains this one
    std::array<std::int64_t, 2> number{};  ///< of this part of that one (common/cubic_source.hpp)
    /// The part, in the box's coordinates, outside of which nothing that is sought lies. A visitor
    /// may set it; halves that do not meet it are settled as excluded.
    Box<2> part;
    int level = 0;        ///< number of halvings
    bool inside = false;  ///< known to lie in all half planes
    bool has_net = false;
    bool excluded = false;
  };

  PlaneSubdivision(Sought<N> sought, const std::vector<Line>& half_planes,
                   const SubdivisionLimits& limits, Kernel& kernel)
      : sought_(std::move(sought)),
        half_planes_(half_planes),
        limits_(limits),
        kernel_(kernel),
        stack_(taken_over(&spare_stack(), kLevelsPerBand + 2)) {
    for (const auto& leaf : sought_.leaves)
      for (const TiledFunction* f : leaf.polynomials) has_gaps_ = has_gaps_ || !f->gaps().empty();
    if (N == 2) bases_ = taken_over(&spare_bases(), kLevelsPerBand + 1);
  }
  PlaneSubdivision(const PlaneSubdivision&) = delete;
  PlaneSubdivision& operator=(const PlaneSubdivision&) = delete;
  ~PlaneSubdivision() {
    spare_stack() = std::move(stack_);
    spare_bases() = std::move(bases_);
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
  static constexpr int kLevelsPerBand = 18;

  /// A tile made for one box, where those of the tree are too coarse; those of a node's ancestors
  /// stay valid while it is at work.
  struct Local {
    int level;
    std::unique_ptr<Tile> tile;
  };

  // The arrays of one subdivision serve the thread's next one: else what many pairs leave behind
  // lies between, and memory ends up in pieces.
  static std::unique_ptr<Node[]>& spare_stack() {
    static thread_local std::unique_ptr<Node[]> spare;
    return spare;
  }
  static std::unique_ptr<CubicBase[]>& spare_bases() {
    static thread_local std::unique_ptr<CubicBase[]> spare;
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
  bool expand_base(Node& node);
  bool restrict_base(Node& node);
  bool use_base(Node& node, CubicBase* base);
  template <class Net>
  bool make_net(const Node& node, int i, Net* net, const Tile** tile);
  bool outside(Node& node) const;
  const Tile* local_tile(const Node& node, int i, int bits);
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
  std::array<std::vector<Local>, N> local_;
  std::unique_ptr<CubicBase[]> bases_;  ///< those of a node's ancestors, by level in the band
  int first_level_ = 0;                 ///< of the band
  int count_ = Patch::kMaxCount;        ///< of the patches' coefficients in either variable
  int boxes_ = 0;                       ///< visited; those that had to wait twice
  int deepest_ = 0;                     ///< the level beyond which nothing is halved
  bool has_gaps_ = false;               ///< some function is not analytic everywhere
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
  if (N == 1) count_ = patch_count(polynomials_[0]->polynomial().degree());
  for (auto& list : local_) list.clear();
  const int last_level = std::min(level + kLevelsPerBand, deepest_);
  first_level_ = level;
  int top = 0;
  stack_[0].box = box;
  stack_[0].level = level;
  stack_[0].inside = stack_[0].has_net = stack_[0].excluded = false;
  stack_[0].part = kWhole;
  stack_[0].tile = {};
  stack_[0].base = nullptr;
  int here = 0;
  while (top >= 0) {
    Node& node = stack_[top];
    // Those of ancestors stay: not that of the other half, which holds nothing of this one.
    for (auto& list : local_)
      while (!list.empty() && list.back().level >= node.level) list.pop_back();
    ++here;
    if (++boxes_ % 64 == 0 && !stopped_) stopped_ = limits_.stop && limits_.stop();
    const int token = stopped_ ? cover::kUnresolved : token_of(node, visit);
    const bool split = token <= cover::kSplitX && token >= cover::kSplitZ;
    if (!split) {
      settle(token, node);
      --top;
      continue;
    }
    const int axis = cover::kSplitX - token;
    Box<2> lower, upper;
    const bool divisible = halve_box(node.box, axis, &lower, &upper) &&
                           node.box.width(axis) > limits_.smallest * sought_.root.width(axis);
    if (!divisible || node.level >= last_level || here > budget) {
      tokens_.push_back(kWaiting);
      waiting_.push_back({node.box, divisible ? node.level : deepest_, leaf});
      --top;
      continue;
    }
    tokens_.push_back(cover::kSplitX - axis);
    const Box<2> part = node.part;
    // The node becomes its upper half, the lower one goes on top of it.
    Node& second = node;
    Node& first = stack_[++top];
    first.tile = second.tile;
    first.expanded_at = second.expanded_at;
    first.base = second.base;
    first.number = second.number;
    first.number[axis] = number_of_half(second.number[axis], false);
    second.number[axis] = number_of_half(second.number[axis], true);
    first.level = ++second.level;
    first.inside = second.inside;
    first.has_net = second.has_net;
    first.box = lower;
    second.box = upper;
    first.excluded = part.lo[axis] > 0;
    second.excluded = part.hi[axis] < 0;
    if (second.has_net) {
      if constexpr (N == 1) {
        halve(second.net, axis, true, &first.net, &second.net);
      } else {
        const auto excluded = halve(second.net, axis, &first.net, &second.net);
        first.excluded = first.excluded || excluded[0];
        second.excluded = second.excluded || excluded[1];
      }
    }
    first.part = second.part = part;
    // After one halving across an axis the patches tell more than the part.
    for (Node* child : {&first, &second}) {
      child->part.lo[axis] = -1;
      child->part.hi[axis] = 1;
    }
  }
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
  if (!provide_net(node)) return node.excluded ? cover::kExcluded : wider_axis(node.box);
  if (has_gaps_)
    for (int i = 0; i < N; ++i)
      if (polynomials_[i]->wants_smaller(*node.tile[i]) && !tells(node.net, i))
        return wider_axis(node.box);
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

/// How far a net may be from its polynomial, beside its size. Small boxes are where curves touch or
/// nearly touch, and only the last digits tell them apart.
constexpr int kUsualLevels = 18;  // of halvings
inline double tolerated(int level, double usual) { return level > kUsualLevels ? 0x1p-26 : usual; }

/// Whether what is known of the tile holds on the box.
inline bool holds(const Tile& tile, const Box<2>& box) {
  constexpr double kReach = 1 + 0x1p-11;  // with room for roundings
  for (int i = 0; i < 2; ++i) {
    const double reach = kReach * tile.half[i];
    if (!(box.lo[i] - tile.center[i] >= -reach && box.hi[i] - tile.center[i] <= reach))
      return false;
  }
  return true;
}

inline bool coarse(const Patch& patch, int level) {
  const double part = tolerated(level, 0x1p-4);
  const double slope_radius = std::max(patch.slope_radius[0], patch.slope_radius[1]);
  return !(patch.radius <= part * patch.magnitude() &&
           slope_radius <= part * (patch.hi - patch.lo));
}

inline bool coarse(const CubicSource& source, int level) {
  return !(source.radius <= tolerated(level, 0x1p-4) * source.size);
}

inline bool coarse(const CubicSystem& system, int level) {
  const double of_value = tolerated(level, 0.06), of_slope = tolerated(level, 4);
  for (int i = 0; i < 2; ++i) {
    const double slope_radius = std::max(system.slope_radius[i][0], system.slope_radius[i][1]);
    if (!(system.radius[i] <= of_value * system.magnitude(i) &&
          slope_radius <= of_slope * (system.hi[i] - system.lo[i])))
      return true;
  }
  return false;
}

/// Whether the sign of an expression is proved, so that its slopes need not be known better.
inline bool is_settled(const TiledFunction& f, const Patch& patch) {
  return !f.polynomial().is_polynomial() && patch.sign().has_value();
}
inline bool is_settled(const TiledFunction& f, const CubicSource& source) {
  return !f.polynomial().is_polynomial() && source.has_sign();
}

/// Whether a net on the box is not worth trying. (Nets tell by themselves how far they are; of high
/// degrees they are tried on every other level.)
inline bool hopeless(const Tile& tile, int level) { return tile.degree > 7 && level % 2 == 1; }

/// Whether a smaller box should have the first net.
inline bool too_large(const Patch& patch, int level) {
  return coarse(patch, level) && patch.left_out > 0.5 * patch.radius;
}
/// (What a source lacks must not matter on parts of its box, the more of which there are the larger
/// it is.)
inline bool too_large(const CubicSource& source, int level) {
  return source.left_out > std::ldexp(source.size, std::min(-10, level - 18)) &&
         source.left_out > 0.5 * source.radius;
}

/// Whether a net says anything of a function.
inline bool tells(const Patch& patch, int) { return patch.radius < 0.25 * patch.magnitude(); }
inline bool tells(const CubicSystem& system, int i) {
  return system.radius[i] < 0.25 * system.magnitude(i);
}

/// Makes the node's net where it is missing or too coarse; false if there is none, because the box
/// is too large or excluded at once.
template <>
inline bool PlaneSubdivision<1>::provide_net(Node& node) {
  if (node.has_net && (node.expanded_at + 2 > node.level || !coarse(node.net, node.level)))
    return true;
  if (!make_net(node, 0, &node.net, &node.tile[0])) return false;
  node.expanded_at = node.level;
  node.has_net = true;
  return true;
}

/// Whether the node's cubic nets, which come from its own base, are close enough to the
/// polynomials, or prove at once that the box is excluded.
template <>
inline bool PlaneSubdivision<2>::use_base(Node& node, CubicBase* base) {
  base->chart = chart_of(node.box);
  node.base = base;
  node.number = {1, 1};
  node.has_net = true;
  node.excluded = node.net.excluded();
  return node.excluded || !coarse(node.net, node.level);
}

/// Gives the node a base on its own box from the tiles; false if that is too large, or excluded at
/// once.
template <>
inline bool PlaneSubdivision<2>::expand_base(Node& node) {
  CubicBase& base = bases_[node.level - first_level_];
  base.tile = node.tile;
  base.expanded_at = node.level;
  for (int i = 0; i < 2; ++i) {
    CubicSource& source = base.source[i];
    source.radius = node.has_net ? node.net.radius[i] : HUGE_VAL;
    if (!make_net(node, i, &source, &base.tile[i])) return false;
    node.excluded = source.has_sign();
    if (node.excluded) return false;
  }
  node.tile = base.tile;
  cut_off(base.source, &node.net);
  use_base(node, &base);
  return true;
}

/// The same from the last base, if something can be expected of it; whether it serves.
template <>
inline bool PlaneSubdivision<2>::restrict_base(Node& node) {
  const CubicBase& from = *node.base;
  CubicBase& base = bases_[node.level - first_level_];
  if (&base == &from) return false;
  const double half = std::max(node.box.width(0) / (2 * from.chart[0].half),
                               node.box.width(1) / (2 * from.chart[1].half));
  if (node.level <= kUsualLevels)
    for (const CubicSource& source : from.source)
      if (source.radius > 0.1 * source.size * half) return false;
  if (node.number[0] > 0 && node.number[1] > 0)
    restrict_to(from.source, node.number, &base.source, &node.net);
  else
    restrict_to(from.source, part_of(from.chart, node.box), &base.source, &node.net);
  base.tile = from.tile;
  base.expanded_at = from.expanded_at;
  return use_base(node, &base);
}

template <>
inline bool PlaneSubdivision<2>::provide_net(Node& node) {
  if (node.has_net && !coarse(node.net, node.level)) return true;
  if (node.base && restrict_base(node)) return !node.excluded;
  // From the tiles, unless that was done on a box that is hardly larger.
  const int between = node.level <= kUsualLevels ? 4 : 1;
  if (!node.base || node.base->expanded_at + between <= node.level)
    if (!expand_base(node)) return false;
  return node.has_net && !node.excluded;
}

/// A net on the node's box from a tile, which replaces the one that was used last; `net->radius` is
/// what was known with that.
template <int N>
template <class Net>
bool PlaneSubdivision<N>::make_net(const Node& node, int i, Net* net, const Tile** used) {
  const auto make = [&](const Tile& tile) {
    if constexpr (std::is_same_v<Net, Patch>)
      expand(tile, node.box, count_, net);
    else
      expand(tile, node.box, net);
  };
  const bool has_local = !local_[i].empty();  // of an ancestor
  if (node.level < 2 * kLevelsPerBand || has_local) {
    const Tile* tile =
        has_local ? local_[i].back().tile.get() : &polynomials_[i]->at(node.box.center());
    Point<2> parts;
    for (int axis = 0; axis < 2; ++axis)
      parts[axis] = 0.5 * node.box.width(axis) / tile->half[axis];
    const double part = std::max(parts[0], parts[1]);
    if (part > 1.01) return false;
    const bool within = holds(*tile, node.box);
    if (!*used && hopeless(*tile, node.level)) return false;
    if (within) {
      make(*tile);
      if (!*used && too_large(*net, node.level)) return false;
      *used = tile;
      // What is lost by the low degree shrinks with the box.
      if (!coarse(*net, node.level) || net->left_out > 0.5 * net->radius) return true;
    }
  }
  // A tile of the box's own, in double-doubles, then in MPFR.
  for (int bits = kernel_.start_bits; bits > 0; bits = kernel_.next(bits)) {
    if (bits == Kernel::kExtendedBits) continue;
    const double before = *used ? net->radius : HUGE_VAL;
    *used = local_tile(node, i, bits);
    make(**used);
    if (!coarse(*net, node.level) || polynomials_[i]->wants_smaller(**used) ||
        is_settled(*polynomials_[i], *net) ||
        (bits > Kernel::kDoubleBits && !(net->radius < 0.5 * before)))
      break;
  }
  return true;
}

template <int N>
const Tile* PlaneSubdivision<N>::local_tile(const Node& node, int i, int bits) {
  if (local_[i].empty() || local_[i].back().level != node.level)
    local_[i].push_back({node.level, std::make_unique<Tile>()});
  polynomials_[i]->expand(node.box, bits, local_[i].back().tile.get());
  return local_[i].back().tile.get();
}

}  // namespace encase
