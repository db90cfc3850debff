// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// A polynomial's value, gradient and second derivatives at a point, in doubles.
struct Jet {
  double value = 0;
  Point<2> gradient{};
  double xx = 0, xy = 0, yy = 0;
};

/// The coefficients of a polynomial in two variables, laid out for fast evaluation: those of
/// x^i y^j by rows i, each padded with zeros to whole blocks of eight.
///
/// In every function below a term c x^i y^j passes through at most `roundings(degree)` roundings.
/// Powers and the products of padding can overflow where the value does not: results that are not
/// finite say nothing.
class CoefficientRows {
 public:
  CoefficientRows() = default;
  /// From dense coefficients: that of x^i y^j at i (degree + 1) + j, zero where i + j > degree.
  CoefficientRows(const std::vector<double>& dense, int degree);

  static int roundings(int degree) { return 2 * degree + degree / 8 + 5; }

  double value(const Point<2>& at) const;
  /// The sum of the terms' absolute values at coordinates that are not negative.
  double absolute(const Point<2>& at) const;
  /// The second derivatives are left zero.
  Jet value_and_gradient(const Point<2>& at) const;
  Jet jet(const Point<2>& at) const;

  struct alignas(64) Block {
    double lane[8];
  };

 private:
  int degree_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace encase
