// SPDX-License-Identifier: MIT
#include "encase/region.hpp"

#include <gtest/gtest.h>

#include <string>

namespace encase {
namespace {

using Corners = std::vector<RationalPoint<2>>;

std::string complaint(const Corners& corners) {
  const auto region = make_region(corners);
  if (region.ok()) return "";
  EXPECT_EQ(region.error().code, Error::Code::BadInput);
  return region.error().message;
}

TEST(Region, RectangleHasUnitSidesWithTheInsideNegative) {
  const auto region = make_region(Rational(-1), Rational(2), Rational(0), Rational(1, 3));
  ASSERT_TRUE(region.ok());
  ASSERT_EQ(region.value().side_count(), 4);
  for (int k = 0; k < 4; ++k) {
    const auto c = region.value().side(k).exact();
    EXPECT_EQ(abs(c[0]) + abs(c[1]), 1);
    EXPECT_LT(c[0] * Rational(1, 2) + c[1] * Rational(1, 6) + c[2], 0);
    for (int end = k; end <= k + 1; ++end) {
      const auto& p = region.value().corners[static_cast<std::size_t>(end % 4)];
      EXPECT_EQ(c[0] * p[0] + c[1] * p[1] + c[2], 0);
    }
  }
  EXPECT_FALSE(region.value().side(0).rational);
  EXPECT_TRUE(region.value().side(2).rational);  // y = 1/3
  const Box<2> box = region.value().bounding_box();
  EXPECT_EQ(box.lo, (Point<2>{-1, 0}));
  EXPECT_EQ(box.hi[0], 2);
  EXPECT_GT(Rational(box.hi[1]), Rational(1, 3));
}

TEST(Region, EitherOrientationAndCornersWithinSidesGiveOnePolygon) {
  const Corners ccw = {{0, 0}, {1, 0}, {2, 0}, {2, 0}, {1, 1}, {0, 0}};
  const auto a = make_region(ccw);
  const auto b = make_region(Corners(ccw.rbegin(), ccw.rend()));
  ASSERT_TRUE(a.ok() && b.ok());
  EXPECT_EQ(a.value().side_count(), 3);
  EXPECT_EQ(b.value().side_count(), 3);
  for (const Region* r : {&a.value(), &b.value()})
    for (int k = 0; k < 3; ++k) {
      const auto c = r->side(k).exact();
      EXPECT_LT(c[0] + c[1] * Rational(1, 3) + c[2], 0);
    }
}

TEST(Region, SidesOfAHugePolygonStayFinite) {
  const Rational far(1e299);
  const auto region = make_region(Corners{{-far, 0}, {far, -far}, {far, Rational(far / 3)}});
  ASSERT_TRUE(region.ok());
  for (int k = 0; k < 3; ++k) {
    const Line side = region.value().side(k);
    EXPECT_LE(std::abs(side.normal[0]), 4);
    EXPECT_LE(std::abs(side.offset), 8e299);
  }
}

TEST(Region, ComplaintsNameTheCorner) {
  EXPECT_NE(complaint({{0, 0}, {1, 0}}).find("at least three corners"), std::string::npos);
  EXPECT_NE(complaint({{0, 0}, {1, 1}, {2, 2}}).find("no area"), std::string::npos);
  EXPECT_NE(complaint({{0, 0}, {2, 0}, {1, Rational(1, 2)}, {1, 2}}).find("corner 3 (1, 0.5)"),
            std::string::npos);
  EXPECT_NE(complaint({{0, 0}, {0, 2}, {Rational(1, 4), Rational(1, 4)}, {2, 0}}).find("corner 3"),
            std::string::npos);
}

TEST(Region, SpikesAndStarsAreNotConvex) {
  EXPECT_NE(complaint({{0, 0}, {2, 0}, {1, 0}, {1, 1}}).find("not convex"), std::string::npos);
  // A pentagram turns left everywhere, but twice around.
  EXPECT_NE(complaint({{10, 0}, {-8, 6}, {3, -10}, {3, 10}, {-8, -6}}).find("crosses itself"),
            std::string::npos);
  EXPECT_NE(complaint({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), "");
}

TEST(Region, EmptyRectanglesAreRejected) {
  const auto flat = make_region(Rational(0), Rational(1), Rational(2), Rational(2));
  ASSERT_FALSE(flat.ok());
  EXPECT_NE(flat.error().message.find("ymin = 2 is not less than ymax = 2"), std::string::npos);
}

}  // namespace
}  // namespace encase
