// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/kernel.hpp"
#include "common/root_isolation.hpp"
#include "common/subdivision.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// Where the curve f = g = 0 may turn back with respect to a direction: the common zeros of f, g
/// and the polynomial `direction`, which is (grad f x grad g) . w (arc_direction.hpp). Between them
/// w is strictly monotone on every arc, and every closed curve holds at least two of them.
struct PairCriticalPoints {
  FilteredFunction<3> direction;
  RootIsolation<3> points;
};

/// Isolates them in the part of `box` that lies on the negative side of every half space. Nothing
/// if f or g is no polynomial. Where `direction` vanishes on a whole arc of the curve (w is at
/// right angles to it), or at singular points of it, boxes stay unresolved. Cost: an exact product,
/// then isolate_roots<3> for degrees m, n and m + n - 2.
std::optional<PairCriticalPoints> pair_critical_points(
    const FilteredFunction<3>& f, const FilteredFunction<3>& g, const Point<3>& w,
    const Box<3>& box, const std::vector<Hyperplane<3>>& half_spaces,
    const SubdivisionLimits& limits, Kernel& kernel);

}  // namespace encase
