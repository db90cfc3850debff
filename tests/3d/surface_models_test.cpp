// SPDX-License-Identifier: MIT
#include "3d/surface_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "3d/triangle_bounds.hpp"
#include "written.hpp"

namespace encase {
namespace {

bool holds(const Interval& range, double by, double value) {
  return range.lo - by <= value && value <= range.hi + by;
}

/// Compares with the narrow ranges of Bernstein forms on tiny boxes.
void expect_derivatives(const FilteredFunction<3>& f) {
  Kernel kernel;
  const SurfaceBounds bounds(f, 1);
  SurfaceModels models(bounds, kernel);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const double half = std::ldexp(1.0, -1 - k % 7);
    const Point<3> middle{unit(random), unit(random), unit(random)};
    const Box<3> box = inflated({middle, middle}, half);
    const SurfaceModel& model = models.around(box);
    Point<3> at;
    for (int i = 0; i < 3; ++i) at[i] = middle[i] + half * unit(random);
    const DerivativeRanges near = bounds.derivatives({at, at}, Kernel::kDoubleBits, kernel);
    const IntervalVector first = model.gradient(at);
    const auto second = model.second(box);
    const double spread = 1e-3;  // of the ranges on tiny boxes
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(holds(first[i], model.slope_error() + spread, near.first[i].mid()));
      for (int j = 0; j < 3; ++j)
        EXPECT_TRUE(holds(second[i][j], model.bend_error() + spread, near.second[i][j].mid()));
    }
  }
}

TEST(SurfaceModels, HoldTheDerivatives) {
  expect_derivatives(FilteredFunction<3>(written::polynomial<3>("x^4-3*x^2*y*z+y^3*z-2*z^2*x+y")));
}

TEST(SurfaceModels, AreNarrowInTheMiddleOfSmallBoxes) {
  const FilteredFunction<3> f(written::polynomial<3>("x^4+y^2*z-z"));
  Kernel kernel;
  const SurfaceBounds bounds(f, 1);
  SurfaceModels models(bounds, kernel);
  const Point<3> at{0.5, 0.25, 0.125};
  const SurfaceModel& model = models.around(inflated({at, at}, 0x1p-8));
  const IntervalVector first = model.gradient(at);
  EXPECT_LT(first[0].width(), 1e-3);
  EXPECT_TRUE(holds(first[0], 1e-12, 4 * 0.125 / f.scale()));
  EXPECT_LT(model.slope_error(), 1e-9);
}

TEST(TriangleBounds, AreSharpForASphere) {
  const FilteredFunction<3> f(written::polynomial<3>("x^2+y^2+z^2-1"));
  Kernel kernel;
  const SurfaceBounds bounds(f, 4);
  SurfaceModels models(bounds, kernel);
  const double a = 0.1, height = std::sqrt(1 - a * a);
  Corners corners;
  for (int k = 0; k < 3; ++k) {
    const Point<3> p{a * std::cos(2 * M_PI * k / 3), a * std::sin(2 * M_PI * k / 3), height};
    corners[k] = {p, kWithin, magnitude(bounds.value(p, Kernel::kDoubleBits)), p, 1.0};
  }
  const TriangleBounds proved = bound_triangle(models, corners, 0.01, 0x1p-40);
  EXPECT_GE(proved.distance, 1 - height);
  EXPECT_LE(proved.distance, 1.1 * (1 - height));
  EXPECT_GE(proved.angle, std::asin(a));
  EXPECT_LE(proved.angle, 1.1 * std::asin(a));
  // Along directions from the origin the sphere is as far as it is at all.
  EXPECT_GE(proved.way, 1 - height);
  EXPECT_LE(proved.way, 1.1 * (1 - height));
}

TEST(TriangleBounds, HaveNoWayWhereDirectionsCross) {
  const FilteredFunction<3> f(written::polynomial<3>("z"));
  Kernel kernel;
  const SurfaceBounds bounds(f, 4);
  SurfaceModels models(bounds, kernel);
  const double side = 1e-3, height = 4e-4, z = std::sqrt(1 - 0.9 * 0.9);
  for (const double turned : {0.9, -0.9}) {
    const std::array<Point<3>, 3> points{{{0, 0, height}, {side, 0, height}, {0, side, height}}};
    Corners corners;
    for (int k = 0; k < 3; ++k)
      corners[k] = {points[k], kWithin, magnitude(bounds.value(points[k], Kernel::kDoubleBits)),
                    Point<3>{k == 1 ? turned : 0.9, 0, z}, 1.0};
    const double way = bound_triangle(models, corners, 0.1, 0x1p-40).way;
    EXPECT_EQ(std::isfinite(way), turned > 0) << way;
  }
}

TEST(TriangleBounds, HaveNoWayOutOfTheRegion) {
  const FilteredFunction<3> f(written::polynomial<3>("x^2+y^2+z^2-1"));
  Kernel kernel;
  const SurfaceBounds bounds(f, 4);
  SurfaceModels models(bounds, kernel);
  const double a = 0.1, height = std::sqrt(1 - a * a);
  for (const double room : {1.1 * (1 - height), 0.9 * (1 - height)}) {
    Corners corners;
    for (int k = 0; k < 3; ++k) {
      const Point<3> p{a * std::cos(2 * M_PI * k / 3), a * std::sin(2 * M_PI * k / 3), height};
      corners[k] = {p, kWithin, magnitude(bounds.value(p, Kernel::kDoubleBits)), p,
                    k == 1 ? room : 1.0};
    }
    EXPECT_EQ(std::isfinite(bound_triangle(models, corners, 0.01, 0x1p-40).way), room > 1 - height);
  }
}

}  // namespace
}  // namespace encase
