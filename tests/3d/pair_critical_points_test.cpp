// SPDX-License-Identifier: MIT
#include "3d/pair_critical_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "3d/arc_direction.hpp"
#include "3d/verify_isolation.hpp"
#include "random_triples.hpp"
#include "written.hpp"

namespace encase {
namespace {

const Box<3> kCube{{-2, -2, -2}, {2, 2, 2}};

PairCriticalPoints critical(const Polynomial<3>& f, const Polynomial<3>& g, const Point<3>& w) {
  Kernel kernel;
  const FilteredFunction<3> first(f), second(g);
  auto result =
      pair_critical_points(first, second, w, kCube, {}, SubdivisionLimits{}, kernel).value();
  const System<3> system{&first, &second, &result.direction};
  const Verification proof = verify_isolation(system, kCube, {}, result.points);
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return result;
}

TEST(ArcDirection, IsTheTripleProduct) {
  const auto f = written::polynomial<3>("x^2 y + z^3 - 1"), g = written::polynomial<3>("x z - y^2");
  const Polynomial<3> h = *arc_direction(f, g, {0.5, 0, -3});
  const RationalPoint<3> p{Rational(1, 3), 2, Rational(-5, 7)};
  std::array<Rational, 3> a, b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = f.derivative(static_cast<int>(i))(p);
    b[i] = g.derivative(static_cast<int>(i))(p);
  }
  EXPECT_EQ(h(p), (a[1] * b[2] - a[2] * b[1]) / 2 - 3 * (a[0] * b[1] - a[1] * b[0]));
  EXPECT_FALSE(arc_direction(f, Expression::variable(0), {1, 0, 0}));
}

TEST(PairCriticalPoints, ACircleHasTwo) {
  // Unit spheres with centres a unit apart: a circle of radius sqrt(3) / 2 in the plane x = 1/2.
  const auto result = critical(written::polynomial<3>("x^2+y^2+z^2-1"),
                               written::polynomial<3>("(x-1)^2+y^2+z^2-1"), {0.25, 0.6, 0.8});
  EXPECT_TRUE(result.points.unresolved.empty());
  ASSERT_EQ(result.points.roots.size(), 2u);
  for (const Box<3>& root : result.points.roots) {
    EXPECT_NEAR(root.center()[0], 0.5, 1e-14);
    // Where the tangent is at right angles to (0.6, 0.8).
    EXPECT_NEAR(root.center()[1] * 0.8, root.center()[2] * 0.6, 1e-14);
    EXPECT_NEAR(std::hypot(root.center()[1], root.center()[2]), std::sqrt(0.75), 1e-14);
  }
}

TEST(PairCriticalPoints, RandomPairsAreSettledAndProved) {
  for (const int degree : {2, 3, 4})
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const auto triple = random_triple(degree, seed);
      const auto result = critical(triple[0], triple[1], {0.3, 0.5, 0.8});
      EXPECT_EQ(result.direction.degree(), 2 * (degree - 1));
      EXPECT_TRUE(result.points.unresolved.empty()) << degree << ", " << seed;
    }
}

TEST(PairCriticalPoints, NeedlesAreFoundWhereverTheyAre) {
  // Small spheres and surfaces through their centres meet in closed loops.
  std::mt19937_64 random(5);
  for (const double radius : {5e-4, 5e-7, 5e-9})
    for (int place = 0; place < 20; ++place) {
      Polynomial<3> sphere = Polynomial<3>::constant(-Rational(radius) * Rational(radius)), plane;
      for (int i = 0; i < 3; ++i) {
        const auto offset = Polynomial<3>::variable(i) -
                            Polynomial<3>::constant(Rational(symmetric_random(random)));
        sphere = sphere + offset * offset;
        plane = plane + Polynomial<3>::constant(Rational(symmetric_random(random))) * offset;
      }
      const auto result = critical(sphere, plane + Polynomial<3>::constant(Rational(1, 3)) * sphere,
                                   {0.3, 0.5, 0.8});
      EXPECT_EQ(result.points.roots.size(), 2u) << radius;
      EXPECT_TRUE(result.points.unresolved.empty()) << radius;
    }
}

TEST(PairCriticalPoints, WhereTheDirectionIsAtRightAnglesToAnArcBoxesStayUnresolved) {
  Kernel kernel;
  SubdivisionLimits limits;
  limits.max_boxes = 3000;
  const FilteredFunction<3> f(written::polynomial<3>("x^2+y^2+z^2-1")),
      g(written::polynomial<3>("z - 1/2"));
  const auto result = pair_critical_points(f, g, {0, 0, 1}, kCube, {}, limits, kernel);
  EXPECT_TRUE(result->direction.polynomial().exact().is_zero());
  EXPECT_FALSE(result->points.unresolved.empty());
}

TEST(PairCriticalPoints, OfExpressionsThereAreNone) {
  Kernel kernel;
  const FilteredFunction<3> f(written::polynomial<3>("x^2+y^2+z^2-1"));
  const FilteredFunction<3> g(Function<3>(
      Expression::variable(2) - Expression::apply(Operation::Sin, Expression::variable(0))));
  EXPECT_FALSE(pair_critical_points(f, g, {0, 0, 1}, kCube, {}, SubdivisionLimits{}, kernel));
}

}  // namespace
}  // namespace encase
