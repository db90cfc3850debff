// SPDX-License-Identifier: MIT
#pragma once

#include <cfloat>
#include <cstdint>
#include <limits>

#include "encase/number.hpp"

namespace encase {

// What the error bounds assume of doubles: IEEE arithmetic without excess precision (as with the
// x87) and without fast-math. Rounding to nearest is assumed too, and contraction must be off.
static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0);

/// The precision ladder of one computation and its counters. Precision is never global: what climbs
/// the ladder takes the kernel as an argument. Not shared between threads: each task has its own.
struct Kernel {
  static constexpr int kDoubleBits = 53;
  /// The processor's extended format where it has one (x87), a quick step before MPFR.
  static constexpr int kExtendedBits = 64;
  static constexpr bool kHasExtended = std::numeric_limits<long double>::digits == kExtendedBits;

  static constexpr bool is_mpfr(int bits) {
    return bits > kDoubleBits && !(kHasExtended && bits == kExtendedBits);
  }

  int start_bits = kDoubleBits;  ///< kDoubleBits: doubles first; more: MPFR from the start
  int max_bits = 848;
  DecisionCounts decisions;
  std::int64_t expansions = 0;       ///< local expansions from the coefficients
  std::int64_t mpfr_expansions = 0;  ///< those among them in MPFR
  std::int64_t restrictions = 0;     ///< those among them on segments

  /// The precision after `bits`: 53, 64, 106, 212, ... ; 0 when the cap is passed.
  int next(int bits) const {
    int following = 2 * bits;
    if (bits == kDoubleBits && kHasExtended) following = kExtendedBits;
    if (bits == kExtendedBits && kHasExtended) following = 2 * kDoubleBits;
    return following <= max_bits ? following : 0;
  }
  void count(int bits) {
    if (!is_mpfr(bits))
      ++decisions.by_double;
    else
      ++decisions.by_mpfr;
  }

  /// The same ladder, with counters at zero.
  Kernel fresh() const {
    Kernel kernel;
    kernel.start_bits = start_bits;
    kernel.max_bits = max_bits;
    return kernel;
  }
  /// Adds what another one has counted.
  void add(const Kernel& other) {
    decisions += other.decisions;
    expansions += other.expansions;
    mpfr_expansions += other.mpfr_expansions;
    restrictions += other.restrictions;
  }
};

}  // namespace encase
