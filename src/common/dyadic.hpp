// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <optional>

#include "encase/number.hpp"

/// Rationals that are doubles, recognised by their limbs.
namespace encase {

/// The number of bits of |value|; 0 for zero.
inline long bit_length(mpz_srcptr value) {
  const long limbs = static_cast<long>(mpz_size(value));
  if (limbs == 0) return 0;
  return GMP_NUMB_BITS * (limbs - 1) + std::bit_width(mpz_limbs_read(value)[limbs - 1]);
}

/// Of a positive value.
inline bool is_power_of_two(mpz_srcptr value) {
  const mp_limb_t* limbs = mpz_limbs_read(value);
  const std::size_t top = mpz_size(value) - 1;
  return (limbs[top] & (limbs[top] - 1)) == 0 &&
         std::all_of(limbs, limbs + top, [](mp_limb_t limb) { return limb == 0; });
}

/// value * 2^exponent if that is zero or a normal double and shows it at once; nothing proves that
/// it is no double.
inline std::optional<double> quick_double(const Rational& value, long exponent = 0) {
  const mpz_srcptr numerator = value.get_num_mpz_t(), denominator = value.get_den_mpz_t();
  if (mpz_sgn(numerator) == 0) return 0.0;
  if (mpz_size(numerator) != 1 || !is_power_of_two(denominator)) return std::nullopt;
  const mp_limb_t digits = mpz_limbs_read(numerator)[0];
  exponent -= bit_length(denominator) - 1;
  // The result lies in [2^exponent, 2^(exponent + 64)).
  if (std::bit_width(digits) - std::countr_zero(digits) > 53 || std::labs(exponent) > 900)
    return std::nullopt;
  const double scale = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
  const double magnitude = static_cast<double>(digits) * scale;
  return mpz_sgn(numerator) < 0 ? -magnitude : magnitude;
}

}  // namespace encase
