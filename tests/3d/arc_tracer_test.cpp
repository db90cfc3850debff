// SPDX-License-Identifier: MIT
#include "3d/arc_tracer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "3d/space_vectors.hpp"
#include "written.hpp"

namespace encase {
namespace {

struct Scene {
  Scene(const std::string& first, const std::string& second)
      : f(written::polynomial<3>(first)),
        g(written::polynomial<3>(second)),
        bounds_f(f, 4),
        bounds_g(g, 4),
        tracer(bounds_f, bounds_g, 4, kernel) {}
  FilteredFunction<3> f, g;
  SurfaceBounds bounds_f, bounds_g;
  Kernel kernel;
  ArcTracer tracer;
};

SpacePoint exact(const Point<3>& p) { return {p, {p, p}}; }

double largest(const SpacePath& path) {
  return *std::max_element(path.distances.begin(), path.distances.end());
}

/// The unit circle in z = 0, counter-clockwise: grad f x grad g = (2x, 2y, 0) x (0, 0, 1) runs
/// clockwise.
TEST(ArcTracer, FollowsACircleWithinTheTolerance) {
  Scene scene("x^2+y^2-1", "z");
  for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
    for (const int sense : {-1, 1}) {
      const SpacePath path =
          scene.tracer.trace(exact({1, 0, 0}), exact({0, 1, 0}), sense, tolerance, 1000000);
      EXPECT_LE(largest(path), tolerance);
      double way = 0;
      for (std::size_t k = 0; k + 1 < path.points.size(); ++k) {
        const Point<3>&p = path.points[k].point, &q = path.points[k + 1].point;
        way += length(q - p);
        const Point<3> middle = 0.5 * (p + q);
        const double away = std::fabs(std::hypot(middle[0], middle[1]) - 1);
        EXPECT_LE(away, path.distances[k]);
        EXPECT_LE(path.distances[k], 40 * away + 1e-13);  // the bound is not idle
      }
      EXPECT_NEAR(way, (sense < 0 ? 0.5 : 1.5) * M_PI, 10 * tolerance);
      EXPECT_LT(path.points.size(), 20 / std::sqrt(tolerance));
    }
  }
}

TEST(ArcTracer, NoToleranceNeedsProofsNevertheless) {
  Scene scene("x^2+y^2-1", "z");
  ArcTracer coarse(scene.bounds_f, scene.bounds_g, 100, scene.kernel);  // begins with long steps
  const Point<3> end{-std::sqrt(0.75), 0.5, 0};
  const double infinity = std::numeric_limits<double>::infinity();
  const SpacePath path =
      coarse.trace(exact({1, 0, 0}), {end, inflated({end, end}, 1e-15)}, -1, infinity, 1000);
  EXPECT_LT(path.points.size(), 20u);
  double turned = 0;
  for (std::size_t k = 0; k + 1 < path.points.size(); ++k) {
    const Point<3>&p = path.points[k].point, &q = path.points[k + 1].point;
    const double angle = std::acos(std::min(1.0, dot(p, q)));
    turned += angle;
    EXPECT_GE(path.distances[k], 1 - std::cos(angle / 2));
    EXPECT_LT(path.distances[k], 1);
  }
  EXPECT_NEAR(turned, M_PI * 5 / 6, 1e-9);
}

TEST(ArcTracer, BoxesHoldThePointsOfTheCurve) {
  Scene scene("x^2+y^2+z^2-4", "x-y*y/3");
  const Point<3> start{0, 0, 2};
  const Point<3> end{0, 0, -2};
  for (const int sense : {-1, 1}) {
    const SpacePath path = scene.tracer.trace(exact(start), exact(end), sense, 1e-6, 100000);
    EXPECT_LE(largest(path), 1e-6);
    for (const SpacePoint& p : path.points) {
      EXPECT_LE(p.box.largest_width(), 1e-12);
      EXPECT_TRUE(p.box.contains(p.point));
    }
  }
}

TEST(ArcTracer, DoesNotPassThroughASingularPoint) {
  // Two planes cross f = x y: the curve xy = z = 0 has a double point at the origin.
  Scene scene("x*y", "z");
  const SpacePath path = scene.tracer.trace(exact({-1, 0, 0}), exact({1, 0, 0}), 1, 1e-3, 10000);
  const SpacePath back = scene.tracer.trace(exact({-1, 0, 0}), exact({1, 0, 0}), -1, 1e-3, 10000);
  EXPECT_TRUE(std::isinf(largest(path)));
  EXPECT_TRUE(std::isinf(largest(back)));
}

TEST(ArcTracer, RefusesToGoAgainstItsSense) {
  Scene scene("y", "z");  // grad f x grad g = (1, 0, 0)
  const auto way = [&](int sense) {
    // Near enough to be one piece.
    return scene.tracer.trace(exact({0, 0, 0}), exact({0.1, 0, 0}), sense, 1e-3, 1000);
  };
  EXPECT_LE(largest(way(1)), 1e-3);
  EXPECT_TRUE(std::isinf(largest(way(-1))));
  EXPECT_EQ(scene.tracer.sense({{0, 0, 0}, {0, 0, 0}}, {1, 5, 5}), Sign::Positive);
  EXPECT_EQ(scene.tracer.sense({{0, 0, 0}, {0, 0, 0}}, {-1, 5, 5}), Sign::Negative);
  EXPECT_EQ(scene.tracer.sense({{0, 0, 0}, {0, 0, 0}}, {0, 5, 5}), Sign::Zero);
}

TEST(ArcTracer, TellsNearbyBranchesApart) {
  // Two sheets of a hyperbola x^2 - y^2 = 1e-6 in z = 0, 2e-3 apart.
  Scene scene("x^2-y^2-1e-6", "z");
  const double at = std::sqrt(0.25 + 1e-6);
  SpacePoint from{{at, -0.5, 0}, {{at - 1e-15, -0.5, 0}, {at + 1e-15, -0.5, 0}}};
  SpacePoint same{{at, 0.5, 0}, {{at - 1e-15, 0.5, 0}, {at + 1e-15, 0.5, 0}}};
  SpacePoint other{{-at, 0.5, 0}, {{-at - 1e-15, 0.5, 0}, {-at + 1e-15, 0.5, 0}}};
  // grad f x grad g = (-2y, -2x, 0): y falls on the right sheet.
  EXPECT_LE(largest(scene.tracer.trace(from, same, -1, 1e-2, 10000)), 1e-2);
  EXPECT_TRUE(std::isinf(largest(scene.tracer.trace(from, other, -1, 1e-2, 10000))));
}

}  // namespace
}  // namespace encase
