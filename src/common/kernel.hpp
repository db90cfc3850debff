// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "encase/number.hpp"

namespace encase {

/// The precision ladder of one computation and its counters. Precision is never global: what climbs
/// the ladder takes the kernel as an argument. Not shared between threads.
struct Kernel {
  static constexpr int kDoubleBits = 53;

  int start_bits = kDoubleBits;  ///< kDoubleBits: doubles first; more: MPFR from the start
  int max_bits = 848;
  DecisionCounts decisions;
  std::int64_t expansions = 0;       ///< local expansions from the coefficients
  std::int64_t mpfr_expansions = 0;  ///< those among them in MPFR
  std::int64_t restrictions = 0;     ///< those among them on segments

  /// The precision after `bits`: 53, 106, 212, ... ; 0 when the cap is passed.
  int next(int bits) const { return 2 * bits <= max_bits ? 2 * bits : 0; }
  void count(int bits) {
    if (bits <= kDoubleBits)
      ++decisions.by_double;
    else
      ++decisions.by_mpfr;
  }
};

}  // namespace encase
