// SPDX-License-Identifier: MIT
#include "encase/slice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/verify.hpp"
#include "written.hpp"

namespace encase {
namespace {

NamedSurface surface(const std::string& name, const std::string& text) {
  return {name, written::polynomial<3>(text)};
}

Polyhedron cube(int half) { return make_box({-half, -half, -half}, {half, half, half}).value(); }

const std::string kTorus = "(x^2+y^2+z^2+3)^2-16*(x^2+y^2)";  // radii 2 and 1

Slice certified(const std::vector<NamedSurface>& surfaces, const Polyhedron& region,
                const std::array<Rational, 4>& plane) {
  auto result = slice(surfaces, region, plane);
  EXPECT_TRUE(result) << result.error().message;
  EXPECT_EQ(result.value().encasement.outcome, Outcome::Certified);
  const Verification proof = verify(result.value());
  EXPECT_TRUE(proof.ok()) << proof.objections.front();
  return std::move(result).value();
}

/// The loops and arcs of the arrangement's curves.
std::size_t components(const Slice& slice) {
  return arrange(slice.encasement).value().curve_components.size();
}

TEST(Slice, PlanesCutATorusInItsSpiricSections) {
  const std::vector<NamedSurface> torus{surface("torus", kTorus)};
  // Through its middle: two circles; across: two circles; beyond the hole: one loop; none.
  EXPECT_EQ(components(certified(torus, cube(4), {0, 0, 1, 0})), 2u);
  EXPECT_EQ(components(certified(torus, cube(4), {1, 0, 0, 0})), 2u);
  EXPECT_EQ(components(certified(torus, cube(4), {1, 0, 0, Rational(-3, 2)})), 1u);
  EXPECT_EQ(components(certified(torus, cube(4), {1, 0, 0, Rational(-7, 2)})), 0u);
  // Villarceau's circles cross, where the plane touches the torus, in two points.
  const auto villarceau = slice(torus, cube(4), {1, 0, Rational(-10001, 10000), 0});
  EXPECT_TRUE(villarceau);
}

TEST(Slice, CrossingsAreThoseOfTheIntersectionCurveWithThePlane) {
  // Two unit spheres with centres a unit apart meet in a circle of radius sqrt(3) / 2 in the plane
  // x = 1/2, and that circle meets the plane y = z / 3 + 1/10 in two points.
  const std::vector<NamedSurface> spheres{surface("a", "x^2+y^2+z^2-1"),
                                          surface("b", "(x-1)^2+y^2+z^2-1")};
  const Slice result = certified(spheres, cube(2), {0, 1, Rational(-1, 3), Rational(-1, 10)});
  ASSERT_EQ(result.encasement.crossings.size(), 2u);
  for (const Crossing& crossing : result.encasement.crossings) {
    const Point<3> p = result.source.chart.lift(crossing.point);
    EXPECT_NEAR(p[0], 0.5, 1e-14);
    EXPECT_NEAR(p[1] * p[1] + p[2] * p[2], 0.75, 1e-14);
    EXPECT_NEAR(p[1], p[2] / 3 + 0.1, 1e-14);
  }
}

TEST(Slice, SurfacesWithoutACurveOnThePlaneAreToldApart) {
  const std::vector<NamedSurface> surfaces{surface("contains", "z*(x+y-1)"),
                                           surface("beside", "z-1"),
                                           surface("sphere", "x^2+y^2+z^2-1")};
  const Slice result = certified(surfaces, cube(2), {0, 0, 1, 0});
  EXPECT_EQ(result.source.containing, std::vector<int>{0});
  EXPECT_EQ(result.source.surface_of, std::vector<int>{2});
  ASSERT_EQ(result.encasement.input.size(), 1u);
  EXPECT_EQ(result.encasement.input[0].name, "sphere");
}

TEST(Slice, ConstantExpressionsAreToldApartToo) {
  const Expression x = Expression::variable(0), z = Expression::variable(2);
  const auto sine = [](const Expression& f) { return Expression::apply(Operation::Sin, f); };
  const std::vector<NamedSurface> surfaces{{"contains", sine(z) * Expression::pi()},
                                           {"beside", sine(z + Expression(1))}};
  const Slice result = certified(surfaces, cube(2), {0, 0, 1, 0});
  EXPECT_EQ(result.source.containing, std::vector<int>{0});
  EXPECT_TRUE(result.source.surface_of.empty());
  // sin(pi) is zero, but no arithmetic of intervals proves it.
  const auto unknown = slice({{"s", sine(z + Expression::pi())}}, cube(2), {0, 0, 1, 0});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, Error::Code::Undecided);
}

TEST(Slice, WithoutCurvesIsAnEmptyCell) {
  const Slice result = certified({surface("beside", "z-1")}, cube(2), {0, 0, 1, 0});
  EXPECT_EQ(result.encasement.cells.size(), 1u);
  EXPECT_TRUE(result.source.surface_of.empty());
}

TEST(Slice, CheckerObjectsToWhatIsNotOnThePlane) {
  const Slice good =
      certified({surface("beside", "z-1"), surface("s", "x^2+y^2+z^2-1")}, cube(2), {0, 0, 1, 0});
  const auto expect_objection = [&](auto change) {
    Slice bad = good;
    change(bad);
    EXPECT_FALSE(verify(bad).ok());
  };
  expect_objection([](Slice& s) { s.source.chart = PlaneChart({0, 0, 1, Rational(-1, 2)}); });
  expect_objection([](Slice& s) { s.source.chart = PlaneChart({0, 0, 1, -1}); });
  expect_objection(
      [](Slice& s) { s.source.surfaces[1].function = written::polynomial<3>("x^2+y^2-2"); });
  expect_objection([](Slice& s) { s.source.surfaces[0].function = written::polynomial<3>("z"); });
  expect_objection([](Slice& s) { s.source.surfaces[1].name = "t"; });
  expect_objection([](Slice& s) { s.source.surface_of = {0}; });
  expect_objection([](Slice& s) { s.source.containing = {0}; });
  expect_objection([](Slice& s) { s.source.region = cube(3); });
  expect_objection([](Slice& s) { s.encasement.crossings.push_back({}); });
}

TEST(Slice, BadPlanesAreRefused) {
  const std::vector<NamedSurface> sphere{surface("s", "x^2+y^2+z^2-1")};
  EXPECT_EQ(slice(sphere, cube(2), {0, 0, 0, 1}).error().code, Error::Code::BadInput);
  EXPECT_EQ(slice(sphere, cube(2), {0, 0, 1, 9}).error().code, Error::Code::BadInput);
  EncaseOptions perturbed;
  perturbed.perturbation = 1e-8;
  EXPECT_EQ(slice(sphere, cube(2), {0, 0, 1, 0}, perturbed).error().code, Error::Code::BadInput);
}

TEST(Slice, ParallelPlanesCutTheRegionEvenly) {
  const auto planes = parallel_planes(cube(2), {0, 0, 2}, 3);
  ASSERT_EQ(planes.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(planes[k][2], 2);
    EXPECT_EQ(Rational(-planes[k][3] / 2), k - 1);
  }
}

}  // namespace
}  // namespace encase
