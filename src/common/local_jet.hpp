// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "encase/expression.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// A value with all first and second derivatives, in doubles and without error bounds: what follows
/// for a function's from its operands'.
template <int D>
struct LocalJet {
  double value = 0;
  Point<D> gradient{};
  std::array<Point<D>, D> hessian{};

  /// g of this, from the value, the first and the second derivative of g.
  LocalJet composed(double g, double slope, double bend) const {
    LocalJet r;
    r.value = g;
    for (std::size_t i = 0; i < D; ++i) {
      r.gradient[i] = slope * gradient[i];
      for (std::size_t k = 0; k < D; ++k)
        r.hessian[i][k] = slope * hessian[i][k] + bend * gradient[i] * gradient[k];
    }
    return r;
  }
  /// This plus a multiple of b.
  LocalJet plus(double factor, const LocalJet& b) const {
    LocalJet r = *this;
    r.value += factor * b.value;
    for (std::size_t i = 0; i < D; ++i) {
      r.gradient[i] += factor * b.gradient[i];
      for (std::size_t k = 0; k < D; ++k) r.hessian[i][k] += factor * b.hessian[i][k];
    }
    return r;
  }
  LocalJet times(const LocalJet& b) const {
    LocalJet r;
    r.value = value * b.value;
    for (std::size_t i = 0; i < D; ++i) {
      r.gradient[i] = value * b.gradient[i] + b.value * gradient[i];
      for (std::size_t k = 0; k < D; ++k)
        r.hessian[i][k] = value * b.hessian[i][k] + b.value * hessian[i][k] +
                          gradient[i] * b.gradient[k] + gradient[k] * b.gradient[i];
    }
    return r;
  }
  LocalJet inverse() const {
    const double w = 1 / value;
    return composed(w, -w * w, 2 * w * w * w);
  }
  /// Of an operation with one operand, this; `exponent` is that of a power.
  LocalJet of(Operation operation, int exponent) const;
};

}  // namespace encase
