// SPDX-License-Identifier: MIT
#include "common/substitute.hpp"

#include <gtest/gtest.h>

#include "common/segments.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

TEST(Substitute, TrivariateRestrictedToAPlaneIsAPlaneCurve) {
  // The unit sphere on z = u + v/2 - 1/3.
  const auto curve =
      substitute<2, 3>(polynomial<3>("x^2 + y^2 + z^2 - 1"),
                       {polynomial<2>("x"), polynomial<2>("y"), polynomial<2>("x + y/2 - 1/3")});
  EXPECT_EQ(curve, polynomial<2>("2x^2 + x y + 5/4 y^2 - 2/3 x - 1/3 y - 8/9"));
}

TEST(Substitute, RestrictionToAPlaneHasTheValuesOnThePlane) {
  const auto f = polynomial<3>("x^3 y - 2/7 y^2 z^2 + x z - 5 z + 1/3");
  const std::array<Polynomial<2>, 3> plane{polynomial<2>("1 + 2x - y"), polynomial<2>("x/3 + 2y"),
                                           polynomial<2>("7 - x")};
  const auto g = substitute<2, 3>(f, plane);
  EXPECT_EQ(g.degree(), 4);
  for (int i = -3; i <= 3; ++i)
    for (int j = -3; j <= 3; ++j) {
      const RationalPoint<2> at{Rational(i, 2), Rational(j, 3)};
      EXPECT_EQ(g(at), f({plane[0](at), plane[1](at), plane[2](at)}));
    }
}

TEST(Substitute, TrivariateOnALineIsUnivariate) {
  const auto t = polynomial<1>("x");
  EXPECT_EQ((substitute<1, 3>(polynomial<3>("x y z - 1"), {t, t + t, t - t})), polynomial<1>("-1"));
  EXPECT_EQ((substitute<1, 3>(polynomial<3>("x y z - 1"), {t, t + t, t})),
            polynomial<1>("2x^3 - 1"));
}

TEST(Substitute, WhatContainsThePlaneBecomesZero) {
  const auto f = polynomial<3>("(x - y + z) (x^2 + y z - 3)");
  EXPECT_TRUE((substitute<2, 3>(f, {polynomial<2>("x"), polynomial<2>("x + y"), polynomial<2>("y")})
                   .is_zero()));
  EXPECT_TRUE((substitute<2, 3>(Polynomial<3>(),
                                {polynomial<2>("x"), polynomial<2>("y"), polynomial<2>("1")})
                   .is_zero()));
}

TEST(RestrictExactly, LinesAreParametrisedByTheirLongerAxis) {
  const auto f = polynomial<2>("x^2 + 3 y - 1");
  // y = 2/3 x + 1/5, by x.
  EXPECT_EQ(restrict_exactly(f, Line::from_rationals({Rational(-2, 3), 1, Rational(-1, 5)})),
            polynomial<1>("x^2 + 2 x + 3/5 - 1"));
  // x = 1/2 y - 1, by y.
  EXPECT_EQ(restrict_exactly(f, Line::from_rationals({-2, 1, -2})),
            polynomial<1>("(x/2 - 1)^2 + 3x - 1"));
  // x = 1/3, y = 1/10.
  EXPECT_EQ(restrict_exactly(f, Line::from_rationals({1, 0, Rational(-1, 3)})),
            polynomial<1>("3x - 8/9"));
  EXPECT_EQ(restrict_exactly(f, Line::from_rationals({0, -3, Rational(3, 10)})),
            polynomial<1>("x^2 - 7/10"));
}

TEST(RestrictExactly, HasTheValuesOnTheLine) {
  const auto f = polynomial<2>("x^4 - 3/7 x y^2 + y^3 - x + 1/9");
  for (const Line& line : {Line::from_rationals({0.1, -0.7, 0.3}),
                           Line::from_rationals({Rational(5, 3), Rational(1, 7), -1})}) {
    const auto g = restrict_exactly(f, line);
    for (int i = -4; i <= 4; ++i) {
      const Rational parameter(i, 3);
      EXPECT_EQ(g({parameter}), f(point_on_line(line, parameter)));
    }
  }
}

TEST(RestrictExactly, CurveThatContainsTheLineBecomesZero) {
  EXPECT_TRUE(restrict_exactly(polynomial<2>("(3x - y + 1/7) (x^2 + y)"),
                               Line::from_rationals({3, -1, Rational(1, 7)}))
                  .is_zero());
}

}  // namespace
}  // namespace encase
