// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "3d/surface_models.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// How close a triangle is to a surface.
struct TriangleBounds {
  /// No point of the triangle is farther than this from the surface; infinite: nothing is proved.
  double distance = std::numeric_limits<double>::infinity();
  /// The triangle's normal and the gradient include no larger angle, over the triangle and as far
  /// from it as the distance.
  double angle = std::numeric_limits<double>::infinity();
};

/// A triangle's corners with bounds of |f| there.
struct Corners {
  std::array<Point<3>, 3> points;
  std::array<double, 3> sizes;
};

/// At least |f| at a point.
inline double size_at(const SurfaceBounds& f, const Point<3>& point) {
  return magnitude(f.value(point, Kernel::kDoubleBits));
}

/// Proves such bounds. The gradient is to point to the side from which the corners are
/// counter-clockwise. `reach`: how far from the triangle the surface is looked for; a distance
/// beyond it is not proved.
///
/// A function whose second derivatives in directions of the triangle's plane are at most h differs
/// on the triangle by at most h l^2 / 6 from what is linear between the corners, l the longest
/// side: f(p_i) = f(x) + grad f(x) . (p_i - x) + a rest of at most h |p_i - x|^2 / 2, and for x =
/// sum of c_i p_i the mean of |p_i - x|^2 is at most l^2 / 3. So are bounded f on the triangle, by
/// m, and its derivatives, from which those over the triangle differ by the way times the second
/// ones. With n the unit normal, n . grad f >= mu > 0 there: f changes its sign on the way from a
/// point of the triangle along n or -n by m / mu.
TriangleBounds bound_triangle(SurfaceModels& f, const Corners& corners, double reach);

/// With unit vectors at the corners, linear between them: from every point of the triangle the
/// surface is met exactly once as far as this in the vector's direction and in the opposite one,
/// and f grows along all these ways; also if corners move by up to `moved`, and directions by
/// roundings. Infinite: that is not proved, or it is beyond the reach.
double bound_along(SurfaceModels& f, const Corners& corners,
                   const std::array<Point<3>, 3>& directions, double reach, double moved);

}  // namespace encase
