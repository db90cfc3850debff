// SPDX-License-Identifier: MIT
#include "3d/box_clusters.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "common/union_find.hpp"

namespace encase {

std::vector<int> box_components(const std::vector<Box<3>>& boxes) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return boxes[a].lo[0] < boxes[b].lo[0]; });
  UnionFind sets(boxes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].lo[0] <= boxes[order[i]].hi[0];
         ++j)
      if (boxes[order[i]].meets(boxes[order[j]]))
        sets.join(static_cast<int>(order[i]), static_cast<int>(order[j]));
  std::vector<int> component(boxes.size()), number(boxes.size(), -1);
  int count = 0;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    int& n = number[static_cast<std::size_t>(sets.find(static_cast<int>(k)))];
    if (n < 0) n = count++;
    component[k] = n;
  }
  return component;
}

}  // namespace encase
