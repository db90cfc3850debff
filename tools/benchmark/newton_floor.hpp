// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase::benchmark {

/// A polynomial's coefficients rounded to doubles, for each power of y those of the powers of x in
/// blocks of eight, ascending, zeros at the end.
class PackedPolynomial {
 public:
  static constexpr int kLanes = 8;
  /// Room for `degree` >= f.degree().
  PackedPolynomial(const Polynomial<2>& f, int degree);

  int degree() const { return degree_; }
  /// The blocks of the power j of y: enough for the powers of x up to degree() - j.
  int blocks(int j) const { return (degree_ - j) / kLanes + 1; }
  /// All blocks, those of the highest power of y first; aligned to kLanes doubles.
  const double* data() const { return data_; }

 private:
  int degree_;
  std::vector<double> storage_;
  const double* data_;
};

/// The least that any method based on doubles has to do for the common points of two curves: four
/// Newton steps at each, from a point nearby, with the values and gradients of both polynomials.
/// The time this takes is the benchmark's unit, the floor. Both polynomials have one degree()
/// <= 60. Vectorised for the processor at hand, one point at a time.
void newton_steps(const PackedPolynomial& f, const PackedPolynomial& g,
                  std::vector<Point<2>>& points);

/// The same for eight points at a time, what they cost where there are many.
void newton_steps_together(const PackedPolynomial& f, const PackedPolynomial& g,
                           std::vector<Point<2>>& points);

}  // namespace encase::benchmark
