// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/slice.hpp"
#include "written.hpp"

namespace encase {
namespace {

struct Pair {
  std::string name, f, g;
};

std::ostream& operator<<(std::ostream& out, const Pair& pair) { return out << pair.name; }

class SlicesOfPairs : public testing::TestWithParam<Pair> {};

double value_at(const std::array<Rational, 4>& plane, const Point<3>& p) {
  return plane[0].get_d() * p[0] + plane[1].get_d() * p[1] + plane[2].get_d() * p[2] +
         plane[3].get_d();
}

/// Where polylines pass from one side of a plane to the other.
std::vector<Point<3>> passages(const std::vector<TracedIntersection>& curves,
                               const std::array<Rational, 4>& plane) {
  std::vector<Point<3>> found;
  for (const auto& curve : curves)
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
      const Point<3>&p = curve.points[k], &q = curve.points[k + 1];
      const double a = value_at(plane, p), b = value_at(plane, q);
      if ((a < 0) == (b < 0)) continue;
      Point<3> at;
      for (int i = 0; i < 3; ++i) at[i] = p[i] + a / (a - b) * (q[i] - p[i]);
      found.push_back(at);
    }
  return found;
}

/// On a random plane the curves of two surfaces cross exactly where their intersection curves pass
/// through it: two ways to the same points that share little.
TEST_P(SlicesOfPairs, CrossWhereTheIntersectionCurvesPass) {
  const Function<3> f = written::polynomial<3>(GetParam().f),
                    g = written::polynomial<3>(GetParam().g);
  const Polyhedron region = make_box({-3, -3, -3}, {3, 3, 3}).value();
  const auto met = intersect(f, g, region, 1e-4);
  ASSERT_TRUE(met) << met.error().message;
  ASSERT_EQ(met.value().encasement.outcome, Outcome::Certified);
  ASSERT_TRUE(met.value().within_tolerance);
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> coefficient(-1000, 1000);
  std::size_t crossings = 0;
  for (int k = 0; k < 20; ++k) {
    std::array<Rational, 4> plane;
    for (Rational& c : plane) c = Rational(coefficient(random), 1000);
    const auto on_plane = slice({{"f", f}, {"g", g}}, region, plane);
    ASSERT_TRUE(on_plane) << on_plane.error().message;
    ASSERT_EQ(on_plane.value().encasement.outcome, Outcome::Certified);
    const std::vector<Point<3>> expected = passages(met.value().curves, plane);
    std::size_t inside = 0;
    for (const Crossing& crossing : on_plane.value().encasement.crossings) {
      if (crossing.location != Location::Inside) continue;
      ++inside;
      const Point<3> p = on_plane.value().source.chart.lift(crossing.point);
      double nearest = HUGE_VAL;
      for (const Point<3>& q : expected)
        nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]));
      EXPECT_LT(nearest, 0.02);
    }
    EXPECT_EQ(inside, expected.size());
    crossings += inside;
  }
  EXPECT_GT(crossings, 20u);
}

INSTANTIATE_TEST_SUITE_P(
    All, SlicesOfPairs,
    testing::Values(Pair{"Spheres", "x^2+y^2+z^2-4", "(x-1)^2+(y-1/2)^2+z^2-3"},
                    Pair{"SphereAndTorus", "x^2+(y-1)^2+(z-1/2)^2-4",
                         "(x^2+y^2+z^2+3/4)^2-4*(x^2+y^2)-z/10"},
                    Pair{"Cubics", "x^3+y^3+z^3-x*y*z-1/2", "x^3-2*x*y+z^2*y-z+1/3"}),
    [](const auto& pair) { return pair.param.name; });

}  // namespace
}  // namespace encase
