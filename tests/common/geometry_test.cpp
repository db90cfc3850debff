// SPDX-License-Identifier: MIT
#include "encase/geometry.hpp"

#include <gtest/gtest.h>

namespace encase {
namespace {

TEST(Hyperplane, DoublesAreKeptAndOtherRationalsRemembered) {
  const Line dyadic = Line::from_rationals({Rational(1, 2), -3, 0});
  EXPECT_FALSE(dyadic.rational);
  EXPECT_EQ(dyadic.normal[0], 0.5);
  EXPECT_EQ(dyadic.exact()[1], -3);
  const Line third = Line::from_rationals({1, Rational(1, 3), Rational(1, 10)});
  ASSERT_TRUE(third.rational);
  EXPECT_EQ(third.normal[1], 1.0 / 3);
  EXPECT_EQ(third.offset, 0.1);
  EXPECT_EQ(third.exact()[1], Rational(1, 3));
  EXPECT_EQ(third.exact()[2], Rational(1, 10));
}

TEST(Box, HullAndMeetingIncludeBoundaries) {
  const Box<3> a{{0, 0, 0}, {1, 1, 1}}, b{{1, -2, 0.5}, {2, 0, 3}}, c{{1.5, 0, 0}, {2, 1, 1}};
  EXPECT_TRUE(a.meets(b));
  EXPECT_FALSE(a.meets(c));
  EXPECT_EQ(hull(a, b), (Box<3>{{0, -2, 0}, {2, 1, 3}}));
  EXPECT_TRUE(hull(a, b).contains(a));
  EXPECT_FALSE(a.contains(b));
  EXPECT_EQ(b.largest_width(), 2.5);
}

}  // namespace
}  // namespace encase
