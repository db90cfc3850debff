// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "2d/curve_bounds.hpp"
#include "encase/caps.hpp"

namespace encase {

/// The quadtree of CAPS. Node 0 is the root; the children of a node follow each other: lower left,
/// upper left, lower right, upper right.
struct CapsTree {
  Box<2> box;
  std::vector<int> nodes;  ///< the first child, or ~leaf
  std::vector<CapsLeaf> leaves;
  std::vector<std::vector<int>> curve_sets;  ///< of the leaves; the first is empty
  bool cut_short = false;                    ///< a budget ran out

  bool is_leaf(int node) const { return nodes[node] < 0; }
  /// The child towards the upper or lower side along both axes.
  int child(int node, int x, int y) const { return nodes[node] + 2 * x + y; }
  /// As in CapsResult.
  std::vector<int> tokens() const;
};

/// Subdivides the box, breadth first. `stop` is asked now and then; true ends it.
CapsTree subdivide(std::vector<CurveBounds>& curves, const Box<2>& box, const CapsOptions& options,
                   const std::function<bool()>& stop);

/// Calls visit(lower, upper, axis) for every two leaves that share a piece of a side, which lies
/// across the axis.
template <class Visit>
class SharedSides {
 public:
  SharedSides(const CapsTree& tree, Visit visit) : tree_(tree), visit_(std::move(visit)) {
    within(0);
  }

 private:
  void within(int node) {
    if (tree_.is_leaf(node)) return;
    const auto child = [&](int x, int y) { return tree_.child(node, x, y); };
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 2; ++y) within(child(x, y));
    for (int k = 0; k < 2; ++k) {
      between(child(0, k), child(1, k), 0);
      between(child(k, 0), child(k, 1), 1);
    }
  }
  void between(int lower, int upper, int axis) {
    if (tree_.is_leaf(lower) && tree_.is_leaf(upper))
      return visit_(~tree_.nodes[lower], ~tree_.nodes[upper], axis);
    for (int k = 0; k < 2; ++k) between(along(lower, axis, 1, k), along(upper, axis, 0, k), axis);
  }
  /// The node itself if it is a leaf, else its k-th child on one side.
  int along(int node, int axis, int side, int k) const {
    if (tree_.is_leaf(node)) return node;
    return axis == 0 ? tree_.child(node, side, k) : tree_.child(node, k, side);
  }

  const CapsTree& tree_;
  Visit visit_;
};

}  // namespace encase
