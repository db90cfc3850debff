// SPDX-License-Identifier: MIT
#include "common/mpfr_interval.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace encase {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Rational exact(mpfr_srcptr x) {
  Rational q;
  mpfr_get_q(q.get_mpq_t(), x);
  return q;
}

struct Bounds {
  Rational lo, hi;
};

Bounds bounds(const MpfrInterval& x) { return {exact(x.lo()), exact(x.hi())}; }

const std::vector<double> kEnds = {-3, -1.5, -1, 0, 0.75, 1, 2.5};

template <class Check>
void for_all_pairs(Check check) {
  for (double a : kEnds)
    for (double b : kEnds)
      for (double c : kEnds)
        for (double d : kEnds)
          if (a <= b && c <= d) check(a, b, c, d);
}

TEST(MpfrInterval, ProductIsTheHullOfTheBoundsProductsForEverySign) {
  for_all_pairs([](double a, double b, double c, double d) {
    const Bounds p = bounds(MpfrInterval(60, a, b) * MpfrInterval(60, c, d));
    EXPECT_EQ(p.lo, Rational(std::min({a * c, a * d, b * c, b * d})));
    EXPECT_EQ(p.hi, Rational(std::max({a * c, a * d, b * c, b * d})));
  });
}

TEST(MpfrInterval, QuotientIsTightForEverySign) {
  for_all_pairs([](double a, double b, double c, double d) {
    const MpfrInterval quotient = MpfrInterval(60, a, b) / MpfrInterval(60, c, d);
    if (c <= 0 && d >= 0) {
      EXPECT_TRUE(mpfr_inf_p(quotient.lo()) && mpfr_sgn(quotient.lo()) < 0);
      EXPECT_TRUE(mpfr_inf_p(quotient.hi()) && mpfr_sgn(quotient.hi()) > 0);
      return;
    }
    const Rational qa(a), qb(b), qc(c), qd(d);
    const std::initializer_list<Rational> all = {Rational(qa / qc), Rational(qa / qd),
                                                 Rational(qb / qc), Rational(qb / qd)};
    const Bounds q = bounds(quotient);
    const Rational lo = std::min(all), hi = std::max(all);
    EXPECT_LE(q.lo, lo);
    EXPECT_GE(q.hi, hi);
    EXPECT_LE(lo - q.lo, Rational(0x1p-55));
    EXPECT_LE(q.hi - hi, Rational(0x1p-55));
  });
}

TEST(MpfrInterval, BoundsRoundOutwardsWhenBitsAreFew) {
  // Both operands have 10 bits, product and quotient need more: each bound alone must give way.
  const Rational a(513, 512), b(515, 512);
  for (const int s : {1, -1})
    for (const int t : {1, -1}) {
      const MpfrInterval x(10, Rational(s * a)), y(10, Rational(t * b));
      const Bounds product = bounds(x * y), quotient = bounds(x / y);
      EXPECT_LT(product.lo, s * t * a * b);
      EXPECT_GT(product.hi, s * t * a * b);
      EXPECT_LT(quotient.lo, s * t * a / b);
      EXPECT_GT(quotient.hi, s * t * a / b);
    }
  // Mixed signs take another path; the bounds of x * y are -b * b and a * b, of x * x: -a * b, b *
  // b.
  const MpfrInterval x(10, -a.get_d(), b.get_d()), y(10, -b.get_d(), a.get_d());
  EXPECT_LT(bounds(x * y).lo, -b * b);
  EXPECT_GT(bounds(x * y).hi, a * b);
  EXPECT_LT(bounds(x * x).lo, -a * b);
  EXPECT_GT(bounds(x * x).hi, b * b);
}

TEST(MpfrInterval, AnOperandMayBeItsOwnPartner) {
  MpfrInterval x(60, -2, 3);
  x *= x;
  EXPECT_EQ(bounds(x).lo, -6);
  EXPECT_EQ(bounds(x).hi, 9);
  MpfrInterval y(60, 2, 4);
  y /= y;
  EXPECT_EQ(bounds(y).lo, Rational(1, 2));
  EXPECT_EQ(bounds(y).hi, 2);
}

TEST(MpfrInterval, InfiniteBoundsNeverMakeNan) {
  const std::vector<double> ends = {-kInfinity, -1, 0, 1, kInfinity};
  for (double a : ends)
    for (double b : ends)
      for (double c : ends)
        for (double d : ends) {
          if (!(a <= b && c <= d)) continue;
          const MpfrInterval x(60, a, b), y(60, c, d);
          for (const MpfrInterval& z : {x * y, x / y}) {
            EXPECT_FALSE(mpfr_nan_p(z.lo())) << a << ' ' << b << ' ' << c << ' ' << d;
            EXPECT_FALSE(mpfr_nan_p(z.hi())) << a << ' ' << b << ' ' << c << ' ' << d;
          }
        }
  EXPECT_TRUE((MpfrInterval(60, 0.0) * MpfrInterval(60, -kInfinity, kInfinity)).is_zero());
}

}  // namespace
}  // namespace encase
