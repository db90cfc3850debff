// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "2d/caps_graph.hpp"
#include "common/union_find.hpp"

namespace encase {

std::vector<CapsRegion> label_regions(CapsTree& tree, bool singular_apart) {
  std::vector<CapsLeaf>& leaves = tree.leaves;
  const auto singular = [&](const CapsLeaf& leaf) {
    return singular_apart && leaf.graph_axis < 0 &&
           tree.curve_sets[static_cast<std::size_t>(leaf.curves)].size() == 1;
  };
  UnionFind sets(leaves.size());
  std::vector<std::array<int, 2>> borders;
  SharedSides(tree, [&](int a, int b, int) {
    const CapsLeaf &first = leaves[a], &second = leaves[b];
    if (first.curves == second.curves && singular(first) == singular(second))
      sets.join(a, b);
    else
      borders.push_back({a, b});
  });

  std::vector<CapsRegion> regions;
  std::vector<int> number(leaves.size(), -1);
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    CapsLeaf& leaf = leaves[k];
    int& region = number[static_cast<std::size_t>(sets.find(static_cast<int>(k)))];
    if (region < 0) {
      region = static_cast<int>(regions.size());
      regions.push_back({leaf.label, leaf.curves, singular(leaf), 0, leaf.box, {}, false});
    }
    leaf.region = region;
    CapsRegion& r = regions[static_cast<std::size_t>(region)];
    ++r.leaves;
    r.box = hull(r.box, leaf.box);
    // Proved in one leaf, or not known in one.
    const bool one = tree.curve_sets[static_cast<std::size_t>(leaf.curves)].size() == 1;
    if (leaf.label == (one ? CapsLabel::OneCurve : CapsLabel::Indeterminate)) r.label = leaf.label;
  }

  for (auto& [a, b] : borders) {
    a = leaves[static_cast<std::size_t>(a)].region;
    b = leaves[static_cast<std::size_t>(b)].region;
    if (a > b) std::swap(a, b);
  }
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  for (const auto& [a, b] : borders) regions[static_cast<std::size_t>(a)].neighbours.push_back(b);
  for (const auto& [a, b] : borders) regions[static_cast<std::size_t>(b)].neighbours.push_back(a);
  for (CapsRegion& region : regions) std::sort(region.neighbours.begin(), region.neighbours.end());
  return regions;
}

}  // namespace encase
