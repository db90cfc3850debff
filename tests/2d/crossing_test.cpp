// SPDX-License-Identifier: MIT
#include "encase/crossing.hpp"

#include <gtest/gtest.h>

namespace encase {
namespace {

const Polynomial<2> kX = Polynomial<2>::variable(0), kY = Polynomial<2>::variable(1);
Polynomial<2> constant(const Rational& c) { return Polynomial<2>::constant(c); }

/// Only what a crossing refers to.
Encasement with_curves(const std::vector<Polynomial<2>>& curves) {
  Encasement e;
  for (const auto& f : curves) e.curves.push_back({"", f, {}});
  return e;
}

int add_crossing(Encasement* e, int i, int j, const Box<2>& box) {
  Crossing crossing;
  crossing.curves = {i, j};
  crossing.box = box;
  e->crossings.push_back(crossing);
  return static_cast<int>(e->crossings.size()) - 1;
}

Rational power_of_two(int exponent) {
  Rational result = 1;
  if (exponent >= 0)
    result <<= static_cast<unsigned long>(exponent);
  else
    result >>= static_cast<unsigned long>(-exponent);
  return result;
}

bool is_dyadic(const Rational& q) { return mpz_popcount(q.get_den_mpz_t()) == 1; }

void expect_box(const RationalBox& box, const Box<2>& stored, int bits) {
  for (int i = 0; i < 2; ++i) {
    EXPECT_LE(box.hi[i] - box.lo[i], power_of_two(-bits));
    EXPECT_GE(box.lo[i], Rational(stored.lo[i]));
    EXPECT_LE(box.hi[i], Rational(stored.hi[i]));
    EXPECT_TRUE(is_dyadic(box.lo[i]) && is_dyadic(box.hi[i]));
  }
}

/// x = y = sqrt(1/2).
struct UnitCircle {
  Box<2> box{{0.5, 0.25}, {1, 1}};
  Encasement e = with_curves({kX * kX + kY * kY - constant(1), kX - kY});
  int id = add_crossing(&e, 0, 1, box);
};

TEST(Refine, EnclosesTheCommonPointAsNarrowlyAsAsked) {
  const UnitCircle circle;
  for (int bits : {0, 1, 30, 53, 100, 1000, 10000}) {
    const auto box = refine(circle.e, circle.id, bits);
    ASSERT_TRUE(box.ok()) << box.error().message;
    expect_box(box.value(), circle.box, bits);
    for (int i = 0; i < 2; ++i) {
      EXPECT_LE(box.value().lo[i] * box.value().lo[i], Rational(1, 2));
      EXPECT_GE(box.value().hi[i] * box.value().hi[i], Rational(1, 2));
    }
  }
}

TEST(Refine, RationalPointsAreEnclosedToo) {
  // 3 x = 1 and y = 0, where floating point numbers are dense.
  Encasement e = with_curves({constant(3) * kX - constant(1) + kY * kY, kY - kX * kY * kY});
  const Box<2> box{{0.25, -0.125}, {0.5, 0.25}};
  const int id = add_crossing(&e, 0, 1, box);
  const auto refined = refine(e, id, 500);
  ASSERT_TRUE(refined.ok()) << refined.error().message;
  expect_box(refined.value(), box, 500);
  EXPECT_LE(refined.value().lo[0], Rational(1, 3));
  EXPECT_GE(refined.value().hi[0], Rational(1, 3));
  EXPECT_LE(refined.value().lo[1], 0);
  EXPECT_GE(refined.value().hi[1], 0);
}

TEST(Refine, WideBoxesAreSubdividedFirst) {
  // In the stored box both curves bend so much that the Jacobian's enclosure contains singular
  // ones.
  const auto f = kY - kX.power(5) + kX.power(3) * constant(2) - kX * constant(Rational(1, 2));
  const auto g = kX - kY.power(3) * constant(3) - constant(Rational(9, 10));
  Encasement e = with_curves({f, g});
  const Box<2> box{{1, 0.125}, {1.75, 1}};
  const int id = add_crossing(&e, 0, 1, box);
  const auto refined = refine(e, id, 200);
  ASSERT_TRUE(refined.ok()) << refined.error().message;
  expect_box(refined.value(), box, 200);
  // Exact sign changes around the box show that the point is inside.
  const RationalBox& r = refined.value();
  for (const auto& h : {f, g}) {
    int positive = 0, negative = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Rational margin = power_of_two(-150);
      const int sign =
          sgn(h({corner & 1 ? Rational(r.hi[0] + margin) : Rational(r.lo[0] - margin),
                 corner & 2 ? Rational(r.hi[1] + margin) : Rational(r.lo[1] - margin)}));
      positive += sign > 0;
      negative += sign < 0;
    }
    EXPECT_GT(positive, 0);
    EXPECT_GT(negative, 0);
  }
}

TEST(Refine, IllConditionedCrossingsOnlyNeedMoreBits) {
  // Lines that cross at an angle of 1e-60, at (0, 1/3).
  const Rational tiny = Rational(1) / constant(10).power(60).terms()[0].coefficient;
  Encasement e = with_curves({kY - constant(Rational(1, 3)) - kX * constant(tiny),
                              kY - constant(Rational(1, 3)) + kX * constant(tiny)});
  const Box<2> box{{-1, 0}, {1, 1}};
  const int id = add_crossing(&e, 0, 1, box);
  const auto refined = refine(e, id, 300);
  ASSERT_TRUE(refined.ok()) << refined.error().message;
  expect_box(refined.value(), box, 300);
  EXPECT_LE(refined.value().lo[1], Rational(1, 3));
  EXPECT_GE(refined.value().hi[1], Rational(1, 3));
}

TEST(Refine, FalseClaimsAreNotConfirmed) {
  UnitCircle circle;
  const int empty = add_crossing(&circle.e, 0, 1, {{0.75, 0.75}, {1, 1}});
  const auto refined = refine(circle.e, empty, 20);
  ASSERT_FALSE(refined.ok());
  EXPECT_EQ(refined.error().code, Error::Code::Internal);
  const int two = add_crossing(&circle.e, 0, 1, {{-1, -1}, {1, 1}});
  EXPECT_EQ(refine(circle.e, two, 20).error().code, Error::Code::Undecided);
  EXPECT_EQ(refine(circle.e, 7, 20).error().code, Error::Code::BadInput);
  EXPECT_EQ(refine(circle.e, -1, 20).error().code, Error::Code::BadInput);
  EXPECT_EQ(refine(circle.e, 0, 2000000000).error().code, Error::Code::Undecided);
}

Sign compared(const Encasement& e, int axis, int first, int second) {
  const auto forward = compare_coordinate(e, axis, first, second);
  const auto backward = compare_coordinate(e, axis, second, first);
  if (!forward.ok() || !backward.ok()) {
    ADD_FAILURE() << (forward.ok() ? backward : forward).error().message;
    return Sign::Zero;
  }
  EXPECT_EQ(forward.value(), -backward.value());
  return forward.value();
}

TEST(CompareCoordinate, FarAndNearCoordinatesAreOrdered) {
  // The circle with y = x, and with lines through a point 1e-100 beside (sqrt(1/2), sqrt(1/2)).
  UnitCircle circle;
  Rational tiny = 1;
  for (int k = 0; k < 100; ++k) tiny /= 10;
  circle.e.curves.push_back({"", kX - kY + constant(tiny), {}});
  const int near = add_crossing(&circle.e, 0, 2, circle.box);
  const int far = add_crossing(&circle.e, 0, 1, {{-1, -1}, {-0.5, -0.5}});
  EXPECT_EQ(compared(circle.e, 0, circle.id, near), Sign::Positive);
  EXPECT_EQ(compared(circle.e, 1, circle.id, near), Sign::Negative);
  EXPECT_EQ(compared(circle.e, 0, far, circle.id), Sign::Negative);
  EXPECT_EQ(compared(circle.e, 0, far, far), Sign::Zero);
}

TEST(CompareCoordinate, EqualityIsProvedByResultants) {
  // x^2 + y^2 = 1 and y^2 = x^2: four points, in pairs of equal coordinates.
  Encasement e = with_curves({kX * kX + kY * kY - constant(1), kX * kX - kY * kY,
                              constant(2) * kX * kX - constant(1),
                              kY - kX.power(3) - constant(Rational(1, 9))});
  const int ne = add_crossing(&e, 0, 1, {{0.5, 0.5}, {1, 1}});
  const int nw = add_crossing(&e, 0, 1, {{-1, 0.5}, {-0.5, 1}});
  const int se = add_crossing(&e, 0, 1, {{0.5, -1}, {1, -0.5}});
  // The same x = sqrt(1/2), on other curves and at another y.
  const int other = add_crossing(&e, 2, 3, {{0.5, 0}, {1, 1}});
  EXPECT_EQ(compared(e, 0, ne, se), Sign::Zero);
  EXPECT_EQ(compared(e, 1, ne, nw), Sign::Zero);
  EXPECT_EQ(compared(e, 0, ne, nw), Sign::Positive);
  EXPECT_EQ(compared(e, 0, ne, other), Sign::Zero);
  EXPECT_EQ(compared(e, 1, ne, other), Sign::Positive);
}

TEST(CompareCoordinate, BadArgumentsAreRefused) {
  const UnitCircle circle;
  EXPECT_EQ(compare_coordinate(circle.e, 2, 0, 0).error().code, Error::Code::BadInput);
  EXPECT_EQ(compare_coordinate(circle.e, 0, 0, 1).error().code, Error::Code::BadInput);
}

}  // namespace
}  // namespace encase
