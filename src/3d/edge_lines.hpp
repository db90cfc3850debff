// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "3d/facet_places.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// Numbers the points where surfaces meet the facets' sides, and two surfaces a facet: fills
/// Facet::points of all encased facets. A point on a side is the same on all facets beside it.
///
/// Of a surface every crossing with a line has an interval that holds no other root of it, and it
/// is not zero at the ends. Two intervals of one line, from different facets, hold the same root if
/// one contains the other, or if they overlap and the surface's sign changes the same way: then it
/// changes on what they have in common. Otherwise it does not change there, and the roots differ.
///
/// `planes` are those that the facets name; `facets` must be certified or not encased.
std::vector<FacetPoint> number_facet_points(const std::vector<Plane>& planes, PlaneCharts& charts,
                                            const std::vector<Facet*>& facets);

}  // namespace encase
