// SPDX-License-Identifier: MIT
#pragma once

#include "common/filtered_polynomial.hpp"

/// Approximate values and derivatives, for heuristics.
namespace encase {

struct ValueAndGradient {
  double value;
  Point<2> gradient;
};

inline ValueAndGradient value_and_gradient(const FilteredPolynomial<2>& f, const Point<2>& at) {
  return {f.approximate(at), f.gradient(at)};
}

struct SecondOrder {
  double value, x, y, xx, xy, yy;
};

/// All derivatives up to the second order.
class SecondOrderJets {
 public:
  explicit SecondOrderJets(const FilteredPolynomial<2>& f)
      : f_(f), x_(f.exact().derivative(0)), y_(f.exact().derivative(1)) {
    // Each polynomial is scaled on its own.
    x_scale_ = x_.scale() / f.scale();
    y_scale_ = y_.scale() / f.scale();
  }
  SecondOrder at(const Point<2>& point) const {
    const Point<2> x = x_.gradient(point), y = y_.gradient(point), g = f_.gradient(point);
    return {f_.approximate(point), g[0], g[1], x[0] * x_scale_, x[1] * x_scale_, y[1] * y_scale_};
  }

 private:
  const FilteredPolynomial<2>& f_;
  FilteredPolynomial<2> x_, y_;
  double x_scale_, y_scale_;
};

}  // namespace encase
