// SPDX-License-Identifier: MIT
#pragma once

#include <mpfr.h>

#include <type_traits>
#include <utility>

#include "encase/number.hpp"

namespace encase {

/// An MPFR number, rounded to nearest by every operation. For algorithms that are written once for
/// doubles and for MPFR and whose error is bounded a priori from the unit roundoff.
class Mpfr {
 public:
  explicit Mpfr(int bits) {
    mpfr_init2(value_, bits);
    mpfr_set_zero(value_, 1);
  }
  Mpfr(const Mpfr& other) : Mpfr(static_cast<int>(mpfr_get_prec(other.value_))) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
  }
  Mpfr(Mpfr&& other) noexcept : Mpfr(MPFR_PREC_MIN) { mpfr_swap(value_, other.value_); }
  Mpfr& operator=(const Mpfr& other) {
    if (this != &other) {
      mpfr_set_prec(value_, mpfr_get_prec(other.value_));
      mpfr_set(value_, other.value_, MPFR_RNDN);
    }
    return *this;
  }
  Mpfr& operator=(Mpfr&& other) noexcept {
    mpfr_swap(value_, other.value_);
    return *this;
  }
  ~Mpfr() { mpfr_clear(value_); }

  mpfr_ptr get() { return value_; }
  mpfr_srcptr get() const { return value_; }

 private:
  mpfr_t value_;
};

/// Zero in a kind of numbers, of a precision if it has several.
template <class Number>
Number make_number(int bits) {
  if constexpr (std::is_floating_point_v<Number>)
    return 0;
  else
    return Number(bits);
}

// What the templated algorithms ask of a number: each of these rounds at most twice.

inline void assign(double& r, double x) { r = x; }
inline void assign(long double& r, double x) { r = x; }
inline void assign(Mpfr& r, double x) { mpfr_set_d(r.get(), x, MPFR_RNDN); }
inline void assign(double& r, const Rational& x) { r = x.get_d(); }
inline void assign(long double& r, const Rational& x) {
  mpfr_t nearest;
  mpfr_init2(nearest, 64);
  mpfr_set_q(nearest, x.get_mpq_t(), MPFR_RNDN);
  r = mpfr_get_ld(nearest, MPFR_RNDN);
  mpfr_clear(nearest);
}
inline void assign(Mpfr& r, const Rational& x) { mpfr_set_q(r.get(), x.get_mpq_t(), MPFR_RNDN); }

/// r += a * b
inline void add_product(double& r, double a, double b) { r += a * b; }
inline void add_product(long double& r, long double a, long double b) { r += a * b; }
inline void add_product(Mpfr& r, const Mpfr& a, const Mpfr& b) {
  // Product and sum, each rounded: several times faster than MPFR's fused operation.
  thread_local Mpfr product(MPFR_PREC_MIN);
  if (mpfr_get_prec(product.get()) != mpfr_get_prec(r.get()))
    mpfr_set_prec(product.get(), mpfr_get_prec(r.get()));
  mpfr_mul(product.get(), a.get(), b.get(), MPFR_RNDN);
  mpfr_add(r.get(), r.get(), product.get(), MPFR_RNDN);
}
inline void multiply(double& r, double a) { r *= a; }
inline void multiply(long double& r, long double a) { r *= a; }
inline void multiply(Mpfr& r, const Mpfr& a) { mpfr_mul(r.get(), r.get(), a.get(), MPFR_RNDN); }
inline void add(double& r, double a) { r += a; }
inline void add(long double& r, long double a) { r += a; }
inline void add(Mpfr& r, const Mpfr& a) { mpfr_add(r.get(), r.get(), a.get(), MPFR_RNDN); }
inline void divide(double& r, double a) { r /= a; }
inline void divide(long double& r, long double a) { r /= a; }
inline void divide(Mpfr& r, const Mpfr& a) { mpfr_div(r.get(), r.get(), a.get(), MPFR_RNDN); }
inline void negate(double& r) { r = -r; }
inline void negate(long double& r) { r = -r; }
inline void negate(Mpfr& r) { mpfr_neg(r.get(), r.get(), MPFR_RNDN); }
inline double to_double(double x) { return x; }
inline double to_double(long double x) { return static_cast<double>(x); }
inline double to_double(const Mpfr& x) { return mpfr_get_d(x.get(), MPFR_RNDN); }

}  // namespace encase
