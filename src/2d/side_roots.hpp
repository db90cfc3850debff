// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "2d/curve_bounds.hpp"

namespace encase {

/// The zeros of a curve on a segment along `axis` (a box without extent along the other axis), in
/// ascending order: each in a piece of the segment that holds no other, whose ends are no zeros,
/// and with a derivative along the segment that is not zero. Pieces share ends at most. Nothing if
/// that is not proved (a zero at an end, a tangent).
std::optional<std::vector<Box<2>>> side_roots(CurveBounds& curve, const Box<2>& segment, int axis);

}  // namespace encase
