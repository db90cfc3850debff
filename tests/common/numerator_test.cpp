// SPDX-License-Identifier: MIT
#include "common/numerator.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <variant>

#include "common/expression_program.hpp"
#include "io/expression_parser.hpp"
#include "random_expressions.hpp"

namespace encase {
namespace {

Expression read(const std::string& text) { return std::get<Expression>(parse_expression<2>(text)); }

TEST(Numerator, HasNoQuotients) {
  const auto expect = [](const std::string& f, const std::string& numerator,
                         const std::set<std::string>& divisors) {
    SCOPED_TRACE(f);
    const Numerator n = numerator_of(read(f));
    EXPECT_EQ(n.numerator, read(numerator)) << n.numerator.to_string();
    std::set<std::string> texts;
    for (const Expression& divisor : n.divisors) texts.insert(divisor.to_string());
    EXPECT_EQ(texts, divisors);
  };
  expect("y - 1/x", "y*x - 1", {"x"});
  expect("y - tan(x)", "y*cos(x) - sin(x)", {"cos(x)"});
  expect("tan(x)^2 - y", "sin(x)^2 - y*cos(x)^2", {"cos(x)"});
  expect("x/y + y/x - 3", "x*x + y*y - 3*(y*x)", {"x", "y"});
  expect("sin(x)/x + cos(x)/x", "sin(x) + cos(x)", {"x"});
  expect("-(1/x)*y", "-1*y", {"x"});
  expect("x^-2 - 4", "1 - 4*x^2", {"x"});
  expect("y/(x - 1/y)", "y*y", {"y", "x*y - 1"});
  expect("x/(x*x)", "x", {"x*x"});
}

TEST(Numerator, IsTheExpressionWhereNothingIsGained) {
  for (const char* text : {"sin(x)*y - 1", "x/3 - y/pi", "exp(1/x) - y", "y - 1/(1/x)", "tan(1/x)",
                           "x + tan(1)", "min(1/x, y)"}) {
    const Expression f = read(text);
    const Numerator n = numerator_of(f);
    EXPECT_EQ(n.numerator, f) << text;
    EXPECT_TRUE(n.divisors.empty()) << text;
  }
}

/// Where no divisor is zero, the numerator has a value where f has one, and the same sign or zero
/// as f times some product of the divisors' signs.
TEST(Numerator, HasTheZerosOfTheExpressionWhereNoDivisorIsZero) {
  std::mt19937_64 generator(3);
  ExpressionProgram<2>::Workspace<MpfrInterval> workspace;
  int compared = 0, with_divisors = 0;
  for (int round = 0; round < 4000; ++round) {
    const Expression f = random_expressions::tree(3 + round % 9, 2, generator);
    const Numerator n = numerator_of(f);
    if (n.divisors.empty()) continue;
    ++with_divisors;
    // Small rational points: zeros and poles are often met.
    for (int k = 0; k < 8; ++k) {
      const auto coordinate = [&] {
        Rational q(static_cast<long>(generator() % 9) - 4, 1 + static_cast<long>(generator() % 2));
        q.canonicalize();
        return q;
      };
      const RationalPoint<2> p{coordinate(), coordinate()};
      Kernel kernel;
      const auto sign = [&](const Expression& e) {
        return ExpressionProgram<2>(e).sign_at(p, kernel);
      };
      const PointSign of_f = sign(f), of_n = sign(n.numerator);
      bool zero = false, known = of_f != PointSign::Unknown && of_n != PointSign::Unknown;
      for (const Expression& divisor : n.divisors) {
        const PointSign s = sign(divisor);
        known = known && s != PointSign::Unknown;
        zero = zero || s == PointSign::Zero || s == PointSign::NoValue;
      }
      if (!known) continue;
      ++compared;
      if (zero) {
        EXPECT_EQ(of_f, PointSign::NoValue) << f.to_string();
        continue;
      }
      EXPECT_EQ(of_f == PointSign::NoValue, of_n == PointSign::NoValue) << f.to_string();
      EXPECT_EQ(of_f == PointSign::Zero, of_n == PointSign::Zero) << f.to_string();
    }
  }
  EXPECT_GT(with_divisors, 300);
  EXPECT_GT(compared, 1000);
}

TEST(Numerator, OfTooManyQuotientsIsTheExpression) {
  Expression few(Rational(0)), many(Rational(0));
  for (int k = 1; k <= 40; ++k) {
    many = many + Expression(Rational(1)) / (Expression::variable(0) - Expression(Rational(k)));
    if (k == 10) few = many;
  }
  EXPECT_EQ(numerator_of(few).divisors.size(), 10u);
  EXPECT_LT(numerator_of(few).numerator.steps().size(), 100u);
  EXPECT_TRUE(numerator_of(many).divisors.empty());
  EXPECT_EQ(numerator_of(many).numerator, many);
}

}  // namespace
}  // namespace encase
