// SPDX-License-Identifier: MIT
//
// The whole plane as the region: a rectangle is encased, and what is outside of it is proved.
#include <algorithm>
#include <functional>
#include <utility>

#include "common/random_polynomials.hpp"
#include "common/substitute.hpp"
#include "encase/arrangement.hpp"
#include "encase/curves_file.hpp"
#include "encase/result_json.hpp"
#include "encased.hpp"
#include "objections.hpp"

namespace encase {
namespace {

using encased::expect_certified;
using encased::has_crossing_at;
using encased::run;

Encasement in_plane(const std::vector<std::string>& texts) { return run(texts, whole_plane()); }

/// How often a curve leaves the rectangle: its ends at infinity.
int ends(const Encasement& e, int curve) {
  return static_cast<int>(std::count_if(
      e.line_crossings.begin(), e.line_crossings.end(), [&](const LineCrossing& crossing) {
        return crossing.curve == curve && crossing.line < e.region_used.side_count();
      }));
}

/// Certified in the rectangle, but for the line at infinity, where so many directions are open.
void expect_open_at_infinity(const Encasement& e, std::size_t directions) {
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  EXPECT_TRUE(e.infinity.empty());
  EXPECT_TRUE(e.undecided.empty());
  ASSERT_EQ(e.degenerate.size(), directions);
  for (const Unresolved& u : e.degenerate) {
    EXPECT_EQ(u.kind, Unresolved::Kind::Infinity);
    EXPECT_FALSE(u.has_box);
  }
  EXPECT_EQ(encased::count(e, CellState::Degenerate), 0);
  EXPECT_EQ(encased::count(e, CellState::Undecided), 0);
}

/// How many faces of the arrangement are bounded and how many are not.
std::pair<int, int> faces(const Encasement& e) {
  const Arrangement arrangement = arrange(e).value();
  std::pair<int, int> result{0, 0};
  for (int face = 0; face < static_cast<int>(arrangement.faces.size()); ++face)
    if (face != arrangement.outside)
      ++(arrangement.touches_boundary(face) ? result.second : result.first);
  return result;
}

TEST(Plane, FacesAreBoundedOrNot) {
  EXPECT_EQ(faces(in_plane({"x^2 + y^2 - 1"})), std::pair(1, 1));
  EXPECT_EQ(faces(in_plane({"x^2 + y^2 - 1", "x - y"})), std::pair(2, 2));
  EXPECT_EQ(faces(in_plane({"x - y", "x + 2*y - 5", "x + y/3 - 1000"})), std::pair(1, 6));
  EXPECT_EQ(faces(in_plane({"x*y - 1", "x^2 + y^2 - 9", "x^2 + y^2 - 1/4"})), std::pair(4, 4));
}

TEST(Outside, CoordinatesAreThoseOfTheCharts) {
  const auto f = written::polynomial<2>("3 x^2 y - 2 x y + 5 y^2 + 7");
  const Point<2> half{4, 0.5};
  const Rational u(1, 3), v(-2, 5);
  for (int chart = 0; chart < 2; ++chart) {
    const auto g = outside_of_rectangle(f, half, chart);
    RationalPoint<2> point;
    point[chart] = Rational(half[chart]) / u;
    point[1 - chart] = Rational(half[1 - chart]) * v / u;
    EXPECT_EQ(g({u, v}), f(point) * u * u * u);
  }
}

TEST(Plane, ALineLeavesACircleTwice) {
  const Encasement e = in_plane({"x^2 + y^2 - 1", "x - y"});
  expect_certified(e);
  EXPECT_EQ(e.crossings.size(), 2u);
  EXPECT_EQ(ends(e, 0), 0);
  EXPECT_EQ(ends(e, 1), 2);
  EXPECT_FALSE(e.infinity.empty());
}

TEST(Plane, AHyperbolaHasFourEnds) {
  const Encasement e = in_plane({"x^2 - y^2 - 1", "y - 3x"});
  expect_certified(e);
  EXPECT_TRUE(e.crossings.empty());
  EXPECT_EQ(ends(e, 0), 4);
  EXPECT_EQ(ends(e, 1), 2);
}

TEST(Plane, CirclesDoNotMeetAtInfinity) {
  // In complex points they do.
  const Encasement e = in_plane({"x^2 + y^2 - 4", "(x - 1)^2 + y^2 - 4", "(x - 9)^2 + y^2 - 1"});
  expect_certified(e);
  EXPECT_EQ(e.crossings.size(), 2u);
}

TEST(Plane, CrossingsFarAwayAreFound) {
  const Encasement far = in_plane({"x - 1000000", "y - x"});
  expect_certified(far);
  ASSERT_EQ(far.crossings.size(), 1u);
  EXPECT_TRUE(has_crossing_at(far, 0, 1, 1e6, 1e6));
  const Encasement flat = in_plane({"1000 y - x", "1000 y + x - 1000"});
  expect_certified(flat);
  EXPECT_TRUE(has_crossing_at(flat, 0, 1, 500, 0.5));
}

TEST(Plane, SmallCurvesGetASmallRectangle) {
  const Encasement e = in_plane({"x^2 + y^2 - 1/1000000", "y - x/2"});
  expect_certified(e);
  EXPECT_EQ(e.crossings.size(), 2u);
  EXPECT_LT(e.region_used.bounding_box().hi[0], 0.01);
}

TEST(Plane, NoCurvesAndOneCurve) {
  expect_certified(encased::run_curves({}, whole_plane()));
  const Encasement e = in_plane({"x y - 1"});
  expect_certified(e);
  EXPECT_EQ(ends(e, 0), 4);
}

TEST(Plane, RandomCurvesHaveAllTheirCrossings) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomOptions options;
    options.degree = 2 + static_cast<int>(seed % 3);
    options.seed = seed;
    const auto curves = random_curves(options);
    const Encasement e = encased::run_curves(curves, whole_plane());
    expect_certified(e);
    // A larger rectangle has the same.
    const Box<2> box = e.region_used.bounding_box();
    const Encasement large = encased::run_curves(
        curves, encased::rectangle(3 * Rational(box.lo[0]), 3 * Rational(box.hi[0]),
                                   3 * Rational(box.lo[1]), 3 * Rational(box.hi[1])));
    EXPECT_EQ(e.crossings.size(), large.crossings.size()) << "seed " << seed;
    for (int c = 0; c < 2; ++c) EXPECT_EQ(ends(e, c), ends(large, c)) << "seed " << seed;
  }
}

TEST(Plane, AParabolaTouchesTheLineAtInfinity) {
  const Encasement e = in_plane({"y - x^2", "y - 2x - 3"});
  expect_open_at_infinity(e, 1);
  EXPECT_EQ(e.degenerate[0].curves, std::vector<int>{0});
  EXPECT_EQ(e.crossings.size(), 2u);  // and none at infinity
  EXPECT_TRUE(has_crossing_at(e, 0, 1, -1, 1));
  EXPECT_TRUE(has_crossing_at(e, 0, 1, 3, 9));
}

TEST(Plane, ACubicHasACuspAtInfinity) {
  const Encasement e = in_plane({"y - x^3", "y - 1"});
  expect_open_at_infinity(e, 1);
  EXPECT_EQ(e.crossings.size(), 1u);
}

TEST(Plane, ParallelLinesMeetAtInfinity) {
  const Encasement e = in_plane({"y - 1", "y - 2", "y - x"});
  expect_open_at_infinity(e, 1);
  EXPECT_EQ(e.degenerate[0].curves, (std::vector<int>{0, 1}));
  EXPECT_EQ(e.crossings.size(), 2u);
}

TEST(Plane, HyperbolasWithCommonAsymptotesMeetAtInfinity) {
  const Encasement e = in_plane({"x y - 1", "x y - 2"});
  expect_open_at_infinity(e, 2);
  EXPECT_TRUE(e.crossings.empty());
  for (int c = 0; c < 2; ++c) EXPECT_EQ(ends(e, c), 4);
}

TEST(Plane, MeetingsFarApartAreReported) {
  // Two directions in small rectangles, one in large ones.
  const Encasement e = in_plane({"y", "y - 1000000000"});
  expect_open_at_infinity(e, 1);
  EXPECT_GT(e.region_used.bounding_box().hi[1], 1e9);
}

TEST(Plane, TheSearchForARectangleIsStopped) {
  EncaseOptions options;
  int asked = 0;
  options.progress = [&](const char*, double) { return ++asked < 3; };
  const Encasement e = run({"y - x^2", "y - x^2 - 1"}, whole_plane(), options);
  EXPECT_EQ(e.outcome, Outcome::Undecided);
  EXPECT_TRUE(e.infinity.empty());
}

TEST(Plane, ResultsAreReadAgain) {
  for (const Encasement& e :
       {in_plane({"x^2 + y^2 - 1", "x - y"}), in_plane({"y - x^2", "y - 2x - 3"})}) {
    const std::string text = to_json(e);
    const auto again = encasement_from_json(text, "text");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_TRUE(again.value().region.plane);
    EXPECT_EQ(to_json(again.value()), text);
    encased::expect_verified(again.value());
  }
}

/// What the checker objects to when `change` was made.
std::string objections(Encasement e, const std::function<void(Encasement&)>& change) {
  change(e);
  return text(verify(e));
}

TEST(Plane, TheCheckerObjects) {
  const Encasement e = in_plane({"x^2 - y^2 - 1", "y - 3x"});
  const auto expect = [&](const std::string& reason, const auto& change) {
    EXPECT_NE(objections(e, change).find(reason), std::string::npos) << reason << "\n"
                                                                     << objections(e, change);
  };
  const auto with_curve = [](Encasement& m) {
    return std::find_if(m.infinity.begin(), m.infinity.end(),
                        [](const InfinityPiece& piece) { return piece.curve >= 0; });
  };
  expect("is not proved", [&](auto& m) { with_curve(m)->curve = -1; });
  expect("is not proved", [&](auto& m) {
    const auto piece = with_curve(m);
    piece->curve = 1 - piece->curve;
  });
  expect("cannot have curve", [&](auto& m) { with_curve(m)->curve = 2; });
  expect("cannot have curve", [&](auto& m) { m.infinity.front().curve = 0; });
  expect("does not follow", [&](auto& m) { m.infinity.erase(m.infinity.begin() + 1); });
  expect("do not cover", [&](auto& m) { m.infinity.pop_back(); });
  expect("Nothing is said", [&](auto& m) { m.infinity.clear(); });
  // Pieces of another rectangle: the hyperbola's ends are elsewhere.
  expect("not a rectangle", [&](auto& m) { m.region_used.corners[0][0] *= 2; });
}

TEST(Plane, ATouchingCurveIsNotTakenForAnArc) {
  // The parabola alone is in the middle piece, but turns back there.
  const Encasement e = in_plane({"y - x^2"});
  const std::string text = objections(e, [](Encasement& m) {
    m.degenerate.clear();
    m.outcome = Outcome::Certified;
    m.infinity = {{0, -1, 1, -1}, {1, -1, -0.75, -1}, {1, -0.75, 0.75, 0}, {1, 0.75, 1, -1}};
  });
  EXPECT_EQ(text, "The direction of curve 0 in piece 2 at infinity is not proved.\n");
}

}  // namespace
}  // namespace encase
