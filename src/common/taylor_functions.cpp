// SPDX-License-Identifier: MIT
#include "common/taylor_functions.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "common/point_enclosures.hpp"
#include "common/taylor_bounds.hpp"

namespace encase {

using namespace taylor;

namespace {

/// x^k / k! e^x for k = n + 1, rounded up: the rest of the exponential series from there.
double exponential_tail(double x, int n) {
  if (!(x < 600)) return kInfinite;
  double tail = std::ldexp(1.0, static_cast<int>(x * 1.4427) + 1);  // e < 2^1.4427
  for (int k = 1; k <= n + 1; ++k) tail *= x / k * kUp;
  return tail;
}

}  // namespace

template <int D, class Number>
void TaylorFunctions<D, Number>::sqrt(Model& a, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  const double rest = rest_norm(a), least = at_most(a.c[0]) * kDown;
  if (!(rest < least)) return r->claim_nothing();
  if (!is_positive(a.c[0])) return r->claim_nothing(true);  // negative everywhere
  Number inverse = number(1);
  encase::divide(inverse, a.c[0]);
  Number next = rounded(a.c[0], [](mpfr_ptr to, mpfr_srcptr x) { mpfr_sqrt(to, x, MPFR_RNDN); });
  const double root = at_least(next);
  std::array<double, Model::kMaxDegree + 1> relative;
  for (int k = 0; k <= this->max_degree(); ++k) {
    series_[static_cast<std::size_t>(k)] = next;
    relative[static_cast<std::size_t>(k)] = 4 * k + 1;
    // The binomial coefficients of 1/2.
    encase::multiply(next, inverse);
    multiply_by(next, 1 - 2 * k);
    divide_by(next, 2 * k + 2);
  }
  const double tail = geometric_tail(rest / least * kUp, this->max_degree()) * root * kUp;
  compose(a, rest, tail, relative.data(), r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::exp(Model& a, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  const double rest = rest_norm(a);
  Number next = number(0);
  double error = 0;  // of this number, where it is not correctly rounded
  bool known = false;
  if constexpr (std::is_same_v<Number, double>) {
    known = point::can_exp(a.c[0]);
    if (known) {
      const Interval enclosure = point::exp(a.c[0]);
      next = enclosure.mid();
      error = enclosure.width() * kUp;
    }
  }
  if (!known)
    next = rounded(a.c[0], [](mpfr_ptr to, mpfr_srcptr x) { mpfr_exp(to, x, MPFR_RNDN); });
  const double value = (at_least(next) + error) * kUp + kUnderflow;
  std::array<double, Model::kMaxDegree + 1> relative;
  for (int k = 0; k <= this->max_degree(); ++k) {
    series_[static_cast<std::size_t>(k)] = next;
    relative[static_cast<std::size_t>(k)] = k + 1;
    divide_by(next, k + 1);
  }
  const double tail = exponential_tail(rest, this->max_degree()) * value * kUp;
  compose(a, rest, tail + error * exponential_tail(rest, -1) * kUp, relative.data(), r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::log(Model& a, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  const double rest = rest_norm(a), least = at_most(a.c[0]) * kDown;
  if (!(rest < least)) return r->claim_nothing();
  if (!is_positive(a.c[0])) return r->claim_nothing(true);  // negative everywhere
  Number inverse = number(1);
  encase::divide(inverse, a.c[0]);
  series_[0] = rounded(a.c[0], [](mpfr_ptr to, mpfr_srcptr x) { mpfr_log(to, x, MPFR_RNDN); });
  std::array<double, Model::kMaxDegree + 1> relative{1};
  Number power = inverse;
  for (int k = 1; k <= this->max_degree(); ++k) {
    Number& term = series_[static_cast<std::size_t>(k)];
    term = power;
    divide_by(term, k);
    relative[static_cast<std::size_t>(k)] = 2 * k + 1;
    encase::multiply(power, inverse);
    encase::negate(power);
  }
  compose(a, rest, geometric_tail(rest / least * kUp, this->max_degree()), relative.data(), r);
}

/// The sine, and the cosine, of a number (or the hyperbolic ones), each within `error` of what is
/// within half a unit in the last place of the exact one.
template <int D, class Number>
Number TaylorFunctions<D, Number>::sine_and_cosine(const Number& of, bool circular, Number* cosine,
                                                   double* error) const {
  if constexpr (std::is_same_v<Number, double>) {
    if (circular && std::fabs(of) <= point::kLargestReduced) {
      const point::Reduced reduced = point::reduce(of);
      const Interval s = point::sine(reduced, 0), c = point::sine(reduced, 1);
      *cosine = c.mid();
      *error = std::max(s.width(), c.width()) * kUp;
      return s.mid();
    }
  }
  return rounded(of, [&](mpfr_ptr to, mpfr_srcptr x) {
    thread_local Mpfr other(53);
    if (mpfr_get_prec(other.get()) != mpfr_get_prec(to)) other = Mpfr(this->bits());
    circular ? mpfr_sin_cos(to, other.get(), x, MPFR_RNDN)
             : mpfr_sinh_cosh(to, other.get(), x, MPFR_RNDN);
    if constexpr (std::is_same_v<Number, double>)
      *cosine = mpfr_get_d(other.get(), MPFR_RNDN);
    else
      *cosine = other;
  });
}

/// sin, cos, sinh, cosh: their derivatives are themselves and another one, up to signs.
template <int D, class Number>
void TaylorFunctions<D, Number>::entire(Model& a, Kind kind, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  const double rest = rest_norm(a);
  const bool circular = kind == Kind::Sin || kind == Kind::Cos;
  Number cosine = number(0);
  double error = 0;  // of the sine and of the cosine, where they are not correctly rounded
  const Number sine = sine_and_cosine(a.c[0], circular, &cosine, &error);
  Number values[2] = {sine, cosine};
  bool negative[2] = {false, false};
  if (kind == Kind::Cos || kind == Kind::Cosh) std::swap(values[0], values[1]);
  // Of the circular ones every second is the first with another sign: sin, cos, -sin, -cos; cos,
  // -sin, -cos, sin.
  if (kind == Kind::Cos) negative[1] = true;
  Number inverse_factorial = number(1);
  std::array<double, Model::kMaxDegree + 1> relative;
  for (int k = 0; k <= this->max_degree(); ++k) {
    Number& term = series_[static_cast<std::size_t>(k)];
    term = values[k % 2];
    encase::multiply(term, inverse_factorial);
    if (circular && negative[k % 2] != (k % 4 >= 2)) encase::negate(term);
    relative[static_cast<std::size_t>(k)] = k + 2;
    divide_by(inverse_factorial, k + 1);
  }
  const double most = circular ? 1 : at_least(cosine) * kUp;
  const double tail = exponential_tail(rest, this->max_degree()) * most * kUp;
  compose(a, rest, tail + error * exponential_tail(rest, -1) * kUp, relative.data(), r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::sin(Model& a, Model* r) {
  entire(a, Kind::Sin, r);
}
template <int D, class Number>
void TaylorFunctions<D, Number>::cos(Model& a, Model* r) {
  entire(a, Kind::Cos, r);
}
template <int D, class Number>
void TaylorFunctions<D, Number>::sinh(Model& a, Model* r) {
  entire(a, Kind::Sinh, r);
}
template <int D, class Number>
void TaylorFunctions<D, Number>::cosh(Model& a, Model* r) {
  entire(a, Kind::Cosh, r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::tan(Model& a, Model* r) {
  entire(a, Kind::Cos, &first_);
  invert(first_, &second_);
  entire(a, Kind::Sin, &first_);
  multiply(first_, second_, r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::tanh(Model& a, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  // (1 - w) / (1 + w), w = exp(-2 u); the other sign where u is negative, so that w <= 1.
  const bool negative = !is_positive(a.c[0]);
  constant(number(negative ? 2 : -2), 0, &first_);
  multiply(first_, a, &second_);
  exp(second_, &first_);
  constant(number(1), 0, &third_);
  add(third_, first_, false, &second_);
  add(third_, first_, true, r);
  std::swap(third_, *r);
  invert(second_, &first_);
  if (negative) {
    multiply(third_, first_, &second_);
    this->negate(second_, r);
  } else {
    multiply(third_, first_, r);
  }
}

template <int D, class Number>
void TaylorFunctions<D, Number>::atan(Model& a, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  // The derivative is the imaginary part of 1 / (u - i): z^k with z = (u + i) / (1 + u^2).
  const double rest = rest_norm(a), u = at_most(a.c[0]) * kDown;
  const double radius = std::sqrt(1 + u * u) * kDown;
  if (!(rest < radius)) return r->claim_nothing();
  series_[0] = rounded(a.c[0], [](mpfr_ptr to, mpfr_srcptr x) { mpfr_atan(to, x, MPFR_RNDN); });
  Number square = number(1);
  add_product(square, a.c[0], a.c[0]);
  Number real = a.c[0], imaginary = number(1);
  encase::divide(real, square);
  encase::divide(imaginary, square);
  const Number x = real, y = imaginary;
  std::array<double, Model::kMaxDegree + 1> relative{1};
  double rounding = 0, power = 1;
  for (int k = 1; k <= this->max_degree(); ++k) {
    Number& term = series_[static_cast<std::size_t>(k)];
    term = imaginary;
    divide_by(term, k % 2 ? k : -k);
    relative[static_cast<std::size_t>(k)] = 0;
    // Relative to |z|^k / k, not to the imaginary part.
    power *= rest / radius * kUp;
    rounding += (6 * k + 1) * power;
    Number product = real;
    encase::multiply(product, y);
    encase::multiply(real, x);
    Number other = imaginary;
    encase::multiply(other, y);
    encase::negate(other);
    encase::add(real, other);
    encase::multiply(imaginary, x);
    encase::add(imaginary, product);
  }
  const double tail =
      geometric_tail(rest / radius * kUp, this->max_degree()) + gamma(1) * 1.01 * rounding;
  compose(a, rest, tail, relative.data(), r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::asin(Model& a, Model* r) {
  // atan(u / sqrt(1 - u^2)).
  multiply(a, a, &first_);
  constant(number(1), 0, &second_);
  add(second_, first_, true, &third_);
  sqrt(third_, &first_);
  invert(first_, &second_);
  multiply(a, second_, &first_);
  atan(first_, r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::acos(Model& a, Model* r) {
  asin(a, &second_);
  pi(&first_);
  constant(number(0.5), 0, &third_);
  multiply(third_, first_, &next_);
  add(next_, second_, true, r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::pi(Model* r) const {
  const Number value =
      rounded(number(0), [](mpfr_ptr to, mpfr_srcptr) { mpfr_const_pi(to, MPFR_RNDN); });
  constant(value, gamma(4), r);
}

template <int D, class Number>
void TaylorFunctions<D, Number>::euler(Model* r) const {
  const Number value =
      rounded(number(1), [](mpfr_ptr to, mpfr_srcptr x) { mpfr_exp(to, x, MPFR_RNDN); });
  constant(value, gamma(3), r);
}

template class TaylorFunctions<1, double>;
template class TaylorFunctions<2, double>;
template class TaylorFunctions<3, double>;
template class TaylorFunctions<1, Mpfr>;
template class TaylorFunctions<2, Mpfr>;
template class TaylorFunctions<3, Mpfr>;

}  // namespace encase
