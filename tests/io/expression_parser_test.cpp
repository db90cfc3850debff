// SPDX-License-Identifier: MIT
#include "io/expression_parser.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "random_expressions.hpp"

namespace encase {
namespace {

template <int D = 2>
Polynomial<D> parsed(const std::string& text) {
  const auto result = parse_polynomial<D>(text);
  if (const auto* e = std::get_if<SyntaxError>(&result)) {
    ADD_FAILURE() << text << ": " << e->message;
    return {};
  }
  return std::get<Polynomial<D>>(result);
}

SyntaxError error_in(const std::string& text) {
  const auto result = parse_polynomial<2>(text);
  if (const auto* e = std::get_if<SyntaxError>(&result)) return *e;
  ADD_FAILURE() << text << " is " << std::get<Polynomial<2>>(result).to_string();
  return {};
}

const Polynomial<2> kX = Polynomial<2>::variable(0), kY = Polynomial<2>::variable(1);
Polynomial<2> constant(long p, long q = 1) { return Polynomial<2>::constant(Rational(p, q)); }

TEST(Expression, PowersBindTightestAndToTheRight) {
  EXPECT_EQ(parsed("-x^2"), -(kX * kX));
  EXPECT_EQ(parsed("2^3^2"), constant(512));
  EXPECT_EQ(parsed("2x^2"), constant(2) * kX * kX);
  EXPECT_EQ(parsed("(x+y)**2"), kX * kX + kX * kY * constant(2) + kY * kY);
  EXPECT_EQ(parsed("x^(1+1)"), kX * kX);
  EXPECT_EQ(parsed("2^-3 x"), kX * constant(1, 8));
  EXPECT_EQ(parsed("(-1)^999999999999999999999"), constant(-1));
  EXPECT_EQ(parsed("x^0"), constant(1));
  EXPECT_EQ(parsed("(x-x)^3"), Polynomial<2>());
}

TEST(Expression, ImplicitProductsGoLeftToRight) {
  EXPECT_EQ(parsed("1/2x"), kX * constant(1, 2));
  EXPECT_EQ(parsed("xy"), kX * kY);
  EXPECT_EQ(parsed("xy^2"), kX * kY * kY);
  EXPECT_EQ(parsed("3x^2y^2x"), constant(3) * kX.power(3) * kY * kY);
  EXPECT_EQ(parsed("2(x+1)(x-1)"), constant(2) * kX * kX - constant(2));
  EXPECT_EQ(parsed("1/2/2 x y"), kX * kY * constant(1, 4));
  EXPECT_EQ(parsed("(x)3"), kX * constant(3));
  EXPECT_EQ(parsed("2*-x"), kX * constant(-2));
  EXPECT_EQ(parsed("x - -y"), kX + kY);
}

TEST(Expression, DecimalsAreExact) {
  EXPECT_EQ(parsed("0.1x"), kX * constant(1, 10));
  EXPECT_EQ(parsed(".5"), constant(1, 2));
  EXPECT_EQ(parsed("2e-1 x"), kX * constant(1, 5));
  EXPECT_EQ(parsed("1e400 x"), kX * parsed("10^400"));
  EXPECT_EQ(parsed("1e2y"), kY * constant(100));
}

TEST(Expression, EquationsAreDifferences) {
  EXPECT_EQ(parsed("x^2 + y^2 = 1"), kX * kX + kY * kY - constant(1));
  EXPECT_EQ(parsed("y = x"), kY - kX);
}

TEST(Expression, TheThirdVariableNeedsThreeDimensions) {
  EXPECT_EQ(parsed<3>("xyz").degree(), 3);
  EXPECT_EQ(parsed<1>("x^2 - 1").degree(), 2);
  EXPECT_NE(error_in("x + z").message.find("unknown variable 'z'"), std::string::npos);
}

TEST(Expression, TextOfAPolynomialReadsBack) {
  std::mt19937_64 generator(2);
  for (int round = 0; round < 50; ++round) {
    std::vector<Polynomial<3>::Term> terms(8);
    for (auto& term : terms) {
      for (int& e : term.exponent) e = static_cast<int>(generator() % 3);
      term.coefficient =
          Rational(static_cast<long>(generator() % 19) - 9, static_cast<long>(generator() % 5) + 1);
      term.coefficient.canonicalize();
    }
    const auto f = Polynomial<3>::from_terms(terms);
    EXPECT_EQ(parsed<3>(f.to_string()), f) << f.to_string();
  }
}

struct BadText {
  const char* text;
  std::size_t offset;
  const char* message;
};

TEST(Expression, ErrorsSayWhatAndWhere) {
  for (const BadText& bad : std::initializer_list<BadText>{
           {"", 0, "end of the expression"},
           {"(x + y", 0, "'(' without a ')'"},
           {"(x + (y)", 0, "'(' without a ')'"},
           {"x + y)", 5, "')' without a '('"},
           {"(x y = 2)", 5, "expected ')' before '='"},
           {"x + w", 4, "unknown variable 'w'; the variables are x and y"},
           {"x2 + y", 0, "a power is written x^2"},
           {"X + y", 0, "unknown variable 'X'"},
           {"x +", 3, "end of the expression"},
           {"x * / y", 4, "before '/'"},
           {"x^(1/2)", 2, "exponent must be an integer that is not negative"},
           {"x^-2", 2, "exponent must be an integer that is not negative"},
           {"x^y", 2, "exponent must be an integer that is not negative"},
           {"1/x", 2, "divided by constants"},
           {"x/(1-1)", 2, "division by zero"},
           {"x/0", 2, "division by zero"},
           {"0^-1", 2, "division by zero"},
           {"x + NaN", 4, "'NaN' is not a number"},
           {"inf*x", 0, "'inf' is not a number"},
           {"2 3", 2, "a number follows a number"},
           {"x = y = 1", 6, "more than one '='"},
           {"sin(x) - y", 0, "function 'sin' cannot be part of a polynomial"},
           {"y - 2exp(x)", 5, "function 'exp' cannot be part of a polynomial"},
           {"min(x, 1)", 0, "function 'min' cannot be part of a polynomial"},
           {"x, y", 1, "unexpected ','"},
           {"x*pi", 2, "'pi' is irrational; a polynomial has rational"},
           {"2e", 1, "'e' is irrational"},
           {"x \xE2\x88\x92 y", 2, "unexpected character '\xE2\x88\x92'"},
           {"x ; y", 2, "unexpected character ';'"},
           {"x^500", 2, "the degree is 500; polynomials are limited to degree 60"},
           {"(x+y)^50*(x-y)^11", 8, "the degree is 61; polynomials are limited to degree 60"},
           {"x^99999999999999999999", 2, "limited to degree 60"},
           {"2^9999999", 2, "more than a million bits"},
           {"2^99999999999999999999", 2, "more than a million bits"},
           {"1e99999999", 0, "exponent of '1e99999999' is too large"},
       }) {
    const SyntaxError error = error_in(bad.text);
    EXPECT_NE(error.message.find(bad.message), std::string::npos)
        << bad.text << ": " << error.message;
    EXPECT_EQ(error.offset, bad.offset) << bad.text << ": " << error.message;
  }
  EXPECT_NE(error_in(std::string("x\0y", 3)).message.find("'\\x00'"), std::string::npos);
}

TEST(Expression, FunctionsOfConstantsThatAreRationalArePartsOfPolynomials) {
  EXPECT_EQ(parsed("abs(-2)x + min(3, 1/2)y - max(x-x, -1)"),
            constant(2) * kX + constant(1, 2) * kY);
}

Expression expression(const std::string& text) {
  const auto result = parse_expression<2>(text);
  if (const auto* e = std::get_if<SyntaxError>(&result)) {
    ADD_FAILURE() << text << ": " << e->message;
    return {};
  }
  return std::get<Expression>(result);
}

Expression call(Operation operation, const Expression& operand) {
  return Expression::apply(operation, operand);
}

const Expression kU = Expression::variable(0), kV = Expression::variable(1);
Expression number(long p, long q = 1) { return Expression(Rational(p, q)); }

TEST(Expression, IsReadAsItIsWritten) {
  EXPECT_EQ(expression("y - 2sin(3x)"), kV - number(2) * call(Operation::Sin, number(3) * kU));
  EXPECT_EQ(expression("cos(x y)^2 = e^x"),
            call(Operation::Cos, kU * kV).power(2) - call(Operation::Exp, kU));
  EXPECT_EQ(expression("-x^2 + 1/2/x"), -kU.power(2) + number(1, 2) / kU);
  EXPECT_EQ(expression("x^-2 y"), kU.power(-2) * kV);
  EXPECT_EQ(expression("2pi x"), number(2) * Expression::pi() * kU);
  EXPECT_EQ(expression("2e"), number(2) * Expression::euler());
  EXPECT_EQ(
      expression("min(x, max(y, 2))"),
      Expression::apply(Operation::Min, kU, Expression::apply(Operation::Max, kV, number(2))));
  EXPECT_EQ(expression("ln(x) + arcsin(x) + arccos(x) + arctan(x)"),
            call(Operation::Log, kU) + call(Operation::Asin, kU) + call(Operation::Acos, kU) +
                call(Operation::Atan, kU));
}

TEST(Expression, PowersAreIntegerPowersRootsOrExponentials) {
  EXPECT_EQ(expression("pow(x, 3)"), kU.power(3));
  EXPECT_EQ(expression("x^(1/2)"), call(Operation::Sqrt, kU));
  EXPECT_EQ(expression("x^-1.5"), call(Operation::Sqrt, kU).power(-3));
  EXPECT_EQ(expression("x^(1/3)"), call(Operation::Exp, number(1, 3) * call(Operation::Log, kU)));
  EXPECT_EQ(expression("pow(2, y)"), call(Operation::Exp, kV * call(Operation::Log, number(2))));
  EXPECT_EQ(expression("e^(1/2)"), call(Operation::Exp, number(1, 2)));
  EXPECT_EQ(expression("e^2"), Expression::euler().power(2));
  EXPECT_EQ(expression("x^(2^3)"), kU.power(8));
  EXPECT_EQ(expression("(-1/2)^-3"), number(-8));
}

TEST(Expression, TextOfAnExpressionReadsBackToTheSame) {
  std::mt19937_64 generator(7);
  int compared = 0;
  for (int round = 0; round < 5000; ++round) {
    const Expression f =
        random_expressions::tree(1 + static_cast<int>(generator() % 25), 3, generator);
    const std::string text = f.to_string();
    const auto read = parse_expression<3>(text);
    if (const auto* e = std::get_if<SyntaxError>(&read)) {
      // A quotient by the constant zero is folded by nobody, and refused by the parser.
      ASSERT_EQ(e->message, "division by zero") << text;
      continue;
    }
    ++compared;
    ASSERT_EQ(std::get<Expression>(read), f) << text;
    ASSERT_EQ(std::get<Expression>(read).to_string(), text);
  }
  EXPECT_GT(compared, 4500);
}

TEST(Expression, WhatIsAPolynomialIsReadAsOne) {
  const auto function = [](const std::string& text) {
    return std::get<Function<2>>(parse_function<2>(text));
  };
  EXPECT_EQ(function("x^2 = y/2"), Function<2>(kX * kX - kY * constant(1, 2)));
  EXPECT_EQ(function("y = sin(x)"), Function<2>(kV - call(Operation::Sin, kU)));
  EXPECT_EQ(function("y = x/y"), Function<2>(kV - kU / kV));
  // No limit of degree where something else is no polynomial.
  EXPECT_EQ(function("(x + y)^70 sin(x)"),
            Function<2>((kU + kV).power(70) * call(Operation::Sin, kU)));
}

TEST(Expression, ErrorsInFunctionsSayWhatAndWhere) {
  for (const BadText& bad : std::initializer_list<BadText>{
           {"sinx - y", 0, "unknown variable 'sinx'"},
           {"sin x", 4, "expected '(' after the function 'sin' before 'x'"},
           {"y - Sin(x)", 4, "functions are written in small letters"},
           {"y - cbrt(x)", 4, "function 'cbrt' is not supported; there are sin cos"},
           {"sin(x", 3, "'(' without a ')'"},
           {"sin()", 4, "expected a number, a variable or '(' before ')'"},
           {"sin(x, y)", 5, "expected ')' before ','"},
           {"min(x)", 5, "expected ',' before ')'"},
           {"min(x, y, 1)", 8, "expected ')' before ','"},
           {"min(x", 5, "expected ',' before end"},
           {"sin(x)/(2-2)", 7, "division by zero"},
           {"sin(x)0^-1", 8, "division by zero"},
           {"sin(x)^1000001", 7, "the exponent is 1000001, larger than a million"},
           {"sin(x) + 3^1000000", 11, "more than a million bits"},
           {"(x+y)^61", 6, "the degree is 61; polynomials are limited to degree 60"},
           {"sin(x) +", 8, "end of the expression"},
       }) {
    const auto result = parse_function<2>(bad.text);
    const auto* error = std::get_if<SyntaxError>(&result);
    ASSERT_TRUE(error) << bad.text;
    EXPECT_NE(error->message.find(bad.message), std::string::npos)
        << bad.text << ": " << error->message;
    EXPECT_EQ(error->offset, bad.offset) << bad.text << ": " << error->message;
  }
}

TEST(Expression, HostileFunctionsAreRefusedAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  const auto error_of = [](const std::string& text) {
    const auto result = parse_function<2>(text);
    const auto* error = std::get_if<SyntaxError>(&result);
    return error ? error->message : "none";
  };
  std::string sum = "x", tower = "x";
  for (int k = 0; k < 200000; ++k) sum += "+sin(x)", tower += "^(1/2)";
  EXPECT_NE(error_of(sum).find("more than 20000 operations"), std::string::npos);
  EXPECT_NE(error_of(tower).find("too deeply"), std::string::npos);
  std::string nested;
  for (int k = 0; k < 100000; ++k) nested += "sin(";
  EXPECT_NE(error_of(nested).find("too deeply"), std::string::npos);
  std::string long_one = "sin(x)";
  for (int k = 0; k < 9990; ++k) long_one += "+x";
  EXPECT_EQ(error_of(long_one), "none");
  const Expression read = expression(long_one);
  EXPECT_EQ(expression(read.to_string()), read);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Expression, HostileInputIsRefusedAtOnce) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(error_in(std::string(100000, '(')).message.find("too deeply"), std::string::npos);
  std::string tower = "2";
  for (int k = 0; k < 100000; ++k) tower += "^1";
  EXPECT_NE(error_in(tower).message.find("too deeply"), std::string::npos);
  EXPECT_NE(error_in("(x+y)^999999999").message.find("degree"), std::string::npos);
  EXPECT_NE(error_in("(x+1e100000)^60").message.find("million bits"), std::string::npos);
  EXPECT_NE(error_in("9^9^9^9").message.find("million bits"), std::string::npos);
  EXPECT_EQ(parsed(std::string(100001, '-') + "x"), -kX);
  std::string sum = "x";
  for (int k = 0; k < 50000; ++k) sum += "+y^" + std::to_string(k % 61);
  EXPECT_EQ(parsed(sum).degree(), 60);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

}  // namespace
}  // namespace encase
