// SPDX-License-Identifier: MIT
#include "2d/loop_certificates.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

/// A point of the cell's boundary between its vertices and crossings.
struct Target {
  int edge;
  Point<2> at;
  double gap;  ///< squared
};

constexpr int kMaxTargets = 12;

/// Thirds of what lies between two stops on the boundary, and the foot of the perpendicular where
/// it falls between.
void add_targets(const Point<2>& from, int edge, const Point<2>& a, const Point<2>& b,
                 std::vector<Target>* targets) {
  const Point<2> d{b[0] - a[0], b[1] - a[1]};
  const double square = d[0] * d[0] + d[1] * d[1];
  double foot = 0.5;
  if (square > 0)
    foot = std::clamp(((from[0] - a[0]) * d[0] + (from[1] - a[1]) * d[1]) / square, 0.1, 0.9);
  for (const double w : {foot, 0.3, 0.7}) {
    const Point<2> at{a[0] + w * d[0], a[1] + w * d[1]};
    const double x = at[0] - from[0], y = at[1] - from[1];
    targets->push_back({edge, at, x * x + y * y});
  }
}

Box<2> around(const Point<2>& a, const Point<2>& b) { return hull(Box<2>{a, a}, Box<2>{b, b}); }

/// Whether f seems to keep its sign from one point to the other, well away from zero: what is
/// hopeless or hard to prove is not tried.
bool seems_free(const FilteredFunction<2>& f, Sign sign, const Point<2>& from, const Point<2>& to) {
  constexpr int kSamples = 10;
  double least = HUGE_VAL, most = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const double w = static_cast<double>(i) / kSamples;
    const double value =
        f.approximate({from[0] + w * (to[0] - from[0]), from[1] + w * (to[1] - from[1])});
    if ((value > 0) != (sign == Sign::Positive)) return false;
    least = std::min(least, std::fabs(value));
    most = std::max(most, std::fabs(value));
  }
  return least > 1e-6 * most;
}

}  // namespace

std::optional<LoopCertificate> certify_no_loop(CellAtHand& at_hand, int critical_region) {
  Partition& partition = at_hand.partition();
  const OpenCell& cell = at_hand.cell();
  const CriticalRegion& region = partition.critical_regions[critical_region];
  const FilteredFunction<2>& f = partition.curves()[region.curve];
  const Point<2> from = region.boxes.front().center();
  thread_local std::vector<Target> targets;
  targets.clear();
  const auto& points = at_hand.points();
  for (int k = 0; k < cell.size(); ++k) {
    Point<2> last = cell.vertices[k].center;
    for (int i = cell.begin_of(k); i < cell.edges[k].end; ++i) {
      add_targets(from, k, last, points[i].at, &targets);
      last = points[i].at;
    }
    add_targets(from, k, last, cell.vertices[k + 1 < cell.size() ? k + 1 : 0].center, &targets);
  }
  std::sort(targets.begin(), targets.end(), [](const Target& a, const Target& b) {
    return a.gap != b.gap       ? a.gap < b.gap
           : a.at[0] != b.at[0] ? a.at[0] < b.at[0]
                                : a.at[1] < b.at[1];
  });
  int tries = 0;
  for (const Target& target : targets) {
    if (!seems_free(f, region.sign, from, target.at)) continue;
    if (++tries > kMaxTargets) break;
    const Line& line = partition.lines[cell.edges[target.edge].line];
    // The inside of the edge, told by the region itself.
    const auto inside = side(line, Place(region.boxes.front()), partition.kernel());
    if (!inside) continue;
    // A little beyond the boundary, so that the end is proved not to be inside.
    for (const double beyond : {1e-12, 1e-9, 1e-6}) {
      const Point<2> to{target.at[0] + beyond * (target.at[0] - from[0]),
                        target.at[1] + beyond * (target.at[1] - from[1])};
      if (side(line, to, partition.kernel()) == *inside) continue;
      TiledFunction& tiles = partition.tiles().about(region.curve, around(from, to));
      if (no_root_on_segment(tiles, from, to, partition.kernel()))
        return LoopCertificate{critical_region, from, to};
      break;
    }
  }
  return std::nullopt;
}

}  // namespace encase
