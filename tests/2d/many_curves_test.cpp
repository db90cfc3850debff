// SPDX-License-Identifier: MIT
//
// More curves than pairs can be looked at one by one, and what makes that cheap.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "2d/nested_tiles.hpp"
#include "2d/recycled_memory.hpp"
#include "circles.hpp"
#include "common/random_polynomials.hpp"
#include "encase/arrangement.hpp"
#include "encased.hpp"

namespace encase {
namespace {

using Pair = std::array<int, 2>;

std::map<Pair, int> crossings_by_pair(const Encasement& e) {
  std::map<Pair, int> counts;
  for (const Crossing& crossing : e.crossings) ++counts[crossing.curves];
  return counts;
}

std::vector<NamedCurve> dense_curves(int degree, int count, int bits) {
  RandomOptions options;
  options.kind = RandomOptions::Kind::Dense;
  options.degree = degree;
  options.count = count;
  options.bits = bits;
  return random_curves(options);
}

TEST(ManyCurves, CirclesCrossAsTheirRadiiSay) {
  const auto circles = random_circles(120, 150, 600, 7);
  const int count = static_cast<int>(circles.size());
  const Encasement e = encased::run_curves(curves_of(circles));
  encased::expect_certified(e);
  auto found = crossings_by_pair(e);
  int expected = 0;
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j) {
      EXPECT_EQ((found[{i, j}]), common_points(circles[i], circles[j])) << i << " and " << j;
      expected += common_points(circles[i], circles[j]);
    }
  EXPECT_GT(expected, 7000);
  EXPECT_EQ(static_cast<int>(e.crossings.size()), expected);
  // Crossings need a cell each; few more are made.
  EXPECT_LT(e.cells.size(), 1.25 * expected);

  const Result<Arrangement> arrangement = arrange(e);
  ASSERT_TRUE(arrangement.ok()) << arrangement.error().message;
  EXPECT_EQ(check(arrangement.value()), "");
  // All circles hang together, in the square: two components.
  EXPECT_EQ(arrangement.value().components.size(), 2u);
  EXPECT_EQ(static_cast<int>(arrangement.value().faces.size()), expected + 3);
}

/// Curves whose crossings lie near the origin, in a rectangle of thousands of units.
TEST(ManyCurves, InThePlaneCrossAsTheirPairsDo) {
  const auto curves = dense_curves(5, 8, 50);
  const Encasement e = encased::run_curves(curves, whole_plane());
  encased::expect_certified(e);
  auto found = crossings_by_pair(e);
  for (int i = 0; i < 8; ++i)
    for (int j = i + 1; j < 8; ++j) {
      const Encasement pair = encased::run_curves({curves[i], curves[j]}, whole_plane());
      EXPECT_EQ((found[{i, j}]), static_cast<int>(pair.crossings.size())) << i << " and " << j;
    }
}

TEST(ManyCurves, PairsAreSoughtWhereTheyMeet) {
  const Encasement e = encased::run_curves(dense_curves(5, 30, 50), whole_plane());
  encased::expect_certified(e);
  const double whole = e.shared_cover.root.largest_width();
  EXPECT_GT(whole, 100);
  const auto small =
      std::count_if(e.crossing_covers.begin(), e.crossing_covers.end(),
                    [&](const CrossingCover& c) { return c.root.largest_width() < 0.1 * whole; });
  EXPECT_GT(2 * small, static_cast<long>(e.crossing_covers.size()));
  EXPECT_LT(e.statistics.root_boxes, 300 * e.statistics.pairs_isolated);
}

Line line_of(double a, double b, double c) {
  Line line;
  line.normal = {a, b};
  line.offset = c;
  return line;
}

class NestedTilesOf : public testing::Test {
 protected:
  NestedTiles make(const NamedCurve& curve, const Box<2>& box, bool nested = true) {
    polynomials.emplace_back(curve.function.polynomial());
    whole.emplace_back(polynomials[0], box, kernel);
    return {polynomials, whole, {0, 0}, nested, kernel};
  }

  Kernel kernel;
  std::vector<FilteredFunction<2>> polynomials;
  std::vector<TiledFunction> whole;
};

TEST_F(NestedTilesOf, WideBoxesHaveTilesOfTheirOwnAroundTheMiddle) {
  const Box<2> wide{{-5000, -4000}, {5100, 4000}};
  NestedTiles tiles = make(dense_curves(5, 1, 50)[0], wide);
  EXPECT_EQ(tiles.about(0, wide).box(), wide);
  const Box<2> part{{-1, -1}, {1, 0.5}};
  TiledFunction& inner = tiles.about(0, part);
  EXPECT_TRUE(inner.box().contains(part));
  EXPECT_LT(inner.box().largest_width(), 100);
  // What is lost of values near the middle.
  EXPECT_LT(inner.at({0, 0}).sum, 1e-8 * tiles.whole(0).at({0, 0}).sum);
  // Where the part is not in the middle, the tiles of the whole.
  EXPECT_EQ(tiles.about(0, {{-4000, 0}, {-3999, 1}}).box(), wide);
}

TEST_F(NestedTilesOf, LinesStopWhereTheyEnterAndLeaveInnerBoxes) {
  const Box<2> wide{{-5000, -4000}, {5100, 4000}};
  NestedTiles tiles = make(dense_curves(5, 1, 50)[0], wide);
  for (const Line& line : {line_of(1, 2, 0.25), line_of(1, 0, 0.1), line_of(-1, 1e-9, 3)}) {
    const int p = parameter_axis(line);
    std::vector<double> stops;
    tiles.append_stops(0, line, -3000, 2500, &stops);
    ASSERT_GE(stops.size(), 4u);
    EXPECT_TRUE(std::is_sorted(stops.begin(), stops.end()));
    const auto box_at = [&](double t) {
      Point<2> at;
      at[p] = t;
      at[1 - p] = -(line.normal[p] * t + line.offset) / line.normal[1 - p];
      return tiles.about(0, {at, at}).box();
    };
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      const double width = stops[k + 1] - stops[k];
      EXPECT_EQ(box_at(stops[k] + 0.01 * width), box_at(stops[k + 1] - 0.01 * width));
    }
  }
  // A line that misses the inner boxes, and a part of one that ends before them.
  std::vector<double> stops;
  tiles.append_stops(0, line_of(0, 1, -3500), -3000, 2500, &stops);
  tiles.append_stops(0, line_of(0, 1, -0.5), -3000, -2000, &stops);
  EXPECT_TRUE(stops.empty());
}

TEST_F(NestedTilesOf, OrdinaryBoxesHaveNoInnerOnes) {
  const Box<2> box{{-1, -1}, {1, 1}};
  NestedTiles tiles = make(dense_curves(5, 1, 50)[0], box);
  EXPECT_EQ(tiles.about(0, {{-1e-3, -1e-3}, {1e-3, 1e-3}}).box(), box);
}

TEST_F(NestedTilesOf, OnesThatAreNotAskedForAreNotMade) {
  const Box<2> wide{{-5000, -4000}, {5100, 4000}};
  NestedTiles tiles = make(dense_curves(5, 1, 50)[0], wide, false);
  EXPECT_EQ(tiles.about(0, {{-1, -1}, {1, 1}}).box(), wide);
}

TEST(RecycledMemory, ServesAgainWhatWasGivenBack) {
  RecycledMemory memory;
  void* first = memory.allocate(100);
  void* second = memory.allocate(100);
  EXPECT_NE(first, second);
  memory.deallocate(first, 100);
  EXPECT_EQ(memory.allocate(70), first);  // 65 to 128 bytes are one size
  EXPECT_NE(memory.allocate(100), second);
  memory.deallocate(second, 100);
  EXPECT_NE(memory.allocate(129), second);
}

TEST(RecycledMemory, ArraysDoNotOverlap) {
  RecycledMemory memory;
  std::vector<std::pmr::vector<int>> arrays;
  for (int round = 0; round < 3; ++round) {
    for (int k = 0; k < 50; ++k) arrays.emplace_back(static_cast<std::size_t>(k), k, &memory);
    for (std::size_t k = 0; k < arrays.size(); ++k)
      for (const int entry : arrays[k]) ASSERT_EQ(entry, static_cast<int>(k % 50));
    if (round == 1) arrays.clear();
  }
}

}  // namespace
}  // namespace encase
