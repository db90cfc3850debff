// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string>

#include "common/filtered_function.hpp"
#include "encase/slice.hpp"
#include "written.hpp"

namespace encase {
namespace {

using Coefficients = std::array<Rational, 4>;

Coefficients random_plane(std::mt19937& generator) {
  std::uniform_int_distribution<int> number(-9, 9);
  for (;;) {
    const Coefficients plane{number(generator), number(generator), number(generator),
                             Rational(number(generator), 7)};
    if (plane[0] != 0 || plane[1] != 0 || plane[2] != 0) return plane;
  }
}

TEST(PlaneChart, LiftedPointsLieOnThePlane) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Coefficients plane = random_plane(generator);
    const PlaneChart chart(plane);
    const RationalPoint<2> point{Rational(trial, 11), Rational(3 - trial, 13)};
    const RationalPoint<3> lifted = chart.lift(point);
    EXPECT_EQ(plane[0] * lifted[0] + plane[1] * lifted[1] + plane[2] * lifted[2] + plane[3], 0);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(lifted[chart.axes()[i]], point[i]);
    const Point<3> rounded = chart.lift(Point<2>{point[0].get_d(), point[1].get_d()});
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(rounded[i], lifted[i].get_d(), 1e-12);
  }
}

TEST(PlaneChart, TurnsCounterClockwiseSeenFromTheNormal) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Coefficients plane = random_plane(generator);
    const PlaneChart chart(plane);
    const auto origin = chart.lift(RationalPoint<2>{0, 0});
    std::array<RationalPoint<3>, 2> along{chart.lift(RationalPoint<2>{1, 0}),
                                          chart.lift(RationalPoint<2>{0, 1})};
    for (auto& direction : along)
      for (int i = 0; i < 3; ++i) direction[i] -= origin[i];
    const auto& [u, v] = along;
    const Rational turn = plane[0] * (u[1] * v[2] - u[2] * v[1]) +
                          plane[1] * (u[2] * v[0] - u[0] * v[2]) +
                          plane[2] * (u[0] * v[1] - u[1] * v[0]);
    EXPECT_GT(turn, 0);
  }
}

TEST(PlaneChart, RestrictedPolynomialsHaveTheValuesOfTheLiftedPoints) {
  std::mt19937 generator(3);
  const auto f = written::polynomial<3>("x^3*y - 2*x*y*z + z^4/3 - 5*y^2 + x - 1/7");
  for (int trial = 0; trial < 50; ++trial) {
    const PlaneChart chart(random_plane(generator));
    const Polynomial<2> restricted = chart.restrict(Function<3>(f)).polynomial();
    const RationalPoint<2> point{Rational(trial, 5), Rational(7 - trial, 3)};
    EXPECT_EQ(restricted(point), f(chart.lift(point)));
  }
}

TEST(PlaneChart, RestrictedExpressionsReplaceVariables) {
  // On z = 0 and on x = y, x and y are left.
  const Expression x = Expression::variable(0), y = Expression::variable(1),
                   z = Expression::variable(2);
  const Expression f = Expression::apply(Operation::Sin, x * y) + z.power(2) * Expression::pi();
  const PlaneChart flat({0, 0, 1, Rational(-1, 2)});
  EXPECT_EQ(flat.restrict(Function<3>(f)).expression(),
            Expression::apply(Operation::Sin, x * y) +
                Expression(Rational(1, 2)).power(2) * Expression::pi());
  const PlaneChart steep({1, -2, 0, 0});  // y = x / 2; the chart has (z, x)
  ASSERT_EQ(steep.axes(), (std::array<int, 2>{0, 2}));
  const Expression restricted = steep.restrict(Function<3>(f)).expression();
  EXPECT_TRUE(restricted.uses(0) && restricted.uses(1) && !restricted.uses(2));
}

TEST(PlaneChart, DiagonalPlaneCutsACubeInAHexagon) {
  const Polyhedron cube = make_box({0, 0, 0}, {1, 1, 1}).value();
  const PlaneChart chart({1, 1, 1, Rational(-3, 2)});
  const Region hexagon = chart.restrict(cube).value();
  ASSERT_EQ(hexagon.corners.size(), 6u);
  for (const auto& corner : hexagon.corners) {
    const auto lifted = chart.lift(corner);
    int whole = 0, half = 0;
    for (const Rational& c : lifted) {
      whole += c == 0 || c == 1;
      half += c == Rational(1, 2);
    }
    EXPECT_EQ(whole, 2);
    EXPECT_EQ(half, 1);
  }
}

TEST(PlaneChart, ASideIsASliceAndAnEdgeIsNone) {
  const Polyhedron cube = make_box({0, 0, 0}, {1, 1, 1}).value();
  EXPECT_EQ(PlaneChart({0, 0, 1, -1}).restrict(cube).value().corners.size(), 4u);
  const auto edge = PlaneChart({1, 1, 0, 0}).restrict(cube);
  ASSERT_FALSE(edge);
  EXPECT_NE(edge.error().message.find("corner or an edge"), std::string::npos);
  EXPECT_FALSE(PlaneChart({1, 1, 1, -3}).restrict(cube));
  const auto beside = PlaneChart({1, 1, 1, -4}).restrict(cube);
  ASSERT_FALSE(beside);
  EXPECT_NE(beside.error().message.find("does not meet"), std::string::npos);
}

}  // namespace
}  // namespace encase
