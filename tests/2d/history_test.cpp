// SPDX-License-Identifier: MIT
#include "2d/history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

double area(const std::vector<Point<2>>& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

TEST(History, RecoversThePolygonsThatWereCut) {
  const auto polygons = history_polygons(sample::circle_and_line());
  ASSERT_EQ(polygons.size(), 2u);
  EXPECT_EQ(polygons[0], (std::vector<Point<2>>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  EXPECT_EQ(polygons[1], (std::vector<Point<2>>{{0.0625, -1}, {1, -1}, {1, 1}, {0.0625, 1}}));
}

TEST(History, CutsThroughCornersExactly) {
  // The square by its diagonal x = y, then the upper part by x + y = 0, through corners both.
  Encasement e = sample::circle_and_line();
  e.lines[4] = sample::line(1, -1, 0);
  e.lines[5] = sample::line(1, 1, 0);
  e.history = {{4, 1, ~0}, {5, ~1, 2}, {4, ~2, ~2}};
  const auto polygons = history_polygons(e);
  ASSERT_EQ(polygons.size(), 3u);
  EXPECT_EQ(polygons[1].size(), 3u);
  EXPECT_NEAR(area(polygons[1]), 2, 1e-12);
  EXPECT_EQ(polygons[2].size(), 3u);
  EXPECT_NEAR(area(polygons[2]), 1, 1e-12);
}

TEST(History, ReplacesAPieceByItsPartsCutByCut) {
  const Encasement e = sample::circle_and_line();
  const auto before = pieces_after(e, 0);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before[0].split, 0);
  const auto after = pieces_after(e, 1);
  ASSERT_EQ(after.size(), 2u);
  EXPECT_EQ(after[0].cell, 0);
  EXPECT_EQ(after[0].depth, 1);
  EXPECT_EQ(after[1].split, 1);
  const auto last = pieces_after(e, 2);
  ASSERT_EQ(last.size(), 3u);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(last[k].cell, k);
  EXPECT_EQ(last[2].depth, 2);
}

TEST(History, IsOneCellWhereNothingIsCut) {
  Encasement e = sample::circle_and_line();
  e.history.clear();
  e.cells.resize(1);
  EXPECT_TRUE(history_polygons(e).empty());
  const auto pieces = pieces_after(e, 0);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].cell, 0);
}

}  // namespace
}  // namespace encase
