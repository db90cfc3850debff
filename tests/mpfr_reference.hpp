// SPDX-License-Identifier: MIT
#pragma once

#include <mpfr.h>

#include <cstdlib>
#include <optional>
#include <vector>

#include "common/mpfr_number.hpp"
#include "encase/expression.hpp"

/// Expressions at points, in plain MPFR arithmetic at high precision: what enclosures must contain.
namespace encase::mpfr_reference {

inline constexpr int kBits = 300;

/// A value and its derivative along one axis; NaN where there is none.
struct Dual {
  Mpfr value{kBits}, slope{kBits};
};

inline Mpfr number(double x) {
  Mpfr r(kBits);
  mpfr_set_d(r.get(), x, MPFR_RNDN);
  return r;
}
template <class F, class... Operands>
Mpfr apply(F f, const Operands&... operands) {
  Mpfr r(kBits);
  f(r.get(), operands.get()..., MPFR_RNDN);
  return r;
}
inline Mpfr operator+(const Mpfr& a, const Mpfr& b) { return apply(mpfr_add, a, b); }
inline Mpfr operator-(const Mpfr& a, const Mpfr& b) { return apply(mpfr_sub, a, b); }
inline Mpfr operator*(const Mpfr& a, const Mpfr& b) { return apply(mpfr_mul, a, b); }
inline Mpfr operator/(const Mpfr& a, const Mpfr& b) { return apply(mpfr_div, a, b); }

inline Mpfr not_a_number() {
  Mpfr r(kBits);
  mpfr_set_nan(r.get());
  return r;
}

/// What MPFR calls infinite has no value.
inline Mpfr finite(Mpfr a) { return mpfr_number_p(a.get()) ? a : not_a_number(); }

inline Mpfr power(const Mpfr& base, long exponent) {
  if (mpfr_nan_p(base.get())) return base;  // for MPFR its power 0 is 1
  Mpfr r(kBits);
  mpfr_pow_si(r.get(), base.get(), exponent, MPFR_RNDN);
  return r;
}

inline Dual unary(const Expression::Step& step, const Dual& u) {
  const Mpfr& a = u.value;
  const Mpfr one = number(1), two = number(2), minus = number(-1);
  Mpfr value(kBits), factor(kBits);
  switch (step.operation) {
    case Operation::Negate:
      value = minus * a, factor = minus;
      break;
    case Operation::Sqrt:
      value = apply(mpfr_sqrt, a), factor = one / (two * value);
      break;
    case Operation::Exp:
      value = apply(mpfr_exp, a), factor = value;
      break;
    case Operation::Log:
      value = apply(mpfr_log, a), factor = one / a;
      break;
    case Operation::Sin:
      value = apply(mpfr_sin, a), factor = apply(mpfr_cos, a);
      break;
    case Operation::Cos:
      value = apply(mpfr_cos, a), factor = minus * apply(mpfr_sin, a);
      break;
    case Operation::Tan:
      value = apply(mpfr_tan, a), factor = one + value * value;
      break;
    case Operation::Asin:
    case Operation::Acos: {
      const bool sine = step.operation == Operation::Asin;
      value = sine ? apply(mpfr_asin, a) : apply(mpfr_acos, a);
      factor = (sine ? one : minus) / apply(mpfr_sqrt, (one - a) * (one + a));
      break;
    }
    case Operation::Atan:
      value = apply(mpfr_atan, a), factor = one / (one + a * a);
      break;
    case Operation::Sinh:
      value = apply(mpfr_sinh, a), factor = apply(mpfr_cosh, a);
      break;
    case Operation::Cosh:
      value = apply(mpfr_cosh, a), factor = apply(mpfr_sinh, a);
      break;
    case Operation::Tanh:
      value = apply(mpfr_tanh, a), factor = power(apply(mpfr_cosh, a), -2);
      break;
    case Operation::Abs:
      value = apply(mpfr_abs, a);
      factor = mpfr_zero_p(a.get()) ? not_a_number() : value / a;
      break;
    default:
      value = power(a, step.number);
      factor = step.number == 0 ? number(0) : number(step.number) * power(a, step.number - 1L);
  }
  return {finite(value), factor * u.slope};
}

inline Dual binary(Operation operation, const Dual& a, const Dual& b) {
  switch (operation) {
    case Operation::Add:
      return {a.value + b.value, a.slope + b.slope};
    case Operation::Subtract:
      return {a.value - b.value, a.slope - b.slope};
    case Operation::Multiply:
      return {a.value * b.value, a.slope * b.value + a.value * b.slope};
    case Operation::Divide: {
      const Mpfr q = finite(a.value / b.value);
      return {q, (a.slope - q * b.slope) / b.value};
    }
    default: {
      if (mpfr_nan_p(a.value.get()) || mpfr_nan_p(b.value.get()))
        return {not_a_number(), not_a_number()};
      const int order = mpfr_cmp(a.value.get(), b.value.get());
      const bool takes_a = operation == Operation::Min ? order < 0 : order > 0;
      Dual r = takes_a ? a : b;
      if (order == 0) r.slope = not_a_number();
      return r;
    }
  }
}

/// A value and its derivative along `axis` at a point; nothing if something on the way is beyond
/// 2^5000 or below 2^-5000, where sines would take too long.
template <class Point>
std::optional<Dual> evaluate(const std::vector<Expression::Step>& steps, const Point& point,
                             int axis) {
  mpfr_clear_flags();
  std::vector<Dual> values;
  for (const Expression::Step& step : steps) {
    Dual result;
    if (step.operation == Operation::Constant) {
      mpfr_set_q(result.value.get(), step.constant.get_mpq_t(), MPFR_RNDN);
    } else if (step.operation == Operation::Pi) {
      mpfr_const_pi(result.value.get(), MPFR_RNDN);
    } else if (step.operation == Operation::Euler) {
      result.value = apply(mpfr_exp, number(1));
    } else if (step.operation == Operation::Variable) {
      result = {number(point[static_cast<std::size_t>(step.number)]),
                number(step.number == axis ? 1 : 0)};
    } else if (step.second < 0) {
      result = unary(step, values[static_cast<std::size_t>(step.first)]);
    } else {
      result = binary(step.operation, values[static_cast<std::size_t>(step.first)],
                      values[static_cast<std::size_t>(step.second)]);
    }
    if (mpfr_regular_p(result.value.get()) && std::abs(mpfr_get_exp(result.value.get())) > 5000)
      return std::nullopt;
    values.push_back(std::move(result));
  }
  if (mpfr_overflow_p() || mpfr_underflow_p()) return std::nullopt;
  return values.back();
}

}  // namespace encase::mpfr_reference
