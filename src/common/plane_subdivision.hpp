// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "common/patch.hpp"
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

inline bool meets_none(const std::vector<Box<2>>& boxes, const Box<2>& box) {
  return std::none_of(boxes.begin(), boxes.end(), [&](const Box<2>& b) { return b.meets(box); });
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

/// The subdivision of a box of the plane, with the patches of N polynomials on the boxes. Of
/// several polynomials the common zeros are sought: a box on which one keeps a sign is excluded.
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
    std::array<Patch, N> patch;
    /// The tiles that the patches come from. Their rectangles contain the box.
    std::array<const Tile*, N> tile{};
    std::array<int, N> expanded_at{};  ///< the level of the box that the patch was made for
    /// The part, in the box's coordinates, outside of which nothing that is sought lies. A visitor
    /// may set it; halves that do not meet it are settled as excluded.
    Box<2> part;
    int level = 0;        ///< number of halvings
    bool inside = false;  ///< known to lie in all half planes
    bool has_patches = false;
    bool excluded = false;
  };

  PlaneSubdivision(const std::array<TiledPolynomial*, N>& polynomials, const Box<2>& root,
                   const std::vector<Line>& half_planes, const SubdivisionLimits& limits,
                   Kernel& kernel)
      : polynomials_(polynomials),
        root_(root),
        half_planes_(half_planes),
        limits_(limits),
        kernel_(kernel),
        stack_(std::make_unique_for_overwrite<Node[]>(kLevelsPerBand + 2)) {
    for (const TiledPolynomial* f : polynomials)
      count_ = std::max(count_, patch_count(f->polynomial().degree()));
  }

  /// `visit(node)` returns the token that settles the box, or a split token. Returns the tokens in
  /// preorder (encase/cover.hpp).
  template <class Visit>
  std::vector<int> run(Visit visit);

  /// Whether a box stayed unresolved.
  bool unresolved() const { return unresolved_; }

 private:
  static constexpr Box<2> kWhole{{-1, -1}, {1, 1}};
  static constexpr int kWaiting = cover::kUnresolved - 1;
  static constexpr int kLevelsPerBand = 18;

  /// A tile made for one box, where those of the tree are too coarse; those of a node's ancestors
  /// stay valid while it is at work.
  struct Local {
    int level;
    std::unique_ptr<Tile> tile;
  };

  template <class Visit>
  void descend(const Box<2>& box, int level, int budget, Visit visit);
  template <class Visit>
  int token_of(Node& node, Visit visit);
  bool provide_patches(Node& node);
  bool provide_patch(Node& node, int i);
  bool coarse(const Node& node, int i) const;
  bool outside(Node& node) const;
  const Tile* local_tile(const Node& node, int i, int bits);
  void settle(int token, const Node& node);

  std::array<TiledPolynomial*, N> polynomials_;
  Box<2> root_;
  const std::vector<Line>& half_planes_;
  const SubdivisionLimits& limits_;
  Kernel& kernel_;
  std::vector<int> tokens_;
  struct Waiting {
    Box<2> box;
    int level;
  };
  std::vector<Waiting> waiting_;
  std::unique_ptr<Node[]> stack_;
  std::array<std::vector<Local>, N> local_;
  int count_ = 0;    ///< of the patches' coefficients in either variable
  int boxes_ = 0;    ///< visited; those that had to wait twice
  int deepest_ = 0;  ///< the level beyond which nothing is halved
  bool stopped_ = false;
  bool unresolved_ = false;
};

template <int N>
template <class Visit>
std::vector<int> PlaneSubdivision<N>::run(Visit visit) {
  deepest_ = 2 * static_cast<int>(std::floor(-std::log2(std::max(limits_.smallest, 0x1p-500))));
  descend(root_, 0, limits_.max_boxes, visit);
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
        descend(at.box, at.level, budget, visit);
      }
    }
  }
  return std::move(tokens_);
}

template <int N>
template <class Visit>
void PlaneSubdivision<N>::descend(const Box<2>& box, int level, int budget, Visit visit) {
  for (auto& list : local_) list.clear();
  const int last_level = std::min(level + kLevelsPerBand, deepest_);
  int top = 0;
  stack_[0].box = box;
  stack_[0].level = level;
  stack_[0].inside = stack_[0].has_patches = stack_[0].excluded = false;
  stack_[0].part = kWhole;
  int here = 0;
  while (top >= 0) {
    Node& node = stack_[top];
    for (auto& list : local_)
      while (!list.empty() && list.back().level > node.level) list.pop_back();
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
                           node.box.width(axis) > limits_.smallest * root_.width(axis);
    if (!divisible || node.level >= last_level || here > budget) {
      tokens_.push_back(kWaiting);
      waiting_.push_back({node.box, divisible ? node.level : deepest_});
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
    first.level = ++second.level;
    first.inside = second.inside;
    first.has_patches = second.has_patches;
    first.box = lower;
    second.box = upper;
    if (second.has_patches)
      for (int i = 0; i < N; ++i)
        halve(second.patch[i], axis, N == 1, &first.patch[i], &second.patch[i]);
    first.excluded = part.lo[axis] > 0;
    second.excluded = part.hi[axis] < 0;
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
  if (node.has_patches)
    for (const Tile* tile : node.tile) bits = std::max(bits, tile->bits);
  kernel_.count(bits);
}

template <int N>
template <class Visit>
int PlaneSubdivision<N>::token_of(Node& node, Visit visit) {
  if (node.excluded) return cover::kExcluded;
  // Of several polynomials all must vanish. (A patch of proved sign has no coefficients any more.)
  if (N > 1 && node.has_patches)
    for (const Patch& patch : node.patch)
      if (patch.sign()) return cover::kExcluded;
  // A half that is free need not be asked about.
  if (node.has_patches)
    for (int axis = 0; axis < 2; ++axis)
      if ((node.part.hi[axis] < 0 || node.part.lo[axis] > 0) &&
          node.box.width(axis) > 0.3 * node.box.width(1 - axis))
        return cover::kSplitX - axis;
  node.part = kWhole;
  if (!node.inside && outside(node)) return cover::kOutside;
  if (limits_.places && meets_none(*limits_.places, node.box)) return cover::kExcluded;
  if (!provide_patches(node)) return wider_axis(node.box);
  return visit(node);
}

/// Whether the box lies outside one of the half planes; notes if it lies in all of them.
template <int N>
bool PlaneSubdivision<N>::outside(Node& node) const {
  const std::optional<bool> where = lies_inside(node.box, half_planes_);
  node.inside = where == true;
  return where == false;
}

template <int N>
bool PlaneSubdivision<N>::coarse(const Node& node, int i) const {
  const Patch& patch = node.patch[i];
  // Small boxes are where curves touch or nearly touch, and only the last digits tell them apart.
  const double tolerated = node.level > kLevelsPerBand ? 0x1p-26 : 0x1p-4;
  const double slope_radius = std::max(patch.slope_radius[0], patch.slope_radius[1]);
  return !(patch.radius <= tolerated * patch.magnitude() &&
           slope_radius <= tolerated * (patch.hi - patch.lo));
}

/// Makes the node's patches where they are missing or too coarse; false if the box is too large
/// for patches.
template <int N>
bool PlaneSubdivision<N>::provide_patches(Node& node) {
  for (int i = 0; i < N; ++i) {
    if (node.has_patches && (node.expanded_at[i] + 2 > node.level || !coarse(node, i))) continue;
    // A fresh patch whose chart is larger than the box does not go with one from halving.
    if (node.has_patches && N > 1 && !halves_exactly(node.box)) continue;
    if (!provide_patch(node, i)) return false;
  }
  for (int i = 1; i < N; ++i)
    if (node.patch[i].rows_axis != node.patch[0].rows_axis) turn(&node.patch[i]);
  node.has_patches = true;
  return true;
}

template <int N>
bool PlaneSubdivision<N>::provide_patch(Node& node, int i) {
  const Tile* tile = nullptr;
  if (node.level < 2 * kLevelsPerBand && local_[i].empty()) {
    tile = &polynomials_[i]->at(node.box.center());
    for (int axis = 0; axis < 2; ++axis) {
      const double part = 0.5 * node.box.width(axis) / tile->half[axis];
      if (part > 1.01) return false;
    }
    if (!node.has_patches) {
      const double part = std::max(0.5 * node.box.width(0) / tile->half[0],
                                   0.5 * node.box.width(1) / tile->half[1]);
      double size = 0;
      for (int k = 0; k <= 2; ++k)
        for (int l = 0; k + l <= 2; ++l) size += std::fabs(tile->a[k][l]);
      if (interpolation_loss(*tile, part).slope > 0x1p-4 * size) return false;
    }
    expand(*tile, node.box, count_, &node.patch[i]);
    node.tile[i] = tile;
    node.expanded_at[i] = node.level;
    if (!coarse(node, i)) return true;
    // What is lost by the low degree shrinks with the box.
    if (interpolation_loss(*tile, 0.5 * std::max(node.box.width(0) / tile->half[0],
                                                 node.box.width(1) / tile->half[1]))
            .value > 0.5 * node.patch[i].radius)
      return true;
  }
  // A tile of the box's own, in double-doubles, then in MPFR.
  for (int bits = kernel_.start_bits; bits > 0; bits = kernel_.next(bits)) {
    if (bits == Kernel::kExtendedBits) continue;
    const double before = node.patch[i].radius;
    const bool had = node.tile[i] != nullptr;
    node.tile[i] = local_tile(node, i, bits);
    expand(*node.tile[i], node.box, count_, &node.patch[i]);
    node.expanded_at[i] = node.level;
    if (!coarse(node, i) ||
        (had && bits > Kernel::kDoubleBits && !(node.patch[i].radius < 0.5 * before)))
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
