// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "2d/earlier_encasement.hpp"
#include "common/random_polynomials.hpp"
#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"
#include "tests/encased.hpp"

/// Curves that are added one by one lead to the same arrangement as all at once.
namespace encase {
namespace {

std::vector<NamedCurve> random_scene(int degree, int count, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.count = count;
  options.seed = seed;
  return random_curves(options);
}

Encasement added(const Encasement& earlier, const std::vector<NamedCurve>& more) {
  const Result<Encasement> result = add_curves(earlier, more);
  if (!result) {
    ADD_FAILURE() << result.error().message;
    return {};
  }
  encased::expect_verified(result.value());
  return result.value();
}

Encasement one_by_one(const std::vector<NamedCurve>& curves, const Region& region) {
  Encasement e = encased::run_curves({curves[0]}, region);
  for (std::size_t k = 1; k < curves.size(); ++k) e = added(e, {curves[k]});
  return e;
}

std::string topology(const Encasement& e) {
  const Result<Arrangement> arrangement = arrange(e);
  if (!arrangement) {
    ADD_FAILURE() << arrangement.error().message;
    return {};
  }
  EXPECT_EQ(check(arrangement.value()), "");
  return canonical_topology(arrangement.value());
}

/// How many of the earlier splitting lines are lines of the later encasement.
int kept_lines(const Encasement& earlier, const Encasement& later) {
  int kept = 0;
  for (const Line& line : earlier.lines)
    kept += std::any_of(later.lines.begin(), later.lines.end(), [&](const Line& other) {
      return other.normal == line.normal && other.offset == line.offset;
    });
  return kept;
}

TEST(AddCurves, OneByOneIsTheSameAsAllAtOnce) {
  for (unsigned seed = 1; seed <= 3; ++seed)
    for (int degree = 1; degree <= 5; ++degree) {
      SCOPED_TRACE("degree " + std::to_string(degree) + ", seed " + std::to_string(seed));
      const auto curves = random_scene(degree, 5, seed);
      const Encasement at_once = encased::run_curves(curves);
      const Encasement built_up = one_by_one(curves, encased::square());
      encased::expect_certified(built_up);
      EXPECT_EQ(built_up.crossings.size(), at_once.crossings.size());
      EXPECT_EQ(topology(built_up), topology(at_once));
    }
}

TEST(AddCurves, SeveralAtOnceToManyKeepTheLinesAndTheIsolations) {
  const auto curves = random_scene(4, 12, 7);
  const Encasement earlier = encased::run_curves({curves.begin(), curves.begin() + 9});
  const Encasement later = added(earlier, {curves.begin() + 9, curves.end()});
  const Encasement at_once = encased::run_curves(curves);
  EXPECT_EQ(topology(later), topology(at_once));
  EXPECT_GE(kept_lines(earlier, later), 0.95 * static_cast<double>(earlier.lines.size()));
  // Of the 66 pairs 30 are new; the subdivision shared by all curves is new too.
  EXPECT_LT(later.statistics.root_boxes, 0.8 * static_cast<double>(at_once.statistics.root_boxes));
  EXPECT_LT(later.statistics.critical_boxes,
            0.5 * static_cast<double>(at_once.statistics.critical_boxes));
}

TEST(AddCurves, InTheWholePlane) {
  const auto curves = encased::curves({"x^2 + y^2 - 1", "x*y - 2", "x^2 - 3*y^2 - x + 5/7"});
  const Encasement at_once = encased::run_curves(curves, whole_plane());
  encased::expect_certified(at_once);
  const Encasement built_up = one_by_one(curves, whole_plane());
  encased::expect_certified(built_up);
  EXPECT_EQ(built_up.crossings.size(), 6u);
  EXPECT_EQ(topology(built_up), topology(at_once));
}

TEST(AddCurves, AComponentSharedWithAnEarlierCurveIsFound) {
  const auto curves = encased::curves({"(x - 1/3)*(y + x^2)", "(x - 1/3)*(x + y - 1/5)"});
  const Encasement at_once = encased::run_curves(curves);
  const Encasement built_up = one_by_one(curves, encased::square());
  EXPECT_EQ(built_up.curves.size(), 3u);
  EXPECT_EQ(built_up.outcome, Outcome::Degenerate);
  EXPECT_EQ(built_up.crossings.size(), at_once.crossings.size());
  EXPECT_EQ(built_up.degenerate.size(), at_once.degenerate.size());
}

TEST(AddCurves, AContactIsReportedAndWhatTouchedBeforeStaysReported) {
  const auto curves = encased::curves({"y - x^2", "y", "x - y/3 - 1/2", "x + y + 1/10"});
  const Encasement at_once = encased::run_curves(curves);
  const Encasement built_up = one_by_one(curves, encased::square());
  EXPECT_EQ(built_up.outcome, Outcome::Degenerate);
  ASSERT_EQ(built_up.degenerate.size(), 1u);
  EXPECT_EQ(built_up.degenerate[0].kind, Unresolved::Kind::Contact);
  EXPECT_EQ(built_up.crossings.size(), at_once.crossings.size());
}

TEST(AddCurves, AnEarlierVertexOnTheNewCurveIsNoObstacle) {
  // The first cuts meet the sides where nothing was; the new line runs along one of them.
  const auto curves = encased::curves({"x^2 + y^2 - 1/4", "(x - 1/2)^2 + y^2 - 1/5"});
  const Encasement earlier = encased::run_curves(curves);
  ASSERT_GT(earlier.lines.size(), 4u);
  for (std::size_t k = 4; k < earlier.lines.size(); ++k) {
    const Line& line = earlier.lines[k];
    const auto term = [](int i, int j, double c) {
      return Polynomial<2>::Term{{i, j}, Rational(c)};
    };
    const auto along = Polynomial<2>::from_terms(
        {term(1, 0, line.normal[0]), term(0, 1, line.normal[1]), term(0, 0, line.offset)});
    const Encasement later = added(earlier, {{"along", along}});
    encased::expect_certified(later);
    auto all = curves;
    all.push_back({"along", along});
    EXPECT_EQ(topology(later), topology(encased::run_curves(all)));
  }
}

TEST(AddCurves, PerturbsTheNewCurvesAsAllTogether) {
  const auto curves = encased::curves({"y - x^2", "y", "x^2 + y^2 - 1/2"});
  EncaseOptions options;
  options.perturbation = 1e-6;
  options.seed = 5;
  const Encasement at_once = encased::run_curves(curves, encased::square(), options);
  const Encasement first = encased::run_curves({curves[0]}, encased::square(), options);
  const Encasement built_up = added(first, {curves[1], curves[2]});
  ASSERT_EQ(built_up.input.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(built_up.input[k].function, at_once.input[k].function) << k;
  EXPECT_EQ(built_up.perturbation, 1e-6);
}

TEST(AddCurves, RefusesWhatIsNoCurve) {
  const Encasement earlier = encased::run({"x^2 + y^2 - 1/4"});
  const Result<Encasement> zero = add_curves(earlier, {{"zero", Polynomial<2>()}});
  ASSERT_FALSE(zero);
  EXPECT_EQ(zero.error().code, Error::Code::BadInput);
}

TEST(AddCurves, NothingAddedIsTheSameEncasement) {
  const Encasement earlier = encased::run_curves(random_scene(4, 4, 3));
  const Encasement again = added(earlier, {});
  EXPECT_EQ(again.cells.size(), earlier.cells.size());
  EXPECT_EQ(topology(again), topology(earlier));
}

TEST(EarlierEncasement, TakesOverOnlyWhatCoversTheSameCurvesInTheSamePolygon) {
  const Encasement e = encased::run({"x^2 + y^2 - 1/2", "y - x^3"});
  EarlierEncasement earlier(e);
  std::vector<Crossing> crossings;
  std::vector<CrossingCover> crossing_covers;
  std::vector<CriticalRegion> regions;
  std::vector<CriticalCover> critical_covers;
  const auto takes = [&](const Box<2>& box) {
    const bool both = earlier.append_crossings({0, 1}, box, &crossings, &crossing_covers);
    EXPECT_EQ(earlier.append_critical_regions(0, box, &regions, &critical_covers), both);
    return both;
  };
  const Box<2> root = e.crossing_covers[0].root;
  Box<2> larger = root;
  larger.hi[0] += 1;
  EXPECT_FALSE(takes(root));
  earlier.match(e.curves, e.region_used);
  EXPECT_TRUE(takes(root));
  EXPECT_EQ(crossings.size(), 2u);
  EXPECT_FALSE(takes(larger));
  earlier.match(e.curves, encased::rectangle(-2, 2, -2, 2));
  EXPECT_FALSE(takes(root));
  earlier.match({e.curves[1], e.curves[0]}, e.region_used);
  EXPECT_FALSE(takes(root));
}

}  // namespace
}  // namespace encase
