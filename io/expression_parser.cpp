// SPDX-License-Identifier: MIT
#include "expression_parser.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "formula_parser.hpp"

namespace encase {

namespace {

constexpr std::size_t kMaxBits = 1000000;
constexpr char kTooManyBits[] = "a coefficient has more than a million bits";

/// The number of bits of the largest numerator or denominator.
template <int D>
std::size_t coefficient_bits(const Polynomial<D>& f) {
  std::size_t bits = 1;
  for (const auto& term : f.terms())
    bits = std::max({bits, mpz_sizeinbase(term.coefficient.get_num_mpz_t(), 2),
                     mpz_sizeinbase(term.coefficient.get_den_mpz_t(), 2)});
  return bits;
}

/// Makes polynomials.
template <int D>
class PolynomialAlgebra : public FormulaError {
 public:
  using Value = Polynomial<D>;

  /// Terms are collected and added up together: one by one they would cost their number squared.
  class Sum {
   public:
    void add(Value next, bool negative) {
      if (negative) next = -next;
      terms_.insert(terms_.end(), next.terms().begin(), next.terms().end());
      if (terms_.size() > 2 * compact_ + 4096) {
        terms_ = Polynomial<D>::from_terms(std::move(terms_)).terms();
        compact_ = terms_.size();
      }
    }
    Value result() { return Polynomial<D>::from_terms(std::move(terms_)); }

   private:
    std::vector<typename Polynomial<D>::Term> terms_;
    std::size_t compact_ = 0;
  };

 protected:
  using Made = std::optional<Value>;

  Made within_limits(Value value, std::size_t) { return value; }
  Value of_number(const Rational& value) { return Polynomial<D>::constant(value); }
  Value of_variable(int axis) { return Polynomial<D>::variable(axis); }
  Value negated(const Value& a) { return -a; }

  Made of_irrational(Operation operation, std::size_t offset) {
    return fail(std::string("the constant '") + (operation == Operation::Pi ? "pi" : "e") +
                    "' is irrational; a polynomial has rational coefficients",
                offset, Refusal::NoPolynomial);
  }

  Made times(const Value& a, const Value& b, std::size_t offset) {
    if (a.is_zero() || b.is_zero()) return Polynomial<D>();
    if (a.degree() + b.degree() > kMaxDegree) return too_high(a.degree() + b.degree(), offset);
    if (coefficient_bits(a) + coefficient_bits(b) > kMaxBits) return too_large(offset);
    return a * b;
  }

  Made divided(const Value& a, const Value& b, std::size_t offset) {
    if (b.is_zero()) return fail("division by zero", offset);
    if (!b.is_constant())
      return fail("polynomials can only be divided by constants", offset, Refusal::NoPolynomial);
    return times(a, Polynomial<D>::constant(1 / b.terms()[0].coefficient), offset);
  }

  Made raised(const Value& base, const Value& exponent, std::size_t offset) {
    constexpr char kRule[] = "the exponent must be an integer that is not negative";
    if (!exponent.is_constant()) return fail(kRule, offset, Refusal::NoPolynomial);
    const Rational value = constant(exponent);
    if (value.get_den() != 1) return fail(kRule, offset, Refusal::NoPolynomial);
    if (value < 0 && !base.is_constant()) return fail(kRule, offset, Refusal::NoPolynomial);
    if (value < 0 && base.is_zero()) return fail("division by zero", offset);
    if (value == 0) return Polynomial<D>::constant(1);
    if (base.is_zero()) return Polynomial<D>();
    if (base.is_constant()) {
      const Rational& c = base.terms()[0].coefficient;
      if (abs(c) == 1)
        return Polynomial<D>::constant(mpz_odd_p(value.get_num_mpz_t()) ? c : Rational(1));
    }
    // From here on every unit of the exponent costs a degree or bits.
    const Integer e = abs(value.get_num());
    if (!e.fits_sint_p() || e > kMaxBits) {
      if (base.is_constant()) return too_large(offset);
      return fail("the exponent is " + value.get_str() + "; polynomials are limited to degree " +
                      std::to_string(kMaxDegree),
                  offset, Refusal::Limit);
    }
    const int n = static_cast<int>(e.get_si());
    if (static_cast<long long>(n) * base.degree() > kMaxDegree)
      return too_high(static_cast<long long>(n) * base.degree(), offset);
    if (static_cast<std::size_t>(n) * coefficient_bits(base) > kMaxBits) return too_large(offset);
    auto result = base.power(n);
    if (value < 0) return Polynomial<D>::constant(1 / result.terms()[0].coefficient);
    return result;
  }

  Made called(Operation operation, const Value& a, std::size_t offset) {
    if (operation != Operation::Abs || !a.is_constant()) return no_polynomial(operation, offset);
    return Polynomial<D>::constant(abs(constant(a)));
  }
  Made called(Operation operation, const Value& a, const Value& b, std::size_t offset) {
    if (!a.is_constant() || !b.is_constant()) return no_polynomial(operation, offset);
    const Rational first = constant(a), second = constant(b);
    return Polynomial<D>::constant(operation == Operation::Min ? std::min(first, second)
                                                               : std::max(first, second));
  }

 private:
  static Rational constant(const Value& a) {
    return a.is_zero() ? Rational(0) : a.terms()[0].coefficient;
  }
  std::nullopt_t no_polynomial(Operation operation, std::size_t offset) {
    return fail(std::string("the function '") + function_name(operation) +
                    "' cannot be part of a polynomial",
                offset, Refusal::NoPolynomial);
  }
  std::nullopt_t too_high(long long degree, std::size_t offset) {
    return fail("the degree is " + std::to_string(degree) + "; polynomials are limited to degree " +
                    std::to_string(kMaxDegree),
                offset, Refusal::Limit);
  }
  std::nullopt_t too_large(std::size_t offset) {
    return fail(kTooManyBits, offset, Refusal::Limit);
  }
};

std::size_t bits_of(const Rational& value) {
  return std::max(mpz_sizeinbase(value.get_num_mpz_t(), 2),
                  mpz_sizeinbase(value.get_den_mpz_t(), 2));
}

/// Makes expressions as they are written.
class ExpressionAlgebra : public FormulaError {
 public:
  using Value = Expression;

  class Sum {
   public:
    void add(Value next, bool negative) {
      if (!sum_)
        sum_ = std::move(next);
      else
        sum_ = negative ? *sum_ - next : *sum_ + next;
    }
    Value result() { return std::move(*sum_); }

   private:
    std::optional<Value> sum_;
  };

  /// Whether something has been read that no polynomial has.
  bool is_beyond_polynomials() const { return beyond_; }

 protected:
  using Made = std::optional<Value>;

  Made within_limits(Value value, std::size_t offset) {
    if (value.size() > kMaxOperations)
      return fail("the expression has more than " + std::to_string(kMaxOperations) + " operations",
                  offset);
    if (value.constant() && bits_of(*value.constant()) > kMaxBits)
      return fail(kTooManyBits, offset);
    return value;
  }
  Value of_number(const Rational& value) { return Expression(value); }
  Value of_variable(int axis) { return Expression::variable(axis); }
  Value of_irrational(Operation operation, std::size_t) {
    beyond_ = true;
    return operation == Operation::Pi ? Expression::pi() : Expression::euler();
  }
  Value negated(const Value& a) { return -a; }
  Made times(const Value& a, const Value& b, std::size_t) { return a * b; }

  Made divided(const Value& a, const Value& b, std::size_t offset) {
    if (!b.constant()) beyond_ = true;
    if (b.constant() && *b.constant() == 0) return fail("division by zero", offset);
    return a / b;
  }

  Made raised(const Value& base, const Value& exponent, std::size_t offset) {
    const Rational* value = exponent.constant();
    if (!value || (*value < 0 && !base.constant()) || value->get_den() != 1) beyond_ = true;
    if (!value || value->get_den() > 2) return any_power(base, exponent);
    if (base == Expression::euler() && value->get_den() == 2)
      return Expression::apply(Operation::Exp, exponent);
    const Integer n = value->get_num();
    if (abs(n) > kMaxExponent)
      return fail("the exponent is " + value->get_str() + ", larger than a million", offset);
    const int power = static_cast<int>(n.get_si());
    if (value->get_den() == 2) return Expression::apply(Operation::Sqrt, base).power(power);
    if (const Rational* c = base.constant()) {
      if (power < 0 && *c == 0) return fail("division by zero", offset);
      if (abs(*c) != 1 && static_cast<std::size_t>(std::abs(power)) > kMaxBits / bits_of(*c))
        return fail(kTooManyBits, offset);
    }
    return base.power(power);
  }

  Made called(Operation operation, const Value& a, std::size_t) {
    Value result = Expression::apply(operation, a);
    if (!result.constant()) beyond_ = true;
    return result;
  }
  Made called(Operation operation, const Value& a, const Value& b, std::size_t) {
    Value result = Expression::apply(operation, a, b);
    if (!result.constant()) beyond_ = true;
    return result;
  }

 private:
  static constexpr int kMaxExponent = 1000000;

  /// exp(exponent log(base)).
  static Value any_power(const Value& base, const Value& exponent) {
    if (base == Expression::euler()) return Expression::apply(Operation::Exp, exponent);
    return Expression::apply(Operation::Exp, exponent * Expression::apply(Operation::Log, base));
  }

  bool beyond_ = false;
};

}  // namespace

template <int D>
std::variant<Polynomial<D>, SyntaxError> parse_polynomial(std::string_view text) {
  FormulaParser<D, PolynomialAlgebra<D>> parser(text);
  auto polynomial = parser.parse();
  if (!polynomial) return parser.error();
  return std::move(*polynomial);
}

template <int D>
std::variant<Expression, SyntaxError> parse_expression(std::string_view text) {
  FormulaParser<D, ExpressionAlgebra> parser(text);
  auto expression = parser.parse();
  if (!expression) return parser.error();
  return std::move(*expression);
}

template <int D>
std::variant<Function<D>, SyntaxError> parse_function(std::string_view text) {
  FormulaParser<D, PolynomialAlgebra<D>> polynomials(text);
  if (auto polynomial = polynomials.parse()) return Function<D>(std::move(*polynomial));
  if (polynomials.refusal() == Refusal::Syntax) return polynomials.error();
  // From the beginning again: only now it is worth while to keep the expression. A polynomial
  // beyond a limit may be part of what is none; else the limit stands.
  FormulaParser<D, ExpressionAlgebra> expressions(text);
  auto expression = expressions.parse();
  if (!expressions.is_beyond_polynomials()) return polynomials.error();
  if (!expression) return expressions.error();
  return Function<D>(std::move(*expression));
}

template std::variant<Polynomial<1>, SyntaxError> parse_polynomial<1>(std::string_view);
template std::variant<Polynomial<2>, SyntaxError> parse_polynomial<2>(std::string_view);
template std::variant<Polynomial<3>, SyntaxError> parse_polynomial<3>(std::string_view);
template std::variant<Expression, SyntaxError> parse_expression<1>(std::string_view);
template std::variant<Expression, SyntaxError> parse_expression<2>(std::string_view);
template std::variant<Expression, SyntaxError> parse_expression<3>(std::string_view);
template std::variant<Function<1>, SyntaxError> parse_function<1>(std::string_view);
template std::variant<Function<2>, SyntaxError> parse_function<2>(std::string_view);
template std::variant<Function<3>, SyntaxError> parse_function<3>(std::string_view);

}  // namespace encase
