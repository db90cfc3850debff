// SPDX-License-Identifier: MIT
#include "3d/triangle_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "3d/space_vectors.hpp"

namespace encase {

namespace {

constexpr double kUp = 1 + 0x1p-40;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What is known of f over a triangle, as far from it as `way`.
struct Surroundings {
  Surroundings(SurfaceModels& f, const Corners& corners, double furthest);
  /// The second derivatives in a direction and those of the axes.
  IntervalVector bend_along(const IntervalVector& a) const {
    return {dot(bends[0], a), dot(bends[1], a), dot(bends[2], a)};
  }

  bool known = false;
  double longest = 0, way = 0;
  double tilt = 0;                       ///< between the basis and that of the plane, at most
  IntervalVector u, v, n;                ///< of the plane, and across it
  std::array<IntervalVector, 3> slopes;  ///< gradients at the corners
  double between = 0;            ///< on the triangle they differ by this from what is linear
  double aside = 0, upward = 0;  ///< they change along n by these times the way, in and across it
  std::array<IntervalVector, 3> bends;  ///< second derivatives
  double bend = 0;                      ///< bounds the norm of second derivatives
  double size = 0;                      ///< bounds |f| on the triangle
};

Surroundings::Surroundings(SurfaceModels& f, const Corners& corners, double furthest) {
  const Point<3>&p = corners[0].at, &q = corners[1].at, &r = corners[2].at;
  const Point<3> area = cross(q - p, r - p), normal = unit(area);
  if (!(length(normal) > 0.5)) return;
  longest = std::max({length(q - p), length(r - q), length(p - r)}) * kUp;
  // The basis is that of the plane up to rounding, relative to the triangle's shape.
  tilt = 0x1p-48 * longest * longest / length(area);
  if (!(tilt < 0x1p-10)) return;
  const auto basis = across(normal);
  u = exactly(basis[0]);
  v = exactly(basis[1]);
  n = exactly(normal);

  way = std::min(furthest, longest) * kUp;
  const Box<3> box = inflated(hull(hull(Box<3>{p, p}, {q, q}), {r, r}), way);
  const SurfaceModel& model = f.around(box);
  bends = model.second(box);
  const IntervalVector bend_n = bend_along(n), bend_u = bend_along(u);
  const double turning = std::hypot(magnitude(dot(bend_n, u)), magnitude(dot(bend_n, v)));
  const double nn = magnitude(dot(bend_n, n));
  // The norm of the 2 x 2 matrix of second derivatives in the plane.
  const Interval uu = dot(bend_u, u), vv = dot(bend_along(v), v), half(0.5);
  const double in_plane = magnitude(half * (uu + vv)) +
                          std::hypot(magnitude(half * (uu - vv)), magnitude(dot(bend_u, v)));
  bend = (2 * in_plane + nn + 2 * turning) * kUp;
  const double tilted = 4 * tilt * bend;
  aside = (turning + tilted) * kUp;
  upward = (nn + tilted) * kUp;
  between = (model.third() * longest * longest / 6 + 2 * model.slope_error()) * kUp;

  double sum = between + bend;
  for (int i = 0; i < 3; ++i) {
    slopes[i] = model.gradient(corners[i].at);
    size = std::max(size, corners[i].size);
    sum += corners[i].size;
    for (const Interval& slope : slopes[i]) sum += magnitude(slope);
  }
  const double h = in_plane + tilted + 4 * model.bend_error();
  size = (size + h * longest * longest / 6) * kUp;
  known = std::isfinite(sum + size);
}

/// Distance and angle, if the surface is looked for as far as `s` reaches.
void bound_across(const Surroundings& s, TriangleBounds* bounds) {
  double up = kInfinity, along = 0, largest = 0;
  for (const IntervalVector& slope : s.slopes) {
    const Interval rise = dot(slope, s.n);
    up = std::min(up, rise.lo);
    along = std::max(along, std::hypot(magnitude(dot(slope, s.u)), magnitude(dot(slope, s.v))));
    largest = std::max(largest, magnitude(rise));
  }
  along = (along + s.between + s.aside * s.way) * kUp;
  largest = (largest + along + s.between + s.upward * s.way) * kUp;
  const double mu = up - (s.between + s.upward * s.way + s.tilt * largest) * kUp;
  if (!(mu > 0)) return;
  bounds->angle = std::atan((along + s.tilt * largest) / mu) * kUp;
  const double distance = s.size / mu * kUp;
  if (distance <= s.way) bounds->distance = distance;
}

double determinant(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  return dot(cross(a, b), c);
}

/// Whether (x, s) -> x + s W(x) has a positive Jacobian on the triangle, for |s| <= way, also if
/// the corners are moved a little.
bool unfolded(const Corners& c, double way, double moved) {
  const Point<3> e1 = c[1].at - c[0].at, e2 = c[2].at - c[0].at;
  const Point<3> w1 = c[1].direction - c[0].direction, w2 = c[2].direction - c[0].direction;
  const double long1 = length(e1) + way * length(w1), long2 = length(e2) + way * length(w2);
  const double slack = 0x1p-40 * long1 * long2 + 8 * moved * (long1 + long2 + moved);
  return std::all_of(c.begin(), c.end(), [&](const Corner& corner) {
    const Point<3>& w = corner.direction;
    return determinant(e1, e2, w) -
               way * std::fabs(determinant(w1, e2, w) + determinant(e1, w2, w)) -
               way * way * std::fabs(determinant(w1, w2, w)) >
           slack;
  });
}

/// The way, if the surface is looked for as far as `s` reaches. grad f . W is up to `between` a
/// quadratic form in the barycentric coordinates of a point of the triangle, at least the least of
/// its Bernstein coefficients; on the way it changes by second derivatives W . H W.
double way_along(const Surroundings& s, const Corners& corners, double moved) {
  double up = kInfinity, steepest = 0, change = 0, room = kInfinity;
  std::array<IntervalVector, 3> w;
  for (int i = 0; i < 3; ++i) w[i] = exactly(corners[i].direction);
  for (int i = 0; i < 3; ++i) {
    room = std::min(room, corners[i].room);
    steepest = std::max(steepest, magnitude(s.slopes[i][0]) + magnitude(s.slopes[i][1]) +
                                      magnitude(s.slopes[i][2]));
    const IntervalVector bend = s.bend_along(w[i]);
    for (int j = i; j < 3; ++j) {
      up = std::min(up, 0.5 * (dot(s.slopes[i], w[j]) + dot(s.slopes[j], w[i])).lo);
      change = std::max(change, magnitude(dot(bend, w[j])));
    }
  }
  steepest = (steepest + s.between + s.bend * s.way) * kUp;
  change = (change + 3 * 0x1p-40 * s.bend) * s.way + s.bend * moved;
  const double mu = up - (s.between + change + 0x1p-40 * steepest) * kUp;
  if (!(mu > 0)) return kInfinity;
  const double way = (s.size + moved * steepest) / mu * kUp + moved;
  return way + 2 * moved <= s.way && way <= room && unfolded(corners, way, moved) ? way : kInfinity;
}

}  // namespace

/// On triangles that turn little against the surface it is nearer than a small part of their sides,
/// and what is far away would only blur the bounds.
TriangleBounds bound_triangle(SurfaceModels& f, const Corners& corners, double reach,
                              double moved) {
  constexpr double kNear = 1.0 / 16;
  const Point<3>&p = corners[0].at, &q = corners[1].at, &r = corners[2].at;
  const double near = kNear * std::max({length(q - p), length(r - q), length(p - r)});
  TriangleBounds result;
  for (const double furthest : {std::min(near, reach), reach}) {
    const Surroundings s(f, corners, furthest);
    if (!s.known) continue;
    if (!std::isfinite(result.distance)) bound_across(s, &result);
    if (!std::isfinite(result.way)) result.way = way_along(s, corners, moved);
    if (std::isfinite(result.distance) && std::isfinite(result.way)) break;
  }
  return result;
}

}  // namespace encase
