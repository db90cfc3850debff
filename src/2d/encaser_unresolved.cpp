// SPDX-License-Identifier: MIT
// What resists in steps 2 and 3: how it is reported, and the zones that keep it apart.
#include "2d/encaser.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "2d/critical_regions.hpp"
#include "common/analytic_gaps.hpp"
#include "common/plane_subdivision.hpp"

namespace encase {
namespace {

/// Whether two of the boxes share a point.
bool any_meet(std::vector<Box<2>> boxes) {
  std::sort(boxes.begin(), boxes.end(),
            [](const Box<2>& a, const Box<2>& b) { return a.lo[0] < b.lo[0]; });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lo[0] <= boxes[i].hi[0]; ++j)
      if (boxes[i].meets(boxes[j])) return true;
  return false;
}

}  // namespace

std::vector<Box<2>> Encaser::clusters_of(const std::vector<Box<2>>& unresolved) const {
  // Boxes that nearly touch are one place.
  std::vector<Box<2>> grown = unresolved;
  for (Box<2>& box : grown) {
    const double margin = 4 * box.largest_width();
    for (int i = 0; i < 2; ++i) {
      box.lo[i] -= margin;
      box.hi[i] += margin;
    }
  }
  std::vector<Box<2>> clusters;
  const std::vector<int> component = connected_components(grown);
  for (std::size_t i = 0; i < unresolved.size(); ++i) {
    const std::size_t k = component[i];
    if (k == clusters.size())
      clusters.push_back(unresolved[i]);
    else
      clusters[k] = hull(clusters[k], unresolved[i]);
  }
  return clusters;
}

/// Where curves are not known to be zero sets of analytic functions.
void Encaser::report_gaps() {
  for (std::size_t c = 0; c < tiled_.size(); ++c) {
    std::vector<Box<2>> zones;
    for (const Box<2>& gap : tiled_[c].gaps())
      if (lies_inside(zone_of(gap), sides_) != false) zones.push_back(zone_of(gap));
    for (const Box<2>& box : gathered(std::move(zones), tiled_[c].box())) {
      Unresolved entry;
      entry.kind = Unresolved::Kind::NotAnalytic;
      entry.box = box;
      entry.has_box = true;
      entry.curves = {static_cast<int>(c)};
      entry.reason = result_.curves[c].function.is_inclusion()
                         ? "the inclusion function of curve '" + result_.curves[c].name +
                               "' tells nothing here"
                         : "the function of curve '" + result_.curves[c].name +
                               "' is not defined, has a pole or is not differentiable here, or "
                               "nearly";
      result_.degenerate.push_back(std::move(entry));
    }
  }
}

void Encaser::report(Leftover left, Unresolved::Kind kind, std::vector<int> curves) {
  // What lies in gaps is reported already.
  std::erase_if(left.unresolved, [&](const Box<2>& box) {
    return std::any_of(curves.begin(), curves.end(),
                       [&](int c) { return relation(box, tiled_[c].gaps()) == Relation::Within; });
  });
  if (left.unresolved.empty()) return;
  std::string names;
  for (const int c : curves)
    names += (names.empty() ? "'" : " and '") + result_.curves[c].name + "'";
  for (const Box<2>& box : clusters_of(left.unresolved)) {
    Unresolved entry;
    entry.box = box;
    entry.has_box = true;
    entry.curves = curves;
    // Halved as far as sizes go, as opposed to left over when the number of boxes ran out.
    bool at_cap = true;
    for (const Box<2>& leaf : left.unresolved)
      if (box.contains(leaf))
        at_cap = at_cap && (leaf.width(0) <= left.smallest * left.root.width(0) ||
                            leaf.width(1) <= left.smallest * left.root.width(1));
    if (at_cap) {
      entry.kind = kind;
      entry.reason = kind == Unresolved::Kind::Contact
                         ? "curves " + names + " touch, nearly touch or meet at a singular point"
                         : "curve " + names + " is singular or nearly singular";
      result_.degenerate.push_back(std::move(entry));
    } else {
      entry.kind = Unresolved::Kind::Budget;
      entry.reason = (left.stopped ? budget_ : "the limit on boxes was reached") +
                     (kind == Unresolved::Kind::Contact
                          ? " before curves " + names + " were told apart"
                          : " before the critical points of curve " + names + " were settled");
      result_.undecided.push_back(std::move(entry));
    }
  }
}

void Encaser::report_concurrency() {
  // Boxes of different pairs that meet: three curves through one point, as far as can be told.
  std::vector<Box<2>> boxes;
  boxes.reserve(features_.crossings.size());
  for (const Crossing& crossing : features_.crossings) boxes.push_back(crossing.box);
  if (!any_meet(boxes)) return;
  const std::vector<int> component = connected_components(boxes);
  std::vector<std::vector<int>> groups(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    groups[component[k]].push_back(static_cast<int>(k));
  for (const auto& group : groups) {
    if (group.size() < 2) continue;
    Unresolved entry;
    entry.kind = Unresolved::Kind::Concurrency;
    entry.has_box = true;
    entry.box = boxes[group[0]];
    for (const int k : group) {
      entry.box = hull(entry.box, boxes[k]);
      for (const int c : features_.crossings[k].curves)
        if (std::find(entry.curves.begin(), entry.curves.end(), c) == entry.curves.end())
          entry.curves.push_back(c);
    }
    std::sort(entry.curves.begin(), entry.curves.end());
    entry.reason = "three or more curves meet or nearly meet in a point";
    result_.degenerate.push_back(std::move(entry));
  }
}

void Encaser::collect_zones() {
  // Boxes that touch make one zone.
  std::vector<Box<2>> boxes;
  for (const auto* list : {&result_.degenerate, &result_.undecided})
    for (const Unresolved& entry : *list)
      if (entry.has_box && entry.kind != Unresolved::Kind::NotAnalytic) boxes.push_back(entry.box);
  for (std::size_t before = 0; before != boxes.size();) {
    before = boxes.size();
    boxes = clusters_of(boxes);
  }
  const double diameter = bounds_.largest_width();
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Box<2>& box = boxes[k];
    // Wide enough to be cheap to surround, but clear of every other feature.
    double margin = 0x1p-6 * diameter;
    const auto keep_off = [&](const Box<2>& other) {
      double gap = 0;
      for (int i = 0; i < 2; ++i)
        gap = std::max({gap, other.lo[i] - box.hi[i], box.lo[i] - other.hi[i]});
      if (gap > 0) margin = std::min(margin, 0.3 * gap);
    };
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (j != k) keep_off(boxes[j]);
    for (const Crossing& crossing : features_.crossings) keep_off(crossing.box);
    margin = std::max(margin, 2 * box.largest_width());
    Zone zone{box, box};
    for (int i = 0; i < 2; ++i) {
      zone.clearance.lo[i] -= margin;
      zone.clearance.hi[i] += 1.07 * margin;
    }
    features_.zones.push_back(zone);
  }
  for (const Unresolved& entry : result_.degenerate) {
    if (entry.kind != Unresolved::Kind::NotAnalytic) continue;
    Zone zone{entry.box, entry.box, true};
    for (int i = 0; i < 2; ++i) {
      const bool tiny = entry.box.largest_width() < 0x1p-8 * diameter;
      const double margin =
          tiny ? 0x1p-6 * diameter
               : 0x1p-10 * diameter +
                     0.5 * std::min({entry.box.width(0), entry.box.width(1), 0x1p-8 * diameter});
      zone.clearance.lo[i] -= margin;
      zone.clearance.hi[i] += 1.07 * margin;
    }
    features_.zones.push_back(zone);
  }
}

}  // namespace encase
