// SPDX-License-Identifier: MIT
#pragma once

#include <gmpxx.h>

#include <cstdint>

namespace encase {

using Integer = mpz_class;
using Rational = mpq_class;

enum class Sign : std::int8_t { Negative = -1, Zero = 0, Positive = 1 };

constexpr Sign operator-(Sign s) { return static_cast<Sign>(-static_cast<int>(s)); }
constexpr Sign sign_of(int value) {
  return value < 0 ? Sign::Negative : value > 0 ? Sign::Positive : Sign::Zero;
}

/// The arithmetic that settled a question: doubles with a proved bound, MPFR intervals, or exact
/// rationals.
enum class Rung { Double, Mpfr, Exact };

/// How many questions each rung settled, and how many none did.
struct DecisionCounts {
  std::int64_t by_double = 0;
  std::int64_t by_mpfr = 0;
  std::int64_t by_exact = 0;
  std::int64_t undecided = 0;

  DecisionCounts& operator+=(const DecisionCounts& other) {
    by_double += other.by_double;
    by_mpfr += other.by_mpfr;
    by_exact += other.by_exact;
    undecided += other.undecided;
    return *this;
  }
};

/// The rational number written in `text`: an integer, a fraction `p/q`, or a decimal with an
/// optional exponent ("-1.25e-3"), taken exactly. False if `text` is none of these.
/// Exponents beyond 100000 in absolute value are refused.
bool parse_rational(const char* text, Rational* value);

/// The double nearest to a rational, ties to even; infinite beyond the range of doubles.
double nearest_double(const Rational& value);

}  // namespace encase
