// SPDX-License-Identifier: MIT
#include "common/interval.hpp"

#include <mpfr.h>

#include "common/dyadic.hpp"

namespace encase {

Interval Interval::enclose(const Rational& value) {
  if (const auto exact = quick_double(value)) return *exact;
  // Doubles are among the 53-bit numbers, so rounding twice in one direction rounds once.
  mpfr_t rounded;
  mpfr_init2(rounded, 53);
  mpfr_set_q(rounded, value.get_mpq_t(), MPFR_RNDD);
  const double lo = mpfr_get_d(rounded, MPFR_RNDD);
  mpfr_set_q(rounded, value.get_mpq_t(), MPFR_RNDU);
  const double hi = mpfr_get_d(rounded, MPFR_RNDU);
  mpfr_clear(rounded);
  return {lo, hi};
}

}  // namespace encase
