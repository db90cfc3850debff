// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// Boxes, halved again and again across the longest side of what their middles span.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<Box<3>>& boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!boxes.empty()) add_node(0, static_cast<int>(boxes.size()));
  }

  /// Calls use(i, j), i < j, for all pairs of boxes that meet, each once. Cost: for n boxes of
  /// which none meets many, n log n.
  template <class Use>
  void for_each_meeting_pair(const Use& use) const {
    if (!nodes_.empty()) within(0, use);
  }

 private:
  static constexpr int kLeaf = 6;

  /// The boxes order_[begin] to order_[end - 1]. The first half is the next node.
  struct Node {
    Box<3> hull;
    int begin = 0, end = 0;
    int second = -1;  ///< the other half; -1: a leaf
  };

  int add_node(int begin, int end) {
    const int k = static_cast<int>(nodes_.size());
    Box<3> all = boxes_[order_[begin]];
    Point<3> lo = all.center(), hi = lo;
    for (int i = begin + 1; i < end; ++i) {
      const Box<3>& box = boxes_[order_[i]];
      all = hull(all, box);
      const Point<3> middle = box.center();
      for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], middle[axis]);
        hi[axis] = std::max(hi[axis], middle[axis]);
      }
    }
    nodes_.push_back({all, begin, end, -1});
    if (end - begin <= kLeaf) return k;
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (hi[i] - lo[i] > hi[axis] - lo[axis]) axis = i;
    const int middle = begin + (end - begin) / 2;
    std::nth_element(
        order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
          return boxes_[a].lo[axis] + boxes_[a].hi[axis] < boxes_[b].lo[axis] + boxes_[b].hi[axis];
        });
    add_node(begin, middle);
    const int second = add_node(middle, end);
    nodes_[k].second = second;
    return k;
  }

  template <class Use>
  void within(int k, const Use& use) const {
    const Node& node = nodes_[k];
    if (node.second >= 0) {
      within(k + 1, use);
      within(node.second, use);
      between(k + 1, node.second, use);
      return;
    }
    for (int i = node.begin; i < node.end; ++i)
      for (int j = i + 1; j < node.end; ++j) use_if_met(order_[i], order_[j], use);
  }

  template <class Use>
  void between(int a, int b, const Use& use) const {
    const Node &first = nodes_[a], &second = nodes_[b];
    if (!first.hull.meets(second.hull)) return;
    if (first.second < 0 && second.second < 0) {
      for (int i = first.begin; i < first.end; ++i)
        for (int j = second.begin; j < second.end; ++j) use_if_met(order_[i], order_[j], use);
      return;
    }
    const bool halve_first =
        second.second < 0 ||
        (first.second >= 0 && first.end - first.begin > second.end - second.begin);
    if (halve_first) {
      between(a + 1, b, use);
      between(first.second, b, use);
    } else {
      between(a, b + 1, use);
      between(a, second.second, use);
    }
  }

  template <class Use>
  void use_if_met(int i, int j, const Use& use) const {
    if (boxes_[i].meets(boxes_[j])) use(std::min(i, j), std::max(i, j));
  }

  const std::vector<Box<3>>& boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace encase
