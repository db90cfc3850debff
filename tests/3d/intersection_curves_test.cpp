// SPDX-License-Identifier: MIT
#include "encase/intersection_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "3d/space_vectors.hpp"
#include "encased_surfaces.hpp"

namespace encase {
namespace {

const char* const kSphere = "x^2+y^2+z^2-1";

IntersectionTracing traced(const SurfaceEncasement& encasement, double tolerance) {
  IntersectionTraceOptions options;
  options.tolerance = tolerance;
  return trace(encasement, options).value();
}

double length_of(const TracedIntersection& curve) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < curve.points.size(); ++k)
    sum += length(curve.points[k + 1] - curve.points[k]);
  return sum;
}

TEST(IntersectionCurves, ASphereAndAPlaneMeetInOneCircle) {
  const SurfaceEncasement e = encased_surfaces({kSphere, "z-1/3"}, 2);
  const auto curves = intersection_curves(e);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_TRUE(curves[0].closed);
  EXPECT_EQ(curves[0].facet_points.front(), curves[0].facet_points.back());
  EXPECT_EQ(curves[0].facet_points.size(), curves[0].arcs.size() + 1);
  const double radius = std::sqrt(8.0 / 9);
  for (const double tolerance : {1e-2, 1e-5}) {
    const IntersectionTracing tracing = traced(e, tolerance);
    EXPECT_TRUE(tracing.within_tolerance);
    const TracedIntersection& circle = tracing.curves.at(0);
    EXPECT_EQ(circle.points.front(), circle.points.back());
    EXPECT_NEAR(length_of(circle), 2 * M_PI * radius, 10 * tolerance);
    for (std::size_t k = 0; k < circle.points.size(); ++k) {
      const Point<3>& p = circle.points[k];
      EXPECT_NEAR(std::hypot(p[0], p[1]), radius, 1e-12);
      EXPECT_NEAR(p[2], 1.0 / 3, 1e-12);
      // Along grad f x grad g = (2x, 2y, 2z) x (0, 0, 1) = (2y, -2x, 0).
      EXPECT_NEAR(circle.tangents[k][0], p[1] / radius, 1e-9);
      EXPECT_NEAR(circle.tangents[k][1], -p[0] / radius, 1e-9);
      EXPECT_NEAR(circle.normals[k][0][2], p[2], 1e-9);
      EXPECT_NEAR(circle.normals[k][1][2], 1, 1e-9);
    }
    for (std::size_t k = 0; k + 1 < circle.points.size(); ++k) {
      const Point<3> middle = 0.5 * (circle.points[k] + circle.points[k + 1]);
      EXPECT_LE(std::fabs(std::hypot(middle[0], middle[1]) - radius), circle.distances[k]);
      const Point<3> step = circle.points[k + 1] - circle.points[k];
      EXPECT_GT(dot(step, circle.tangents[k]), 0);
    }
  }
}

TEST(IntersectionCurves, OpenOnesEndOnTheRegionsBoundary) {
  const SurfaceEncasement e = encased_surfaces({"z-x*y", "x+y/3-1/7"}, 1);
  const IntersectionTracing tracing = traced(e, 1e-4);
  ASSERT_EQ(tracing.curves.size(), 1u);
  const TracedIntersection& curve = tracing.curves[0];
  EXPECT_FALSE(curve.curve.closed);
  EXPECT_EQ(curve.curve.cut_off, (std::array<bool, 2>{false, false}));
  for (const Point<3>& end : {curve.points.front(), curve.points.back()})
    EXPECT_NEAR(std::max({std::fabs(end[0]), std::fabs(end[1]), std::fabs(end[2])}), 1, 1e-9);
  for (const Point<3>& p : curve.points) {
    EXPECT_NEAR(p[2], p[0] * p[1], 1e-12);
    EXPECT_NEAR(p[0] + p[1] / 3, 1.0 / 7, 1e-12);
  }
}

TEST(IntersectionCurves, PassThroughTheTriplePointsInOrder) {
  const SurfaceEncasement e = encased_surfaces({kSphere, "x-y/5-1/10", "z-x/7-1/9"}, 2);
  ASSERT_EQ(e.triple_points.size(), 2u);
  const IntersectionTracing tracing = traced(e, 1e-4);
  int passed = 0;
  for (const TracedIntersection& curve : tracing.curves) {
    ASSERT_EQ(curve.triple_points.size(), curve.points.size());
    for (std::size_t k = 0; k < curve.points.size(); ++k) {
      if (curve.triple_points[k] < 0) continue;
      ++passed;
      EXPECT_EQ(curve.points[k], e.triple_points[curve.triple_points[k]].point);
    }
  }
  // Each of the two lies on the curves of three pairs.
  EXPECT_EQ(passed, 6);
}

TEST(IntersectionCurves, RefusesATolerance) {
  const SurfaceEncasement e = encased_surfaces({"x-1/3"}, 1);
  for (const double tolerance : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    IntersectionTraceOptions options;
    options.tolerance = tolerance;
    EXPECT_EQ(trace(e, options).error().code, Error::Code::BadInput);
  }
}

TEST(Intersect, GivesTheCurvesOfTwoSurfaces) {
  const auto spheres =
      intersect(written::polynomial<3>(kSphere), written::polynomial<3>("(x-1)^2+y^2+z^2-1"),
                make_box({-2, -2, -2}, {3, 2, 2}).value(), 1e-3);
  ASSERT_TRUE(spheres);
  EXPECT_EQ(spheres.value().encasement.outcome, Outcome::Certified);
  ASSERT_EQ(spheres.value().curves.size(), 1u);
  EXPECT_TRUE(spheres.value().within_tolerance);
  EXPECT_NEAR(length_of(spheres.value().curves[0]), M_PI * std::sqrt(3), 0.01);
}

}  // namespace
}  // namespace encase
