// SPDX-License-Identifier: MIT
#include "encase/polynomial.hpp"

#include <gtest/gtest.h>

#include <random>

namespace encase {
namespace {

template <int D>
Polynomial<D> random_polynomial(std::mt19937_64& generator, int terms, int degree) {
  std::vector<typename Polynomial<D>::Term> list(static_cast<std::size_t>(terms));
  for (auto& term : list) {
    for (int& e : term.exponent) e = static_cast<int>(generator() % (degree + 1));
    term.coefficient = Rational(static_cast<long>(generator() % 201) - 100,
                                static_cast<long>(generator() % 12) + 1);
    term.coefficient.canonicalize();
  }
  return Polynomial<D>::from_terms(list);
}

template <int D>
RationalPoint<D> random_point(std::mt19937_64& generator) {
  RationalPoint<D> p;
  for (Rational& c : p) {
    c = Rational(static_cast<long>(generator() % 41) - 20, static_cast<long>(generator() % 9) + 1);
    c.canonicalize();
  }
  return p;
}

/// The value term by term.
template <int D>
Rational slow_value(const Polynomial<D>& f, const RationalPoint<D>& p) {
  Rational sum = 0;
  for (const auto& term : f.terms()) {
    Rational product = term.coefficient;
    for (int i = 0; i < D; ++i)
      for (int e = 0; e < term.exponent[i]; ++e) product *= p[i];
    sum += product;
  }
  return sum;
}

template <int D>
void check_ring_laws() {
  std::mt19937_64 generator(7);
  for (int round = 0; round < 30; ++round) {
    const auto f = random_polynomial<D>(generator, 6, 4);
    const auto g = random_polynomial<D>(generator, round % 3, 3);
    const auto h = random_polynomial<D>(generator, 4, 2);
    const auto p = random_point<D>(generator);
    EXPECT_EQ(f(p), slow_value<D>(f, p));
    EXPECT_EQ((f * h)(p), f(p) * h(p));
    EXPECT_EQ((f + g)(p), f(p) + g(p));
    EXPECT_EQ((f - g)(p), f(p) - g(p));
    EXPECT_EQ(f * (g + h), f * g + f * h);
    EXPECT_EQ(h.power(3), h * h * h);
    const auto monomial = random_polynomial<D>(generator, 1, 4);
    EXPECT_EQ(monomial.power(3), monomial * monomial * monomial);
    EXPECT_TRUE((f + -f).is_zero());
    for (int axis = 0; axis < D; ++axis)
      EXPECT_EQ((f * h).derivative(axis), f.derivative(axis) * h + f * h.derivative(axis));
  }
}

TEST(Polynomial, RingLawsHoldInOneVariable) { check_ring_laws<1>(); }
TEST(Polynomial, RingLawsHoldInTwoVariables) { check_ring_laws<2>(); }
TEST(Polynomial, RingLawsHoldInThreeVariables) { check_ring_laws<3>(); }

TEST(Polynomial, EqualTermsAddUpAndVanish) {
  const auto f = Polynomial<2>::from_terms({{{1, 0}, 2}, {{0, 1}, 1}, {{1, 0}, -2}, {{0, 1}, 1}});
  ASSERT_EQ(f.terms().size(), 1U);
  EXPECT_EQ(f.terms()[0].coefficient, 2);
  EXPECT_TRUE(Polynomial<2>::from_terms({{{3, 3}, 0}}).is_zero());
  EXPECT_EQ(Polynomial<2>().degree(), -1);
  EXPECT_EQ(Polynomial<2>().degree(0), -1);
}

TEST(Polynomial, DegreesAreTotalAndByVariable) {
  const auto x = Polynomial<3>::variable(0), y = Polynomial<3>::variable(1);
  const auto f = x * x * y + y.power(2);
  EXPECT_EQ(f.degree(), 3);
  EXPECT_EQ(f.degree(0), 2);
  EXPECT_EQ(f.degree(1), 2);
  EXPECT_EQ(f.degree(2), 0);
  EXPECT_TRUE(Polynomial<3>::constant(5).is_constant());
}

TEST(Polynomial, PowersOfHighDegreeAreExact) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto f = (x * x + y * y).power(12);
  ASSERT_EQ(f.terms().size(), 13U);
  EXPECT_EQ(f.terms()[6].coefficient, 924);  // 12 choose 6
  const auto g = (x + y + Polynomial<2>::constant(Rational(1, 3))).power(60);
  EXPECT_EQ(g.terms().size(), 61U * 62U / 2);
  EXPECT_EQ(g({Rational(1, 3), Rational(1, 3)}), 1);
}

TEST(Polynomial, TextShowsHighestTermsFirst) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const auto c = [](long p, long q) { return Polynomial<2>::constant(Rational(p, q)); };
  EXPECT_EQ((c(-3, 2) * x * x * y - y.power(3) + x * c(5, 1) + c(7, 4)).to_string(),
            "-3/2*x^2*y + 5*x - y^3 + 7/4");
  EXPECT_EQ((-x).to_string(), "-x");
  EXPECT_EQ(Polynomial<2>().to_string(), "0");
}

TEST(Polynomial, CopiesShareTermsButStayValues) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  Polynomial<2> f = x * x + y;
  const Polynomial<2> copy = f, same = x * x + y;
  EXPECT_EQ(&copy.terms(), &f.terms());
  EXPECT_NE(&same.terms(), &f.terms());
  EXPECT_EQ(same, f);
  f = f + x;
  EXPECT_EQ(copy, same);
  EXPECT_NE(copy, f);
  EXPECT_EQ(copy - copy, Polynomial<2>());
  const Polynomial<2> moved = std::move(f);
  EXPECT_EQ(moved, x * x + y + x);
  EXPECT_EQ(f, Polynomial<2>());  // NOLINT(bugprone-use-after-move): a moved polynomial is zero
  EXPECT_EQ(f.degree(), -1);
}

}  // namespace
}  // namespace encase
