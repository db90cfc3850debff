// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// Cuts a polygon into triangles: n - 2 of them for n corners, which are indices of `points`,
/// counter-clockwise. Those of a simple polygon do not overlap; whatever the polygon, they add up
/// to its signed area. Ties and rounding are broken in doubles: triangles may be flat. Cost: about
/// n^2, at most n^3.
std::vector<std::array<int, 3>> cut_ears(const std::vector<Point<2>>& points,
                                         std::vector<int> polygon);

}  // namespace encase
