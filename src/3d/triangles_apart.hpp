// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// Two triangles that share no corner and are not proved to be farther than `margin` apart, by
/// their places in the list; nothing if there are none: any two are proved to be. The margin is
/// at least 2^-44 of the largest distance between points. Cost: about two microseconds a triangle.
std::optional<std::pair<int, int>> find_near_triangles(
    const std::vector<Point<3>>& points, const std::vector<std::array<int, 3>>& triangles,
    double margin);

}  // namespace encase
