// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/random_polynomials.hpp"
#include "common/segments.hpp"
#include "encase/arrangement.hpp"
#include "tests/encased.hpp"
#include "tests/located_points.hpp"

namespace encase {
namespace {

using encased::run;
using Feature = Arrangement::Feature;
using located_points::arranged;
using located_points::count;
using located_points::expect_locates;
using located_points::expect_right;
using located_points::mixed_curves;

Rational random_rational(std::mt19937_64& random) {
  constexpr int kDenominator = 1009;
  const int numerator = static_cast<int>(random() % (2 * kDenominator - 1)) - (kDenominator - 1);
  return Rational(numerator, kDenominator);
}

/// Curves that pass through a known rational point each, of one degree or of the degrees 1 to 4.
struct Scene {
  std::vector<NamedCurve> curves;
  std::vector<RationalPoint<2>> on_curve;
};
Scene random_scene(int degree, int count, std::uint64_t seed) {
  Scene scene;
  std::mt19937_64 random(seed);
  for (int k = 0; k < count; ++k) {
    RandomOptions options;
    options.degree = degree > 0 ? degree : 1 + k % 4;
    options.count = 1;
    options.seed = 1000 * seed + static_cast<std::uint64_t>(k);
    const RationalPoint<2> p = {random_rational(random), random_rational(random)};
    const Polynomial<2> f = random_polynomials<2>(options)[0];
    scene.curves.push_back({"c" + std::to_string(k), f - Polynomial<2>::constant(f(p))});
    scene.on_curve.push_back(p);
  }
  return scene;
}

/// Rational points of a conic or a line through a rational point of it: lines with rational slopes
/// meet it in one more point, which the restriction's coefficients tell.
std::vector<RationalPoint<2>> more_points(const Polynomial<2>& f, const RationalPoint<2>& p,
                                          std::mt19937_64& random) {
  std::vector<RationalPoint<2>> points;
  for (int k = 0; k < 10; ++k) {
    const Rational u = random_rational(random), v = random_rational(random);
    // f(p + t (u, v)) = b t + a t^2, by its values at t = 1 and t = -1.
    const auto value = [&](int t) { return f({Rational(p[0] + t * u), Rational(p[1] + t * v)}); };
    const Rational a = (value(1) + value(-1)) / 2, b = (value(1) - value(-1)) / 2;
    if (a != 0) {
      const Rational t = -b / a;
      points.push_back({Rational(p[0] + t * u), Rational(p[1] + t * v)});
    } else if (b == 0) {
      points.push_back({Rational(p[0] + u), Rational(p[1] + v)});
    }
  }
  return points;
}

TEST(PointLocator, AgreesWithSignsOfUpToTwelveCurves) {
  for (int degree = 0; degree <= 4; ++degree)
    for (const int count : {1, 2, 5, 12}) {
      const std::uint64_t seed = static_cast<std::uint64_t>(20 * degree + count);
      const Scene scene = random_scene(degree, count, seed);
      const Result<Encasement> encasement = encase(scene.curves, encased::square());
      ASSERT_TRUE(encasement.ok());
      const Encasement& e = encasement.value();
      ASSERT_EQ(e.outcome, Outcome::Certified);
      const Arrangement a = arranged(e);
      SCOPED_TRACE("degree " + std::to_string(degree) + ", " + std::to_string(count) + " curves");
      expect_locates(e, a, 400, static_cast<unsigned>(seed));

      const PointLocator locator(e, a);
      std::mt19937_64 random(seed);
      // Exactly on curves, and on their edges.
      std::vector<RationalPoint<2>> points;
      for (int k = 0; k < count; ++k) {
        const Polynomial<2>& f = scene.curves[k].function.polynomial();
        points.push_back(scene.on_curve[k]);
        if (f.degree() > 2) continue;
        for (const auto& p : more_points(f, scene.on_curve[k], random)) points.push_back(p);
      }
      for (const RationalPoint<2>& p : points) {
        const Feature feature = locator.locate(p);
        expect_right(e, a, feature, p);
        const bool outside = feature == Feature{Feature::Kind::Face, a.outside};
        EXPECT_TRUE(outside || feature.kind != Feature::Kind::Face);
        // Beside it, as close as this.
        for (const int axis : {0, 1}) {
          RationalPoint<2> beside = p;
          beside[axis] += Rational(1) / Rational("1000000000000000000000000000000");
          expect_right(e, a, locator.locate(beside), beside);
        }
      }
      // What is near vertices: their points as doubles, and the doubles next to them.
      for (const Crossing& c : e.crossings)
        for (const double x : {-1.0, c.point[0], 1.0})
          for (const double y : {-1.0, c.point[1], 1.0}) {
            const Point<2> p = {x == c.point[0] ? x : std::nextafter(c.point[0], x),
                                y == c.point[1] ? y : std::nextafter(c.point[1], y)};
            expect_right(e, a, locator.locate(p), located_points::exactly(p));
          }
      for (const LineCrossing& c : e.line_crossings) {
        const auto at = point_on_line(e.lines[c.line], Rational(c.lo + 0.5 * (c.hi - c.lo)));
        expect_right(e, a, locator.locate(at), at);
        const Point<2> rounded = {at[0].get_d(), at[1].get_d()};
        expect_right(e, a, locator.locate(rounded), located_points::exactly(rounded));
      }
      for (const RationalPoint<2>& corner : e.region_used.corners)
        expect_right(e, a, locator.locate(corner), corner);
      if (testing::Test::HasFailure()) return;
    }
}

TEST(PointLocator, FindsCrossingsThatAreRational) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 20; ++n) {
    // Two random curves of the degrees 1 to 4 through one rational point.
    const RationalPoint<2> p = {random_rational(random), random_rational(random)};
    std::vector<NamedCurve> curves;
    for (int k = 0; k < 2; ++k) {
      RandomOptions options;
      options.degree = 1 + (n + k) % 4;
      options.count = 1;
      options.seed = static_cast<std::uint64_t>(10 * n + k + 1);
      const Polynomial<2> f = random_polynomials<2>(options)[0];
      curves.push_back({"c" + std::to_string(k), f - Polynomial<2>::constant(f(p))});
    }
    const Result<Encasement> e = encase(curves, encased::square());
    ASSERT_TRUE(e.ok());
    const Arrangement a = arranged(e.value());
    const Feature feature = PointLocator(e.value(), a).locate(p);
    ASSERT_EQ(feature.kind, Feature::Kind::Vertex);
    expect_right(e.value(), a, feature, p);
  }
}

TEST(PointLocator, FindsCrossingsByTheirBoxes) {
  // The corners of a crossing's box lie on four faces around it, or on fewer.
  const Encasement e = encased::run_curves(mixed_curves(5, 3));
  const Arrangement a = arranged(e);
  const PointLocator locator(e, a);
  for (int v = 0; v < static_cast<int>(a.vertices.size()); ++v) {
    if (a.vertices[v].kind != Arrangement::Vertex::Kind::Crossing) continue;
    const Box<2>& box = e.crossings[a.vertices[v].index].box;
    const std::vector<int> faces = a.faces_around(v);
    for (const double x : {box.lo[0], box.hi[0]})
      for (const double y : {box.lo[1], box.hi[1]}) {
        const Feature feature = locator.locate(Point<2>{x, y});
        if (feature.kind != Feature::Kind::Face) continue;
        EXPECT_EQ(std::count(faces.begin(), faces.end(), feature.index), 1);
      }
  }
}

TEST(PointLocator, FindsOneFaceAlongASegmentWithoutCurves) {
  RandomOptions many;
  many.degree = 8;
  many.count = 3;
  const Encasement e = encased::run_curves(random_curves(many));
  const Arrangement a = arranged(e);
  const PointLocator locator(e, a);
  std::vector<FilteredFunction<2>> curves;
  for (const Curve& curve : e.curves) curves.emplace_back(curve.function.polynomial());
  Kernel kernel;
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> place(-1, 1), step(-0.3, 0.3);
  int same = 0, different = 0;
  for (int k = 0; k < 1000; ++k) {
    const Point<2> p = {place(random), place(random)};
    const Point<2> q = {p[0] + step(random), p[1] + step(random)};
    const Feature at_p = locator.locate(p), at_q = locator.locate(q);
    if (at_q == Feature{Feature::Kind::Face, a.outside}) continue;
    const bool free = std::all_of(curves.begin(), curves.end(), [&](const auto& f) {
      return no_root_on_segment(f, p, q, kernel);
    });
    (free ? same : different) += 1;
    if (free) {
      EXPECT_EQ(at_p, at_q);
    }
  }
  EXPECT_GT(same, 100);
  EXPECT_GT(different, 100);
}

TEST(PointLocator, KnowsRegionsWithRationalSides) {
  const Region triangle = make_region({{Rational(-1, 3), Rational(-2, 7)},
                                       {Rational(5, 3), Rational(1, 9)},
                                       {Rational(1, 7), Rational(11, 6)}})
                              .value();
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/3 - 1/5", "x*y - 1/6"}, triangle);
  ASSERT_EQ(e.region.corners, e.region_used.corners);
  const Arrangement a = arranged(e);
  EXPECT_EQ(count(a, Arrangement::Vertex::Kind::Corner), 3);
  const PointLocator locator(e, a);
  for (int k = 0; k < 3; ++k) {
    const RationalPoint<2>&p = triangle.corners[k], &q = triangle.corners[(k + 1) % 3];
    for (int i = 0; i <= 50; ++i) {
      const Rational t = Rational(i) / 50;
      const RationalPoint<2> point = {Rational(p[0] + t * (q[0] - p[0])),
                                      Rational(p[1] + t * (q[1] - p[1]))};
      const Feature feature = locator.locate(point);
      EXPECT_NE(feature.kind, Feature::Kind::Face);
      expect_right(e, a, feature, point);
      if (feature.kind != Feature::Kind::Edge) continue;
      EXPECT_EQ(a.edges[feature.index].side, k);
    }
  }
  // The line meets the side from corner 2 to corner 0 in a rational point.
  const Line side = triangle.side(2);
  const auto s = side.exact();
  const Rational x = -(s[1] / 5 + s[2]) / (s[0] + s[1] / 3);
  const Feature meeting = locator.locate(RationalPoint<2>{x, Rational(x / 3 + Rational(1, 5))});
  ASSERT_EQ(meeting.kind, Feature::Kind::Vertex);
  EXPECT_EQ(a.vertices[meeting.index].kind, Arrangement::Vertex::Kind::OnBoundary);
  expect_locates(e, a, 1000, 12);
}

TEST(PointLocator, CallsWhatIsNotFiniteOutside) {
  const Encasement e = run({"x"});
  const Arrangement a = arranged(e);
  const PointLocator locator(e, a);
  for (const double bad : {HUGE_VAL, -HUGE_VAL, std::nan("")})
    EXPECT_EQ(locator.locate(Point<2>{0.5, bad}), (Feature{Feature::Kind::Face, a.outside}));
  EXPECT_EQ(locator.locate(Point<2>{1e308, -1e308}), (Feature{Feature::Kind::Face, a.outside}));
  EXPECT_EQ(locator.locate(Point<2>{0, 5e-324}).kind, Feature::Kind::Edge);
  EXPECT_NE(locator.locate(Point<2>{5e-324, 0}), locator.locate(Point<2>{-5e-324, 0}));
}

}  // namespace
}  // namespace encase
