// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "3d/facet_places.hpp"
#include "encase/polyhedron.hpp"

namespace encase {

/// The region, with the sides only that have a facet, each once; that of a box has the sides lower
/// x, upper x, lower y, ..., and double bounds, rounded outward. With `attempt` > 0 every side is
/// moved outward by about 2^-33 of the diameter, differently each time. Nothing if the result is
/// not around the region.
std::optional<SolidRegion> usable_region(const Polyhedron& region, int attempt);

/// The oriented planes of the sides.
std::vector<Plane> planes_of(const Polyhedron& region);

}  // namespace encase
