// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/expression.hpp"

namespace encase {

/// An expression f without its quotients. Where all divisors have values and none of these is zero,
/// f is the numerator divided by a product of divisors: both have values at the same points and the
/// same zeros. Elsewhere f has no value.
struct Numerator {
  Expression numerator;
  std::vector<Expression> divisors;  ///< that are no constants
};

/// Sums, products, integer powers, quotients and tangents are brought over one denominator; what
/// stands within other functions is kept as it is. Without divisors the numerator is f. Cost: some
/// operations for each of f; an f with too many divisors is kept as it is.
Numerator numerator_of(const Expression& f);

}  // namespace encase
