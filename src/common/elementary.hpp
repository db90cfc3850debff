// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/interval.hpp"

namespace encase {

class MpfrInterval;

/// What is proved of a function on a closed box: it has no value anywhere there; nothing; it is
/// defined and continuous on all of the box; it is analytic on a neighbourhood of the box.
enum class Regularity : unsigned char { Nowhere, Unproved, Continuous, Smooth };

inline void limit(Regularity& regularity, Regularity bound) {
  if (bound < regularity) regularity = bound;
}

/// Arithmetic and elementary functions of closed intervals of reals. A bound may be infinite: then
/// the interval is unbounded. The lower bound is never +infinity, the upper one never -infinity,
/// and none is NaN, in operands and results. A result encloses every value that the function has
/// at points of its operands; functions that do not have one everywhere limit `regularity` to what
/// is proved, and return the whole line where it becomes Nowhere. Precision is that of the first
/// operand. Enclosures of doubles are those of MPFR's correct rounding or wider by a few units in
/// the last place (docs/error-bounds.md, "Elementary functions in doubles").
namespace elementary {

inline Interval whole_line() {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

/// The largest double not above the sum of two lower bounds.
inline double add_down(double a, double b) {
  const double sum = a + b;
  if (sum > std::numeric_limits<double>::max()) return std::numeric_limits<double>::max();
  // Knuth's TwoSum: the exact error. It is NaN where something overflows.
  const double from_b = sum - a, from_a = sum - from_b;
  const double error = (a - from_a) + (b - from_b);
  return error >= 0 ? sum : round_down(sum);
}
inline double add_up(double a, double b) { return -add_down(-a, -b); }

/// A double not above the product of two bounds, where 0 times infinity is 0.
inline double multiply_down(double a, double b) {
  if (a == 0 || b == 0) return 0;
  const double product = a * b;
  if (product > std::numeric_limits<double>::max()) return std::numeric_limits<double>::max();
  if (product == 0 && (a > 0) == (b > 0)) return 0;  // an underflow
  return round_down(product);
}
inline double multiply_up(double a, double b) { return -multiply_down(-a, b); }

/// A double not above the quotient of two bounds, the second not zero; infinity over infinity is 0.
inline double divide_down(double a, double b) {
  if (a == 0 || (std::isinf(a) && std::isinf(b))) return 0;
  const double quotient = a / b;
  if (quotient > std::numeric_limits<double>::max()) return std::numeric_limits<double>::max();
  if (quotient == 0 && (a > 0) == (b > 0)) return 0;
  return round_down(quotient);
}
inline double divide_up(double a, double b) { return -divide_down(-a, b); }

inline Interval negate(const Interval& a) { return {-a.hi, -a.lo}; }
inline Interval add(const Interval& a, const Interval& b) {
  return {add_down(a.lo, b.lo), add_up(a.hi, b.hi)};
}
inline Interval subtract(const Interval& a, const Interval& b) { return add(a, negate(b)); }

// Not std::min and std::max, which take references.
inline double least(double a, double b) { return a < b ? a : b; }
inline double largest(double a, double b) { return a > b ? a : b; }

/// Whether four results of which `lo` and `hi` are the least and the largest are finite, and these
/// two not zero: a NaN among them makes their sum one.
inline bool is_ordinary(double lo, double hi, double sum) {
  constexpr double kMax = std::numeric_limits<double>::max();
  return lo != 0 && hi != 0 && -kMax <= lo && hi <= kMax && !std::isnan(sum);
}

inline Interval multiply(const Interval& a, const Interval& b) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  const double lo = least(least(p, q), least(r, s)), hi = largest(largest(p, q), largest(r, s));
  if (is_ordinary(lo, hi, p + q + r + s)) return {round_down(lo), round_up(hi)};
  return {least(least(multiply_down(a.lo, b.lo), multiply_down(a.lo, b.hi)),
                least(multiply_down(a.hi, b.lo), multiply_down(a.hi, b.hi))),
          largest(largest(multiply_up(a.lo, b.lo), multiply_up(a.lo, b.hi)),
                  largest(multiply_up(a.hi, b.lo), multiply_up(a.hi, b.hi)))};
}

Interval divide(const Interval& a, const Interval& b, Regularity& regularity);
/// To an integer power, not the least `long`; to the power of 0 all is 1.
Interval power(const Interval& a, long exponent, Regularity& regularity);
Interval sqrt(const Interval& a, Regularity& regularity);
Interval exp(const Interval& a);
Interval log(const Interval& a, Regularity& regularity);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
Interval tan(const Interval& a, Regularity& regularity);
Interval asin(const Interval& a, Regularity& regularity);
Interval acos(const Interval& a, Regularity& regularity);
Interval atan(const Interval& a);
Interval sinh(const Interval& a);
Interval cosh(const Interval& a);
Interval tanh(const Interval& a);
Interval abs(const Interval& a, Regularity& regularity);
Interval min(const Interval& a, const Interval& b, Regularity& regularity);
Interval max(const Interval& a, const Interval& b, Regularity& regularity);
/// Whether all of one interval is below all of the other.
inline bool is_below(const Interval& a, const Interval& b) { return a.hi < b.lo; }
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

MpfrInterval negate(const MpfrInterval& a);
MpfrInterval add(const MpfrInterval& a, const MpfrInterval& b);
MpfrInterval subtract(const MpfrInterval& a, const MpfrInterval& b);
MpfrInterval multiply(const MpfrInterval& a, const MpfrInterval& b);
MpfrInterval divide(const MpfrInterval& a, const MpfrInterval& b, Regularity& regularity);
MpfrInterval power(const MpfrInterval& a, long exponent, Regularity& regularity);
MpfrInterval sqrt(const MpfrInterval& a, Regularity& regularity);
MpfrInterval exp(const MpfrInterval& a);
MpfrInterval log(const MpfrInterval& a, Regularity& regularity);
MpfrInterval sin(const MpfrInterval& a);
MpfrInterval cos(const MpfrInterval& a);
MpfrInterval tan(const MpfrInterval& a, Regularity& regularity);
MpfrInterval asin(const MpfrInterval& a, Regularity& regularity);
MpfrInterval acos(const MpfrInterval& a, Regularity& regularity);
MpfrInterval atan(const MpfrInterval& a);
MpfrInterval sinh(const MpfrInterval& a);
MpfrInterval cosh(const MpfrInterval& a);
MpfrInterval tanh(const MpfrInterval& a);
MpfrInterval abs(const MpfrInterval& a, Regularity& regularity);
MpfrInterval min(const MpfrInterval& a, const MpfrInterval& b, Regularity& regularity);
MpfrInterval max(const MpfrInterval& a, const MpfrInterval& b, Regularity& regularity);
bool is_below(const MpfrInterval& a, const MpfrInterval& b);
MpfrInterval hull(const MpfrInterval& a, const MpfrInterval& b);
MpfrInterval pi(int bits);
MpfrInterval euler(int bits);

/// The smallest interval of doubles around it.
Interval rounded_outward(const MpfrInterval& a);

}  // namespace elementary
}  // namespace encase
