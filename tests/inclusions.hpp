// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "common/interval.hpp"
#include "encase/inclusion_function.hpp"

/// Inclusion functions written with intervals of values, gradients and Hessian matrices.
namespace encase::inclusions {

template <int D>
struct Jet {
  Interval value;
  std::array<Interval, D> gradient{};
  std::array<std::array<Interval, D>, D> hessian{};

  Jet() = default;
  Jet(double constant) : value(constant) {}

  /// g of this, from ranges of the value and the first two derivatives of g.
  Jet composed(const Interval& g, const Interval& slope, const Interval& bend) const {
    Jet r;
    r.value = g;
    for (std::size_t i = 0; i < D; ++i) {
      r.gradient[i] = slope * gradient[i];
      for (std::size_t k = 0; k < D; ++k)
        r.hessian[i][k] = slope * hessian[i][k] + bend * (gradient[i] * gradient[k]);
    }
    return r;
  }
};

template <int D>
Jet<D> operator+(const Jet<D>& a, const Jet<D>& b) {
  Jet<D> r;
  r.value = a.value + b.value;
  for (std::size_t i = 0; i < D; ++i) {
    r.gradient[i] = a.gradient[i] + b.gradient[i];
    for (std::size_t k = 0; k < D; ++k) r.hessian[i][k] = a.hessian[i][k] + b.hessian[i][k];
  }
  return r;
}
template <int D>
Jet<D> operator-(const Jet<D>& a) {
  return a.composed(-a.value, -1, 0);
}
template <int D>
Jet<D> operator-(const Jet<D>& a, const Jet<D>& b) {
  return a + (-b);
}
template <int D>
Jet<D> operator*(const Jet<D>& a, const Jet<D>& b) {
  Jet<D> r;
  r.value = a.value * b.value;
  for (std::size_t i = 0; i < D; ++i) {
    r.gradient[i] = a.value * b.gradient[i] + b.value * a.gradient[i];
    for (std::size_t k = 0; k < D; ++k)
      r.hessian[i][k] = a.value * b.hessian[i][k] + b.value * a.hessian[i][k] +
                        a.gradient[i] * b.gradient[k] + a.gradient[k] * b.gradient[i];
  }
  return r;
}
template <int D>
Jet<D> operator+(const Jet<D>& a, double b) {
  return a + Jet<D>(b);
}
template <int D>
Jet<D> operator-(const Jet<D>& a, double b) {
  return a - Jet<D>(b);
}
template <int D>
Jet<D> operator*(double a, const Jet<D>& b) {
  return Jet<D>(a) * b;
}
template <int D>
Jet<D> square(const Jet<D>& a) {
  Interval value = a.value * a.value;
  if (a.value.lo <= 0 && a.value.hi >= 0) value.lo = 0;
  return a.composed(value, Interval(2) * a.value, 2);
}
/// (glibc's exponential errs by less than a unit in the last place.)
template <int D>
Jet<D> exp(const Jet<D>& a) {
  const Interval e(round_down(std::exp(a.value.lo)), round_up(std::exp(a.value.hi)));
  return a.composed(e, e, e);
}

template <int D>
using Written = std::function<Jet<D>(const std::array<Jet<D>, D>&)>;

/// The inclusion function of what is written as an expression in the coordinates.
template <int D>
InclusionFunction<D> of(Written<D> f) {
  return [f = std::move(f)](const Box<D>& box) {
    std::array<Jet<D>, D> x;
    for (std::size_t i = 0; i < D; ++i) {
      x[i].value = {box.lo[i], box.hi[i]};
      x[i].gradient[i] = 1;
    }
    const Jet<D> jet = f(x);
    const auto closed = [](const Interval& a) { return ClosedInterval{a.lo, a.hi}; };
    Enclosure<D> result;
    result.value = closed(jet.value);
    for (std::size_t i = 0; i < D; ++i) {
      result.gradient[i] = closed(jet.gradient[i]);
      for (std::size_t k = 0; k < D; ++k) result.hessian[i][k] = closed(jet.hessian[i][k]);
    }
    return result;
  };
}

using Coordinates = std::array<Jet<3>, 3>;

/// x^2 + y^2 + z^2 - 1
inline InclusionFunction<3> sphere() {
  return of<3>([](const Coordinates& x) { return square(x[0]) + square(x[1]) + square(x[2]) - 1; });
}

/// (x^2 + y^2 + z^2 + 3/4)^2 - 4 (x^2 + y^2): radii 1 and 1/2.
inline InclusionFunction<3> torus() {
  return of<3>([](const Coordinates& x) {
    const Jet<3> r = square(x[0]) + square(x[1]);
    return square(r + square(x[2]) + 0.75) - 4 * r;
  });
}

/// exp(-4 |p - c|^2) + exp(-4 |p + c|^2) - 3/8, c = (1/2, 0, 0).
inline InclusionFunction<3> drops() {
  return of<3>([](const Coordinates& x) {
    const Jet<3> r = square(x[1]) + square(x[2]);
    return exp(-4.0 * (square(x[0] - 0.5) + r)) + exp(-4.0 * (square(x[0] + 0.5) + r)) - 0.375;
  });
}

}  // namespace encase::inclusions
