// SPDX-License-Identifier: MIT
#include "2d/clearing.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace encase {
namespace {

TEST(Clearing, IsTheWidestPlaceOfARegion) {
  const std::vector<Point<2>> square = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  Clearing clearing = largest_clearing({square}, 1);
  EXPECT_NEAR(clearing.radius, 50, 1);
  EXPECT_NEAR(clearing.center[0], 50, 1);
  // A hole in the middle: the corners have the most room, 20 / (1 + 1 / sqrt 2).
  clearing = largest_clearing({square, {{20, 20}, {80, 20}, {80, 80}, {20, 80}}}, 1);
  EXPECT_GT(clearing.radius, 10);
  EXPECT_LT(clearing.radius, 12.5);
  // A corridor with a room at its end.
  clearing = largest_clearing({{{0, 0}, {300, 0}, {300, 4}, {30, 4}, {30, 30}, {0, 30}}}, 1);
  EXPECT_NEAR(clearing.center[0], 15, 2);
  EXPECT_NEAR(clearing.center[1], 15, 2);
  EXPECT_NEAR(clearing.radius, 15, 1);
}

TEST(Clearing, KeepsItsPrecisionAtAnyScale) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const std::vector<Point<2>> triangle = {{0, 0}, {3 * scale, 0}, {0, 4 * scale}};
    const Clearing clearing = largest_clearing({triangle}, 1e-4 * scale);
    EXPECT_NEAR(clearing.radius / scale, 1, 1e-4);
  }
}

TEST(Clearing, IsNoneWhereThereIsNoRegion) {
  EXPECT_LE(largest_clearing({}, 1).radius, 0);
  EXPECT_LE(largest_clearing({{{1, 1}, {1, 1}, {1, 1}}}, 1).radius, 0);
  EXPECT_LE(largest_clearing({{{0, 0}, {1, 0}}}, 0.1).radius, 0);
}

}  // namespace
}  // namespace encase
