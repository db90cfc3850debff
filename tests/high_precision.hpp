// SPDX-License-Identifier: MIT
//
// Values and derivatives of expressions in MPFR, by rules of their own: what tests compare with.
#pragma once

#include <mpfr.h>

#include <array>
#include <vector>

#include "encase/expression.hpp"

namespace encase::high_precision {

inline constexpr int kBits = 320;

/// An MPFR number that is used like a double.
class Number {
 public:
  Number() : Number(0.0) {}
  Number(double value) {
    mpfr_init2(x_, kBits);
    mpfr_set_d(x_, value, MPFR_RNDN);
  }
  explicit Number(const Rational& value) : Number() {
    mpfr_set_q(x_, value.get_mpq_t(), MPFR_RNDN);
  }
  Number(const Number& other) : Number() { mpfr_set(x_, other.x_, MPFR_RNDN); }
  Number& operator=(const Number& other) {
    mpfr_set(x_, other.x_, MPFR_RNDN);
    return *this;
  }
  ~Number() { mpfr_clear(x_); }

  mpfr_ptr get() { return x_; }
  mpfr_srcptr get() const { return x_; }
  double to_double() const { return mpfr_get_d(x_, MPFR_RNDN); }

  friend Number operator+(const Number& a, const Number& b) { return apply(mpfr_add, a, b); }
  friend Number operator-(const Number& a, const Number& b) { return apply(mpfr_sub, a, b); }
  friend Number operator*(const Number& a, const Number& b) { return apply(mpfr_mul, a, b); }
  friend Number operator/(const Number& a, const Number& b) { return apply(mpfr_div, a, b); }
  friend Number operator-(const Number& a) { return Number(0.0) - a; }
  friend bool operator<(const Number& a, const Number& b) { return mpfr_less_p(a.x_, b.x_) != 0; }

  template <class Function>
  static Number apply(Function f, const Number& a) {
    Number r;
    f(r.x_, a.x_, MPFR_RNDN);
    return r;
  }
  template <class Function>
  static Number apply(Function f, const Number& a, const Number& b) {
    Number r;
    f(r.x_, a.x_, b.x_, MPFR_RNDN);
    return r;
  }

 private:
  mpfr_t x_;
};

inline Number abs(const Number& a) { return a < Number(0.0) ? -a : a; }

/// A value with the first and second partial derivatives with respect to x and y.
struct Jet {
  Number value;
  std::array<Number, 2> d;
  std::array<std::array<Number, 2>, 2> dd;

  Jet composed(const Number& g, const Number& slope, const Number& bend) const {
    Jet r;
    r.value = g;
    for (int i = 0; i < 2; ++i) {
      r.d[i] = slope * d[i];
      for (int k = 0; k < 2; ++k) r.dd[i][k] = slope * dd[i][k] + bend * d[i] * d[k];
    }
    return r;
  }
};

inline Jet plus(const Jet& a, const Jet& b, const Number& factor) {
  Jet r;
  r.value = a.value + factor * b.value;
  for (int i = 0; i < 2; ++i) {
    r.d[i] = a.d[i] + factor * b.d[i];
    for (int k = 0; k < 2; ++k) r.dd[i][k] = a.dd[i][k] + factor * b.dd[i][k];
  }
  return r;
}

inline Jet times(const Jet& a, const Jet& b) {
  Jet r;
  r.value = a.value * b.value;
  for (int i = 0; i < 2; ++i) {
    r.d[i] = a.value * b.d[i] + b.value * a.d[i];
    for (int k = 0; k < 2; ++k)
      r.dd[i][k] = a.value * b.dd[i][k] + b.value * a.dd[i][k] + a.d[i] * b.d[k] + a.d[k] * b.d[i];
  }
  return r;
}

inline Jet inverse(const Jet& a) {
  const Number w = Number(1.0) / a.value;
  return a.composed(w, -w * w, Number(2.0) * w * w * w);
}

inline Jet elementary(Operation operation, const Jet& a) {
  const Number &u = a.value, one = 1.0, two = 2.0;
  const auto of = [&](auto f) { return Number::apply(f, u); };
  switch (operation) {
    case Operation::Sqrt: {
      const Number g = of(mpfr_sqrt);
      return a.composed(g, one / (two * g), -one / (Number(4.0) * g * u));
    }
    case Operation::Exp:
      return a.composed(of(mpfr_exp), of(mpfr_exp), of(mpfr_exp));
    case Operation::Log:
      return a.composed(of(mpfr_log), one / u, -one / (u * u));
    case Operation::Sin:
      return a.composed(of(mpfr_sin), of(mpfr_cos), -of(mpfr_sin));
    case Operation::Cos:
      return a.composed(of(mpfr_cos), -of(mpfr_sin), -of(mpfr_cos));
    case Operation::Tan: {
      const Number g = of(mpfr_tan), slope = one + g * g;
      return a.composed(g, slope, two * g * slope);
    }
    case Operation::Asin:
    case Operation::Acos: {
      const Number square = one - u * u, slope = one / Number::apply(mpfr_sqrt, square),
                   bend = u * slope / square;
      return operation == Operation::Asin ? a.composed(of(mpfr_asin), slope, bend)
                                          : a.composed(of(mpfr_acos), -slope, -bend);
    }
    case Operation::Atan: {
      const Number slope = one / (one + u * u);
      return a.composed(of(mpfr_atan), slope, -two * u * slope * slope);
    }
    case Operation::Sinh:
      return a.composed(of(mpfr_sinh), of(mpfr_cosh), of(mpfr_sinh));
    case Operation::Cosh:
      return a.composed(of(mpfr_cosh), of(mpfr_sinh), of(mpfr_cosh));
    case Operation::Tanh: {
      const Number g = of(mpfr_tanh), slope = one - g * g;
      return a.composed(g, slope, -two * g * slope);
    }
    case Operation::Abs:
      return u < Number(0.0) ? a.composed(-u, Number(-1.0), Number(0.0)) : a;
    default:
      return a.composed(-u, Number(-1.0), Number(0.0));  // Negate
  }
}

/// The value and derivatives of an expression in x and y at a point.
inline Jet jet(const Expression& expression, const std::array<Number, 2>& point) {
  std::vector<Jet> done;
  for (const Expression::Step& step : expression.steps()) {
    const auto at = [&](int k) -> const Jet& { return done[static_cast<std::size_t>(k)]; };
    Jet r;
    switch (step.operation) {
      case Operation::Constant:
        r.value = Number(step.constant);
        break;
      case Operation::Pi:
        mpfr_const_pi(r.value.get(), MPFR_RNDN);
        break;
      case Operation::Euler:
        r.value = Number::apply(mpfr_exp, Number(1.0));
        break;
      case Operation::Variable:
        r.value = point[static_cast<std::size_t>(step.number)];
        r.d[static_cast<std::size_t>(step.number)] = Number(1.0);
        break;
      case Operation::Add:
        r = plus(at(step.first), at(step.second), Number(1.0));
        break;
      case Operation::Subtract:
        r = plus(at(step.first), at(step.second), Number(-1.0));
        break;
      case Operation::Multiply:
        r = times(at(step.first), at(step.second));
        break;
      case Operation::Divide:
        r = times(at(step.first), inverse(at(step.second)));
        break;
      case Operation::Power: {
        r.value = Number(1.0);
        const int n = step.number < 0 ? -step.number : step.number;
        for (int k = 0; k < n; ++k) r = times(r, at(step.first));
        if (step.number < 0) r = inverse(r);
        break;
      }
      case Operation::Min:
        r = at(step.first).value < at(step.second).value ? at(step.first) : at(step.second);
        break;
      case Operation::Max:
        r = at(step.first).value < at(step.second).value ? at(step.second) : at(step.first);
        break;
      default:
        r = elementary(step.operation, at(step.first));
    }
    done.push_back(r);
  }
  return done.back();
}

}  // namespace encase::high_precision
