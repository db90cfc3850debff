// SPDX-License-Identifier: MIT
#pragma once

#include "encase/polynomial.hpp"

namespace encase {

/// The least common multiple of the denominators of a polynomial's coefficients.
template <int D>
Integer common_denominator(const Polynomial<D>& f) {
  Integer common = 1;
  for (const auto& term : f.terms())
    mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), term.coefficient.get_den_mpz_t());
  return common;
}

/// A coefficient times a multiple of its denominator.
inline Integer scaled(const Rational& coefficient, const Integer& multiple) {
  return coefficient.get_num() * (multiple / coefficient.get_den());
}

}  // namespace encase
