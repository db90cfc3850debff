// SPDX-License-Identifier: MIT
#include "common/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/mpfr_interval.hpp"
#include "common/mpfr_number.hpp"

namespace encase {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();

struct Kernel {
  const char* name;
  Interval (*in_doubles)(const Interval&);
  int (*in_mpfr)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
  double lo, hi;    ///< arguments
  double relative;  ///< allowed width of an enclosure at a point, relative to the value
  double absolute;  ///< and absolute
};

Regularity regularity;
Interval enclosed_sqrt(const Interval& a) { return elementary::sqrt(a, regularity); }
Interval enclosed_log(const Interval& a) { return elementary::log(a, regularity); }
Interval enclosed_tan(const Interval& a) { return elementary::tan(a, regularity); }
Interval enclosed_asin(const Interval& a) { return elementary::asin(a, regularity); }
Interval enclosed_acos(const Interval& a) { return elementary::acos(a, regularity); }

const Kernel kKernels[] = {
    {"sqrt", enclosed_sqrt, mpfr_sqrt, 0, kInfinity, 0x1p-50, 0},
    {"exp", elementary::exp, mpfr_exp, -800, 800, 0x1p-49, 0x1p-1070},
    {"log", enclosed_log, mpfr_log, 0, kInfinity, 0x1p-49, 0x1p-51},
    {"sin", elementary::sin, mpfr_sin, -kInfinity, kInfinity, 0x1p-49, 0x1p-49},
    {"cos", elementary::cos, mpfr_cos, -kInfinity, kInfinity, 0, 0x1p-49},
    {"tan", enclosed_tan, mpfr_tan, -1.5, 1.5, 0x1p-45, 0x1p-48},
    {"asin", enclosed_asin, mpfr_asin, -1, 1, 0x1p-47, 0},
    {"acos", enclosed_acos, mpfr_acos, -1, 1, 0x1p-47, 0},
    {"atan", elementary::atan, mpfr_atan, -kInfinity, kInfinity, 0x1p-48, kTiny},
    {"sinh", elementary::sinh, mpfr_sinh, -800, 800, 0x1p-47, 0x1p-1070},
    {"cosh", elementary::cosh, mpfr_cosh, -800, 800, 0x1p-48, 0},
    {"tanh", elementary::tanh, mpfr_tanh, -800, 800, 0x1p-46, 0x1p-1070},
};

/// Doubles of all magnitudes, near zero, near multiples of pi/2 and 1/8, and the largest and least.
double random_argument(const Kernel& kernel, std::mt19937_64& generator) {
  const double t = static_cast<double>(generator() >> 11) * 0x1p-53;
  const double sign = generator() % 2 == 0 ? 1 : -1;
  double x = 0;
  switch (generator() % 20) {
    case 0:
      x = sign * std::ldexp(1 + t, static_cast<int>(generator() % 2100) - 1075);
      break;
    case 1:
      x = sign * std::ldexp(1 + t, static_cast<int>(generator() % 80) - 60);
      break;
    case 2: {
      // A few doubles beside a multiple of pi/2 or 1/8.
      const double step = generator() % 2 == 0 ? 1.5707963267948966 : 0.125;
      x = sign * step * static_cast<double>(generator() % (1 << (generator() % 22)));
      for (int k = static_cast<int>(generator() % 4); k > 0; --k) x = std::nextafter(x, kInfinity);
      break;
    }
    case 3:
      x = 1400 * (t - 0.5);
      break;
    default:
      x = 8 * (t - 0.5);
  }
  if (kernel.lo == -1) x = std::remainder(x, 2);
  if (kernel.lo == 0) x = std::fabs(x);
  if (kernel.lo == -1.5) x = std::remainder(x, 3);
  return std::clamp(x, std::max(kernel.lo, -0x1p1000), std::min(kernel.hi, 0x1p1000));
}

TEST(Elementary, EnclosuresAtPointsHoldWhatMpfrFindsAndAreTight) {
  std::mt19937_64 generator(1);
  Mpfr value(120);
  mpfr_t argument;
  mpfr_init2(argument, 53);
  for (const Kernel& kernel : kKernels) {
    double widest = 0;
    for (int round = 0; round < 100000; ++round) {
      const double x = random_argument(kernel, generator);
      mpfr_set_d(argument, x, MPFR_RNDN);
      kernel.in_mpfr(value.get(), argument, MPFR_RNDN);
      if (!mpfr_number_p(value.get())) continue;
      const Interval found = kernel.in_doubles(x);
      ASSERT_TRUE(mpfr_cmp_d(value.get(), found.lo) >= 0 && mpfr_cmp_d(value.get(), found.hi) <= 0)
          << kernel.name << " of " << std::hexfloat << x << ": " << found.lo << ", " << found.hi;
      const double near = std::fabs(mpfr_get_d(value.get(), MPFR_RNDN));
      if (std::isinf(near) || std::isinf(found.hi)) continue;
      const double allowed = kernel.relative * near + kernel.absolute + 4 * kTiny;
      widest = std::max(widest, (found.hi - found.lo) / allowed);
      ASSERT_LE(found.hi - found.lo, allowed) << kernel.name << " of " << std::hexfloat << x;
    }
    // What is allowed is not a multiple of what is used.
    EXPECT_GT(widest, 0.2) << kernel.name;
  }
  mpfr_clear(argument);
}

TEST(Elementary, EnclosuresOnIntervalsHoldValuesBetween) {
  std::mt19937_64 generator(2);
  Mpfr value(120);
  mpfr_t argument;
  mpfr_init2(argument, 53);
  for (const Kernel& kernel : kKernels)
    for (int round = 0; round < 50000; ++round) {
      double a = random_argument(kernel, generator), b = random_argument(kernel, generator);
      if (round % 2 == 0) b = a + (b - a) * 0x1p-10;
      if (a > b) std::swap(a, b);
      const double t = static_cast<double>(generator() >> 11) * 0x1p-53;
      const double x = std::clamp(a + t * (b - a), a, b);
      mpfr_set_d(argument, x, MPFR_RNDN);
      kernel.in_mpfr(value.get(), argument, MPFR_RNDN);
      if (!mpfr_number_p(value.get())) continue;
      const Interval whole = kernel.in_doubles({a, b});
      ASSERT_TRUE(mpfr_cmp_d(value.get(), whole.lo) >= 0 && mpfr_cmp_d(value.get(), whole.hi) <= 0)
          << kernel.name << " on " << std::hexfloat << a << ", " << b << " at " << x;
    }
  mpfr_clear(argument);
}

TEST(Elementary, ExtremaOfWavesAreFound) {
  const double half_pi = 1.5707963267948966;
  for (int k = -50; k <= 50; ++k) {
    const Interval around(k * half_pi - 0.1, k * half_pi + 0.1);
    const Interval s = elementary::sin(around), c = elementary::cos(around);
    const int phase = ((k % 4) + 4) % 4;
    EXPECT_EQ(s.hi == 1, phase == 1) << k;
    EXPECT_EQ(s.lo == -1, phase == 3) << k;
    EXPECT_EQ(c.hi == 1, phase == 0) << k;
    EXPECT_EQ(c.lo == -1, phase == 2) << k;
    Regularity tangent = Regularity::Smooth;
    elementary::tan(around, tangent);
    EXPECT_EQ(tangent == Regularity::Smooth, k % 2 == 0) << k;
  }
  for (const Interval& wide : {Interval(0, 7), Interval(-kInfinity, 3), Interval(1e300, 2e300)}) {
    EXPECT_EQ(elementary::sin(wide).lo, -1);
    EXPECT_EQ(elementary::cos(wide).hi, 1);
  }
}

TEST(Elementary, WhatIsExactStaysExact) {
  const auto is = [](const Interval& a, double value) { return a.lo == value && a.hi == value; };
  EXPECT_TRUE(is(elementary::sin(0), 0));
  EXPECT_TRUE(is(elementary::exp(0), 1));
  EXPECT_TRUE(is(enclosed_log(1), 0));
  EXPECT_TRUE(is(elementary::atan(0), 0));
  EXPECT_TRUE(is(elementary::sinh(0), 0));
  EXPECT_TRUE(is(enclosed_sqrt(2.25), 1.5));
  EXPECT_TRUE(is(elementary::add(0.5, 0.25), 0.75));
  EXPECT_TRUE(is(elementary::subtract(1e300, 1e300), 0));
  EXPECT_TRUE(is(elementary::multiply(0, {-kInfinity, kInfinity}), 0));
}

struct Domain {
  Interval (*function)(const Interval&, Regularity&);
  Interval argument, range;
  Regularity regularity;
};

TEST(Elementary, DomainsEndWhereTheyEnd) {
  using R = Regularity;
  const auto reciprocal = [](const Interval& a, R& r) { return elementary::divide(1, a, r); };
  const auto inverse_square = [](const Interval& a, R& r) { return elementary::power(a, -2, r); };
  const auto zero_over = [](const Interval& a, R& r) { return elementary::divide(0, a, r); };
  const Interval line(-kInfinity, kInfinity);
  const double quarter = 1.5707963267948966;
  for (const Domain& d : std::initializer_list<Domain>{
           {reciprocal, {-1, 2}, line, R::Unproved},
           {reciprocal, {0, 2}, {0.5, kInfinity}, R::Unproved},
           {reciprocal, {-2, 0}, {-kInfinity, -0.5}, R::Unproved},
           {reciprocal, {0, 0}, line, R::Nowhere},
           {reciprocal, {2, 4}, {0.25, 0.5}, R::Smooth},
           {reciprocal, {2, kInfinity}, {0, 0.5}, R::Smooth},
           {zero_over, {-1, 1}, {0, 0}, R::Unproved},
           {inverse_square, {-1, 2}, {0.25, kInfinity}, R::Unproved},
           {inverse_square, {0, 0}, line, R::Nowhere},
           {elementary::sqrt, {-1, 4}, {0, 2}, R::Unproved},
           {elementary::sqrt, {0, 4}, {0, 2}, R::Continuous},
           {elementary::sqrt, {1, 4}, {1, 2}, R::Smooth},
           {elementary::sqrt, {0, kInfinity}, {0, kInfinity}, R::Continuous},
           {elementary::sqrt, {-2, -1}, line, R::Nowhere},
           {elementary::log, {0, 1}, {-kInfinity, 0}, R::Unproved},
           {elementary::log, {-1, 0}, line, R::Nowhere},
           {elementary::log, {1, kInfinity}, {0, kInfinity}, R::Smooth},
           {elementary::asin, {-2, 2}, {-quarter, quarter}, R::Unproved},
           {elementary::asin, {-1, 0}, {-quarter, 0}, R::Continuous},
           {elementary::asin, {-0.5, 0}, {-0.52359877559829887, 0}, R::Smooth},
           {elementary::asin, {1.5, 2}, line, R::Nowhere},
           {elementary::acos, {-2, 2}, {0, 2 * quarter}, R::Unproved},
           {elementary::acos, {-3, -2}, line, R::Nowhere},
           {elementary::tan, {1, 2}, line, R::Unproved},
           {elementary::tan, {-kInfinity, 2}, line, R::Unproved},
           {elementary::abs, {-1, 2}, {0, 2}, R::Continuous},
           {elementary::abs, {-2, -1}, {1, 2}, R::Smooth},
       }) {
    R found = R::Smooth;
    const Interval range = d.function(d.argument, found);
    EXPECT_EQ(found, d.regularity) << d.argument.lo << ", " << d.argument.hi;
    const auto near = [](double a, double b) {
      return a == b || std::fabs(a - b) <= 1e-14 * std::fabs(b) || std::fabs(a - b) <= 1e-320;
    };
    EXPECT_TRUE(near(range.lo, d.range.lo) && near(range.hi, d.range.hi))
        << range.lo << ", " << range.hi << " instead of " << d.range.lo << ", " << d.range.hi;
    EXPECT_TRUE(range.lo <= d.range.lo && d.range.hi <= range.hi);
  }
}

}  // namespace
}  // namespace encase
