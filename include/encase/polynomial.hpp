// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/number.hpp"

namespace encase {

template <int D>
using Exponent = std::array<int, D>;

/// The largest total degree Encase accepts.
inline constexpr int kMaxDegree = 60;

/// An exact polynomial in D variables with rational coefficients: a sum of terms with different
/// exponents and non-zero coefficients, in ascending lexicographic order of the exponents.
template <int D>
class Polynomial {
 public:
  struct Term {
    Exponent<D> exponent;
    Rational coefficient;
    bool operator==(const Term&) const = default;
  };

  Polynomial() = default;
  /// Adds up terms of equal exponents and drops what cancels. Exponents are not negative.
  static Polynomial from_terms(std::vector<Term> terms);
  static Polynomial constant(const Rational& value);
  static Polynomial variable(int axis);

  const std::vector<Term>& terms() const { return terms_; }
  bool is_zero() const { return terms_.empty(); }
  bool is_constant() const { return degree() <= 0; }
  /// Total degree; -1 for zero.
  int degree() const;
  /// Degree in one variable; -1 for zero.
  int degree(int axis) const;

  Polynomial operator-() const;
  Polynomial operator+(const Polynomial& other) const;
  Polynomial operator-(const Polynomial& other) const;
  Polynomial operator*(const Polynomial& other) const;
  /// This to the power of `exponent` >= 0.
  Polynomial power(int exponent) const;
  Polynomial derivative(int axis) const;
  Rational operator()(const RationalPoint<D>& point) const;
  bool operator==(const Polynomial&) const = default;

  /// A text the parser reads back to the same polynomial, in x, y, z; highest terms first.
  std::string to_string() const;

 private:
  std::vector<Term> terms_;
};

extern template class Polynomial<1>;
extern template class Polynomial<2>;
extern template class Polynomial<3>;

}  // namespace encase
