// SPDX-License-Identifier: MIT
#include "3d/triangle_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "3d/space_vectors.hpp"

namespace encase {

TriangleBounds bound_triangle(const SurfaceBounds& f, const std::array<Point<3>, 3>& corners,
                              double reach, Kernel& kernel) {
  constexpr double kUp = 1 + 0x1p-40;
  TriangleBounds result;
  const auto& [p, q, r] = corners;
  const Point<3> normal = unit(cross(q - p, r - p));
  if (!(length(normal) > 0.5)) return result;
  const double longest = std::max({length(q - p), length(r - q), length(p - r)}) * kUp;
  const Box<3> box =
      inflated(hull(hull(Box<3>{p, p}, {q, q}), {r, r}), std::min(reach, longest) * kUp);
  const DerivativeRanges d = f.derivatives(box, Kernel::kDoubleBits, kernel);

  // The basis is that of the plane up to rounding, relative to the triangle's shape: what is off
  // tilts directions by `tilt` at most.
  const double height = length(cross(q - p, r - p)) / longest;
  const double tilt = 0x1p-48 * longest / height;
  if (!(tilt < 0x1p-10)) return result;
  const auto basis = across(normal);
  const IntervalVector u = exactly(basis[0]), v = exactly(basis[1]), n = exactly(normal);
  const double largest =
      std::sqrt(3.0) * kUp *
      std::max({magnitude(d.first[0]), magnitude(d.first[1]), magnitude(d.first[2])});
  const double mu = dot(d.first, n).lo - tilt * largest;
  if (!(mu > 0)) return result;
  const double along = std::hypot(magnitude(dot(d.first, u)), magnitude(dot(d.first, v))) * kUp;
  result.angle = std::atan((along + tilt * largest) / mu) * kUp;

  const auto second = [&](const IntervalVector& a, const IntervalVector& b) {
    Interval sum(0);
    for (int i = 0; i < 3; ++i) sum = sum + dot(d.second[i], a) * b[i];
    return magnitude(sum);
  };
  const double uv = second(u, v);
  double whole = 0;  // bounds the norm of all second derivatives
  for (const IntervalVector& row : d.second)
    for (const Interval& entry : row) whole += magnitude(entry);
  const double h =
      (std::hypot(std::hypot(second(u, u), second(v, v)), std::sqrt(2.0) * uv) + 4 * tilt * whole) *
      kUp;
  double m = 0;
  for (const Point<3>& corner : corners)
    m = std::max(m, magnitude(f.value(corner, Kernel::kDoubleBits)));
  const double distance = (m + h * longest * longest / 6) / mu * kUp * kUp;
  if (distance <= std::min(reach, longest)) result.distance = distance;
  return result;
}

}  // namespace encase
