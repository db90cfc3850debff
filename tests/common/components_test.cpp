// SPDX-License-Identifier: MIT
#include "common/components.hpp"

#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_poly.h>
#include <gtest/gtest.h>

#include <random>

#include "common/flint_polynomial.hpp"

namespace encase {
namespace {

using Source = BaseElement<2>::Source;
using Sources = std::vector<Source>;

const Polynomial<2> kX = Polynomial<2>::variable(0), kY = Polynomial<2>::variable(1);

Polynomial<2> constant(const Rational& c) { return Polynomial<2>::constant(c); }
Polynomial<1> t() { return Polynomial<1>::variable(0); }
Polynomial<1> number(const Rational& c) { return Polynomial<1>::constant(c); }

template <int D>
Polynomial<D> random_dense(std::mt19937_64& generator, int degree) {
  std::vector<typename Polynomial<D>::Term> terms;
  Exponent<D> e{};
  for (;;) {
    int total = 0;
    for (int k : e) total += k;
    if (total <= degree) terms.push_back({e, Rational(static_cast<long>(generator() % 101) - 50)});
    int axis = 0;
    while (axis < D && e[static_cast<std::size_t>(axis)] == degree)
      e[static_cast<std::size_t>(axis++)] = 0;
    if (axis == D) break;
    ++e[static_cast<std::size_t>(axis)];
  }
  return Polynomial<D>::from_terms(terms);
}

/// Whether f = c g for a constant c.
template <int D>
bool proportional(const Polynomial<D>& f, const Polynomial<D>& g) {
  if (f.terms().size() != g.terms().size()) return false;
  if (f.is_zero()) return true;
  const Rational ratio = f.terms()[0].coefficient / g.terms()[0].coefficient;
  return f == g * Polynomial<D>::constant(ratio);
}

/// Every input is the product of its elements' powers.
void expect_factored(const std::vector<Polynomial<2>>& inputs,
                     const std::vector<BaseElement<2>>& base) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (inputs[i].is_constant()) continue;
    Polynomial<2> product = constant(1);
    for (const auto& element : base)
      for (const Source& source : element.sources)
        if (source.index == static_cast<int>(i))
          product = product * element.polynomial.power(source.multiplicity);
    EXPECT_TRUE(proportional(product, inputs[i])) << i << ": " << product.to_string();
  }
}

TEST(Base, OrdinaryInputsStayAsTheyAre) {
  const std::vector<Polynomial<2>> inputs = {
      kX * kX + kY * kY * constant(Rational(1, 3)) - constant(Rational(1, 10)), kX * kY, kX - kY,
      constant(3), constant(0)};
  const auto base = coprime_square_free_base(inputs);
  ASSERT_EQ(base.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(base[i].polynomial, inputs[i]);
    EXPECT_EQ(base[i].sources, (Sources{{i, 1}}));
  }
}

TEST(Base, RepeatedFactorsAreDividedOut) {
  const auto circle = kX * kX + kY * kY - constant(1), line = kX - kY * constant(2);
  const std::vector<Polynomial<2>> inputs = {circle * circle, circle * line.power(3), kX};
  const auto base = coprime_square_free_base(inputs);
  ASSERT_EQ(base.size(), 3U);
  expect_factored(inputs, base);
  EXPECT_TRUE(proportional(base[0].polynomial, circle));
  EXPECT_EQ(base[0].sources, (Sources{{0, 2}, {1, 1}}));
  EXPECT_TRUE(proportional(base[1].polynomial, line));
  EXPECT_EQ(base[1].sources, (Sources{{1, 3}}));
  EXPECT_EQ(base[2].polynomial, kX);
}

TEST(Base, ARepeatedFactorIsFoundInAnInputAlone) {
  const auto circle = kX * kX + kY * kY - constant(1), line = kX - kY;
  const auto square = coprime_square_free_base({circle * circle});
  ASSERT_EQ(square.size(), 1U);
  EXPECT_TRUE(proportional(square[0].polynomial, circle));
  EXPECT_EQ(square[0].sources, (Sources{{0, 2}}));
  EXPECT_EQ(coprime_square_free_base({circle * line.power(2)}).size(), 2U);
}

TEST(Base, FactorsOfTheSameSourcesStayTogether) {
  const auto a = kX + constant(1), b = kY * kY - kX, c = kX + kY;
  const std::vector<Polynomial<2>> inputs = {a * b, a * b * c};
  const auto base = coprime_square_free_base(inputs);
  ASSERT_EQ(base.size(), 2U);
  EXPECT_EQ(base[0].polynomial, a * b);
  EXPECT_EQ(base[0].sources, (Sources{{0, 1}, {1, 1}}));
  EXPECT_TRUE(proportional(base[1].polynomial, c));
  EXPECT_EQ(base[1].sources, (Sources{{1, 1}}));
}

TEST(Base, ALaterInputMayDivideAnEarlierOne) {
  const auto a = kX + constant(Rational(1, 3)), b = kY * kY - kX;
  const std::vector<Polynomial<2>> inputs = {a * b, a};
  const auto base = coprime_square_free_base(inputs);
  ASSERT_EQ(base.size(), 2U);
  expect_factored(inputs, base);
  for (const auto& element : base)
    if (element.sources.size() == 2) {
      EXPECT_EQ(element.polynomial, a);
    }
}

TEST(Base, TheSameCurveTwiceIsOneElement) {
  const auto f = kX.power(3) - kY * constant(Rational(2, 7));
  const auto base = coprime_square_free_base({f, f * constant(Rational(-5, 3))});
  ASSERT_EQ(base.size(), 1U);
  EXPECT_EQ(base[0].polynomial, f);
  EXPECT_EQ(base[0].sources, (Sources{{0, 1}, {1, 1}}));
}

TEST(Base, ManyInputsAreLookedAtTogether) {
  std::mt19937_64 generator(3);
  std::vector<Polynomial<2>> inputs;
  for (int k = 0; k < 60; ++k)
    inputs.push_back(random_dense<2>(generator, 1 + k % 3) + constant(Rational(k, 7)));
  const auto base = coprime_square_free_base(inputs);
  ASSERT_EQ(base.size(), inputs.size());
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    EXPECT_EQ(base[k].polynomial, inputs[k]);
    ASSERT_EQ(base[k].sources.size(), 1u);
    EXPECT_EQ(base[k].sources[0].index, static_cast<int>(k));
    EXPECT_EQ(base[k].sources[0].multiplicity, 1);
  }
  // One shared, one repeated, one constant: each is found among the others.
  for (const auto& more : {inputs[7] * (kX - kY), (kX + kY).power(2), constant(5)}) {
    auto changed = inputs;
    changed.push_back(more);
    const auto found = coprime_square_free_base(changed);
    expect_factored(changed, found);
    EXPECT_EQ(found.size(), inputs.size() + (more.is_constant() ? 0 : 1));
  }
}

TEST(Base, APrimeThatDropsDegreesProvesNothing) {
  // Modulo p = 2^61 - 1 the shared factor is constant.
  const Rational p((ulong{1} << 61) - 1);
  const auto shared = kX * constant(p) + constant(1);
  const std::vector<Polynomial<2>> inputs = {shared * (kY + constant(2)),
                                             shared * (kY + constant(3))};
  const auto base = coprime_square_free_base(inputs);
  EXPECT_EQ(base.size(), 3U);
  expect_factored(inputs, base);
  // Nor where the repeated factor is.
  const auto square = coprime_square_free_base({shared * shared * kY});
  ASSERT_EQ(square.size(), 2U);
  // Nor where it divides a denominator, or a whole input.
  const std::vector<Polynomial<2>> scaled = {kX * constant(1 / p) + kY,
                                             kX * constant(p) - kY * constant(p)};
  const auto unchanged = coprime_square_free_base(scaled);
  ASSERT_EQ(unchanged.size(), 2U);
  EXPECT_EQ(unchanged[0].polynomial, scaled[0]);
  EXPECT_EQ(unchanged[1].polynomial, scaled[1]);
}

TEST(Base, RandomProductsAreFactoredBack) {
  std::mt19937_64 generator(5);
  for (int round = 0; round < 5; ++round) {
    std::vector<Polynomial<2>> factors;
    for (int k = 0; k < 4; ++k) factors.push_back(random_dense<2>(generator, 2 + k % 2));
    std::vector<Polynomial<2>> inputs;
    std::vector<std::vector<int>> exponents;
    for (int i = 0; i < 3; ++i) {
      Polynomial<2> product = constant(Rational(1 + i, 7));
      auto& vector = exponents.emplace_back();
      for (const auto& factor : factors) {
        vector.push_back(static_cast<int>(generator() % 3));
        product = product * factor.power(vector.back());
      }
      inputs.push_back(product);
    }
    const auto base = coprime_square_free_base(inputs);
    expect_factored(inputs, base);
    // Every random factor is irreducible (almost surely), and lies in the element of its sources.
    for (std::size_t k = 0; k < factors.size(); ++k) {
      Sources expected;
      for (int i = 0; i < 3; ++i)
        if (exponents[static_cast<std::size_t>(i)][k] > 0)
          expected.push_back({i, exponents[static_cast<std::size_t>(i)][k]});
      int found = 0;
      for (const auto& element : base) found += element.sources == expected;
      EXPECT_EQ(found, expected.empty() ? 0 : 1);
    }
  }
}

TEST(Resultant, OfAGraphIsSubstitution) {
  // Eliminating y from y - x^2 and x^2 + y^2 - 1: x^2 + x^4 - 1.
  const auto circle = kX * kX + kY * kY - constant(1);
  EXPECT_TRUE(
      proportional(resultant(kY - kX * kX, circle, 1), t().power(4) + t().power(2) - number(1)));
  // Eliminating x instead: y + y^2 - 1, twice.
  const auto by_y = t().power(2) + t() - number(1);
  EXPECT_TRUE(proportional(resultant(kY - kX * kX, circle, 0), by_y * by_y));
}

TEST(Resultant, AgreesWithSubresultantsOverTheRationals) {
  std::mt19937_64 generator(11);
  const FlintContext<2> context;
  for (int round = 0; round < 20; ++round) {
    auto f = random_dense<2>(generator, 1 + round % 4), g = random_dense<2>(generator, 3);
    // Leading coefficients that are not constant, and vanish where the resultant is evaluated.
    if (round % 3 == 0) f = f + (kX - constant(2)) * kY.power(5) + (kY - constant(1)) * kX.power(5);
    if (round % 3 == 1) g = g + kX * kY.power(4) + kY * kX.power(4);
    f = f * constant(Rational(1, 6));
    for (int axis = 0; axis < 2; ++axis) {
      FlintPolynomial<2> a(context), b(context), r(context);
      const Integer denominator = a.set(f);
      b.set(g);
      ASSERT_TRUE(fmpz_mpoly_resultant(r, a, b, axis, context));
      Integer scale;
      mpz_pow_ui(scale.get_mpz_t(), denominator.get_mpz_t(),
                 static_cast<unsigned long>(g.degree(axis)));
      std::vector<Polynomial<1>::Term> terms;
      const Polynomial<2> expected = r.get(scale);
      for (const auto& term : expected.terms())
        terms.push_back({{term.exponent[static_cast<std::size_t>(1 - axis)]}, term.coefficient});
      EXPECT_EQ(resultant(f, g, axis), Polynomial<1>::from_terms(terms));
    }
  }
}

TEST(Resultant, VanishesExactlyForSharedComponents) {
  const auto line = kX + kY * constant(3) - constant(1);
  EXPECT_TRUE(resultant(line * (kX - kY), line * kY, 1).is_zero());
  EXPECT_TRUE(resultant(line * (kX - kY), line * kY, 0).is_zero());
  EXPECT_FALSE(resultant(line * (kX - kY), kY - constant(1), 0).is_zero());
  // The shared component x = 1 does not contain y: no information, and no zero.
  EXPECT_FALSE(resultant((kX - constant(1)), (kX - constant(1)) * (kY - kX), 1).is_zero());
}

TEST(Gcd, IsPrimitiveWithPositiveLeadingCoefficient) {
  const auto f = (t() - number(1)) * (t() * number(2) + number(1));
  const auto g = (number(1) - t()) * (t() + number(5)) * number(Rational(4, 3));
  EXPECT_EQ(gcd(f, g), t() - number(1));
  EXPECT_EQ(gcd(f, {}), t() * t() * number(2) - t() - number(1));
  EXPECT_TRUE(gcd({}, {}).is_zero());
  EXPECT_EQ(gcd(f, t()), number(1));
}

TEST(SquareFreePart, KeepsEachFactorOnce) {
  const auto a = t() * t() + number(1), b = t() - number(Rational(1, 2));
  EXPECT_EQ(square_free_part(-(a * a * b.power(5))), a * (t() * number(2) - number(1)));
  EXPECT_EQ(square_free_part(number(Rational(-7, 3))), number(1));
}

TEST(RealRoots, EndsOfTheIntervalCount) {
  const auto f = (t() - number(1)) * (t() - number(2)).power(3) * (t() * t() + number(1)) * t();
  EXPECT_EQ(count_real_roots(f, 0, 2), 3);
  EXPECT_EQ(count_real_roots(f, Rational(1, 1000), 2), 2);
  EXPECT_EQ(count_real_roots(f, 1, 1), 1);
  EXPECT_EQ(count_real_roots(f, Rational(3, 2), Rational(3, 2)), 0);
  EXPECT_EQ(count_real_roots(f, Rational(4, 3), Rational(5, 3)), 0);
  EXPECT_EQ(count_real_roots(f, -5, Rational(3, 2)), 2);
  EXPECT_EQ(count_real_roots(f, 2, 0), 0);
  EXPECT_EQ(count_real_roots(number(4), 0, 2), 0);
}

TEST(RealRoots, BisectionPointsMayBeRoots) {
  Polynomial<1> f = number(1);
  for (int k = 0; k <= 16; ++k) f = f * (t() - number(Rational(k, 16)));
  EXPECT_EQ(count_real_roots(f, 0, 1), 17);
  EXPECT_EQ(count_real_roots(f, Rational(1, 4), Rational(3, 4)), 9);
}

TEST(RealRoots, CloseRootsAreToldApart) {
  // Mignotte: two roots near 1/1000 at a distance of about 1000^(-12).
  const auto f = t().power(20) - (t() * number(1000) - number(1)).power(2) * number(2);
  EXPECT_EQ(count_real_roots(f, Rational(1, 1001), Rational(1, 999)), 2);
  EXPECT_EQ(count_real_roots(f, Rational(1, 1000), Rational(1, 999)), 1);
}

TEST(RealRoots, CountsAgreeWithSturm) {
  std::mt19937_64 generator(3);
  for (int round = 0; round < 40; ++round) {
    const auto f = random_dense<1>(generator, 1 + round % 15) *
                   (round % 2 ? random_dense<1>(generator, 2).power(2) : number(1));
    if (f.is_constant()) continue;
    const auto g = square_free_part(f);
    fmpz_poly_t sturm;
    fmpz_poly_init(sturm);
    for (const auto& term : g.terms())
      fmpz_poly_set_coeff_mpz(sturm, term.exponent[0], term.coefficient.get_num_mpz_t());
    EXPECT_EQ(count_real_roots(f, -1000, Rational(3001, 3)), fmpz_poly_num_real_roots_sturm(sturm));
    fmpz_poly_clear(sturm);
  }
}

}  // namespace
}  // namespace encase
