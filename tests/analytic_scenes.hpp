// SPDX-License-Identifier: MIT
//
// Curves that are not polynomials, for tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "encase/curves_file.hpp"
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

/// The files of tests/data/curves with functions that are not polynomials: of the test suite of
/// Chebfun, and one of Stan Wagon's.
inline std::vector<Scene> suite() {
  std::vector<Scene> scenes;
  for (const char* name : {"chebsuite_2_1", "chebsuite_2_3", "chebsuite_2_4", "chebsuite_5_1",
                           "chebsuite_8_1", "chebsuite_9_1", "wagon_siam"}) {
    CurvesFile file =
        load_curves(std::string(ENCASE_TEST_DATA "/curves/") + name + ".curves").value();
    scenes.push_back({name, std::move(file.curves), std::move(file.region).value()});
  }
  return scenes;
}

}  // namespace encase::analytic
