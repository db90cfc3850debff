// SPDX-License-Identifier: MIT
#include "3d/pair_critical_points.hpp"

#include "3d/arc_direction.hpp"
#include "common/isolate_roots.hpp"

namespace encase {

std::optional<PairCriticalPoints> pair_critical_points(
    const FilteredFunction<3>& f, const FilteredFunction<3>& g, const Point<3>& w,
    const Box<3>& box, const std::vector<Hyperplane<3>>& half_spaces,
    const SubdivisionLimits& limits, Kernel& kernel) {
  if (!f.is_polynomial() || !g.is_polynomial()) return std::nullopt;
  const auto direction = arc_direction(f.polynomial().exact(), g.polynomial().exact(), w);
  PairCriticalPoints result{FilteredFunction<3>(*direction), {}};
  const System<3> system{&f, &g, &result.direction};
  result.points = isolate_roots<3>(system, box, half_spaces, limits, kernel);
  return result;
}

}  // namespace encase
