// SPDX-License-Identifier: MIT
#include "2d/critical_regions.hpp"

#include <algorithm>
#include <numeric>

#include "common/box_tests.hpp"
#include "common/plane_subdivision.hpp"
#include "common/union_find.hpp"

namespace encase {

std::vector<int> connected_components(const std::vector<Box<2>>& boxes) {
  UnionFind sets(boxes.size());
  // A sweep over the lower x bounds; boxes leave the front when they end before the sweep.
  std::vector<int> order(boxes.size()), front;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return boxes[a].lo[0] != boxes[b].lo[0] ? boxes[a].lo[0] < boxes[b].lo[0] : a < b;
  });
  for (const int i : order) {
    std::erase_if(front, [&](int j) { return boxes[j].hi[0] < boxes[i].lo[0]; });
    for (const int j : front)
      if (boxes[j].meets(boxes[i])) sets.join(j, i);
    front.push_back(i);
  }
  std::vector<int> number(boxes.size(), -1), component(boxes.size());
  int count = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    int& n = number[sets.find(static_cast<int>(i))];
    if (n < 0) n = count++;
    component[i] = n;
  }
  return component;
}

namespace {

/// The longer side's, unless f changes far more along the other one; in small boxes, where branches
/// may stay close together for a long way, that along which it changes more, weighted by the width.
int splitting_axis(const PlaneSubdivision<1>::Node& node, const std::array<double, 2>& change) {
  constexpr int kUsualLevels = 16;
  constexpr double kFarMore = 16, kNearlyAll = 0.999;  // (No rounding breaks symmetry's ties.)
  const Box<2>& box = node.box;
  if (node.level >= kUsualLevels)
    return change[0] * box.width(0) >= kNearlyAll * change[1] * box.width(1) ? 0 : 1;
  const int longer = cover::kSplitX - wider_axis(box);
  return change[1 - longer] > kFarMore * change[longer] ? 1 - longer : longer;
}

}  // namespace

CriticalRegions critical_regions(TiledFunction& f, int curve, const Box<2>& root,
                                 const std::vector<Line>& half_planes,
                                 const SubdivisionLimits& limits, Kernel& kernel) {
  CriticalRegions result;
  result.root_box = root;
  // Small regions are cut by fewer lines but reached by more rays, and some saddles drop out on the
  // way; a region is not split below this width once f has a sign on it.
  const double fine = result.root_box.largest_width() * 0x1p-3;
  // Boxes well below the usual size are few, unless branches stay close together for a long way:
  // then more is tried now and then.
  const double small = result.root_box.largest_width() * 0x1p-10;
  constexpr int kFew = 64;
  int small_boxes = 0;
  constexpr int kNegative = 0, kPositive = 1;  // tokens of leaves on which f has a sign
  const auto visit = [&](const PlaneSubdivision<1>::Node& node) {
    const CriticalVerdict verdict = test_critical(node.net);
    const auto& change = verdict.variation;  // zero if the gradient does not vanish
    if (verdict.excluded) {
      if (change[0] > 0 || change[1] > 0) result.other_points.push_back(node.box);
      return cover::kExcluded;
    }
    if (node.box.largest_width() <= small && ++small_boxes > kFew && node.level % 4 == 0 &&
        no_relevant_critical_point(f.polynomial(), node.box, kernel)) {
      result.other_points.push_back(node.box);
      return cover::kExcluded;
    }
    const int axis = splitting_axis(node, change);
    if (const auto sign = node.net.sign(); sign && node.box.width(axis) <= fine) {
      result.other_points.push_back(node.box);
      return *sign == Sign::Positive ? kPositive : kNegative;
    }
    return cover::kSplitX - axis;
  };
  PlaneSubdivision<1> subdivision({&f}, result.root_box, half_planes, limits, kernel);
  result.tokens = subdivision.run(visit);
  result.boxes = static_cast<int>(result.tokens.size());
  if (subdivision.unresolved())
    result.unresolved = leaves(result.root_box, result.tokens, cover::kUnresolved);

  const std::vector<Box<2>> boxes =
      leaves_with(result.root_box, result.tokens, [](int token) { return token >= 0; });
  const std::vector<int> component = connected_components(boxes);
  if (!component.empty())
    result.regions.reserve(
        1 + static_cast<std::size_t>(*std::max_element(component.begin(), component.end())));
  std::size_t next = 0;
  for (int& token : result.tokens) {
    if (token < 0) continue;
    const std::size_t k = component[next];
    // Boxes that touch share points, so f has one sign on the whole component.
    if (k >= result.regions.size())
      result.regions.push_back({curve, token == kPositive ? Sign::Positive : Sign::Negative, {}});
    result.regions[k].boxes.push_back(boxes[next]);
    token = static_cast<int>(k);
    ++next;
  }
  return result;
}

CriticalRegions critical_regions(const FilteredFunction<2>& f, int curve, const Box<2>& box,
                                 const std::vector<Line>& half_planes,
                                 const SubdivisionLimits& limits, Kernel& kernel) {
  TiledFunction tiled(f, subdivision_root(box), kernel);
  return critical_regions(tiled, curve, tiled.box(), half_planes, limits, kernel);
}

}  // namespace encase
