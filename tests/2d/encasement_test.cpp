// SPDX-License-Identifier: MIT
//
// Input in generic position, and boundaries that are not: the answer is certified. Each is
// verified; see encasement_degenerate_test.cpp and encasement_options_test.cpp for the rest.
#include "encase/encasement.hpp"

#include <cmath>

#include "common/components.hpp"
#include "common/random_polynomials.hpp"
#include "encase/result_json.hpp"
#include "encased.hpp"

namespace encase {
namespace {

using encased::branches;
using encased::expect_certified;
using encased::has_crossing_at;
using encased::inside;
using encased::rectangle;
using encased::run;
using encased::square;

TEST(Encase, CircleAndLineCrossTwice) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"});
  expect_certified(e);
  EXPECT_EQ(e.region_used.corners, e.region.corners);
  ASSERT_EQ(e.crossings.size(), 2u);
  for (const double s : {1.0, -1.0}) {
    const double x = (-0.02 + s * std::sqrt(0.0004 + 4 * 1.04 * 0.4975)) / 2.08;
    EXPECT_TRUE(has_crossing_at(e, 0, 1, x, x / 5 + 0.05));
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Crossing& crossing = e.crossings[k];
    EXPECT_EQ(e.cells[static_cast<std::size_t>(crossing.cell)].crossing, static_cast<int>(k));
    EXPECT_EQ(crossing.location, Location::Inside);
    EXPECT_LT(crossing.box.largest_width(), 1e-12);
    EXPECT_TRUE(crossing.box.contains(crossing.point));
  }
  EXPECT_EQ(static_cast<int>(e.history.size()) + 1, static_cast<int>(e.cells.size()));
}

TEST(Encase, EmptyListOfCurvesIsOneCell) {
  const Encasement e = encased::run_curves({});
  expect_certified(e);
  EXPECT_EQ(e.cells.size(), 1u);
}

TEST(Encase, CurvesThatMissTheRegionLeaveOneCell) {
  const Encasement e = run({"x^2 + y^2 - 9", "x - 5"});
  expect_certified(e);
  EXPECT_EQ(e.cells.size(), 1u);
  EXPECT_TRUE(e.line_crossings.empty());
}

TEST(Encase, OneCurveAloneIsCutIntoBranches) {
  const Encasement line = run({"y - x/3 - 1/7"});
  expect_certified(line);
  EXPECT_EQ(line.cells.size(), 1u);
  EXPECT_EQ(branches(line, 0), 1);
  // Two branches.
  const Encasement hyperbola = run({"x^2 - y^2/2 - 1/10"});
  expect_certified(hyperbola);
  EXPECT_GE(hyperbola.cells.size(), 2u);
  EXPECT_GE(branches(hyperbola, 0), 2);
}

TEST(Encase, OvalsWithoutCrossingsAreFound) {
  for (const std::string radius : {"1/2", "1/1000", "1/10^8"}) {
    const Encasement e = run({"(x - 3/10)^2 + (y - 1/5)^2 - (" + radius + ")^2"});
    expect_certified(e);
    EXPECT_GT(e.cells.size(), 1u) << radius;
    EXPECT_GE(branches(e, 0), 2) << radius;
    for (const LineCrossing& c : e.line_crossings) EXPECT_GE(c.line, 4) << "a side of the square";
  }
}

TEST(Encase, OvalsBesideOtherCurvesAreFound) {
  const Encasement e = run({"((x - 3/10)^2 + (y - 1/5)^2 - 1/10^6) (y + 1/5 - x/9)",
                            "(x + 1/2)^2 + (y - 1/2)^2 - 1/10^4", "y - x - 1/3"});
  expect_certified(e);
  EXPECT_EQ(inside(e), 1);
  EXPECT_GE(branches(e, 0), 3);
  EXPECT_GE(branches(e, 1), 2);
}

TEST(Encase, NestedOvalsAreFound) {
  // Three concentric circles as one curve.
  const Encasement e = run({"(x^2 + y^2 - 1/4) (x^2 + y^2 - 1/2) (x^2 + y^2 - 9/16)", "y - x/7"});
  expect_certified(e);
  EXPECT_EQ(inside(e), 6);
}

class RandomPair : public testing::TestWithParam<int> {};

TEST_P(RandomPair, IsCertified) {
  const int degree = GetParam();
  for (const std::uint64_t seed : {1, 2, 4}) {
    RandomOptions options;
    options.degree = degree;
    options.seed = seed;
    const Encasement e = encased::run_curves(random_curves(options));
    expect_certified(e);
    if (degree > 5) continue;
    // No crossing is missing: each is one of the roots of the resultant, and with those outside
    // they are all of them.
    const auto in_x =
        resultant(e.input[0].function.polynomial(), e.input[1].function.polynomial(), 1);
    for (const Crossing& c : e.crossings)
      EXPECT_EQ(count_real_roots(in_x, Rational(c.box.lo[0]), Rational(c.box.hi[0])), 1);
    EXPECT_LE(static_cast<int>(e.crossings.size()), count_real_roots(in_x, -1, 1));
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, RandomPair, testing::Range(2, 13));

TEST(Encase, HighDegreesAreCertified) {
  for (const auto& [degree, seed] : {std::pair{20, 7}, {40, 1}}) {
    RandomOptions options;
    options.degree = degree;
    options.seed = static_cast<unsigned>(seed);
    const Encasement e = encased::run_curves(random_curves(options));
    expect_certified(e);
    EXPECT_GT(inside(e), degree / 4);
  }
}

TEST(Encase, ManyCurvesAreCertified) {
  for (const auto& [count, degree] : {std::pair{3, 2}, {4, 2}, {3, 3}, {4, 3}})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      RandomOptions options;
      options.degree = degree;
      options.count = count;
      options.seed = seed;
      const Encasement e = encased::run_curves(random_curves(options));
      expect_certified(e);
      for (const Cell& cell : e.cells) EXPECT_LE(cell.branches.size(), 2u);
      EXPECT_EQ(static_cast<std::int64_t>(e.crossing_covers.size()), e.statistics.pairs_met);
      EXPECT_LE(e.statistics.pairs_met, count * (count - 1) / 2);
    }
}

TEST(Encase, DenseCoefficientsAreCertified) {
  RandomOptions options;
  options.kind = RandomOptions::Kind::Dense;
  options.degree = 7;
  options.bits = 200;
  expect_certified(encased::run_curves(random_curves(options)));
}

using Corners = std::vector<RationalPoint<2>>;

void expect_certified_in(Corners corners) {
  const std::vector<std::string> texts{"x^2 + y^2 - 1/3", "y - x^3 - 1/50", "x + y - 1/7"};
  const Encasement forward = run(texts, make_region(corners).value());
  expect_certified(forward);
  std::reverse(corners.begin(), corners.end());
  const Encasement backward = run(texts, make_region(corners).value());
  expect_certified(backward);
  EXPECT_EQ(inside(forward), inside(backward));
  EXPECT_GT(inside(forward), 0);
}

TEST(Encase, PolygonsInEitherOrientationAreCertified) {
  const Rational tenth(1, 10);
  expect_certified_in({{-tenth, -7 * tenth}, {9 * tenth, tenth}, {-3 * tenth, 8 * tenth}});
  expect_certified_in({{-tenth, -9 * tenth},
                       {7 * tenth, -8 * tenth},
                       {9 * tenth, tenth / 3},
                       {2 * tenth, 9 * tenth},
                       {-7 * tenth, 8 * tenth},
                       {-9 * tenth, -tenth}});
  expect_certified_in({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
}

TEST(Encase, SmallAndThinRegionsAreCertified) {
  const Rational e(1, 1000000);
  expect_certified(
      run({"x^2 + y^2 - 1", "y - 4/3 x"}, rectangle(Rational(3, 5) - e, Rational(3, 5) + 2 * e,
                                                    Rational(4, 5) - e, Rational(4, 5) + 3 * e)));
  const Encasement thin =
      run({"y - x^2/10^6 + 10^-7", "y"}, rectangle(-1, 1, Rational(-1, 1000000), e));
  expect_certified(thin);
  EXPECT_EQ(inside(thin), 2);
}

TEST(Encase, CurvesThroughCornersAreEncasedInALargerRegion) {
  const Encasement e = run({"x - y", "x + y"});
  expect_certified(e);
  EXPECT_NE(e.region_used.corners, e.region.corners);
  ASSERT_EQ(e.crossings.size(), 1u);
  EXPECT_EQ(e.crossings[0].location, Location::Inside);
  EXPECT_TRUE(has_crossing_at(e, 0, 1, 0, 0));
}

TEST(Encase, CircleTangentToTheSidesIsEncasedInALargerRegion) {
  const Encasement e = run({"x^2 + y^2 - 1", "y - x/3 - 1/7"});
  expect_certified(e);
  EXPECT_NE(e.region_used.corners, e.region.corners);
  EXPECT_EQ(inside(e), 2);
}

TEST(Encase, CrossingsExactlyOnASideAreOnTheBoundary) {
  // At (0, 0) on the left side and at (1/2, 1/4) inside.
  const Encasement e = run({"y - x/2", "y - x^2"}, rectangle(0, 1, -1, 2));
  expect_certified(e);
  EXPECT_EQ(encased::count(e, Location::OnBoundary), 1);
  EXPECT_EQ(inside(e), 1);
  // At a corner.
  const Encasement corner = run({"y - x/2", "y + x"}, rectangle(0, 1, 0, 1));
  expect_certified(corner);
  EXPECT_EQ(encased::count(corner, Location::OnBoundary), 1);
  // On a side without double coefficients: x = y + 1/3, at (2/3, 1/3).
  const Encasement slanted =
      run({"x^2 + y^2 - 5/9", "y - 1/3"},
          make_region(Corners{{Rational(1, 3), 0}, {Rational(4, 3), 1}, {0, 1}}).value());
  EXPECT_EQ(encased::count(slanted, Location::OnBoundary), 1);
}

TEST(Encase, CrossingsJustBesideASideAreToldFromIt) {
  const std::string tiny = "1/10^19";
  const Region right = rectangle(0, 1, -1, 1);
  const Encasement out = run({"x - y + " + tiny, "x + y + " + tiny}, right);
  expect_certified(out);
  EXPECT_EQ(inside(out) + encased::count(out, Location::OnBoundary), 0);
  const Encasement on = run({"x - y + " + tiny, "x + y - " + tiny}, right);
  expect_certified(on);
  EXPECT_EQ(encased::count(on, Location::OnBoundary), 1);
  const Encasement in = run({"x - y - " + tiny, "x + y - " + tiny}, right);
  expect_certified(in);
  EXPECT_EQ(inside(in), 1);
}

TEST(Encase, CurvesThatEnterWhereTheGridOfASideEndsAreCertified) {
  // The circle meets the lines of the sides at (+-1, 0), just outside.
  const Rational almost(999, 1000);
  const Encasement e = run({"x^2 + y^2 - 1", "y - x/3 - 1/2"}, rectangle(-almost, almost, 0, 1.25));
  expect_certified(e);
  EXPECT_EQ(e.region_used.corners, e.region.corners);
  EXPECT_EQ(inside(e), 2);
}

TEST(Encase, CircleThatTheSidesCutOffIsCertified) {
  for (const Rational& side :
       {Rational(99, 100), Rational(999, 1000), Rational(9999999, 10000000)}) {
    expect_certified(run({"x^2 + y^2 - 1"}, rectangle(-side, side, -side, side)));
    expect_certified(run({"x^2 + y^2 - 1"}, rectangle(-side, 1.1, -1.1, side)));
    expect_certified(run({"x^2 + y^2 - 1"}, rectangle(-side, side, -0.01, side)));
  }
}

TEST(Encase, NearlyTangentCurvesAreCertified) {
  const Encasement two = run({"y - x^2", "y - 1/10^12"});
  expect_certified(two);
  EXPECT_EQ(inside(two), 2);
  const Encasement none = run({"y - x^2", "y + 1/10^12"});
  expect_certified(none);
  EXPECT_EQ(inside(none), 0);
  const Encasement circles = run({"x^2 + y^2 - 1/4", "(x - 3/4)^2 + y^2 - (1/4 - 1/10^12)^2"});
  expect_certified(circles);
  EXPECT_EQ(inside(circles), 0);
}

TEST(Encase, CloseParallelBranchesAreCertified) {
  const Encasement e = run({"y^2 - 1/10^12"});
  expect_certified(e);
  EXPECT_EQ(branches(e, 0), 2);
  const Encasement slanted = run({"(y - x/3)^2 - x^2/10^4 - 1/10^12"});
  expect_certified(slanted);
}

TEST(Encase, BentCurvesAtASmallDistanceAreSeparated) {
  const Encasement e = run({"y - x^2", "y - x^2 - 1/1000 - x^3/50"});
  expect_certified(e);
  EXPECT_LE(e.cells.size(), 1000u);
  // Never crossing: about distance^(-1/2) cells.
  const Encasement apart = run({"y - x^2 + 1/3", "y - x^2 + 1/3 - 1/1000"});
  expect_certified(apart);
  EXPECT_LE(apart.cells.size(), 1000u);
  // Closer: some cells may be relaxed, and are flagged.
  const Encasement close = run({"y - x^2 + 1/3", "y - x^2 + 1/3 - 1/10^7 - x^2/10^8"});
  expect_certified(close);
}

TEST(Encase, SameInputGivesTheSameBytes) {
  RandomOptions options;
  options.degree = 6;
  options.count = 3;
  const auto curves = random_curves(options);
  EXPECT_EQ(to_json(encase(curves, square()).value()), to_json(encase(curves, square()).value()));
}

TEST(Encase, StatisticsCountTheWork) {
  const Encasement e = run({"x^2 + y^2 - 1/2", "y - x/5 - 1/20"});
  EXPECT_GT(e.statistics.root_boxes, 0);
  EXPECT_GT(e.statistics.critical_boxes, 0);
  EXPECT_GT(e.statistics.restrictions, 0);
  EXPECT_GT(e.statistics.expansions, 0);
  EXPECT_GT(e.statistics.decisions.by_double, 0);
  EXPECT_EQ(e.statistics.decisions.undecided, 0);
  EXPECT_EQ(e.statistics.splits, static_cast<std::int64_t>(e.history.size()));
}

}  // namespace
}  // namespace encase
