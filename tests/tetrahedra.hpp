// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase {

/// Euler's characteristic of a surface in a box as a grid of tetrahedra shows it: the box is cut in
/// count^3 bricks, each in six tetrahedra around a diagonal, and the polynomial is linear between
/// the signs at their corners. Then every edge with two signs has a point of the surface, every
/// such triangle a segment and every such tetrahedron a polygon. Values come from doubles; nothing
/// is proved.
inline int euler_by_tetrahedra(const Polynomial<3>& f, const Box<3>& box, int count) {
  const int n = count + 1;
  const auto index = [n](int i, int j, int k) { return (std::size_t(i) * n + j) * n + k; };
  std::vector<bool> positive(std::size_t(n) * n * n);
  const int degree = f.degree();
  const auto coordinate = [&](int axis, int k) {
    return box.lo[axis] + box.width(axis) * k / count;
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      std::vector<double> in_z(degree + 1, 0.0);
      for (const auto& [exponent, coefficient] : f.terms()) {
        double term = coefficient.get_d();
        for (int e = 0; e < exponent[0]; ++e) term *= coordinate(0, i);
        for (int e = 0; e < exponent[1]; ++e) term *= coordinate(1, j);
        in_z[exponent[2]] += term;
      }
      for (int k = 0; k < n; ++k) {
        double value = 0;
        for (int e = degree; e >= 0; --e) value = value * coordinate(2, k) + in_z[e];
        positive[index(i, j, k)] = value > 0;
      }
    }
  // Every simplex is a corner and some of the seven steps in {0,1}^3, each above the one before it.
  const auto above = [](int s, int t) { return (s & t) == s && s != t; };
  int euler = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const bool sign = positive[index(i, j, k)];
        const auto exists = [&](int s) {
          return i + (s >> 2 & 1) < n && j + (s >> 1 & 1) < n && k + (s & 1) < n;
        };
        const auto differs = [&](int s) {
          return positive[index(i + (s >> 2 & 1), j + (s >> 1 & 1), k + (s & 1))] != sign;
        };
        for (int a = 1; a < 8; ++a) {
          if (!exists(a)) continue;
          euler += differs(a);
          for (int b = a + 1; b < 8; ++b) {
            if (!above(a, b) || !exists(b)) continue;
            euler -= differs(a) || differs(b);
            if (b != 7 && exists(7)) euler += differs(a) || differs(b) || differs(7);
          }
        }
      }
  return euler;
}

}  // namespace encase
