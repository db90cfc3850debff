// SPDX-License-Identifier: MIT
//
// Patches against rational arithmetic.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/patch.hpp"
#include "exact_nets.hpp"

namespace encase {

inline Rational dot(const Patch& patch, const std::vector<Rational>& of_x,
                    const std::vector<Rational>& of_y) {
  const bool x_by_rows = patch.rows_axis == 0;
  Rational sum = 0;
  for (int i = 0; i < patch.count; ++i)
    for (int j = 0; j < patch.count; ++j)
      sum += Rational(patch.b[i][j]) * of_x[x_by_rows ? i : j] * of_y[x_by_rows ? j : i];
  return sum;
}

/// What the net says at (x, y) in [-1,1]^2.
inline Jet2 jet(const Patch& patch, const RationalPoint<2>& s) {
  const int n = patch.count - 1;
  std::array<std::array<std::vector<Rational>, 3>, 2> b;
  for (int i = 0; i < 2; ++i)
    for (int d = 0; d < 3; ++d) b[i][d] = basis(n, (s[i] + 1) / 2, d);
  return {dot(patch, b[0][0], b[1][0]), dot(patch, b[0][1], b[1][0]), dot(patch, b[0][0], b[1][1]),
          dot(patch, b[0][2], b[1][0]), dot(patch, b[0][0], b[1][2]), dot(patch, b[0][1], b[1][1])};
}

/// The polynomial is as far from the net as its radii say, or less, at some points; and the
/// extremes are those of the coefficients. `with_bends`: second derivatives, too. Returns the
/// greatest share of a radius that is needed.
inline double expect_true(const Patch& patch, const Exact& exact, const Box<2>& box, Random& random,
                          bool with_bends = true) {
  EXPECT_TRUE(std::isfinite(patch.radius));
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  for (int i = 0; i < patch.count; ++i)
    for (int j = 0; j < 8; ++j) {
      EXPECT_EQ(patch.b[i][j], patch.b[i][std::min(j, patch.count - 1)]);
      lo = std::min(lo, patch.b[i][j]);
      hi = std::max(hi, patch.b[i][j]);
    }
  EXPECT_EQ(patch.lo, lo);
  EXPECT_EQ(patch.hi, hi);
  double needed = 0;
  const int rows = patch.rows_axis, lanes = 1 - rows;
  for (int round = 0; round < 4; ++round) {
    RationalPoint<2> s = random_point(random);
    if (round == 0) s = {Rational(-1), Rational(1)};
    if (round == 1) s[0] = 1;
    const Jet2 f = exact.at(box, s), net = jet(patch, s);
    const auto off = [](const Rational& a, const Rational& b) { return Rational(abs(a - b)); };
    const auto expect_within = [&](const Rational& distance, double radius) {
      EXPECT_LE(distance, Rational(radius));
      needed = std::max(needed, distance.get_d() / radius);
    };
    expect_within(off(f.value, net.value), patch.radius);
    const Rational slope[2] = {off(f.x, net.x), off(f.y, net.y)};
    expect_within(slope[rows], patch.slope_radius[0]);
    expect_within(slope[lanes], patch.slope_radius[1]);
    if (!with_bends) continue;
    const Rational bend[2] = {off(f.xx, net.xx), off(f.yy, net.yy)};
    expect_within(bend[rows], patch.bend_radius[0]);
    expect_within(bend[lanes], patch.bend_radius[1]);
    expect_within(off(f.xy, net.xy), patch.bend_radius[2]);
  }
  return needed;
}

}  // namespace encase
