// SPDX-License-Identifier: MIT
#include "encase/number.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "common/dyadic.hpp"
#include "common/interval.hpp"

namespace encase {

namespace {

constexpr long kMaxExponent = 100000;

bool is_digit(char c) { return '0' <= c && c <= '9'; }

const char* skip_digits(const char* p, std::string* digits) {
  while (is_digit(*p)) digits->push_back(*p++);
  return p;
}

}  // namespace

bool parse_rational(const char* text, Rational* value) {
  const char* p = text;
  const bool negative = *p == '-';
  if (*p == '-' || *p == '+') ++p;
  std::string digits;
  p = skip_digits(p, &digits);

  if (*p == '/') {
    std::string denominator;
    p = skip_digits(p + 1, &denominator);
    if (*p != '\0' || digits.empty() || denominator.empty()) return false;
    const Integer q(denominator, 10);
    if (q == 0) return false;
    *value = Rational(Integer(digits, 10), q);
    value->canonicalize();
    if (negative) *value = -*value;
    return true;
  }

  long exponent = 0;
  if (*p == '.') {
    const std::size_t integer_digits = digits.size();
    p = skip_digits(p + 1, &digits);
    exponent = -static_cast<long>(digits.size() - integer_digits);
  }
  if (digits.empty()) return false;
  if (*p == 'e' || *p == 'E') {
    ++p;
    const bool negative_exponent = *p == '-';
    if (*p == '-' || *p == '+') ++p;
    if (!is_digit(*p)) return false;
    long written = 0;
    for (; is_digit(*p); ++p)
      if ((written = 10 * written + (*p - '0')) > kMaxExponent) return false;
    exponent += negative_exponent ? -written : written;
  }
  if (*p != '\0') return false;

  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::labs(exponent)));
  const Integer mantissa(digits, 10);
  *value = exponent >= 0 ? Rational(mantissa * power) : Rational(mantissa, power);
  value->canonicalize();
  if (negative) *value = -*value;
  return true;
}

double nearest_double(const Rational& value) {
  if (const auto exact = quick_double(value)) return *exact;
  const Interval around = Interval::enclose(value);
  if (around.lo == around.hi) return around.lo;
  constexpr double kMax = std::numeric_limits<double>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // 2^1024 takes the place of infinity as the neighbour of the largest double.
  const Rational beyond = Rational(kMax) + Rational(0x1p971);
  const Rational lo = around.lo == -kInfinity ? Rational(-beyond) : Rational(around.lo);
  const Rational hi = around.hi == kInfinity ? beyond : Rational(around.hi);
  const int side = cmp(Rational(2 * value), Rational(lo + hi));
  if (side != 0) return side < 0 ? around.lo : around.hi;
  if (std::isinf(around.lo)) return around.lo;
  if (std::isinf(around.hi)) return around.hi;
  // A tie: the neighbours are consecutive multiples of their distance, and the even one is taken.
  const double multiple = std::fabs(around.lo) / (around.hi - around.lo);
  return std::fmod(multiple, 2.0) == 0 ? around.lo : around.hi;
}

}  // namespace encase
