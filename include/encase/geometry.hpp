// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>

#include "encase/number.hpp"

namespace encase {

template <int D>
using Point = std::array<double, D>;

template <int D>
using RationalPoint = std::array<Rational, D>;

/// The closed box lo[0] <= x_0 <= hi[0], ... with finite double bounds.
template <int D>
struct Box {
  Point<D> lo{};
  Point<D> hi{};

  double width(int axis) const { return hi[axis] - lo[axis]; }
  Point<D> center() const {
    Point<D> c;
    for (int i = 0; i < D; ++i) c[i] = lo[i] + 0.5 * (hi[i] - lo[i]);
    return c;
  }
  double largest_width() const {
    double w = 0;
    for (int i = 0; i < D; ++i) w = w < width(i) ? width(i) : w;
    return w;
  }
  bool contains(const Point<D>& p) const {
    for (int i = 0; i < D; ++i)
      if (!(lo[i] <= p[i] && p[i] <= hi[i])) return false;
    return true;
  }
  bool contains(const Box& b) const { return contains(b.lo) && contains(b.hi); }
  /// Whether the closed boxes share a point.
  bool meets(const Box& b) const {
    for (int i = 0; i < D; ++i)
      if (!(lo[i] <= b.hi[i] && b.lo[i] <= hi[i])) return false;
    return true;
  }
  bool operator==(const Box&) const = default;
};

/// The smallest box that contains both.
template <int D>
Box<D> hull(Box<D> a, const Box<D>& b) {
  for (int i = 0; i < D; ++i) {
    if (b.lo[i] < a.lo[i]) a.lo[i] = b.lo[i];
    if (b.hi[i] > a.hi[i]) a.hi[i] = b.hi[i];
  }
  return a;
}

/// The oriented hyperplane normal . x + offset = 0; its negative side is normal . x + offset < 0.
///
/// A splitting hyperplane's doubles are its exact coefficients. A side of the user's region may
/// have rational coefficients: then `rational` holds them (normal, then offset) and the doubles are
/// those coefficients rounded to nearest.
template <int D>
struct Hyperplane {
  Point<D> normal{};
  double offset = 0;
  std::shared_ptr<const std::array<Rational, D + 1>> rational;

  static Hyperplane from_rationals(const std::array<Rational, D + 1>& coefficients);
  /// The exact coefficients: normal, then offset.
  std::array<Rational, D + 1> exact() const;
};

using Line = Hyperplane<2>;

/// The coordinate (0: x, 1: y) by which a line is parametrised.
inline int parameter_axis(const Line& line) {
  const double a = line.normal[0] < 0 ? -line.normal[0] : line.normal[0];
  const double b = line.normal[1] < 0 ? -line.normal[1] : line.normal[1];
  return b >= a ? 0 : 1;
}

extern template struct Hyperplane<1>;
extern template struct Hyperplane<2>;
extern template struct Hyperplane<3>;

}  // namespace encase
