// SPDX-License-Identifier: MIT
#include "common/elementary.hpp"

#include "common/mpfr_interval.hpp"

namespace encase::elementary {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MpfrInterval in_mpfr(const Interval& a) { return MpfrInterval(53, a.lo, a.hi); }

/// |base| >= 0 to a power, rounded down.
double power_down(double base, long exponent) {
  double result = 1;
  bool one = true;  // an exact 1 need not be multiplied by
  for (;; base = multiply_down(base, base)) {
    if (exponent % 2 != 0) {
      result = one ? base : multiply_down(result, base);
      one = false;
    }
    if ((exponent /= 2) == 0) return result;
  }
}

double power_up(double base, long exponent) {
  double result = 1;
  bool one = true;
  for (;; base = multiply_up(base, base)) {
    if (exponent % 2 != 0) {
      result = one ? base : multiply_up(result, base);
      one = false;
    }
    if ((exponent /= 2) == 0) return result;
  }
}

/// To a power that is positive.
Interval positive_power(const Interval& a, long exponent) {
  if (a.lo >= 0) return {power_down(a.lo, exponent), power_up(a.hi, exponent)};
  const bool odd = exponent % 2 != 0;
  if (a.hi <= 0) {
    const Interval r{power_down(-a.hi, exponent), power_up(-a.lo, exponent)};
    return odd ? negate(r) : r;
  }
  const double below = power_up(-a.lo, exponent), above = power_up(a.hi, exponent);
  return odd ? Interval(-below, above) : Interval(0, std::max(below, above));
}

}  // namespace

Interval divide(const Interval& a, const Interval& b, Regularity& regularity) {
  if (b.lo > 0 || b.hi < 0)
    return {std::min(std::min(divide_down(a.lo, b.lo), divide_down(a.lo, b.hi)),
                     std::min(divide_down(a.hi, b.lo), divide_down(a.hi, b.hi))),
            std::max(std::max(divide_up(a.lo, b.lo), divide_up(a.lo, b.hi)),
                     std::max(divide_up(a.hi, b.lo), divide_up(a.hi, b.hi)))};
  if (b.lo == 0 && b.hi == 0) {
    limit(regularity, Regularity::Nowhere);
    return whole_line();
  }
  limit(regularity, Regularity::Unproved);
  if (a.lo == 0 && a.hi == 0) return a;
  if ((b.lo < 0 && b.hi > 0) || (a.lo < 0 && a.hi > 0)) return whole_line();
  if (b.lo < 0) return divide(negate(a), negate(b), regularity);
  // Here b is [0, h], and the quotient is as far as infinity from its bound nearest to zero.
  if (a.lo >= 0) return {divide_down(a.lo, b.hi), kInfinity};
  return {-kInfinity, divide_up(a.hi, b.hi)};
}

Interval power(const Interval& a, long exponent, Regularity& regularity) {
  if (exponent == 0) return 1;
  if (exponent == 1) return a;
  const Interval positive = positive_power(a, std::labs(exponent));
  if (exponent > 0) return positive;
  if (a.lo <= 0 && a.hi >= 0)
    limit(regularity, a.lo == 0 && a.hi == 0 ? Regularity::Nowhere : Regularity::Unproved);
  // Where the power has underflown to [0, 0] or has zero as a bound, the division says too little
  // of regularity, which is known.
  Regularity ignored = Regularity::Smooth;
  return divide(1, positive, ignored);
}

Interval sqrt(const Interval& a, Regularity& regularity) {
  return rounded_outward(sqrt(in_mpfr(a), regularity));
}
Interval exp(const Interval& a) { return rounded_outward(exp(in_mpfr(a))); }
Interval log(const Interval& a, Regularity& regularity) {
  return rounded_outward(log(in_mpfr(a), regularity));
}
Interval sin(const Interval& a) { return rounded_outward(sin(in_mpfr(a))); }
Interval cos(const Interval& a) { return rounded_outward(cos(in_mpfr(a))); }
Interval tan(const Interval& a, Regularity& regularity) {
  return rounded_outward(tan(in_mpfr(a), regularity));
}
Interval asin(const Interval& a, Regularity& regularity) {
  return rounded_outward(asin(in_mpfr(a), regularity));
}
Interval acos(const Interval& a, Regularity& regularity) {
  return rounded_outward(acos(in_mpfr(a), regularity));
}
Interval atan(const Interval& a) { return rounded_outward(atan(in_mpfr(a))); }
Interval sinh(const Interval& a) { return rounded_outward(sinh(in_mpfr(a))); }
Interval cosh(const Interval& a) { return rounded_outward(cosh(in_mpfr(a))); }
Interval tanh(const Interval& a) { return rounded_outward(tanh(in_mpfr(a))); }

Interval abs(const Interval& a, Regularity& regularity) {
  if (a.lo > 0) return a;
  if (a.hi < 0) return negate(a);
  limit(regularity, Regularity::Continuous);
  return {0, std::max(-a.lo, a.hi)};
}

Interval min(const Interval& a, const Interval& b, Regularity& regularity) {
  if (!is_below(a, b) && !is_below(b, a)) limit(regularity, Regularity::Continuous);
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}

Interval max(const Interval& a, const Interval& b, Regularity& regularity) {
  return negate(min(negate(a), negate(b), regularity));
}

}  // namespace encase::elementary
