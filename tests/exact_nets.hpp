// SPDX-License-Identifier: MIT
//
// Polynomials in rational arithmetic, to compare the nets of boxes with.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/random_polynomials.hpp"
#include "encase/geometry.hpp"

namespace encase {

using Random = std::mt19937_64;

/// A value, first and second derivatives.
struct Jet2 {
  Rational value, x, y, xx, yy, xy;
};

inline Polynomial<2> random_polynomial(int degree, Random& random) {
  std::vector<Polynomial<2>::Term> terms;
  for (const auto& e : dense_exponents<2>(degree))
    terms.push_back({e, Rational(symmetric_random(random))});
  return Polynomial<2>::from_terms(std::move(terms));
}

/// Bernstein's polynomials of a degree at u, exactly, or their derivatives with respect to s in
/// [-1,1], u = (s + 1) / 2.
inline std::vector<Rational> basis(int degree, const Rational& u, int derivative) {
  std::vector<Rational> b{Rational(1)};
  for (int n = 1; n <= degree - derivative; ++n) {
    b.emplace_back(0);
    for (int j = n; j >= 0; --j)
      b[j] = (j < n ? Rational(b[j] * (1 - u)) : Rational(0)) +
             (j > 0 ? Rational(b[j - 1] * u) : Rational(0));
  }
  for (int k = 1; k <= derivative; ++k) {
    // The derivative's coefficients are n / 2 times differences: weights of b[j - 1] and b[j].
    const int n = degree - derivative + k;
    b.emplace_back(0);
    for (int j = n; j >= 0; --j)
      b[j] = Rational(n, 2) * ((j > 0 ? b[j - 1] : Rational(0)) - (j < n ? b[j] : Rational(0)));
  }
  return b;
}

/// The exact polynomial's, in the coordinates of the box.
struct Exact {
  Polynomial<2> f, x, y, xx, yy, xy;
  Exact(const FilteredFunction<2>& polynomial)
      : f(Polynomial<2>::constant(1 / Rational(polynomial.scale())) *
          polynomial.polynomial().exact()),
        x(f.derivative(0)),
        y(f.derivative(1)),
        xx(x.derivative(0)),
        yy(y.derivative(1)),
        xy(x.derivative(1)) {}
  Jet2 at(const Box<2>& box, const RationalPoint<2>& s) const {
    RationalPoint<2> p, h;
    for (int i = 0; i < 2; ++i) {
      const Rational lo(box.lo[i]), hi(box.hi[i]);
      h[i] = (hi - lo) / 2;
      p[i] = (lo + hi) / 2 + h[i] * s[i];
    }
    return {f(p),
            x(p) * h[0],
            y(p) * h[1],
            xx(p) * h[0] * h[0],
            yy(p) * h[1] * h[1],
            xy(p) * h[0] * h[1]};
  }
};

inline RationalPoint<2> random_point(Random& random) {
  RationalPoint<2> s;
  for (Rational& c : s) c = Rational(static_cast<int>(random() % 2001) - 1000, 1000);
  return s;
}

/// A random box in [-1,1]^2 with centre and corners in few bits.
inline Box<2> random_box(int level, Random& random) {
  Box<2> box;
  for (int i = 0; i < 2; ++i) {
    const double width = std::ldexp(1.0, 1 - level);
    box.lo[i] = -1 + width * static_cast<double>(random() % (1ull << level));
    box.hi[i] = box.lo[i] + width;
  }
  return box;
}

/// A polynomial that vanishes at a point, of a degree: (x - px) a + (y - py) b.
inline Polynomial<2> through(const RationalPoint<2>& point, int degree, Random& random) {
  const auto offset = [&](int i) {
    return Polynomial<2>::variable(i) + Polynomial<2>::constant(-point[i]);
  };
  return offset(0) * random_polynomial(degree - 1, random) +
         offset(1) * random_polynomial(degree - 1, random);
}

}  // namespace encase
