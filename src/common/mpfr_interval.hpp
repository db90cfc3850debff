// SPDX-License-Identifier: MIT
#pragma once

#include <mpfr.h>

#include <optional>
#include <utility>

#include "encase/number.hpp"

namespace encase {

/// A closed interval with MPFR bounds of one precision; every operation rounds its lower bound down
/// and its upper bound up. Results take the precision of the left operand.
class MpfrInterval {
 public:
  /// [0, 0] of the least precision, to be assigned to.
  MpfrInterval() : MpfrInterval(MPFR_PREC_MIN) {}
  explicit MpfrInterval(int bits) {
    mpfr_init2(lo_, bits);
    mpfr_init2(hi_, bits);
    mpfr_set_zero(lo_, 1);
    mpfr_set_zero(hi_, 1);
  }
  MpfrInterval(int bits, double value) : MpfrInterval(bits) {
    mpfr_set_d(lo_, value, MPFR_RNDD);
    mpfr_set_d(hi_, value, MPFR_RNDU);
  }
  MpfrInterval(int bits, double lo, double hi) : MpfrInterval(bits) {
    mpfr_set_d(lo_, lo, MPFR_RNDD);
    mpfr_set_d(hi_, hi, MPFR_RNDU);
  }
  MpfrInterval(int bits, const Rational& value) : MpfrInterval(bits) {
    mpfr_set_q(lo_, value.get_mpq_t(), MPFR_RNDD);
    mpfr_set_q(hi_, value.get_mpq_t(), MPFR_RNDU);
  }
  MpfrInterval(int bits, const Rational& lo, const Rational& hi) : MpfrInterval(bits) {
    mpfr_set_q(lo_, lo.get_mpq_t(), MPFR_RNDD);
    mpfr_set_q(hi_, hi.get_mpq_t(), MPFR_RNDU);
  }
  MpfrInterval(const MpfrInterval& other) : MpfrInterval(other.bits()) { *this = other; }
  MpfrInterval(MpfrInterval&& other) noexcept {
    *lo_ = *other.lo_;
    *hi_ = *other.hi_;
    other.lo_->_mpfr_d = nullptr;
  }
  MpfrInterval& operator=(const MpfrInterval& other) {
    if (this == &other) return *this;
    mpfr_set_prec(lo_, other.bits());
    mpfr_set_prec(hi_, other.bits());
    mpfr_set(lo_, other.lo_, MPFR_RNDD);
    mpfr_set(hi_, other.hi_, MPFR_RNDU);
    return *this;
  }
  MpfrInterval& operator=(MpfrInterval&& other) noexcept {
    std::swap(*lo_, *other.lo_);
    std::swap(*hi_, *other.hi_);
    return *this;
  }
  ~MpfrInterval() {
    if (lo_->_mpfr_d) {
      mpfr_clear(lo_);
      mpfr_clear(hi_);
    }
  }

  int bits() const { return static_cast<int>(mpfr_get_prec(lo_)); }
  bool is_zero() const { return mpfr_zero_p(lo_) && mpfr_zero_p(hi_); }

  MpfrInterval& operator+=(const MpfrInterval& b) {
    mpfr_add(lo_, lo_, b.lo_, MPFR_RNDD);
    mpfr_add(hi_, hi_, b.hi_, MPFR_RNDU);
    return *this;
  }
  MpfrInterval& operator-=(const MpfrInterval& b) {
    // With b = *this the first bound would be overwritten before the second is read.
    if (this == &b) return *this -= MpfrInterval(b);
    mpfr_sub(lo_, lo_, b.hi_, MPFR_RNDD);
    mpfr_sub(hi_, hi_, b.lo_, MPFR_RNDU);
    return *this;
  }
  MpfrInterval& operator*=(const MpfrInterval& b);
  /// Division; by an interval that contains zero: the whole line.
  MpfrInterval& operator/=(const MpfrInterval& b);

  friend MpfrInterval operator+(MpfrInterval a, const MpfrInterval& b) { return a += b; }
  friend MpfrInterval operator-(MpfrInterval a, const MpfrInterval& b) { return a -= b; }
  friend MpfrInterval operator*(MpfrInterval a, const MpfrInterval& b) { return a *= b; }
  friend MpfrInterval operator/(MpfrInterval a, const MpfrInterval& b) { return a /= b; }
  friend MpfrInterval operator-(const MpfrInterval& a) {
    MpfrInterval r(a.bits());
    mpfr_neg(r.lo_, a.hi_, MPFR_RNDD);
    mpfr_neg(r.hi_, a.lo_, MPFR_RNDU);
    return r;
  }

  /// The sign shared by all numbers of the interval (Zero for [0, 0]).
  std::optional<Sign> sign() const {
    if (mpfr_sgn(lo_) > 0) return Sign::Positive;
    if (mpfr_sgn(hi_) < 0) return Sign::Negative;
    if (is_zero()) return Sign::Zero;
    return std::nullopt;
  }

  mpfr_srcptr lo() const { return lo_; }
  mpfr_srcptr hi() const { return hi_; }
  /// To be set rounding outward.
  mpfr_ptr lo() { return lo_; }
  mpfr_ptr hi() { return hi_; }

 private:
  mpfr_t lo_;
  mpfr_t hi_;
};

}  // namespace encase
