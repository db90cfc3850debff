// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "encase/number.hpp"

namespace encase {

/// A closed interval of doubles with outward rounded arithmetic, whatever the rounding mode's sign:
/// each operation is done to nearest and its result moved outward by at least one unit in the last
/// place. NaN bounds enclose everything: every test below is false for them.
struct Interval {
  double lo = 0;
  double hi = 0;

  Interval() = default;
  Interval(double value) : lo(value), hi(value) {}
  Interval(double low, double high) : lo(low), hi(high) {}

  /// The tightest doubles around a rational.
  static Interval enclose(const Rational& value);

  double mid() const { return lo + 0.5 * (hi - lo); }
  double width() const { return hi - lo; }
  std::optional<Sign> sign() const {
    if (lo > 0) return Sign::Positive;
    if (hi < 0) return Sign::Negative;
    if (lo == 0 && hi == 0) return Sign::Zero;
    return std::nullopt;
  }
};

/// A double not above / not below every real within one rounding of `x`.
inline double round_down(double x) {
  return x - (std::fabs(x) * 0x1p-52 + std::numeric_limits<double>::denorm_min());
}
inline double round_up(double x) {
  return x + (std::fabs(x) * 0x1p-52 + std::numeric_limits<double>::denorm_min());
}

/// Whether the difference of two doubles is a double: the rounding error of a - b, which Knuth's
/// TwoSum computes exactly, is zero. False where something overflows.
inline bool exact_difference(double a, double b) {
  const double difference = a - b, first = difference + b, second = difference - first;
  return (a - first) + (-b - second) == 0;
}

/// How [lo, hi] is mapped to [-1, 1]: by the double next to its middle and a half width such that
/// [center - half, center + half] contains [lo, hi], and is [lo, hi] if `exact`.
struct Centered {
  double center;
  double half;
  bool exact;
};
inline Centered centered(double lo, double hi) {
  const double center = lo + 0.5 * (hi - lo), below = center - lo, above = hi - center;
  // (That adding the differences again gives lo and hi would not prove them exact: a tie can be
  // rounded away and back.)
  if (below == above && exact_difference(center, lo) && exact_difference(hi, center))
    return {center, below, true};
  return {center, (below < above ? above : below) * (1 + 0x1p-50), false};
}

/// Encloses what was rounded to the four numbers; everything if one is NaN.
inline Interval around(double p, double q, double r, double s) {
  if (std::isnan(p + q + r + s))
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  // Not fmin and fmax, which are calls.
  const auto least = [](double a, double b) { return a < b ? a : b; };
  const auto largest = [](double a, double b) { return a > b ? a : b; };
  return {round_down(least(least(p, q), least(r, s))),
          round_up(largest(largest(p, q), largest(r, s)))};
}

inline Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }
inline Interval operator+(const Interval& a, const Interval& b) {
  return {round_down(a.lo + b.lo), round_up(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + (-b); }
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  return around(p, q, r, s);
}
inline Interval operator/(const Interval& a, const Interval& b) {
  if (!(b.lo > 0 || b.hi < 0))
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
  return around(p, q, r, s);
}

}  // namespace encase
