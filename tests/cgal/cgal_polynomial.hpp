// SPDX-License-Identifier: MIT
#pragma once

#include <CGAL/Polynomial_traits_d.h>

#include <utility>
#include <vector>

#include "encase/polynomial.hpp"

/// The polynomial times the least common denominator of its coefficients, as one of CGAL's.
template <class CgalPolynomial, class Coefficient>
CgalPolynomial with_integer_coefficients(const encase::Polynomial<2>& f) {
  encase::Integer denominator = 1;
  for (const auto& term : f.terms())
    mpz_lcm(denominator.get_mpz_t(), denominator.get_mpz_t(),
            term.coefficient.get_den().get_mpz_t());
  std::vector<std::pair<CGAL::Exponent_vector, Coefficient>> terms;
  for (const auto& term : f.terms()) {
    const encase::Integer c =
        term.coefficient.get_num() * (denominator / term.coefficient.get_den());
    terms.emplace_back(CGAL::Exponent_vector(term.exponent[0], term.exponent[1]),
                       Coefficient(c.get_str()));
  }
  using Construct = typename CGAL::Polynomial_traits_d<CgalPolynomial>::Construct_polynomial;
  return Construct()(terms.begin(), terms.end());
}
