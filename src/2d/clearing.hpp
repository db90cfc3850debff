// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// About the largest circle in a region of the plane: a place for a label.
struct Clearing {
  Point<2> center{};
  double radius = 0;  ///< not positive if no place inside was found
};

/// The largest circle in the region that closed polygons bound (even-odd, the outer boundary
/// first), to within `precision` of its radius unless a thousand places have been tried before.
/// Cost: the number of corners for each place tried.
Clearing largest_clearing(const std::vector<std::vector<Point<2>>>& boundaries, double precision);

}  // namespace encase
