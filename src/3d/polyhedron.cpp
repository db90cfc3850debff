// SPDX-License-Identifier: MIT
#include "encase/polyhedron.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "common/interval.hpp"

namespace encase {

namespace {

/// Coordinates are limited so that no double computed from them overflows at once.
constexpr double kMaxCoordinate = 1e300;

Error bad(std::string message) { return {Error::Code::BadInput, std::move(message)}; }

using Vector = RationalPoint<3>;

Vector cross(const HalfSpace& a, const HalfSpace& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const Vector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }
Rational along(const HalfSpace& s, const Vector& v) {
  return s[0] * v[0] + s[1] * v[1] + s[2] * v[2];
}
Rational at(const HalfSpace& s, const Vector& p) { return along(s, p) + s[3]; }

/// A point on both planes, the normals of which have the cross product `direction`.
Vector common_point(const HalfSpace& a, const HalfSpace& b, const Vector& direction) {
  int axis = 0;
  while (direction[axis] == 0) ++axis;
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  Vector p{0, 0, 0};
  p[i] = (a[j] * b[3] - b[j] * a[3]) / direction[axis];
  p[j] = (b[i] * a[3] - a[i] * b[3]) / direction[axis];
  return p;
}

/// The part lo <= t <= hi of a line; without a value: unbounded there.
struct LinePart {
  std::optional<Rational> lo, hi;
  bool is_empty() const { return lo && hi && *lo > *hi; }
};

/// The part of the line point + t direction that lies in all half spaces.
LinePart clip(const std::vector<HalfSpace>& sides, const Vector& point, const Vector& direction) {
  LinePart part;
  for (const HalfSpace& side : sides) {
    const Rational slope = along(side, direction), value = at(side, point);
    if (slope == 0) {
      if (value > 0) return {Rational(1), Rational(0)};
      continue;
    }
    const Rational end = -value / slope;
    if (slope > 0) {
      if (!part.hi || end < *part.hi) part.hi = end;
    } else {
      if (!part.lo || end > *part.lo) part.lo = end;
    }
    if (part.is_empty()) return part;
  }
  return part;
}

}  // namespace

Box<3> Polyhedron::bounding_box() const {
  Box<3> box;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    Box<3> corner;
    for (int i = 0; i < 3; ++i) {
      const Interval around = Interval::enclose(corners[k][i]);
      corner.lo[i] = around.lo;
      corner.hi[i] = around.hi;
    }
    box = k == 0 ? corner : hull(box, corner);
  }
  return box;
}

Result<Polyhedron> make_polyhedron(std::vector<HalfSpace> half_spaces) {
  if (half_spaces.size() > kMaxSides)
    return bad("a region can have at most " + std::to_string(kMaxSides) + " half spaces, not " +
               std::to_string(half_spaces.size()));
  for (std::size_t k = 0; k < half_spaces.size(); ++k)
    if (is_zero({half_spaces[k][0], half_spaces[k][1], half_spaces[k][2]}))
      return bad("half space " + std::to_string(k + 1) + " of the region has no normal");
  Polyhedron result;
  result.sides = std::move(half_spaces);
  // Corners are the ends of edges, and an edge lies on two sides. If there is a corner, then the
  // polyhedron contains no line, and is unbounded only if one of its edges is.
  bool spanning = false;  // the normals span the space
  for (std::size_t i = 0; i < result.sides.size(); ++i)
    for (std::size_t j = i + 1; j < result.sides.size(); ++j) {
      const HalfSpace &a = result.sides[i], &b = result.sides[j];
      const Vector direction = cross(a, b);
      if (is_zero(direction)) continue;
      for (const HalfSpace& c : result.sides) spanning = spanning || along(c, direction) != 0;
      const Vector point = common_point(a, b, direction);
      const LinePart edge = clip(result.sides, point, direction);
      if (edge.is_empty()) continue;
      if (!edge.lo || !edge.hi) return bad("the region is not bounded");
      for (const Rational& t : {*edge.lo, *edge.hi}) {
        Vector corner;
        for (int k = 0; k < 3; ++k) corner[k] = point[k] + t * direction[k];
        result.corners.push_back(std::move(corner));
      }
    }
  std::sort(result.corners.begin(), result.corners.end());
  result.corners.erase(std::unique(result.corners.begin(), result.corners.end()),
                       result.corners.end());
  if (result.corners.empty())
    return bad(spanning ? "the region is empty: its half spaces have no common point"
                        : "the region is not bounded, or empty: the normals of its half spaces do "
                          "not span the space");
  Vector sum{0, 0, 0};
  for (const Vector& corner : result.corners)
    for (int k = 0; k < 3; ++k) {
      if (abs(corner[k]) > Rational(kMaxCoordinate))
        return bad("a corner of the region is too far away: coordinates are limited to 1e300");
      sum[k] += corner[k];
    }
  for (Rational& coordinate : sum) coordinate /= static_cast<unsigned long>(result.corners.size());
  for (const HalfSpace& side : result.sides)
    if (at(side, sum) >= 0) return bad("the region has no interior: it lies in a plane");
  return result;
}

Result<Polyhedron> make_box(const RationalPoint<3>& lo, const RationalPoint<3>& hi) {
  std::vector<HalfSpace> sides;
  for (int i = 0; i < 3; ++i) {
    if (lo[i] >= hi[i])
      return bad(std::string("the region has no volume: the lower bound of ") + "xyz"[i] +
                 " is not less than the upper one");
    HalfSpace below{0, 0, 0, lo[i]}, above{0, 0, 0, -hi[i]};
    below[i] = -1;
    above[i] = 1;
    sides.push_back(std::move(below));
    sides.push_back(std::move(above));
  }
  return make_polyhedron(std::move(sides));
}

}  // namespace encase
