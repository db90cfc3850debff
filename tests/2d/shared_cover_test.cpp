// SPDX-License-Identifier: MIT
//
// Many curves: what the shared cover separates, and that nothing is lost by it.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "2d/shared_leaves.hpp"
#include "circles.hpp"
#include "common/isolate_roots.hpp"
#include "common/random_polynomials.hpp"
#include "encased.hpp"

namespace encase {
namespace {

using Pair = std::array<int, 2>;

std::map<Pair, int> counted(const Encasement& e) {
  std::map<Pair, int> counts;
  for (const Crossing& crossing : e.crossings)
    if (crossing.location != Location::Outside) ++counts[crossing.curves];
  return counts;
}

/// That the counters are those of the covers and crossings.
void expect_counters(const Encasement& e) {
  const Statistics& s = e.statistics;
  std::set<Pair> together;
  for (const auto& alive : e.shared_cover.alive)
    for (std::size_t i = 0; i < alive.size(); ++i)
      for (std::size_t j = i + 1; j < alive.size(); ++j) together.insert({alive[i], alive[j]});
  std::set<Pair> covered;
  for (const CrossingCover& cover : e.crossing_covers) covered.insert(cover.curves);
  EXPECT_EQ(covered, together);
  EXPECT_EQ(s.pairs_met, static_cast<std::int64_t>(together.size()));
  EXPECT_EQ(s.pairs_met, static_cast<std::int64_t>(e.crossing_covers.size()));
  EXPECT_LE(s.pairs_isolated, s.pairs_met);
  EXPECT_GE(s.filter_failures, 0);
  EXPECT_EQ(s.pairs_isolated - s.filter_failures, static_cast<std::int64_t>(counted(e).size()));
}

TEST(SharedCover, SparseCirclesCrossWhereTheyShould) {
  for (const auto& [count, least, most] : {std::array{3, 200, 300}, {12, 50, 150}, {60, 20, 60}})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const auto circles = random_circles(count, least, most, seed);
      const Encasement e = encased::run_curves(curves_of(circles));
      EXPECT_EQ(e.outcome, Outcome::Certified);
      const auto counts = counted(e);
      int crossing_pairs = 0;
      for (int i = 0; i < count; ++i)
        for (int j = i + 1; j < count; ++j) {
          const auto found = counts.find({i, j});
          const int expected = common_points(circles[i], circles[j]);
          EXPECT_EQ(found == counts.end() ? 0 : found->second, expected) << i << " and " << j;
          crossing_pairs += expected > 0;
        }
      expect_counters(e);
      EXPECT_EQ(e.statistics.pairs_isolated - e.statistics.filter_failures, crossing_pairs);
    }
}

TEST(SharedCover, MostPairsOfSmallCirclesNeverMeet) {
  const Encasement e = encased::run_curves(curves_of(random_circles(100, 20, 40, 5)));
  EXPECT_EQ(e.outcome, Outcome::Certified);
  EXPECT_LT(e.statistics.pairs_met, 400);  // of 4950
  // The covers of curves and pairs stay where these are.
  const double whole = e.shared_cover.root.largest_width();
  for (const CrossingCover& cover : e.crossing_covers)
    EXPECT_LT(cover.root.largest_width(), 0.5 * whole);
  for (const CriticalCover& cover : e.critical_covers)
    EXPECT_LT(cover.root.largest_width(), 0.5 * whole);
}

/// Some pairs are told apart where they meet, others need not be sought in all of their leaves.
TEST(SharedCover, FewPairsOfLongCurvesAreIsolated) {
  const auto circles = random_circles(40, 200, 500, 11);
  const Encasement e = encased::run_curves(curves_of(circles));
  EXPECT_EQ(e.outcome, Outcome::Certified);
  expect_counters(e);
  EXPECT_LT(e.statistics.pairs_isolated, e.statistics.pairs_met);
  const auto counts = counted(e);
  EXPECT_LT(e.statistics.pairs_isolated, 1.3 * static_cast<double>(counts.size()));
  encased::expect_certified(e);
}

TEST(SharedCover, PairsHaveNone) {
  const auto circles = random_circles(2, 400, 500, 1);
  const Encasement e = encased::run_curves(curves_of(circles));
  EXPECT_TRUE(e.shared_cover.tokens.empty());
  EXPECT_TRUE(e.shared_cover.alive.empty());
  ASSERT_EQ(e.crossing_covers.size(), 1u);
  EXPECT_EQ(e.crossing_covers[0].root, subdivision_root(e.region_used.bounding_box()));
  EXPECT_EQ(e.statistics.pairs_met, 1);
  EXPECT_EQ(e.statistics.pairs_isolated, 1);
  EXPECT_EQ(e.statistics.filter_failures, common_points(circles[0], circles[1]) == 0);
}

TEST(SharedCover, CurvesThatDoNotComeIntoTheRegionAreAbsent) {
  const Encasement e =
      encased::run({"x - y + 1/10", "x + y - 1/7", "(x - 5)^2 + y^2 - 1", "x^2 + 2 y^2 - 1/2"});
  EXPECT_EQ(e.outcome, Outcome::Certified);
  for (const auto& alive : e.shared_cover.alive)
    EXPECT_EQ(std::count(alive.begin(), alive.end(), 2), 0);
  for (const CriticalCover& cover : e.critical_covers) EXPECT_NE(cover.curve, 2);
  EXPECT_EQ(e.critical_covers.size(), 3u);
  EXPECT_EQ(counted(e).size(), 3u);
  expect_counters(e);
}

TEST(SharedCover, LeavesOutWhatLiesOutsideAPolygon) {
  const Region triangle =
      make_region({{Rational(-1), Rational(-1)}, {Rational(1), Rational(-4, 5)}, {0, 1}}).value();
  const auto circles = random_circles(40, 60, 200, 3);
  const Encasement e = encased::run_curves(curves_of(circles), triangle);
  EXPECT_EQ(e.outcome, Outcome::Certified);
  EXPECT_GT(std::count(e.shared_cover.tokens.begin(), e.shared_cover.tokens.end(), cover::kOutside),
            0);
  expect_counters(e);
}

TEST(SharedCover, TouchingCirclesAreReportedAndTheRestCertified) {
  // The first two touch, the third crosses both, the fourth is far.
  const std::vector<Circle> circles{{-300, 0, 200}, {100, 0, 200}, {-100, 90, 150}, {700, 600, 90}};
  const Encasement e = encased::run_curves(curves_of(circles));
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  ASSERT_FALSE(e.degenerate.empty());
  EXPECT_EQ(e.degenerate[0].kind, Unresolved::Kind::Contact);
  EXPECT_EQ(e.degenerate[0].curves, (std::vector<int>{0, 1}));
  EXPECT_LT(e.degenerate[0].box.largest_width(), 1e-6);
  const auto counts = counted(e);
  EXPECT_EQ(counts.at({0, 2}), 2);
  EXPECT_EQ(counts.at({1, 2}), 2);
  EXPECT_EQ(counts.count({0, 3}) + counts.count({1, 3}) + counts.count({2, 3}), 0u);
}

TEST(SharedCover, ManyCurvesThroughOnePoint) {
  std::vector<std::string> lines;
  for (int k = 1; k <= 12; ++k)
    lines.push_back(std::to_string(k) + " (x - 1/3) + " + std::to_string(13 - 2 * k) +
                    " (y + 1/7)");
  const Encasement e = encased::run(lines);
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  EXPECT_EQ(e.statistics.pairs_met, 66);
}

TEST(SharedCover, ComponentsOfManyCurvesAreTakenApart) {
  auto curves = curves_of(random_circles(30, 50, 150, 4));
  EXPECT_EQ(encased::run_curves(curves).outcome, Outcome::Certified);
  const auto line = Polynomial<2>::variable(0) - Polynomial<2>::constant(Rational(1, 7));
  curves.push_back({"more", curves[3].function.polynomial() * line * line});
  const Encasement e = encased::run_curves(curves);
  EXPECT_EQ(e.curves.size(), 31u);
  ASSERT_EQ(e.degenerate.size(), 2u);
  EXPECT_EQ(e.degenerate[0].kind, Unresolved::Kind::SharedComponent);
  EXPECT_EQ(e.degenerate[0].curves, (std::vector<int>{3, 30}));
  EXPECT_EQ(e.degenerate[1].kind, Unresolved::Kind::RepeatedComponent);
  EXPECT_EQ(e.degenerate[1].curves, std::vector<int>{30});
}

TEST(SharedCover, HoldsWhereABudgetRanOut) {
  const auto curves = curves_of(random_circles(30, 100, 300, 2));
  for (int calls = 0; calls < 8; ++calls) {
    EncaseOptions options;
    int left = calls;
    options.progress = [&](const char*, double) { return left-- > 0; };
    const Encasement e = encased::run_curves(curves, encased::square(), options);
    EXPECT_EQ(e.outcome, Outcome::Undecided);
    if (calls > 0) continue;
    // Stopped at once: nothing is known of any pair, and no pair is looked at.
    EXPECT_EQ(e.shared_cover.tokens, std::vector<int>{cover::kUnresolved});
    EXPECT_TRUE(e.crossing_covers.empty());
    ASSERT_FALSE(e.undecided.empty());
    EXPECT_EQ(e.undecided[0].box, e.shared_cover.root);
  }
}

/// The common zeros inside the region of two curves, isolated over the whole of it.
RootIsolation<2> whole_region(const Encasement& e, const Pair& pair, Kernel& kernel) {
  const FilteredFunction<2> f(e.curves[pair[0]].function.polynomial()),
      g(e.curves[pair[1]].function.polynomial());
  const std::vector<Line> sides(e.lines.begin(), e.lines.begin() + e.region_used.side_count());
  return isolate_roots<2>({&f, &g}, e.region_used.bounding_box(), sides, SubdivisionLimits{},
                          kernel);
}

class SharedCoverOfRandomCurves : public testing::TestWithParam<RandomOptions::Kind> {};

TEST_P(SharedCoverOfRandomCurves, HasTheCrossingsOfAllPairs) {
  for (int count = 3; count <= 8; ++count)
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      RandomOptions options;
      options.kind = GetParam();
      options.degree = 1 + (count + static_cast<int>(seed)) % 5;
      options.count = count;
      options.seed = seed;
      const Encasement e = encased::run_curves(random_curves(options));
      EXPECT_EQ(e.outcome, Outcome::Certified);
      expect_counters(e);
      std::map<Pair, std::vector<const Crossing*>> found;
      for (const Crossing& crossing : e.crossings)
        if (crossing.location != Location::Outside) found[crossing.curves].push_back(&crossing);
      Kernel kernel;
      const Box<2> square{{-1, -1}, {1, 1}};
      for (int i = 0; i < count; ++i)
        for (int j = i + 1; j < count; ++j) {
          const RootIsolation<2> all = whole_region(e, {i, j}, kernel);
          EXPECT_TRUE(all.unresolved.empty());
          std::size_t inside = 0;
          for (std::size_t k = 0; k < all.roots.size(); ++k) {
            if (!square.contains(all.roots[k].center())) continue;
            ++inside;
            int same = 0;
            for (const Crossing* crossing : found[{i, j}]) {
              if (!crossing->box.meets(all.roots[k])) continue;
              ++same;
              if (crossing->rounded && all.rounded[k]) {
                EXPECT_EQ(crossing->point, all.roots[k].center());
              }
            }
            EXPECT_EQ(same, 1);
          }
          EXPECT_EQ((found[{i, j}].size()), inside);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SharedCoverOfRandomCurves,
                         testing::Values(RandomOptions::Kind::Interpolating,
                                         RandomOptions::Kind::Dense));

TEST(SharedLeaves, RootsAroundAPartContainIt) {
  const Box<2> whole = subdivision_root(Box<2>{{-1, 0}, {1, 3}});
  for (const Box<2>& part : {Box<2>{{0.1, 0.2}, {0.3, 0.25}}, Box<2>{{0.75, 2.5}, {1, 3}},
                             Box<2>{whole.lo, {-0.5, 3}}, Box<2>{whole.lo, whole.hi}}) {
    const Box<2> root = root_around(part, whole);
    EXPECT_TRUE(root.contains(part));
    EXPECT_TRUE(whole.contains(root));
    EXPECT_TRUE(root == whole || root.width(0) < 0.7 * whole.width(0) ||
                root.width(1) < 0.7 * whole.width(1));
  }
}

}  // namespace
}  // namespace encase
