// SPDX-License-Identifier: MIT
//
// Taylor models of expressions against values and derivatives in MPFR.
#include "common/taylor_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "common/filtered_expression.hpp"
#include "common/filtered_function.hpp"
#include "common/numerator.hpp"
#include "high_precision.hpp"

namespace encase {
namespace {

using high_precision::Number;
using Random = std::mt19937_64;

double uniform(double lo, double hi, Random& random) {
  return std::uniform_real_distribution<double>(lo, hi)(random);
}

const Expression x = Expression::variable(0), y = Expression::variable(1);

Expression constant(double value) { return Expression(Rational(value)); }

Expression of(Operation operation, const Expression& a) { return Expression::apply(operation, a); }

constexpr Operation kUnary[] = {Operation::Sqrt, Operation::Exp,   Operation::Log,  Operation::Sin,
                                Operation::Cos,  Operation::Tan,   Operation::Asin, Operation::Acos,
                                Operation::Atan, Operation::Sinh,  Operation::Cosh, Operation::Tanh,
                                Operation::Abs,  Operation::Negate};
constexpr Operation kBinary[] = {Operation::Add,    Operation::Subtract, Operation::Multiply,
                                 Operation::Divide, Operation::Min,      Operation::Max};

Expression random_expression(int depth, Random& random) {
  const unsigned long choice = random() % 8;
  if (depth == 0 || choice == 0) {
    switch (random() % 4) {
      case 0:
        return constant(uniform(-2, 2, random));
      case 1:
        return Expression(Rational(static_cast<long>(random() % 9) - 4, 3));
      case 2:
        return x;
      default:
        return y;
    }
  }
  const Expression a = random_expression(depth - 1, random);
  if (choice == 1) return a.power(static_cast<int>(random() % 7) - 2);
  if (choice <= 4) return of(kUnary[random() % std::size(kUnary)], a);
  return Expression::apply(kBinary[random() % std::size(kBinary)], a,
                           random_expression(depth - 1, random));
}

/// The value and the derivatives of the model's polynomial, exactly but for 320 bits.
high_precision::Jet polynomial_jet(const TaylorModel<2, double>& model,
                                   const std::array<Number, 2>& s) {
  high_precision::Jet r;
  std::array<std::vector<Number>, 2> power;
  for (std::size_t k = 0; k < 2; ++k) {
    power[k].push_back(Number(1.0));
    for (int i = 0; i < 16; ++i) power[k].push_back(power[k].back() * s[k]);
  }
  // n times the derivative's power, zero where there is none.
  const auto term = [&](std::size_t k, int exponent, int times) {
    Number factor(1.0);
    for (int i = 0; i < times; ++i) factor = factor * Number(exponent - i);
    return exponent < times ? Number(0.0)
                            : factor * power[k][static_cast<std::size_t>(exponent - times)];
  };
  for (int i = 0; i <= std::min(model.span[0], model.degree); ++i)
    for (int j = 0; j <= std::min(model.span[1], model.degree - i); ++j) {
      const Number c(model.c[static_cast<std::size_t>(i * model.stride + j)]);
      const auto part = [&](int a, int b) { return c * term(0, i, a) * term(1, j, b); };
      r.value = r.value + part(0, 0);
      r.d[0] = r.d[0] + part(1, 0);
      r.d[1] = r.d[1] + part(0, 1);
      r.dd[0][0] = r.dd[0][0] + part(2, 0);
      r.dd[0][1] = r.dd[0][1] + part(1, 1);
      r.dd[1][1] = r.dd[1][1] + part(0, 2);
    }
  return r;
}

/// What a model says about an expression on center + half [-1,1]^2 is true at random points.
/// Returns the largest error as a part of what is claimed.
double expect_true(const Expression& f, const TaylorModel<2, double>& model, const Point<2>& center,
                   const Point<2>& half, Random& random) {
  double most = 0;
  for (int round = 0; round < 12; ++round) {
    std::array<Number, 2> s, point;
    for (std::size_t k = 0; k < 2; ++k) {
      // Often at the border, where rests are largest.
      const double at =
          random() % 2 ? uniform(-1, 1, random) : (random() % 2 ? 1 : -1) * (1 + 0x1p-10);
      s[k] = Number(at);
      point[k] = Number(center[k]) + Number(half[k]) * s[k];
    }
    const high_precision::Jet exact = high_precision::jet(f, point),
                              held = polynomial_jet(model, s);
    const auto off = [&](const Number& a, const Number& b, const Number& scale) {
      return high_precision::abs(a * scale - b).to_double();
    };
    const Number one(1.0), h0(half[0]), h1(half[1]);
    const double value = off(exact.value, held.value, one);
    const double slope = std::max(off(exact.d[0], held.d[0], h0), off(exact.d[1], held.d[1], h1));
    const double bend = std::max({off(exact.dd[0][0], held.dd[0][0], h0 * h0),
                                  off(exact.dd[0][1], held.dd[0][1], h0 * h1),
                                  off(exact.dd[1][1], held.dd[1][1], h1 * h1)});
    EXPECT_LE(value, model.error);
    EXPECT_LE(slope, model.error * model.kSlope);
    EXPECT_LE(bend, model.error * model.kBend);
    most = std::max(most, value / model.error);
  }
  return most;
}

TEST(TaylorModel, HoldsRandomExpressions) {
  Random random(1);
  int made = 0, sharp = 0;
  for (int round = 0; round < 3000; ++round) {
    const Expression f = random_expression(1 + static_cast<int>(random() % 4), random);
    const FilteredExpression<2> filtered(f);
    const Point<2> center{uniform(-2, 2, random), uniform(-2, 2, random)};
    const double size = std::ldexp(1.0, -static_cast<int>(random() % 12));
    const Point<2> half{size * uniform(0.1, 1, random), size * uniform(0.1, 1, random)};
    const int bits = random() % 8 ? 53 : 212, degree = random() % 3 ? 15 : 5;
    Kernel kernel;
    const auto& model = filtered.model(center, half, degree, bits, kernel);
    if (!model.exists()) continue;
    ++made;
    sharp += model.error < 1e-10 * (1 + model.polynomial_norm());
    expect_true(numerator_of(f).numerator, model, center, half, random);
    ASSERT_FALSE(HasFailure()) << f.to_string() << " on " << size << " degree " << degree;
  }
  EXPECT_GT(made, 1500);
  EXPECT_GT(sharp, 1000);
}

}  // namespace
}  // namespace encase
