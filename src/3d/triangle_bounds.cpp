// SPDX-License-Identifier: MIT
#include "3d/triangle_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "3d/space_vectors.hpp"

namespace encase {

TriangleBounds bound_triangle(SurfaceModels& f, const Corners& corners, double reach) {
  constexpr double kUp = 1 + 0x1p-40;
  TriangleBounds result;
  const auto& [p, q, r] = corners.points;
  const Point<3> area = cross(q - p, r - p), normal = unit(area);
  if (!(length(normal) > 0.5)) return result;
  const double longest = std::max({length(q - p), length(r - q), length(p - r)}) * kUp;
  // The basis is that of the plane up to rounding, relative to the triangle's shape: what is off
  // tilts directions by `tilt` at most.
  const double tilt = 0x1p-48 * longest * longest / length(area);
  if (!(tilt < 0x1p-10)) return result;
  const auto basis = across(normal);
  const IntervalVector u = exactly(basis[0]), v = exactly(basis[1]), n = exactly(normal);

  const double way = std::min(reach, longest) * kUp;
  const Box<3> box = inflated(hull(hull(Box<3>{p, p}, {q, q}), {r, r}), way);
  const SurfaceModel& model = f.around(box);
  const std::array<IntervalVector, 3> bends = model.second(box);
  const auto bend = [&](const IntervalVector& a, const IntervalVector& b) {
    Interval sum(0);
    for (int i = 0; i < 3; ++i) sum = sum + dot(bends[i], a) * b[i];
    return sum;
  };
  const double un = magnitude(bend(u, n)), vn = magnitude(bend(v, n)), nn = magnitude(bend(n, n));
  // The norm of the 2 x 2 matrix of second derivatives in the plane.
  const Interval uu = bend(u, u), vv = bend(v, v), half(0.5);
  const double in_plane = (magnitude(half * (uu + vv)) +
                           std::hypot(magnitude(half * (uu - vv)), magnitude(bend(u, v)))) *
                          kUp;
  const double tilted = 4 * tilt * (2 * in_plane + nn + 2 * std::hypot(un, vn)) * kUp;

  double up = std::numeric_limits<double>::infinity(), along = 0, largest = 0, m = 0, sum = 0;
  for (int i = 0; i < 3; ++i) {
    const IntervalVector slope = model.gradient(corners.points[i]);
    const Interval rise = dot(slope, n);
    const double aside = std::hypot(magnitude(dot(slope, u)), magnitude(dot(slope, v)));
    up = std::min(up, rise.lo);
    along = std::max(along, aside);
    largest = std::max(largest, magnitude(rise));
    m = std::max(m, corners.sizes[i]);
    sum += rise.lo + aside + corners.sizes[i];
  }
  if (!std::isfinite(sum)) return result;
  const double between = (model.third() * longest * longest / 6 + 2 * model.slope_error()) * kUp;
  along = (along + between + (std::hypot(un, vn) + tilted) * way) * kUp;
  largest = (largest + along + between + (nn + tilted) * way) * kUp;
  const double mu = up - between - ((nn + tilted) * way + tilt * largest) * kUp;
  if (!(mu > 0)) return result;
  result.angle = std::atan((along + tilt * largest) / mu) * kUp;
  const double h = in_plane + tilted + 4 * model.bend_error();
  const double distance = (m + h * longest * longest / 6) / mu * kUp * kUp;
  if (distance <= std::min(reach, longest)) result.distance = distance;
  return result;
}

}  // namespace encase
