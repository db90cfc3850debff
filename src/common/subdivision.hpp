// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "encase/cover.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// A binary subdivision of a box, the quadtree's and octree's common form: every inner node halves
/// its box across one axis.
template <int D>
class Subdivision {
 public:
  explicit Subdivision(const Box<D>& root) : root_(root), nodes_(1) {}

  const Box<D>& root() const { return root_; }
  /// Makes `node` a leaf.
  void settle(int node, int token) { nodes_[node].token = token; }
  /// Halves `node`; its children are first and first + 1, lower half first.
  int split(int node, int axis) {
    const int first = static_cast<int>(nodes_.size());
    nodes_[node].token = cover::kSplitX - axis;
    nodes_[node].first_child = first;
    nodes_.resize(nodes_.size() + 2);
    return first;
  }
  int size() const { return static_cast<int>(nodes_.size()); }

  /// The tokens in preorder (encase/cover.hpp).
  std::vector<int> tokens() const {
    std::vector<int> result, stack{0};
    result.reserve(nodes_.size());
    while (!stack.empty()) {
      const Node& node = nodes_[stack.back()];
      stack.pop_back();
      result.push_back(node.token);
      if (node.first_child >= 0) {
        stack.push_back(node.first_child + 1);
        stack.push_back(node.first_child);
      }
    }
    return result;
  }

 private:
  struct Node {
    int token = cover::kUnresolved;
    int first_child = -1;
  };
  Box<D> root_;
  std::vector<Node> nodes_;
};

/// The halves of a box; false unless the cut is exact in doubles and strictly inside.
template <int D>
bool halve_box(const Box<D>& box, int axis, Box<D>* lower, Box<D>* upper) {
  const Centered cut = centered(box.lo[axis], box.hi[axis]);
  if (!cut.exact || !(cut.half > 0)) return false;
  *lower = *upper = box;
  lower->hi[axis] = upper->lo[axis] = cut.center;
  return true;
}

/// A box around `box`, at most some percent larger and not symmetric to it, whose repeated halves
/// are exact in doubles. (Symmetric input likes to put its features on the cuts of a symmetric
/// box.)
template <int D>
Box<D> subdivision_root(const Box<D>& box) {
  Box<D> root = box;
  for (int i = 0; i < D; ++i) {
    int e;
    std::frexp(box.hi[i] - box.lo[i], &e);
    const double unit = std::ldexp(1.0, e - 7);
    root.lo[i] = (std::floor(box.lo[i] / unit) - 1) * unit;
    root.hi[i] = (std::ceil(box.hi[i] / unit) + 2) * unit;
  }
  return root;
}

struct SubdivisionLimits {
  int max_boxes = 200000;
  /// Asked now and then; true ends the subdivision, and what is open stays unresolved.
  std::function<bool()> stop;
  double smallest = 0x1p-40;  ///< boxes are halved down to this part of the root's widths
  /// Below this part nets are kept sharp to 2^-40 of their size: small boxes are where curves touch
  /// or nearly touch, and only the last digits tell them apart.
  double sharp_below = 0x1p-16;
};

/// The boxes a subdivision visits, breadth first, with the nets of N polynomials on each.
///
/// `visit(nets, box)` returns a token that settles the box, or one of the split tokens. Boxes
/// outside one of the half spaces (positive side) are settled as kOutside, and boxes that would
/// have to be split beyond the limits as kUnresolved. A net whose radius has become a noticeable
/// part of it is expanded anew around its box, in doubles, then in MPFR. All nets of a box share
/// their coordinates; these are the box's own, or those of `expand` on it.
template <int D, int N, class Visit>
Subdivision<D> subdivide(const std::array<const FilteredFunction<D>*, N>& polynomials,
                         const Box<D>& root, const std::vector<Hyperplane<D>>& half_spaces,
                         const SubdivisionLimits& limits, Kernel& kernel, Visit visit) {
  struct Item {
    int node;
    Box<D> box;
    std::array<Bernstein<D>, N> nets;
    std::array<int, N> bits;
  };
  int degree = 0;
  for (const auto* f : polynomials) degree = std::max(degree, f->degree());

  const auto outside = [&](const Box<D>& box) {
    for (const Hyperplane<D>& plane : half_spaces) {
      Interval value = plane.offset;
      for (int i = 0; i < D; ++i)
        value = value +
                Interval(plane.normal[i]) * Interval(plane.normal[i] < 0 ? box.hi[i] : box.lo[i]);
      // Rational coefficients are within an ulp of the doubles, also below the normal range.
      double slack = 0;
      if (plane.rational) {
        slack = std::fabs(plane.offset) + 0x1p-1000;
        for (int i = 0; i < D; ++i)
          slack += (std::fabs(plane.normal[i]) + 0x1p-1000) *
                   std::max(std::fabs(box.lo[i]), std::fabs(box.hi[i]));
        slack *= 0x1p-49;
      }
      if (value.lo > slack) return true;
    }
    return false;
  };
  const auto sharpen = [&](Item& item) {
    // Nets of one box must share their coordinates, and a fresh net has those of a slightly larger
    // box if the centre is not a double. (Such a box is not halved any more.)
    for (int i = 0; i < D; ++i)
      if (!centered(item.box.lo[i], item.box.hi[i]).exact) return;
    bool small = false;
    for (int i = 0; i < D; ++i)
      small = small || item.box.width(i) < limits.sharp_below * root.width(i);
    const double tolerated = small ? 0x1p-40 : 0x1p-10;
    for (int i = 0; i < N; ++i) {
      Bernstein<D>& net = item.nets[i];
      const auto coarse = [&] { return !(net.radius < tolerated * largest_coefficient(net)); };
      if (!coarse()) continue;
      for (int bits = item.bits[i]; bits > 0 && coarse(); bits = kernel.next(bits)) {
        const double before = net.radius;
        polynomials[i]->expand(item.box, degree, bits, kernel, &net);
        const bool gained = net.radius < 0.5 * before;
        if (bits > Kernel::kDoubleBits && bits > item.bits[i] && !gained) break;
        item.bits[i] = bits;
      }
    }
  };

  Subdivision<D> tree(root);
  std::vector<Item> level(1), next, pool;
  level[0].node = 0;
  level[0].box = root;
  level[0].bits.fill(kernel.start_bits);
  for (int i = 0; i < N; ++i)
    polynomials[i]->expand(root, degree, kernel.start_bits, kernel, &level[0].nets[i]);
  int boxes = 0;
  bool stopped = false;
  while (!level.empty()) {
    for (Item& item : level) {
      int token = cover::kOutside;
      if (++boxes % 64 == 0 && !stopped) stopped = limits.stop && limits.stop();
      if (stopped) {
        token = cover::kUnresolved;
      } else if (!outside(item.box)) {
        sharpen(item);
        token = visit(item.nets, item.box);
      }
      const bool split = token <= cover::kSplitX && token >= cover::kSplitZ;
      const int axis = cover::kSplitX - token;
      Item lower, upper;
      if (split && boxes + static_cast<int>(next.size()) < limits.max_boxes &&
          item.box.width(axis) > limits.smallest * root.width(axis) &&
          halve_box(item.box, axis, &lower.box, &upper.box)) {
        if (!pool.empty()) {
          lower.nets = std::move(pool.back().nets);
          pool.pop_back();
        }
        for (int i = 0; i < N; ++i) halve(item.nets[i], axis, &lower.nets[i], &upper.nets[i]);
        lower.bits = upper.bits = item.bits;
        lower.node = tree.split(item.node, axis);
        upper.node = lower.node + 1;
        next.push_back(std::move(lower));
        next.push_back(std::move(upper));
      } else {
        tree.settle(item.node, split ? cover::kUnresolved : token);
        // Counted by the most precise arithmetic that one of its nets came from.
        if (split || token == cover::kUnresolved)
          ++kernel.decisions.undecided;
        else
          kernel.count(*std::max_element(item.bits.begin(), item.bits.end()));
      }
    }
    pool = std::move(level);
    level = std::move(next);
    next.clear();
  }
  return tree;
}

/// The boxes of a subdivision's leaves whose tokens are wanted, in preorder.
template <int D, class Wanted>
std::vector<Box<D>> leaves_with(const Box<D>& root, const std::vector<int>& tokens, Wanted wanted) {
  std::vector<Box<D>> result, stack;
  result.reserve(static_cast<std::size_t>(std::count_if(tokens.begin(), tokens.end(), wanted)));
  stack.reserve(tokens.size() < 64 ? tokens.size() : 64);
  stack.push_back(root);
  for (const int t : tokens) {
    if (t <= cover::kSplitX && t >= cover::kSplitZ) {
      // (That the cut is exact has been seen when it was made.)
      const int axis = cover::kSplitX - t;
      const Box<D> box = stack.back();
      const double cut = box.lo[axis] + 0.5 * (box.hi[axis] - box.lo[axis]);
      stack.back().lo[axis] = cut;
      stack.push_back(box);
      stack.back().hi[axis] = cut;
    } else {
      if (wanted(t)) result.push_back(stack.back());
      stack.pop_back();
    }
  }
  return result;
}
template <int D>
std::vector<Box<D>> leaves(const Box<D>& root, const std::vector<int>& tokens, int token) {
  return leaves_with(root, tokens, [token](int t) { return t == token; });
}

}  // namespace encase
