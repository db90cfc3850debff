// SPDX-License-Identifier: MIT
#include "common/random_polynomials.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace encase {
namespace {

RandomOptions options(int degree, std::uint64_t seed) {
  RandomOptions o;
  o.degree = degree;
  o.seed = seed;
  return o;
}

/// The number of roots found by sign changes along a fine grid's rows.
int sign_changes(const Polynomial<2>& f, double lo, double hi) {
  constexpr int kSteps = 40;
  int changes = 0;
  for (int j = 0; j <= kSteps; ++j) {
    int previous = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const int sign =
          sgn(f({Rational(lo + (hi - lo) * i / kSteps), Rational(lo + (hi - lo) * j / kSteps)}));
      changes += sign * previous < 0;
      previous = sign;
    }
  }
  return changes;
}

TEST(RandomPolynomials, EqualSeedsGiveEqualPolynomials) {
  for (const auto kind : {RandomOptions::Kind::Interpolating, RandomOptions::Kind::Dense}) {
    RandomOptions o = options(4, 9);
    o.kind = kind;
    const auto first = random_polynomials<2>(o), second = random_polynomials<2>(o);
    EXPECT_EQ(first, second);
    EXPECT_NE(first[0], first[1]);
    o.seed = 10;
    EXPECT_NE(random_polynomials<2>(o)[0], first[0]);
  }
}

TEST(RandomPolynomials, AreTheSameOnEveryMachine) {
  RandomOptions o = options(1, 1);
  o.kind = RandomOptions::Kind::Dense;
  o.bits = 8;
  EXPECT_EQ(random_polynomials<2>(o)[0].to_string(), "-13*x - 94*y - 94");
  EXPECT_EQ(random_polynomials<2>(options(1, 1))[0].to_string(),
            "4575014151683647/12500000000000000*x + 5033079209644087/5000000000000000*y + 1");
}

TEST(RandomPolynomials, InterpolatingOnesMeetTheBox) {
  for (int degree = 1; degree <= 10; ++degree)
    for (const auto& f : random_polynomials<2>(options(degree, 3))) {
      EXPECT_EQ(f.degree(), degree);
      EXPECT_EQ(f.terms().size(), static_cast<std::size_t>((degree + 1) * (degree + 2) / 2));
      EXPECT_EQ(f.terms()[0].exponent, (Exponent<2>{0, 0}));
      EXPECT_EQ(f.terms()[0].coefficient, 1);
      EXPECT_GE(sign_changes(f, -1, 1), degree);
    }
}

TEST(RandomPolynomials, InterpolatingOnesPassThroughTheirPoints) {
  // In one variable the points are the roots: as many as the degree, all of them in the box.
  RandomOptions o = options(6, 4);
  o.count = 5;
  o.lo = Rational(1, 5);
  o.hi = Rational(7, 5);
  for (const auto& f : random_polynomials<1>(o)) {
    int roots = 0, previous = 0;
    for (int i = 0; i <= 5000; ++i) {
      const int sign = sgn(f({Rational(o.lo + (o.hi - o.lo) * Rational(i, 5000))}));
      roots += sign * previous < 0;
      previous = sign;
    }
    EXPECT_EQ(roots, 6);
  }
}

TEST(RandomPolynomials, SurfacesHaveThreeVariables) {
  const auto f = random_polynomials<3>(options(3, 1));
  ASSERT_EQ(f.size(), 2U);
  EXPECT_EQ(f[0].terms().size(), 20U);
  EXPECT_EQ(f[0].degree(), 3);
}

TEST(RandomPolynomials, DenseCoefficientsHaveTheBitsAskedFor) {
  for (int bits : {1, 8, 32, 33, 100}) {
    RandomOptions o = options(10, 2);
    o.kind = RandomOptions::Kind::Dense;
    o.bits = bits;
    Integer unit = 1;
    unit <<= bits - 1;
    Rational smallest = 0, largest = 0;
    for (const auto& f : random_polynomials<2>(o))
      for (const auto& term : f.terms()) {
        EXPECT_GE(term.coefficient, -unit);
        EXPECT_LT(term.coefficient, unit);
        EXPECT_EQ(term.coefficient.get_den(), 1);
        smallest = std::min(smallest, term.coefficient);
        largest = std::max(largest, term.coefficient);
      }
    if (bits > 1) {
      EXPECT_GT(largest, unit / 2);
      EXPECT_LT(smallest, -unit / 2);
    }
  }
}

TEST(RandomCurves, AreNamedInOrder) {
  const auto curves = random_curves(options(2, 1));
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[1].name, "c1");
}

}  // namespace
}  // namespace encase
