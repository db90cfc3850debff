// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase::benchmark {

/// A polynomial in space of degree at most 7, its coefficients rounded to doubles: for each power
/// of z and y those of the powers of x, ascending, zeros at the end.
class PackedSpacePolynomial {
 public:
  static constexpr int kLanes = 8;
  explicit PackedSpacePolynomial(const Polynomial<3>& f);

  int degree() const { return degree_; }
  /// Rows of kLanes doubles, aligned to that, the highest powers first: z before y.
  const double* data() const { return data_; }

 private:
  int degree_;
  std::vector<double> storage_;
  const double* data_;
};

/// The least that any method based on doubles has to do for the common points of three surfaces:
/// four Newton steps at each, from a point nearby, with the values and gradients of all three
/// polynomials, one point at a time. Vectorised for the processor at hand.
void newton_steps(const std::array<PackedSpacePolynomial, 3>& f, std::vector<Point<3>>& points);

}  // namespace encase::benchmark
