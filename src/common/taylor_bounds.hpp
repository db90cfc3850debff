// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "common/mpfr_number.hpp"

/// Bounds and small steps that Taylor models take in either kind of numbers, doubles or MPFR.
namespace encase::taylor {

inline constexpr double kUp = 1 + 0x1p-40;      // outweighs the roundings of the sums it multiplies
inline constexpr double kDown = 1 - 0x1p-40;    // likewise
inline constexpr double kUnderflow = 0x1p-960;  // more than what underflows in one operation
inline constexpr double kLargest = 0x1p900;     // beyond it nothing is claimed
inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Not less, and not more, than |x|.
inline double at_least(double x) { return std::fabs(x); }
inline double at_least(const Mpfr& x) { return std::fabs(mpfr_get_d(x.get(), MPFR_RNDA)); }
inline double at_most(double x) { return std::fabs(x); }
inline double at_most(const Mpfr& x) { return std::fabs(mpfr_get_d(x.get(), MPFR_RNDZ)); }

inline bool is_zero(double x) { return x == 0; }
inline bool is_zero(const Mpfr& x) { return mpfr_zero_p(x.get()); }
inline bool is_positive(double x) { return x > 0; }
inline bool is_positive(const Mpfr& x) { return mpfr_sgn(x.get()) > 0; }

inline void divide_by(double& r, int n) { r /= n; }
inline void divide_by(Mpfr& r, int n) { mpfr_div_si(r.get(), r.get(), n, MPFR_RNDN); }
inline void multiply_by(double& r, int n) { r *= n; }
inline void multiply_by(Mpfr& r, int n) { mpfr_mul_si(r.get(), r.get(), n, MPFR_RNDN); }
inline bool less(double a, double b) { return a < b; }
inline bool less(const Mpfr& a, const Mpfr& b) { return mpfr_less_p(a.get(), b.get()); }

/// run(r, x) with MPFR numbers that have the precision of `Number`, where r is correctly rounded.
template <class Run>
double rounded(double x, Run run) {
  thread_local Mpfr from(53), to(53);
  mpfr_set_d(from.get(), x, MPFR_RNDN);
  run(to.get(), from.get());
  return mpfr_get_d(to.get(), MPFR_RNDN);
}
template <class Run>
Mpfr rounded(const Mpfr& x, Run run) {
  Mpfr to(static_cast<int>(mpfr_get_prec(x.get())));
  run(to.get(), x.get());
  return to;
}

/// q^(n+1) / (1 - q), rounded up.
inline double geometric_tail(double q, int n) {
  if (!(q < 1)) return kInfinite;
  double tail = kUp / (1 - q);
  for (int k = 0; k <= n; ++k) tail *= q * kUp;
  return tail;
}

}  // namespace encase::taylor
