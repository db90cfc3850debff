// SPDX-License-Identifier: MIT
#include "common/perturb.hpp"

#include <gtest/gtest.h>

namespace encase {
namespace {

TEST(Perturb, MovesEveryCoefficientWithinItsBound) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto cusp = y * y - x.power(3) * Polynomial<2>::constant(1000);
  constexpr double kDelta = 1e-8;
  std::mt19937_64 generator(1);
  const auto f = perturb(cusp, kDelta, generator);
  EXPECT_EQ(f.degree(), 3);
  EXPECT_EQ(f.terms().size(), 10U);
  int large = 0;
  for (const auto& term : f.terms()) {
    Rational c = 0;
    for (const auto& old : cusp.terms())
      if (old.exponent == term.exponent) c = old.coefficient;
    const Rational bound = Rational(kDelta) * (1 + abs(c)), moved = abs(term.coefficient - c);
    EXPECT_LT(moved, bound);
    EXPECT_GT(moved, 0);
    large += moved > bound / 4;
  }
  EXPECT_GT(large, 3);
}

TEST(Perturb, EqualSeedsGiveEqualPolynomials) {
  const auto z = Polynomial<3>::variable(2);
  std::mt19937_64 first(5), second(5);
  const auto f = perturb(z, 1e-3, first);
  EXPECT_EQ(f, perturb(z, 1e-3, second));
  EXPECT_NE(f, perturb(z, 1e-3, second));
  EXPECT_TRUE(perturb(Polynomial<3>(), 1e-3, first).is_zero());
}

}  // namespace
}  // namespace encase
