// SPDX-License-Identifier: MIT
//
// Strips against rational arithmetic.
#include "common/strip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/subdivision.hpp"
#include "exact_nets.hpp"

namespace encase {
namespace {

class StripOfDegree : public testing::TestWithParam<int> {};

/// f less the strip's linear function lies in [-hi, -lo], so that the zeros lie in the strip.
TEST_P(StripOfDegree, HoldsAllZeros) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 90);
  const FilteredFunction<2> f(random_polynomial(degree, random));
  const Exact exact(f);
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  for (int count = patch_count(degree); count <= Patch::kMaxCount; ++count) {
    Box<2> box = random_box(3, random);
    Patch patch, halves[2];
    expand(tiled.at(box.center()), box, count, &patch);
    for (int step = 0; step < 12; ++step) {
      const Strip strip = strip_of(patch);
      EXPECT_LT(strip.lo, strip.hi);
      for (int round = 0; round < 4; ++round) {
        RationalPoint<2> s = random_point(random);
        if (round == 0) s = {Rational(-1), Rational(1)};
        if (round == 1) s[0] = 1;
        const Rational rest = exact.at(box, s).value - Rational(strip.slope[0]) * s[0] -
                              Rational(strip.slope[1]) * s[1];
        EXPECT_LE(Rational(-strip.hi), rest);
        EXPECT_LE(rest, Rational(-strip.lo));
      }
      const int axis = static_cast<int>(random() % 2), side = static_cast<int>(random() % 2);
      Box<2> lower, upper;
      ASSERT_TRUE(halve_box(box, axis, &lower, &upper));
      halve(patch, axis, true, &halves[0], &halves[1]);
      patch = halves[side];
      box = side == 0 ? lower : upper;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Degrees, StripOfDegree, testing::Values(1, 2, 3, 5, 7, 9, 15));

/// The strip of width `width` around a line through a point.
Strip strip_through(const Point<2>& point, const Point<2>& slope, double width) {
  const double at = slope[0] * point[0] + slope[1] * point[1];
  return {slope, at - width / 2, at + width / 2};
}

TEST(Strips, ThatCrossOutsideOfTheBoxAreApart) {
  const auto crossing = [](const Point<2>& at, double width) {
    const Strip a = strip_through(at, {1, 0.5}, width), b = strip_through(at, {-0.75, 1}, width);
    EXPECT_EQ(apart(a, b), apart(b, a));
    return apart(a, b);
  };
  EXPECT_FALSE(crossing({0.5, 0.25}, 0.01));
  EXPECT_FALSE(crossing({0.99, -0.99}, 0.01));
  EXPECT_TRUE(crossing({1.01, 0.25}, 0.01));
  EXPECT_TRUE(crossing({0.25, 1.01}, 0.01));
  EXPECT_TRUE(crossing({-0.25, -1.01}, 0.01));
  EXPECT_FALSE(crossing({1.01, 0.25}, 0.1));
}

TEST(Strips, ThatAreParallelAreApartUnlessTheyMeet) {
  const Point<2> slope{0.5, 0.25};
  EXPECT_TRUE(apart(strip_through({0, 0}, slope, 0.01), strip_through({0.1, 0}, slope, 0.01)));
  EXPECT_FALSE(apart(strip_through({0, 0}, slope, 0.06), strip_through({0.1, 0}, slope, 0.06)));
  EXPECT_FALSE(apart(strip_through({0, 0}, slope, 0), strip_through({0, 0}, slope, 0)));
  EXPECT_FALSE(apart({}, {}));
}

/// Also where slopes are nearly parallel, huge or tiny.
TEST(Strips, WithACommonPointInTheBoxAreNeverApart) {
  Random random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int k = 0; k < 20000; ++k) {
    const Point<2> at{k % 3 == 0 ? 1.0 : uniform(random), k % 5 == 0 ? -1.0 : uniform(random)};
    Point<2> first{uniform(random), uniform(random)}, second{uniform(random), uniform(random)};
    if (k % 2 == 0)
      for (int i = 0; i < 2; ++i) second[i] = first[i] * (1 + 0x1p-50 * uniform(random));
    const double scale = std::ldexp(1.0, static_cast<int>(random() % 1800) - 900);
    Strip strips[2];
    int n = 0;
    for (const Point<2>& slope : {first, second}) {
      // Around the exact value.
      const Rational value = Rational(slope[0]) * at[0] + Rational(slope[1]) * at[1];
      const double near = value.get_d(), room = 0x1p-50 * std::fabs(near) + 0x1p-70;
      const double s = n == 0 ? scale : 1;
      strips[n++] = {{slope[0] * s, slope[1] * s}, (near - room) * s, (near + room) * s};
    }
    EXPECT_FALSE(apart(strips[0], strips[1]));
  }
}

/// A polynomial's patch on a box, and its strip.
struct Shown {
  Shown(const Polynomial<2>& polynomial, const Box<2>& box) {
    const FilteredFunction<2> f(polynomial);
    Kernel kernel;
    TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
    expand(tiled.at(box.center()), box, patch_count(polynomial.degree()), &patch);
    strip = strip_of(patch);
  }
  Patch patch;
  Strip strip;
};
bool are_apart(const Shown& a, const Shown& b) { return apart(a.patch, a.strip, b.patch, b.strip); }

TEST(Patches, OfCurvesThatBendBesideEachOtherAreApartWhereStripsAreNot) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto lifted = [&](const Rational& by) { return y - x * x - Polynomial<2>::constant(by); };
  const Box<2> box{{-0.5, -0.5}, {0.5, 0.5}};
  const Shown low(lifted(0), box), high(lifted(Rational(1, 100)), box);
  EXPECT_FALSE(apart(low.strip, high.strip));
  EXPECT_TRUE(are_apart(low, high));
  EXPECT_TRUE(are_apart(high, low));
  EXPECT_FALSE(are_apart(low, low));
  EXPECT_FALSE(are_apart(low, Shown(y + x * x - Polynomial<2>::constant(Rational(1, 100)), box)));
}

TEST(Patches, OfCurvesWithACommonPointAreNeverApart) {
  Random random(11);
  for (int k = 0; k < 400; ++k) {
    const Box<2> box = random_box(2 + k % 4, random);
    const RationalPoint<2> s = random_point(random);
    RationalPoint<2> at;
    for (int i = 0; i < 2; ++i)
      at[i] = (Rational(box.lo[i]) + Rational(box.hi[i])) / 2 +
              (Rational(box.hi[i]) - Rational(box.lo[i])) / 2 * s[i];
    const auto through = [&](const Polynomial<2>& f) { return f - Polynomial<2>::constant(f(at)); };
    const auto first = through(random_polynomial(5, random));
    // Every other time they nearly touch there.
    const auto other = through(random_polynomial(5, random));
    const auto second =
        k % 2 == 0 ? other : first + Polynomial<2>::constant(Rational(1, 1000)) * other;
    EXPECT_FALSE(are_apart(Shown(first, box), Shown(second, box)));
  }
}

}  // namespace
}  // namespace encase
