// SPDX-License-Identifier: MIT
#include "common/modular_line.hpp"

#include <flint/nmod_poly.h>
#include <gtest/gtest.h>

#include "common/random_polynomials.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

constexpr ulong kPrime = (ulong{1} << 61) - 1;

ulong residue(const Rational& value) {
  nmod_t mod;
  nmod_init(&mod, kPrime);
  return nmod_div(mpz_fdiv_ui(value.get_num_mpz_t(), kPrime),
                  mpz_fdiv_ui(value.get_den_mpz_t(), kPrime), mod);
}

/// The line's offset and slope, from the restriction of y.
std::array<Rational, 2> line() {
  const auto y = restrict_modulo_prime(polynomial<2>("y")).value();
  return {Rational(y.at(0)), Rational(y.at(1))};
}

/// The restriction at a point of the line, by rational arithmetic and FLINT.
void expect_restriction(const Polynomial<2>& f) {
  const auto restriction = restrict_modulo_prime(f).value();
  ASSERT_EQ(static_cast<int>(restriction.size()), f.degree() + 1);
  nmod_poly_t r;
  nmod_poly_init(r, kPrime);
  for (std::size_t k = 0; k < restriction.size(); ++k)
    nmod_poly_set_coeff_ui(r, static_cast<slong>(k), restriction[k]);
  const auto [offset, slope] = line();
  for (const ulong t : {0UL, 1UL, 2UL, 123456789UL})
    EXPECT_EQ(nmod_poly_evaluate_nmod(r, t),
              residue(f({Rational(t), Rational(offset + slope * t)})));
  nmod_poly_clear(r);
}

TEST(ModularLine, RestrictionIsThatOfRationalArithmetic) {
  for (const auto kind : {RandomOptions::Kind::Interpolating, RandomOptions::Kind::Dense})
    for (const int degree : {1, 2, 5, 9}) {
      RandomOptions options;
      options.kind = kind;
      options.degree = degree;
      options.bits = 150;
      for (const auto& f : random_polynomials<2>(options)) expect_restriction(f);
    }
  expect_restriction(polynomial<2>("-1/3*x^2 + 7/2^200*y^2 - 2^130*x*y + 5/2^61"));
}

TEST(ModularLine, NothingWhereThePrimeDividesADenominatorOrTheLeadingForm) {
  EXPECT_FALSE(restrict_modulo_prime(polynomial<2>("x + 1/(2^61 - 1)")));
  EXPECT_FALSE(restrict_modulo_prime(polynomial<2>("x + (2^61 - 1)*y^2")));
}

TEST(ModularLine, MultipleAndCommonFactorsAreSeen) {
  const auto at = [](const char* text) {
    return restrict_modulo_prime(polynomial<2>(text)).value();
  };
  EXPECT_TRUE(square_free(at("x")));
  EXPECT_TRUE(square_free(at("x^2 + y^2 - 1")));
  EXPECT_FALSE(square_free(at("(x^2 + y^2 - 1)^2")));
  EXPECT_FALSE(square_free(at("(x + 1/3*y)^2*(x^3 - y + 2)")));
  EXPECT_TRUE(square_free(at("(x + 1/3*y)*(x^3 - y + 2)")));
  EXPECT_TRUE(coprime(at("x"), at("y")));
  EXPECT_TRUE(coprime(at("x^2 + y^2 - 1"), at("x^5 - y")));
  EXPECT_TRUE(coprime(at("x^5 - y"), at("x^2 + y^2 - 1")));
  EXPECT_FALSE(coprime(at("(x^2 + y^2 - 1)*(x - y)"), at("(x^2 + y^2 - 1)*(x^2 + 3)")));
  EXPECT_FALSE(coprime(at("x - y"), at("(x - y)*(x^2 + 3)")));
  EXPECT_FALSE(coprime(at("x - y"), at("2*x - 2*y")));
}

TEST(ModularLine, CommonFactorsOfProductsAreSeen) {
  RandomOptions options;
  options.kind = RandomOptions::Kind::Dense;
  options.count = 3;
  for (const int degree : {1, 3, 8, 20}) {
    options.degree = degree;
    const auto list = random_polynomials<2>(options);
    const auto restriction = [](const Polynomial<2>& f) {
      return restrict_modulo_prime(f).value();
    };
    EXPECT_TRUE(coprime(restriction(list[0]), restriction(list[1])));
    EXPECT_TRUE(square_free(restriction(list[0] * list[1])));
    EXPECT_FALSE(coprime(restriction(list[0] * list[1]), restriction(list[2] * list[1])));
    EXPECT_FALSE(square_free(restriction(list[0] * list[1].power(2))));
  }
}

}  // namespace
}  // namespace encase
