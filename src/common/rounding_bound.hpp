// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace encase {

/// What errors are in sums of products of coefficients and coordinates: if each product passes
/// through at most m roundings, the computed sum errs by at most gamma_m times the same sum of
/// absolute values (Higham, Accuracy and Stability, section 3.1), gamma_m = m u / (1 - m u). The
/// counts m are derived in docs/error-bounds.md.
///
/// gamma_m for MPFR or double arithmetic with the given precision, rounded up. Beyond 1000 bits it
/// would come near what underflows; 1000 are claimed then.
inline double gamma(int roundings, int bits) {
  return 1.01 * roundings * std::ldexp(1.0, -std::min(bits, 1000));
}

}  // namespace encase
