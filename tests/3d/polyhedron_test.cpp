// SPDX-License-Identifier: MIT
#include "encase/polyhedron.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace encase {
namespace {

Polyhedron unit_box() { return make_box({0, 0, 0}, {1, 1, 1}).value(); }

std::string message(const std::vector<HalfSpace>& sides) {
  const auto result = make_polyhedron(sides);
  return result ? "" : result.error().message;
}

TEST(Polyhedron, BoxHasItsEightCorners) {
  const Polyhedron box = make_box({-1, 0, Rational(1, 3)}, {1, 2, 5}).value();
  ASSERT_EQ(box.corners.size(), 8u);
  EXPECT_EQ(box.corners.front(), (RationalPoint<3>{-1, 0, Rational(1, 3)}));
  EXPECT_EQ(box.corners.back(), (RationalPoint<3>{1, 2, 5}));
  const Box<3> around = box.bounding_box();
  EXPECT_EQ(around.lo[0], -1);
  EXPECT_LE(Rational(around.lo[2]), Rational(1, 3));
  EXPECT_NEAR(around.lo[2], 1.0 / 3, 1e-15);
  EXPECT_EQ(around.hi[2], 5);
}

TEST(Polyhedron, OctahedronHasSixCornersOnFourSidesEach) {
  std::vector<HalfSpace> sides;
  for (int k = 0; k < 8; ++k) sides.push_back({k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1, -1});
  EXPECT_EQ(make_polyhedron(sides).value().corners.size(), 6u);
}

TEST(Polyhedron, SidesThatAddNothingChangeNoCorner) {
  std::vector<HalfSpace> sides = unit_box().sides;
  sides.push_back({1, 1, 1, -3});  // touches a corner
  sides.push_back({1, 0, 0, -7});  // far away
  sides.push_back({2, 0, 0, -2});  // a side again
  EXPECT_EQ(make_polyhedron(sides).value().corners, unit_box().corners);
}

TEST(Polyhedron, WhatIsNoneIsRefused) {
  EXPECT_NE(message({}).find("not bounded"), std::string::npos);
  std::vector<HalfSpace> open = unit_box().sides;
  open.erase(open.begin());
  EXPECT_NE(message(open).find("not bounded"), std::string::npos);
  // A wedge without a corner.
  EXPECT_NE(message({{1, 0, 0, 0}, {0, 1, 0, 0}}).find("not bounded"), std::string::npos);
  std::vector<HalfSpace> empty = unit_box().sides;
  empty.push_back({1, 1, 1, 1});
  EXPECT_NE(message(empty).find("empty"), std::string::npos);
  std::vector<HalfSpace> flat = unit_box().sides;
  flat.push_back({1, 0, 0, 0});
  EXPECT_NE(message(flat).find("no interior"), std::string::npos);
  std::vector<HalfSpace> point = unit_box().sides;
  point.push_back({1, 1, 1, 0});
  EXPECT_NE(message(point).find("no interior"), std::string::npos);
  std::vector<HalfSpace> no_normal = unit_box().sides;
  no_normal.push_back({0, 0, 0, -1});
  EXPECT_NE(message(no_normal).find("half space 7"), std::string::npos);
  EXPECT_NE(message(std::vector<HalfSpace>(101, {1, 0, 0, 0})).find("at most 100"),
            std::string::npos);
  EXPECT_NE(make_box({0, 1, 0}, {1, 1, 1}).error().message.find("bound of y"), std::string::npos);
}

}  // namespace
}  // namespace encase
