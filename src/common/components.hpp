// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/polynomial.hpp"

/// Exact algebra: repeated and shared components of curves, resultants, and the real roots of
/// polynomials in one variable. Verification and diagnosis use it; the search does not.
namespace encase {

/// A non-constant square-free polynomial, and the inputs that are divisible by it.
template <int D>
struct BaseElement {
  struct Source {
    int index = -1;
    int multiplicity = 0;
    bool operator==(const Source&) const = default;
  };
  Polynomial<D> polynomial;
  std::vector<Source> sources;  ///< ascending in index
};

/// Square-free, pairwise coprime polynomials of which every input is, up to a constant, the product
/// of the powers named by `sources`. Each is the product of all irreducible factors that divide the
/// same inputs equally often, so an input without repeated or shared factors is one element, and
/// that element is the input unchanged. Zero and constant inputs contribute nothing. In the order
/// of the inputs that first contain them.
///
/// Cost: without repeated and shared factors nearly always one restriction to a line modulo a prime
/// for each input and one gcd modulo that prime for each pair; else gcds of the polynomials.
std::vector<BaseElement<2>> coprime_square_free_base(const std::vector<Polynomial<2>>& inputs);
std::vector<BaseElement<3>> coprime_square_free_base(const std::vector<Polynomial<3>>& inputs);

/// The resultant of f and g with respect to the variable `eliminated_axis`, as a polynomial in the
/// other one: zero if and only if f and g share a component that contains the eliminated variable.
/// Neither may be zero. Computed modulo word-sized primes; the cost grows with the product of the
/// degrees squared times the bits of the result's coefficients.
Polynomial<1> resultant(const Polynomial<2>& f, const Polynomial<2>& g, int eliminated_axis);

/// The greatest common divisor, with coprime integer coefficients and a positive leading one; zero
/// if both are zero.
Polynomial<1> gcd(const Polynomial<1>& f, const Polynomial<1>& g);

/// The product of the distinct irreducible factors, normalised like `gcd`; f must not be zero.
Polynomial<1> square_free_part(const Polynomial<1>& f);

/// The number of distinct real roots of f, which is not zero, in the closed interval [lo, hi].
/// By Descartes' rule of signs and bisection in integers.
int count_real_roots(const Polynomial<1>& f, const Rational& lo, const Rational& hi);

}  // namespace encase
