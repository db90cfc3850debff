// SPDX-License-Identifier: MIT
#include "3d/mesh_corner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "3d/space_vectors.hpp"

namespace encase {

MeshCorners::MeshCorners(const SurfaceEncasement& encasement, const SurfaceBounds& surface)
    : surface_(surface), size_(encasement.region_used.bounding_box().largest_width()) {
  const auto& corners = encasement.region_used.corners;
  Point<3> middle{};
  for (const RationalPoint<3>& p : corners)
    for (int i = 0; i < 3; ++i)
      middle[i] += nearest_double(p[i]) / static_cast<double>(corners.size());
  for (std::size_t k = 0; k < encasement.region_used.sides.size(); ++k) {
    const Plane& plane = encasement.planes[k];
    const double sum = dot(plane.normal, middle) + plane.offset;
    const double scale = (sum > 0 ? -1 : 1) / length(plane.normal);
    sides_.push_back({scale * plane.normal, scale * plane.offset});
  }
}

double MeshCorners::beyond(int side, const Point<3>& p) const {
  return dot(sides_[side].normal, p) + sides_[side].offset;
}

Corner MeshCorners::corner(const Point<3>& at, const PointSides& sides) const {
  constexpr double kLeastSine = 0.125;
  Corner corner;
  corner.at = at;
  corner.sides = sides;
  corner.size = magnitude(surface_.value(at, Kernel::kDoubleBits));
  Point<3> w = surface_.function().gradient(at);
  if (sides[0] >= 0) {
    const Point<3>& n = sides_[sides[0]].normal;
    w = w - dot(w, n) * n;
  }
  if (sides[1] >= 0) {
    const Point<3> line = cross(sides_[sides[0]].normal, sides_[sides[1]].normal);
    if (length(line) < kLeastSine) return corner;
    w = dot(w, unit(line)) * unit(line);
  }
  corner.direction = unit(w);
  corner.room = std::numeric_limits<double>::infinity();
  for (int k = 0; k < side_count(); ++k) {
    if (k == sides[0] || k == sides[1]) continue;
    const double depth = -beyond(k, at) - moved();
    corner.room =
        std::min(corner.room, std::max(depth, 0.0) /
                                  (std::fabs(dot(sides_[k].normal, corner.direction)) + 0x1p-40));
  }
  return corner;
}

}  // namespace encase
