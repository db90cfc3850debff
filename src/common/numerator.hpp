// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/expression.hpp"

namespace encase {

/// An expression f without its quotients: where none of the divisors is zero, f is the numerator
/// divided by a function without zeros, so that both have the same zeros there, and f has a value
/// if and only if the numerator has one. Elsewhere f has no value.
struct Numerator {
  Expression numerator;
  std::vector<Expression> divisors;  ///< that are no constants
};

/// Sums, products, integer powers, quotients and tangents are brought over one denominator; what
/// stands within other functions is kept as it is. Without divisors the numerator is f. Cost: some
/// operations for each of f; an f with too many divisors is kept as it is.
Numerator numerator_of(const Expression& f);

}  // namespace encase
