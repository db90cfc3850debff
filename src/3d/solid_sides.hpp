// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "encase/encasement.hpp"
#include "encase/function.hpp"
#include "encase/polyhedron.hpp"

namespace encase {

/// Where a closed box lies with respect to a x + b y + c z + d = 0, exactly: Negative or Positive
/// if all of it lies strictly on that side, else Zero.
Sign side_of(const HalfSpace& plane, const Box<3>& box);

/// Where the only common zero of three functions in a box lies with respect to the region. Exact:
/// on the boundary, and wherever the box meets a side's plane, only if the functions are
/// polynomials and it is the point `guess`, or that with coordinates of sides x = c, y = c, z = c
/// in place of its own. Nothing where that is not so.
std::optional<Location> location_of(const std::array<const Function<3>*, 3>& functions,
                                    const Box<3>& box, const Point<3>& guess,
                                    const Polyhedron& region);

/// The doubles next to a point: a box that holds what is correctly rounded to it.
Box<3> neighbours_of(const Point<3>& point);

}  // namespace encase
