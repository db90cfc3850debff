// SPDX-License-Identifier: MIT
#include "2d/loop_certificates.hpp"

#include <algorithm>
#include <cmath>

namespace encase {

std::optional<LoopCertificate> certify_no_loop(Partition& partition, const OpenCell& cell,
                                               int critical_region) {
  const CriticalRegion& region = partition.critical_regions[critical_region];
  const FilteredPolynomial<2>& f = partition.curves()[region.curve];
  // Targets: points of the boundary between its vertices and crossings.
  struct Target {
    int edge;
    Point<2> at;
    double gap;
  };
  std::vector<Point<2>> stops;
  std::vector<int> edges;
  const int n = static_cast<int>(cell.edges.size());
  for (int k = 0; k < n; ++k) {
    stops.push_back(middle(cell.vertices[k]));
    edges.push_back(k);
    for (const int id : cell.edges[k].crossings) {
      stops.push_back(partition.spot(id).at);
      edges.push_back(k);
    }
  }
  const Point<2> from = region.boxes.front().center();
  std::vector<Target> targets;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Point<2>&a = stops[i], &b = stops[(i + 1) % stops.size()];
    // Thirds, and the foot of the perpendicular where it falls between.
    const Point<2> d{b[0] - a[0], b[1] - a[1]};
    const double square = d[0] * d[0] + d[1] * d[1];
    double foot = 0.5;
    if (square > 0)
      foot = std::clamp(((from[0] - a[0]) * d[0] + (from[1] - a[1]) * d[1]) / square, 0.1, 0.9);
    for (const double w : {foot, 0.3, 0.7}) {
      const Point<2> at{a[0] + w * d[0], a[1] + w * d[1]};
      const double value = f.approximate(at);
      if ((value > 0) != (region.sign == Sign::Positive)) continue;
      targets.push_back({edges[i], at, std::hypot(at[0] - from[0], at[1] - from[1])});
    }
  }
  std::stable_sort(targets.begin(), targets.end(),
                   [](const Target& a, const Target& b) { return a.gap < b.gap; });
  if (targets.size() > 12) targets.resize(12);
  for (const Target& target : targets) {
    const Line& line = partition.lines[cell.edges[target.edge].line];
    // The inside of the edge, told by the region itself.
    const auto inside = side(line, region.boxes.front(), partition.kernel());
    if (!inside) continue;
    // A little beyond the boundary, so that the end is proved not to be inside.
    for (const double beyond : {1e-12, 1e-9, 1e-6}) {
      const Point<2> to{target.at[0] + beyond * (target.at[0] - from[0]),
                        target.at[1] + beyond * (target.at[1] - from[1])};
      if (side(line, to, partition.kernel()) == *inside) continue;
      if (no_root_on_segment(f, from, to, partition.kernel()))
        return LoopCertificate{critical_region, from, to};
      break;
    }
  }
  return std::nullopt;
}

}  // namespace encase
