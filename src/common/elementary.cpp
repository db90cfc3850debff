// SPDX-License-Identifier: MIT
#include "common/elementary.hpp"

#include "common/mpfr_interval.hpp"
#include "common/point_enclosures.hpp"

namespace encase::elementary {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MpfrInterval in_mpfr(const Interval& a) { return MpfrInterval(53, a.lo, a.hi); }

bool is_bounded(const Interval& a) { return a.lo > -kInfinity && a.hi < kInfinity; }

/// The ends of an interval, reduced by multiples of pi/2, and which multiples lie between them.
struct Ends {
  point::Reduced lo, hi;
  std::int64_t first = 0, last = 0;  ///< the multiples, and where that is in doubt more

  /// False if the interval is too far out, and where it is so wide that `first` and `last` matter
  /// no more.
  bool reduce(const Interval& a) {
    if (!(a.lo >= -point::kLargestReduced && a.hi <= point::kLargestReduced)) return false;
    lo = point::reduce(a.lo);
    hi = a.lo == a.hi ? lo : point::reduce(a.hi);
    constexpr double kDoubt = 0x1p-50;
    first = lo.rest <= kDoubt ? lo.quadrant : lo.quadrant + 1;
    last = hi.rest >= -kDoubt ? hi.quadrant : hi.quadrant - 1;
    return true;
  }
  /// Whether there is a multiple n with n + shift = remainder modulo 4.
  bool meet(std::int64_t remainder, int shift) const {
    // The first of them that is not below `first`.
    const std::int64_t step = (remainder - shift - first) & 3;
    return first + step <= last;
  }
};

/// sin(x + shift pi/2).
template <MpfrInterval (*fallback)(const MpfrInterval&)>
Interval wave(const Interval& a, int shift) {
  Ends ends;
  if (!ends.reduce(a)) return rounded_outward(fallback(in_mpfr(a)));
  const bool crest = ends.meet(1, shift), trough = ends.meet(3, shift);
  if (crest && trough) return {-1, 1};
  const Interval low = point::sine(ends.lo, shift), high = point::sine(ends.hi, shift);
  return {trough ? -1 : std::min(low.lo, high.lo), crest ? 1 : std::max(low.hi, high.hi)};
}
constexpr auto mpfr_interval_sin = static_cast<MpfrInterval (*)(const MpfrInterval&)>(sin);
constexpr auto mpfr_interval_cos = static_cast<MpfrInterval (*)(const MpfrInterval&)>(cos);

// At points, from others by interval arithmetic.

/// Unbounded where the cosine is not told apart from zero.
Interval tangent(const point::Reduced& x) {
  Regularity ignored = Regularity::Smooth;
  return divide(point::sine(x, 0), point::sine(x, 1), ignored);
}

/// asin x = atan(x / sqrt((1 - x)(1 + x))), |x| < 1.
Interval arc_sine(double x) {
  Regularity ignored = Regularity::Smooth;
  const Interval cosine = sqrt(multiply(subtract(1, x), add(1, x)), ignored);
  return atan(divide(x, cosine, ignored));
}

/// acos x = 2 atan(sqrt((1 - x) / (1 + x))), |x| < 1.
Interval arc_cosine(double x) {
  Regularity ignored = Regularity::Smooth;
  return multiply(2, atan(sqrt(divide(subtract(1, x), add(1, x), ignored), ignored)));
}

bool can_be_hyperbolic(const Interval& a) { return a.lo >= -350 && a.hi <= 350; }

Interval half(const Interval& a) { return {0.5 * a.lo, 0.5 * a.hi}; }

/// (e^x + e^-x) / 2, |x| <= 350.
Interval hyperbolic_cosine(double x) {
  Regularity ignored = Regularity::Smooth;
  const Interval e = point::exp(x);
  return half(add(e, divide(1, e, ignored)));
}

/// (e^x - e^-x) / 2, and where that cancels x (1 + z/(2 3) (1 + z/(4 5) (1 + ...))) with z = x^2:
/// there are nine factors, and the rest lies between 1 and 1 + z/(20 21) + ... < 1.01.
Interval hyperbolic_sine(double x) {
  Regularity ignored = Regularity::Smooth;
  if (std::fabs(x) > 1) {
    const Interval e = point::exp(x);
    return half(subtract(e, divide(1, e, ignored)));
  }
  if (x == 0) return 0;
  const Interval z = power(x, 2, ignored);
  Interval sum(1, 1.01);
  for (int k = 9; k > 0; --k)
    sum = add(1, multiply(divide(z, 2.0 * k * (2 * k + 1), ignored), sum));
  return multiply(x, sum);
}

/// sinh / cosh, or 1 - 2 / (e^2x + 1) for large |x|, |x| <= 350.
Interval hyperbolic_tangent(double x) {
  Regularity ignored = Regularity::Smooth;
  if (x < 0) return negate(hyperbolic_tangent(-x));
  Interval r = x <= 1 ? divide(hyperbolic_sine(x), hyperbolic_cosine(x), ignored)
                      : subtract(1, divide(2, add(point::exp(2 * x), 1), ignored));
  return {r.lo, std::min(r.hi, 1.0)};
}

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
  if (b.lo > 0 || b.hi < 0) {
    const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
    const double lo = least(least(p, q), least(r, s)), hi = largest(largest(p, q), largest(r, s));
    if (is_ordinary(lo, hi, p + q + r + s)) return {round_down(lo), round_up(hi)};
    return {least(least(divide_down(a.lo, b.lo), divide_down(a.lo, b.hi)),
                  least(divide_down(a.hi, b.lo), divide_down(a.hi, b.hi))),
            largest(largest(divide_up(a.lo, b.lo), divide_up(a.lo, b.hi)),
                    largest(divide_up(a.hi, b.lo), divide_up(a.hi, b.hi)))};
  }
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
  if (a.hi < 0) {
    limit(regularity, Regularity::Nowhere);
    return whole_line();
  }
  if (a.lo <= 0) limit(regularity, a.lo < 0 ? Regularity::Unproved : Regularity::Continuous);
  // A root of few digits whose square is what it shall be is exact, and zero and infinity are.
  const auto root = [](double x, double (*rounded)(double)) {
    const double r = std::sqrt(x);
    if (static_cast<double>(static_cast<float>(r)) == r && r * r == x) return r;
    return rounded(r);
  };
  return {a.lo <= 0 ? 0 : root(a.lo, round_down), root(a.hi, round_up)};
}

Interval exp(const Interval& a) {
  return {point::can_exp(a.lo) ? point::exp(a.lo).lo : rounded_outward(exp(in_mpfr(a))).lo,
          point::can_exp(a.hi) ? point::exp(a.hi).hi : rounded_outward(exp(in_mpfr(a))).hi};
}

Interval log(const Interval& a, Regularity& regularity) {
  if (!point::can_log(a.lo) || !point::can_log(a.hi))
    return rounded_outward(log(in_mpfr(a), regularity));
  return {point::log(a.lo).lo, point::log(a.hi).hi};
}

Interval sin(const Interval& a) { return wave<mpfr_interval_sin>(a, 0); }
Interval cos(const Interval& a) { return wave<mpfr_interval_cos>(a, 1); }

Interval tan(const Interval& a, Regularity& regularity) {
  Ends ends;
  if (ends.reduce(a) && !ends.meet(1, 0) && !ends.meet(3, 0)) {
    const Interval low = tangent(ends.lo), high = tangent(ends.hi);
    if (low.lo > -kInfinity && high.hi < kInfinity) return {low.lo, high.hi};
  }
  return rounded_outward(tan(in_mpfr(a), regularity));
}

Interval asin(const Interval& a, Regularity& regularity) {
  if (!(a.lo > -1 && a.hi < 1)) return rounded_outward(asin(in_mpfr(a), regularity));
  return {arc_sine(a.lo).lo, arc_sine(a.hi).hi};
}

Interval acos(const Interval& a, Regularity& regularity) {
  if (!(a.lo > -1 && a.hi < 1)) return rounded_outward(acos(in_mpfr(a), regularity));
  return {arc_cosine(a.hi).lo, arc_cosine(a.lo).hi};
}

Interval atan(const Interval& a) {
  if (!is_bounded(a)) return rounded_outward(atan(in_mpfr(a)));
  return {point::atan(a.lo).lo, point::atan(a.hi).hi};
}

Interval sinh(const Interval& a) {
  if (!can_be_hyperbolic(a)) return rounded_outward(sinh(in_mpfr(a)));
  return {hyperbolic_sine(a.lo).lo, hyperbolic_sine(a.hi).hi};
}

Interval cosh(const Interval& a) {
  if (!can_be_hyperbolic(a)) return rounded_outward(cosh(in_mpfr(a)));
  Regularity ignored = Regularity::Smooth;
  const Interval magnitude = abs(a, ignored);
  return {hyperbolic_cosine(magnitude.lo).lo, hyperbolic_cosine(magnitude.hi).hi};
}

Interval tanh(const Interval& a) {
  if (!can_be_hyperbolic(a)) return rounded_outward(tanh(in_mpfr(a)));
  return {hyperbolic_tangent(a.lo).lo, hyperbolic_tangent(a.hi).hi};
}

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
