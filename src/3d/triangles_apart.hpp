// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "encase/geometry.hpp"

namespace encase {

using TrianglePairs = std::vector<std::pair<int, int>>;

/// All pairs of triangles that share no corner and are not proved to be farther than `margin`
/// apart, by their places in the list. The margin is at least 2^-44 of the largest distance between
/// points. Cost: about a microsecond a triangle.
TrianglePairs near_triangles(const std::vector<Point<3>>& points,
                             const std::vector<std::array<int, 3>>& triangles, double margin);

/// Those of one of the first triangles, as many as `first` says, and one of the others.
TrianglePairs near_triangles(const std::vector<Point<3>>& points,
                             const std::vector<std::array<int, 3>>& triangles, double margin,
                             int first);

}  // namespace encase
