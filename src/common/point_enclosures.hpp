// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "common/elementary.hpp"

/// Elementary functions at doubles: an approximation in doubles, widened by an error that is proved
/// in docs/error-bounds.md, "Elementary functions in doubles", whose letters are used here. Each
/// one says for which arguments. u is 2^-53.
namespace encase::point {

/// y -+ error, which must be larger than the error proved by at least u |y|, for the rounding here.
inline Interval widened(double y, double error) { return {y - error, y + error}; }

/// The nearest integer of |t| < 2^51, ties to even.
inline double nearest_integer(double t) {
  constexpr double kShift = 0x1.8p52;
  return (t + kShift) - kShift;
}

/// x = quadrant pi/2 + rest, |rest| <= 0.7855, but for an error of at most 1.0001 u in the rest,
/// which is none if the quadrant is 0. For |x| <= 2^20.
struct Reduced {
  std::int64_t quadrant;
  double rest;
};
inline constexpr double kLargestReduced = 0x1p20;
inline Reduced reduce(double x) {
  constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;
  // pi/2 in three parts: products of the first two with integers below 2^20 are exact.
  constexpr double kFirst = 0x1.921fb54400000p+0, kSecond = 0x1.0b4611a600000p-34,
                   kThird = 0x1.3198a2e037073p-69;
  const double k = nearest_integer(x * kTwoOverPi);
  return {static_cast<std::int64_t>(k), ((x - k * kFirst) - k * kSecond) - k * kThird};
}

/// Within 1.6 u |r| of the sine, for |r| <= 0.7855.
inline double short_sine(double r) {
  const double z = r * r;
  const double q =
      -1.0 / 6 +
      z * (1.0 / 120 +
           z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                       z * (1.0 / 6227020800 +
                                                            z * (-1.0 / 1307674368000 +
                                                                 z * (1.0 / 355687428096000)))))));
  return r + r * (z * q);
}

/// Within 2.5 u of the cosine, for |r| <= 0.7855.
inline double short_cosine(double r) {
  const double z = r * r;
  const double q =
      1.0 / 24 +
      z * (-1.0 / 720 +
           z * (1.0 / 40320 +
                z * (-1.0 / 3628800 + z * (1.0 / 479001600 + z * (-1.0 / 87178291200 +
                                                                  z * (1.0 / 20922789888000))))));
  return (1 - 0.5 * z) + z * z * q;
}

/// sin(x + shift pi/2) of what has been reduced from x.
inline Interval sine(const Reduced& x, int shift) {
  const std::int64_t quadrant = x.quadrant + shift;
  if (quadrant == 0 && shift == 0) {
    if (x.rest == 0) return 0;
    const double y = short_sine(x.rest);
    return widened(y, std::fabs(y) * 0x1p-51 + std::numeric_limits<double>::denorm_min());
  }
  double y = quadrant % 2 == 0 ? short_sine(x.rest) : short_cosine(x.rest);
  if ((quadrant & 2) != 0) y = -y;
  const Interval r = widened(y, 5 * 0x1p-53);
  return {std::fmax(r.lo, -1.0), std::fmin(r.hi, 1.0)};
}

/// The exponential, for -708 <= x <= 709.
inline bool can_exp(double x) { return -708 <= x && x <= 709; }
inline Interval exp(double x) {
  if (x == 0) return 1;
  constexpr double kLog2E = 0x1.71547652b82fep+0;
  // log 2 in two parts: products of the first with integers below 2^11 are exact.
  constexpr double kFirst = 0x1.62e42fefa3800p-1, kSecond = 0x1.ef35793c76730p-45;
  const double k = nearest_integer(x * kLog2E);
  const double r = (x - k * kFirst) - k * kSecond;
  const double q =
      1.0 / 2 +
      r * (1.0 / 6 +
           r * (1.0 / 24 + r * (1.0 / 120 +
                                r * (1.0 / 720 +
                                     r * (1.0 / 5040 +
                                          r * (1.0 / 40320 +
                                               r * (1.0 / 362880 +
                                                    r * (1.0 / 3628800 +
                                                         r * (1.0 / 39916800 +
                                                              r * (1.0 / 479001600 +
                                                                   r * (1.0 / 6227020800)))))))))));
  const std::uint64_t bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023) << 52;
  double power;  // 2^k
  std::memcpy(&power, &bits, sizeof power);
  const double y = (1 + (r + r * r * q)) * power;
  return widened(y, y * 0x1p-51);
}

/// The logarithm of a normal positive double.
inline bool can_log(double x) {
  return std::numeric_limits<double>::min() <= x && x <= std::numeric_limits<double>::max();
}
inline Interval log(double x) {
  constexpr double kFirst = 0x1.62e42fefa3800p-1, kSecond = 0x1.ef35793c76730p-45;
  // x = 2^k m with sqrt(1/2) <= m < sqrt(2), roughly.
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  std::int64_t k = static_cast<std::int64_t>(bits >> 52) - 1023;
  bits = (bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1023} << 52);
  double m;
  std::memcpy(&m, &bits, sizeof m);
  if (m > 1.4142) {
    m *= 0.5;
    ++k;
  }
  if (k == 0 && m == 1) return 0;
  const double s = (m - 1) / (m + 1), w = s * s;
  const double q =
      1.0 / 3 +
      w * (1.0 / 5 +
           w * (1.0 / 7 + w * (1.0 / 9 + w * (1.0 / 11 +
                                              w * (1.0 / 13 +
                                                   w * (1.0 / 15 +
                                                        w * (1.0 / 17 +
                                                             w * (1.0 / 19 + w * (1.0 / 21)))))))));
  const double of_m = 2 * s + 2 * s * (w * q);
  if (k == 0) return widened(of_m, std::fabs(of_m) * (5 * 0x1p-53));
  const double scale = static_cast<double>(k);
  const double y = scale * kFirst + (scale * kSecond + of_m);
  return widened(y, std::fabs(y) * (2.5 * 0x1p-53) + 1.5 * 0x1p-53);
}

/// The arc tangent of a double that is not infinite.
inline Interval atan(double x) {
  if (x == 0) return 0;
  // Of j/8, to nearest.
  constexpr double kTable[] = {0,
                               0x1.fd5ba9aac2f6ep-4,
                               0x1.f5b75f92c80ddp-3,
                               0x1.6f61941e4def1p-2,
                               0x1.dac670561bb4fp-2,
                               0x1.1e00babdefeb4p-1,
                               0x1.4978fa3269ee1p-1,
                               0x1.700a7c5784634p-1,
                               0x1.921fb54442d18p-1};
  constexpr double kHalfPi = 0x1.921fb54442d18p+0;
  const double magnitude = std::fabs(x);
  const double t = magnitude > 1 ? 1 / magnitude : magnitude;
  const double j = nearest_integer(8 * t), c = 0.125 * j;
  const double v = (t - c) / (1 + t * c), z = v * v;
  const double q =
      -1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13)))));
  double y = kTable[static_cast<int>(j)] + (v + v * (z * q));
  if (magnitude > 1) y = kHalfPi - y;
  if (x < 0) y = -y;
  return widened(y, std::fabs(y) * (9 * 0x1p-53) + std::numeric_limits<double>::denorm_min());
}

}  // namespace encase::point
