// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>

#include "3d/mesh_corner.hpp"
#include "3d/surface_models.hpp"

namespace encase {

/// How close a triangle is to a surface.
struct TriangleBounds {
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();
  /// No point of the triangle is farther than this from the surface; infinite: nothing is proved.
  double distance = kUnknown;
  /// The triangle's normal and the gradient include no larger angle, over the triangle and as far
  /// from it as the distance.
  double angle = kUnknown;
  /// With the directions W at the corners, linear between them: as far as this along W and -W
  /// every point of the triangle meets the surface exactly once, without leaving the region, f
  /// grows along all these ways, and (x, s) -> x + s W(x) has a positive Jacobian there; also if
  /// corners are moved a little. Infinite: that is not proved.
  double way = kUnknown;
};

using Corners = std::array<Corner, 3>;

/// Proves such bounds. The gradient is to point to the side from which the corners are
/// counter-clockwise. `reach`: how far from the triangle the surface is looked for; what is beyond
/// it is not proved. `moved`: as far as this corners may be moved.
///
/// A function whose second derivatives in directions of the triangle's plane are at most h differs
/// on the triangle by at most h l^2 / 6 from what is linear between the corners, l the longest
/// side: f(p_i) = f(x) + grad f(x) . (p_i - x) + a rest of at most h |p_i - x|^2 / 2, and for x =
/// sum of c_i p_i the mean of |p_i - x|^2 is at most l^2 / 3. So are bounded f on the triangle, by
/// m, and its derivatives, from which those over the triangle differ by the way times the second
/// ones. With n the unit normal, n . grad f >= mu > 0 there: f changes its sign on the way from a
/// point of the triangle along n or -n by m / mu. docs/meshes.md has the rest.
TriangleBounds bound_triangle(SurfaceModels& f, const Corners& corners, double reach, double moved);

}  // namespace encase
