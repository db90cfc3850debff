// SPDX-License-Identifier: MIT
#include "mpfr_interval.hpp"

namespace encase {

namespace {

enum class Shape { Invalid, Zero, NonNegative, NonPositive, Mixed };

Shape shape_of(const mpfr_t lo, const mpfr_t hi) {
  if (mpfr_nan_p(lo) || mpfr_nan_p(hi)) return Shape::Invalid;
  if (mpfr_zero_p(lo) && mpfr_zero_p(hi)) return Shape::Zero;
  if (mpfr_sgn(lo) >= 0) return Shape::NonNegative;
  return mpfr_sgn(hi) <= 0 ? Shape::NonPositive : Shape::Mixed;
}

void set_whole_line(mpfr_t lo, mpfr_t hi) {
  mpfr_set_inf(lo, -1);
  mpfr_set_inf(hi, 1);
}

}  // namespace

// No product below is 0 * infinity: each pairs either two bounds nearest to zero, or two farthest
// from it, or the farthest bound of one factor with a non-zero bound of a factor of mixed sign; and
// the farthest bound of an interval other than [0, 0] is not zero.
MpfrInterval& MpfrInterval::operator*=(const MpfrInterval& b) {
  if (this == &b) return *this *= MpfrInterval(b);
  const Shape sa = shape_of(lo_, hi_), sb = shape_of(b.lo_, b.hi_);
  if (sa == Shape::Invalid || sb == Shape::Invalid) {
    set_whole_line(lo_, hi_);
    return *this;
  }
  if (sa == Shape::Zero) return *this;
  if (sb == Shape::Zero) {
    mpfr_set_zero(lo_, 1);
    mpfr_set_zero(hi_, 1);
    return *this;
  }
  mpfr_srcptr lo_factor = b.lo_, hi_factor = b.hi_;
  if (sa == Shape::Mixed && sb == Shape::Mixed) {
    mpfr_t p, q;
    mpfr_init2(p, mpfr_get_prec(lo_));
    mpfr_init2(q, mpfr_get_prec(lo_));
    mpfr_mul(p, lo_, b.hi_, MPFR_RNDD);
    mpfr_mul(q, hi_, b.lo_, MPFR_RNDD);
    mpfr_min(p, p, q, MPFR_RNDD);
    mpfr_mul(q, lo_, b.lo_, MPFR_RNDU);
    mpfr_mul(hi_, hi_, b.hi_, MPFR_RNDU);
    mpfr_max(hi_, hi_, q, MPFR_RNDU);
    mpfr_swap(lo_, p);
    mpfr_clear(p);
    mpfr_clear(q);
    return *this;
  }
  if (sb == Shape::Mixed) {
    // A factor of one sign scales b by its bound farthest from zero.
    if (sa == Shape::NonNegative) {
      mpfr_set(lo_, hi_, MPFR_RNDD);
    } else {
      mpfr_set(hi_, lo_, MPFR_RNDU);
      std::swap(lo_factor, hi_factor);
    }
  } else if (sa == Shape::Mixed) {
    if (sb == Shape::NonNegative) {
      lo_factor = b.hi_;
    } else {
      mpfr_swap(lo_, hi_);
      hi_factor = b.lo_;
    }
  } else {
    if (sb == Shape::NonPositive) mpfr_swap(lo_, hi_);
    if (sa == Shape::NonPositive) std::swap(lo_factor, hi_factor);
  }
  mpfr_mul(lo_, lo_, lo_factor, MPFR_RNDD);
  mpfr_mul(hi_, hi_, hi_factor, MPFR_RNDU);
  // Only bounds like [infinity, infinity], which hold no number, could have made a NaN.
  if (mpfr_nan_p(lo_) || mpfr_nan_p(hi_)) set_whole_line(lo_, hi_);
  return *this;
}

MpfrInterval& MpfrInterval::operator/=(const MpfrInterval& b) {
  if (this == &b) return *this /= MpfrInterval(b);
  const Shape sa = shape_of(lo_, hi_), sb = shape_of(b.lo_, b.hi_);
  const bool positive = sb == Shape::NonNegative && mpfr_sgn(b.lo_) > 0;
  const bool negative = sb == Shape::NonPositive && mpfr_sgn(b.hi_) < 0;
  if (sa == Shape::Invalid || !(positive || negative)) {
    set_whole_line(lo_, hi_);
    return *this;
  }
  if (sa == Shape::Zero) return *this;
  // For b > 0 the lower bound of the quotient is lo / b.hi where lo >= 0, else lo / b.lo; the upper
  // one is hi / b.lo where hi >= 0, else hi / b.hi. For b < 0 the roles of lo and hi are exchanged.
  mpfr_srcptr near = positive ? b.lo_ : b.hi_;
  mpfr_srcptr far = positive ? b.hi_ : b.lo_;
  if (negative) mpfr_swap(lo_, hi_);
  const bool lo_shrinks = positive ? sa == Shape::NonNegative : sa == Shape::NonPositive;
  const bool hi_shrinks = positive ? sa == Shape::NonPositive : sa == Shape::NonNegative;
  mpfr_div(lo_, lo_, lo_shrinks ? far : near, MPFR_RNDD);
  mpfr_div(hi_, hi_, hi_shrinks ? far : near, MPFR_RNDU);
  // infinity / infinity: a bound that says nothing.
  if (mpfr_nan_p(lo_)) mpfr_set_inf(lo_, -1);
  if (mpfr_nan_p(hi_)) mpfr_set_inf(hi_, 1);
  return *this;
}

}  // namespace encase
