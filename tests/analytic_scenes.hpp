// SPDX-License-Identifier: MIT
//
// Curves that are not polynomials, for tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "encase/encasement.hpp"

namespace encase::analytic {

inline Expression x() { return Expression::variable(0); }
inline Expression y() { return Expression::variable(1); }
inline Expression c(long numerator, long denominator = 1) {
  return Expression(Rational(numerator, denominator));
}
inline Expression sin(const Expression& a) { return Expression::apply(Operation::Sin, a); }
inline Expression cos(const Expression& a) { return Expression::apply(Operation::Cos, a); }
inline Expression exp(const Expression& a) { return Expression::apply(Operation::Exp, a); }
inline Expression of(Operation operation, const Expression& a) {
  return Expression::apply(operation, a);
}

/// a x^2 + b y^2 + c
inline Polynomial<2> conic(long a, long b, const Rational& constant) {
  return Polynomial<2>::from_terms(
      {{{2, 0}, Rational(a)}, {{0, 2}, Rational(b)}, {{0, 0}, constant}});
}

struct Scene {
  std::string name;
  std::vector<NamedCurve> curves;
  Region region;
};

inline Scene scene(std::string name, Function<2> f, Function<2> g, double lo, double hi) {
  return {std::move(name),
          {{"f", std::move(f)}, {"g", std::move(g)}},
          make_region(Rational(lo), Rational(hi), Rational(lo), Rational(hi)).value()};
}

/// Curves that cross simply, inside their regions.
inline std::vector<Scene> simple_scenes() {
  std::vector<Scene> scenes;
  scenes.push_back(
      scene("sine and circle", y() - sin(c(3) * x()), conic(1, 1, Rational(-4)), -3, 3));
  scenes.push_back(scene("product", sin(x() * y()) - c(3, 10), cos(x()) - y(), -4, 4));
  scenes.push_back(
      scene("exponential and cubic", exp(x()) + y() - c(2),
            Polynomial<2>::from_terms(
                {{{0, 2}, Rational(1)}, {{3, 0}, Rational(-1)}, {{0, 0}, Rational(-1)}}),
            -3, 3));
  return scenes;
}

/// About 100 crossings of two sums of cosines.
inline Scene cosines() {
  const Expression f = cos(c(5) * x()) + cos(c(7) * y()) - c(3, 10),
                   g = cos(c(8) * x() + c(1, 5)) + cos(c(6) * y() - c(1, 3)) + c(1, 7);
  return scene("cosines", f, g, -2.8, 2.8);
}
/// The zero sets are waves in both directions.
inline Scene waves() {
  const Expression f = sin(c(3) * x() + c(1, 10)) + cos(c(4) * y()) * c(7, 10),
                   g = sin(c(2) * y() - c(1, 5)) * cos(c(3) * x()) + c(1, 9);
  return scene("waves", f, g, -3, 3);
}

/// Of the test suite of Chebfun, and one of Stan Wagon's.
inline std::vector<Scene> suite() {
  std::vector<Scene> scenes;
  const Expression pi = Expression::pi();
  scenes.push_back(scene("chebsuite_2_1", cos(c(10) * x() * y()),
                         Polynomial<2>::from_terms({{{1, 0}, Rational(1)}, {{0, 2}, Rational(1)}}),
                         -1, 1));
  scenes.push_back(scene("chebsuite_2_3", sin(c(4) * (x() + y() / c(10) + pi / c(10))),
                         cos(c(2) * (x() - c(2) * y() + pi / c(7))), -1, 1));
  scenes.push_back(scene(
      "chebsuite_2_4",
      exp(x() - c(2) * x().power(2) - y().power(2)) * sin(c(10) * (x() + y() + x() * y().power(2))),
      exp(-x() + c(2) * y().power(2) + x() * y().power(2)) *
          sin(c(10) * (x() - y() - c(2) * x() * y().power(2))),
      -1, 1));
  scenes.push_back(scene(
      "chebsuite_5_1", c(2) * x() * y() * cos(y().power(2)) * cos(c(2) * x()) - cos(x() * y()),
      c(2) * sin(x() * y().power(2)) * sin(c(3) * x() * y()) - sin(x() * y()), -2, 2));
  scenes.push_back(
      scene("chebsuite_8_1", sin(c(10) * x() - y() / c(10)), cos(c(3) * x() * y()), -1, 1));
  scenes.push_back(scene("chebsuite_9_1", conic(1, 1, Rational(-81, 100)), sin(x() * y()), -1, 1));
  scenes.push_back(
      {"wagon_siam",
       {{"f", -cos(y()) + c(2) * y() * cos(y().power(2)) * cos(c(2) * x())},
        {"g", -sin(x()) + c(2) * sin(y().power(2)) * sin(c(2) * x())}},
       make_region(Rational(-7, 2), Rational(4), Rational(-9, 5), Rational(21, 5)).value()});
  return scenes;
}

}  // namespace encase::analytic
