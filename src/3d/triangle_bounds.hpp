// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "3d/surface_bounds.hpp"
#include "common/kernel.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// How close a triangle is to a surface.
struct TriangleBounds {
  /// No point of the triangle is farther than this from the surface; infinite: nothing is proved.
  double distance = std::numeric_limits<double>::infinity();
  /// The triangle's normal and the gradient include no larger angle, on a box around the triangle.
  double angle = std::numeric_limits<double>::infinity();
};

/// Proves such bounds. The gradient is to point to the side from which the corners are
/// counter-clockwise. `reach`: how far from the triangle the surface is looked for; a distance
/// beyond it is not proved.
///
/// With n the triangle's unit normal, n . grad f >= mu > 0 on the box and |f| <= m on the triangle,
/// f changes its sign on the way from a point of the triangle along n or -n by m / mu. A point x =
/// sum of c_i p_i of the triangle has |f(x)| <= sum of c_i |f(p_i)| + h / 2 sum of c_i |p_i - x|^2,
/// where h bounds the second derivatives in directions of the triangle's plane; and the last sum is
/// at most a third of the square of the longest side.
TriangleBounds bound_triangle(const SurfaceBounds& f, const std::array<Point<3>, 3>& corners,
                              double reach, Kernel& kernel);

}  // namespace encase
