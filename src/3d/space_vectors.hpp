// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "encase/geometry.hpp"

/// Vectors of space in doubles, for what is not to be proved.
namespace encase {

inline Point<3> operator+(const Point<3>& a, const Point<3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point<3> operator-(const Point<3>& a, const Point<3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point<3> operator*(double s, const Point<3>& a) { return {s * a[0], s * a[1], s * a[2]}; }

inline double dot(const Point<3>& a, const Point<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point<3> cross(const Point<3>& a, const Point<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point<3>& a) { return std::hypot(a[0], a[1], a[2]); }

/// Of length 1; zero stays zero.
inline Point<3> unit(const Point<3>& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}

/// Two unit vectors u, v such that (u, v, w) is a right-handed orthonormal basis, up to rounding; w
/// is of length 1.
inline std::array<Point<3>, 2> across(const Point<3>& w) {
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::fabs(w[i]) < std::fabs(w[least])) least = i;
  Point<3> axis{};
  axis[least] = 1;
  const Point<3> u = unit(cross(w, axis));
  return {u, cross(w, u)};
}

}  // namespace encase
