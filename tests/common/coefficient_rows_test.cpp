// SPDX-License-Identifier: MIT
#include "common/coefficient_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/filtered_function.hpp"
#include "common/random_polynomials.hpp"

namespace encase {
namespace {

/// A polynomial with coefficients that are multiples of 2^-53, of exactly the degree.
Polynomial<2> random_polynomial(int degree, std::mt19937_64& generator) {
  std::vector<Polynomial<2>::Term> terms;
  for (const auto& e : dense_exponents<2>(degree))
    terms.push_back({e, Rational(symmetric_random(generator))});
  return Polynomial<2>::from_terms(std::move(terms));
}

std::vector<double> dense(const Polynomial<2>& f) {
  const std::size_t n = static_cast<std::size_t>(f.degree()) + 1;
  std::vector<double> coefficients(n * n, 0.0);
  for (const auto& term : f.terms())
    coefficients[static_cast<std::size_t>(term.exponent[0]) * n + term.exponent[1]] =
        term.coefficient.get_d();
  return coefficients;
}

Polynomial<2> absolute(const Polynomial<2>& f) {
  auto terms = f.terms();
  for (auto& term : terms) term.coefficient = abs(term.coefficient);
  return Polynomial<2>::from_terms(std::move(terms));
}

/// What a sum whose terms pass through m roundings may err by, for terms that add up to `sum`.
Rational bound(int roundings, const Rational& sum) {
  return Rational(roundings * 1.01 * 0x1p-53) * sum;
}

class JetOfDegree : public testing::TestWithParam<int> {};

TEST_P(JetOfDegree, IsWithinItsRoundings) {
  const int degree = GetParam();
  std::mt19937_64 generator(static_cast<std::uint64_t>(degree));
  const Polynomial<2> f = random_polynomial(degree, generator);
  const CoefficientRows rows(dense(f), degree);
  const int m = CoefficientRows::roundings(degree);
  for (int round = 0; round < 8; ++round) {
    Point<2> point{2 * symmetric_random(generator), 2 * symmetric_random(generator)};
    if (round == 0) point = {0, 0};
    if (round == 1) point[0] = 0;
    if (round == 2) point[1] = 0;
    const RationalPoint<2> exact{Rational(point[0]), Rational(point[1])};
    const Point<2> magnitude{std::fabs(point[0]), std::fabs(point[1])};
    const RationalPoint<2> reach{Rational(magnitude[0]), Rational(magnitude[1])};
    const auto expect = [&](double value, const Polynomial<2>& g, int roundings) {
      EXPECT_LE(abs(Rational(Rational(value) - g(exact))), bound(roundings, absolute(g)(reach)));
    };
    const Jet jet = rows.jet(point);
    expect(rows.value(point), f, m);
    expect(jet.value, f, m);
    // The factors of a derivative are exact integers and bring a rounding each.
    for (int i = 0; i < 2; ++i) expect(jet.gradient[i], f.derivative(i), m + 1);
    expect(jet.xx, f.derivative(0).derivative(0), m + 2);
    expect(jet.xy, f.derivative(0).derivative(1), m + 2);
    expect(jet.yy, f.derivative(1).derivative(1), m + 2);
    const Jet slope = rows.value_and_gradient(point);
    EXPECT_EQ(slope.value, jet.value);
    EXPECT_EQ(slope.gradient, jet.gradient);
    const Rational sum = absolute(f)(reach);
    EXPECT_LE(abs(Rational(Rational(rows.absolute(magnitude)) - sum)), bound(m, sum));
  }
}
INSTANTIATE_TEST_SUITE_P(Rows, JetOfDegree, testing::Values(1, 2, 6, 7, 8, 9, 15, 16, 23, 60));

TEST(CoefficientRows, ValueWhereOnlyThePaddingOverflows) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const FilteredFunction<2> f(x * x + y * y - Polynomial<2>::constant(1));
  const Point<2> far{0x1p300, -0x1p300};  // its seventh power is infinite
  EXPECT_EQ(f.approximate(far), 0x1p601);
  EXPECT_EQ(f.gradient(far), (Point<2>{0x1p301, -0x1p301}));
  EXPECT_EQ(f.value_and_gradient(far).value, 0x1p601);
  EXPECT_LT(f.polynomial().absolute({0x1p300, 0x1p300}), 0x1.00001p601);
  EXPECT_LT(f.evaluate(far, 53).error, 0x1p560);
}

}  // namespace
}  // namespace encase
