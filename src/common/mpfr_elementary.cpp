// SPDX-License-Identifier: MIT
#include <utility>

#include "common/elementary.hpp"
#include "common/mpfr_interval.hpp"

namespace encase::elementary {

namespace {

MpfrInterval whole_line(int bits) {
  MpfrInterval r(bits);
  mpfr_set_inf(r.lo(), -1);
  mpfr_set_inf(r.hi(), 1);
  return r;
}

using Function = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);

MpfrInterval increasing(Function f, mpfr_srcptr lo, mpfr_srcptr hi, int bits) {
  MpfrInterval r(bits);
  f(r.lo(), lo, MPFR_RNDD);
  f(r.hi(), hi, MPFR_RNDU);
  return r;
}
MpfrInterval increasing(Function f, const MpfrInterval& a) {
  return increasing(f, a.lo(), a.hi(), a.bits());
}

bool contains_zero(const MpfrInterval& a) { return mpfr_sgn(a.lo()) <= 0 && mpfr_sgn(a.hi()) >= 0; }

/// The part of an interval in [-1, 1], or nothing.
bool clip_to_unit(MpfrInterval* a, Regularity& regularity) {
  if (mpfr_cmp_si(a->lo(), 1) > 0 || mpfr_cmp_si(a->hi(), -1) < 0) {
    limit(regularity, Regularity::Nowhere);
    return false;
  }
  const int low = mpfr_cmp_si(a->lo(), -1), high = mpfr_cmp_si(a->hi(), 1);
  if (low <= 0 || high >= 0)
    limit(regularity, low < 0 || high > 0 ? Regularity::Unproved : Regularity::Continuous);
  if (low < 0) mpfr_set_si(a->lo(), -1, MPFR_RNDN);
  if (high > 0) mpfr_set_si(a->hi(), 1, MPFR_RNDN);
  return true;
}

/// The multiples of pi / 2 in an interval: `first` < n <= `last`, and where that is in doubt more.
/// False if the interval is unbounded or has four or more.
struct Quadrants {
  long first = 0, count = 0;  ///< `first` modulo 4

  /// Whether a multiple that is `remainder` modulo 4 is among them.
  bool meet(int remainder) const {
    for (long n = first + 1; n <= first + count; ++n)
      if ((n - remainder) % 4 == 0) return true;
    return false;
  }
};

bool find_quadrants(const MpfrInterval& a, Quadrants* quadrants) {
  if (!mpfr_number_p(a.lo()) || !mpfr_number_p(a.hi())) return false;
  const auto exponent = [](mpfr_srcptr x) { return mpfr_zero_p(x) ? 0 : mpfr_get_exp(x); };
  const mpfr_exp_t largest = std::max(exponent(a.lo()), exponent(a.hi()));
  if (largest > 20000) return false;
  // Enough bits for the quotient's integer part and its distance from an integer.
  MpfrInterval half_pi(static_cast<int>(a.bits() + 64 + std::max<mpfr_exp_t>(0, largest)));
  mpfr_const_pi(half_pi.lo(), MPFR_RNDD);
  mpfr_const_pi(half_pi.hi(), MPFR_RNDU);
  mpfr_div_2ui(half_pi.lo(), half_pi.lo(), 1, MPFR_RNDD);
  mpfr_div_2ui(half_pi.hi(), half_pi.hi(), 1, MPFR_RNDU);
  MpfrInterval quotient(half_pi.bits());
  mpfr_set(quotient.lo(), a.lo(), MPFR_RNDD);
  mpfr_set(quotient.hi(), a.hi(), MPFR_RNDU);
  quotient /= half_pi;
  Integer first, last;
  mpfr_get_z(first.get_mpz_t(), quotient.lo(), MPFR_RNDD);
  mpfr_get_z(last.get_mpz_t(), quotient.hi(), MPFR_RNDD);
  const Integer count = last - first;
  if (count >= 4) return false;
  quadrants->first = static_cast<long>(mpz_fdiv_ui(first.get_mpz_t(), 4));
  quadrants->count = count.get_si();
  return true;
}

/// The hull of the values at the ends, and 1 and -1 where those are taken between.
MpfrInterval wave(Function f, const MpfrInterval& a, int crest, int trough) {
  MpfrInterval r(a.bits());
  Quadrants quadrants;
  const bool found = find_quadrants(a, &quadrants);
  if (!found || quadrants.meet(trough)) {
    mpfr_set_si(r.lo(), -1, MPFR_RNDN);
  } else {
    MpfrInterval other(a.bits());
    f(r.lo(), a.lo(), MPFR_RNDD);
    f(other.lo(), a.hi(), MPFR_RNDD);
    mpfr_min(r.lo(), r.lo(), other.lo(), MPFR_RNDD);
  }
  if (!found || quadrants.meet(crest)) {
    mpfr_set_si(r.hi(), 1, MPFR_RNDN);
  } else {
    MpfrInterval other(a.bits());
    f(r.hi(), a.lo(), MPFR_RNDU);
    f(other.hi(), a.hi(), MPFR_RNDU);
    mpfr_max(r.hi(), r.hi(), other.hi(), MPFR_RNDU);
  }
  return r;
}

MpfrInterval constant(int bits, int (*f)(mpfr_ptr, mpfr_rnd_t)) {
  MpfrInterval r(bits);
  f(r.lo(), MPFR_RNDD);
  f(r.hi(), MPFR_RNDU);
  return r;
}

MpfrInterval one(int bits) { return MpfrInterval(bits, 1.0); }

}  // namespace

MpfrInterval negate(const MpfrInterval& a) { return -a; }
MpfrInterval add(const MpfrInterval& a, const MpfrInterval& b) { return a + b; }
MpfrInterval subtract(const MpfrInterval& a, const MpfrInterval& b) { return a - b; }
MpfrInterval multiply(const MpfrInterval& a, const MpfrInterval& b) { return a * b; }

MpfrInterval divide(const MpfrInterval& a, const MpfrInterval& b, Regularity& regularity) {
  if (!contains_zero(b)) return a / b;
  if (b.is_zero()) {
    limit(regularity, Regularity::Nowhere);
    return whole_line(a.bits());
  }
  limit(regularity, Regularity::Unproved);
  if (a.is_zero()) return a;
  const bool below = mpfr_sgn(b.lo())<0, above = mpfr_sgn(b.hi())> 0;
  const int low = mpfr_sgn(a.lo()), high = mpfr_sgn(a.hi());
  if ((below && above) || (low < 0 && high > 0)) return whole_line(a.bits());
  if (below) return divide(-a, -b, regularity);
  // Here b is [0, h], and the quotient is as far as infinity from its bound nearest to zero.
  MpfrInterval r = whole_line(a.bits());
  if (low >= 0)
    mpfr_div(r.lo(), a.lo(), b.hi(), MPFR_RNDD);
  else
    mpfr_div(r.hi(), a.hi(), b.hi(), MPFR_RNDU);
  if (mpfr_nan_p(r.lo()) || mpfr_nan_p(r.hi())) return whole_line(a.bits());
  return r;
}

MpfrInterval power(const MpfrInterval& a, long exponent, Regularity& regularity) {
  if (exponent == 0) return one(a.bits());
  if (exponent < 0 && contains_zero(a)) {
    if (a.is_zero()) {
      limit(regularity, Regularity::Nowhere);
      return whole_line(a.bits());
    }
    // The reciprocal of the positive power, which is an interval from zero if it is even.
    Regularity ignored = Regularity::Smooth;
    limit(regularity, Regularity::Unproved);
    return divide(one(a.bits()), power(a, -exponent, ignored), ignored);
  }
  MpfrInterval r(a.bits());
  const auto set = [&](mpfr_srcptr lo, mpfr_srcptr hi) {
    mpfr_pow_si(r.lo(), lo, exponent, MPFR_RNDD);
    mpfr_pow_si(r.hi(), hi, exponent, MPFR_RNDU);
  };
  if (exponent % 2 != 0) {
    if (exponent > 0)
      set(a.lo(), a.hi());
    else
      set(a.hi(), a.lo());
    return r;
  }
  Regularity ignored = Regularity::Smooth;
  const MpfrInterval magnitude = abs(a, ignored);
  if (exponent > 0)
    set(magnitude.lo(), magnitude.hi());
  else
    set(magnitude.hi(), magnitude.lo());
  return r;
}

MpfrInterval sqrt(const MpfrInterval& a, Regularity& regularity) {
  if (mpfr_sgn(a.hi()) < 0) {
    limit(regularity, Regularity::Nowhere);
    return whole_line(a.bits());
  }
  if (mpfr_sgn(a.lo()) > 0) return increasing(mpfr_sqrt, a);
  limit(regularity, mpfr_sgn(a.lo()) < 0 ? Regularity::Unproved : Regularity::Continuous);
  MpfrInterval r(a.bits());
  mpfr_sqrt(r.hi(), a.hi(), MPFR_RNDU);
  return r;
}

MpfrInterval exp(const MpfrInterval& a) { return increasing(mpfr_exp, a); }

MpfrInterval log(const MpfrInterval& a, Regularity& regularity) {
  if (mpfr_sgn(a.hi()) <= 0) {
    limit(regularity, Regularity::Nowhere);
    return whole_line(a.bits());
  }
  if (mpfr_sgn(a.lo()) > 0) return increasing(mpfr_log, a);
  limit(regularity, Regularity::Unproved);
  MpfrInterval r = whole_line(a.bits());
  mpfr_log(r.hi(), a.hi(), MPFR_RNDU);
  return r;
}

MpfrInterval sin(const MpfrInterval& a) { return wave(mpfr_sin, a, 1, 3); }
MpfrInterval cos(const MpfrInterval& a) { return wave(mpfr_cos, a, 0, 2); }

MpfrInterval tan(const MpfrInterval& a, Regularity& regularity) {
  Quadrants quadrants;
  if (find_quadrants(a, &quadrants) && !quadrants.meet(1) && !quadrants.meet(3))
    return increasing(mpfr_tan, a);
  limit(regularity, Regularity::Unproved);
  return whole_line(a.bits());
}

MpfrInterval asin(const MpfrInterval& a, Regularity& regularity) {
  MpfrInterval clipped = a;
  if (!clip_to_unit(&clipped, regularity)) return whole_line(a.bits());
  return increasing(mpfr_asin, clipped);
}

MpfrInterval acos(const MpfrInterval& a, Regularity& regularity) {
  MpfrInterval clipped = a;
  if (!clip_to_unit(&clipped, regularity)) return whole_line(a.bits());
  MpfrInterval r(a.bits());
  mpfr_acos(r.lo(), clipped.hi(), MPFR_RNDD);
  mpfr_acos(r.hi(), clipped.lo(), MPFR_RNDU);
  return r;
}

MpfrInterval atan(const MpfrInterval& a) { return increasing(mpfr_atan, a); }
MpfrInterval sinh(const MpfrInterval& a) { return increasing(mpfr_sinh, a); }
MpfrInterval cosh(const MpfrInterval& a) {
  Regularity ignored = Regularity::Smooth;
  return increasing(mpfr_cosh, abs(a, ignored));
}
MpfrInterval tanh(const MpfrInterval& a) { return increasing(mpfr_tanh, a); }

MpfrInterval abs(const MpfrInterval& a, Regularity& regularity) {
  if (mpfr_sgn(a.lo()) > 0) return a;
  if (mpfr_sgn(a.hi()) < 0) return -a;
  limit(regularity, Regularity::Continuous);
  MpfrInterval r(a.bits());
  mpfr_neg(r.hi(), a.lo(), MPFR_RNDU);
  mpfr_max(r.hi(), r.hi(), a.hi(), MPFR_RNDU);
  return r;
}

MpfrInterval min(const MpfrInterval& a, const MpfrInterval& b, Regularity& regularity) {
  if (!is_below(a, b) && !is_below(b, a)) limit(regularity, Regularity::Continuous);
  MpfrInterval r(a.bits());
  mpfr_min(r.lo(), a.lo(), b.lo(), MPFR_RNDD);
  mpfr_min(r.hi(), a.hi(), b.hi(), MPFR_RNDU);
  return r;
}

MpfrInterval max(const MpfrInterval& a, const MpfrInterval& b, Regularity& regularity) {
  return negate(min(negate(a), negate(b), regularity));
}

bool is_below(const MpfrInterval& a, const MpfrInterval& b) { return mpfr_less_p(a.hi(), b.lo()); }

MpfrInterval hull(const MpfrInterval& a, const MpfrInterval& b) {
  MpfrInterval r(a.bits());
  mpfr_min(r.lo(), a.lo(), b.lo(), MPFR_RNDD);
  mpfr_max(r.hi(), a.hi(), b.hi(), MPFR_RNDU);
  return r;
}

MpfrInterval pi(int bits) { return constant(bits, mpfr_const_pi); }

MpfrInterval euler(int bits) { return exp(one(bits)); }

Interval rounded_outward(const MpfrInterval& a) {
  return {mpfr_get_d(a.lo(), MPFR_RNDD), mpfr_get_d(a.hi(), MPFR_RNDU)};
}

}  // namespace encase::elementary
