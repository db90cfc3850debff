// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
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
/// exponents and non-zero coefficients, in ascending lexicographic order of the exponents. A value:
/// copies share the terms, which never change.
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

  const std::vector<Term>& terms() const;
  bool is_zero() const { return !shared_; }
  bool is_constant() const { return degree() <= 0; }
  /// Total degree; -1 for zero.
  int degree() const { return shared_ ? shared_->degree : -1; }
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
  bool operator==(const Polynomial& other) const {
    return shared_ == other.shared_ || terms() == other.terms();
  }

  /// A text the parser reads back to the same polynomial, in x, y, z; highest terms first.
  std::string to_string() const;

 private:
  /// Takes terms that are as they shall be.
  static Polynomial from_ordered(std::vector<Term> terms);

  struct Shared {
    std::vector<Term> terms;
    int degree = 0;
  };
  std::shared_ptr<const Shared> shared_;  ///< none for zero
};

extern template class Polynomial<1>;
extern template class Polynomial<2>;
extern template class Polynomial<3>;

}  // namespace encase
