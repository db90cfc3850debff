// SPDX-License-Identifier: MIT
//
// Encasements of curves that are not polynomials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analytic_scenes.hpp"
#include "common/filtered_expression.hpp"
#include "encased.hpp"
#include "high_precision.hpp"

namespace encase {
namespace {

using namespace analytic;
using high_precision::Number;

Encasement run(const Scene& scene, const EncaseOptions& options = {}) {
  Result<Encasement> result = encase(scene.curves, scene.region, options);
  EXPECT_TRUE(result) << scene.name << ": " << (result ? "" : result.error().message);
  return result ? std::move(result).value() : Encasement{};
}

Expression expression_of(const Function<2>& f) {
  return f.is_polynomial() ? Expression(f.polynomial()) : f.expression();
}

/// Newton's iteration with 320 bits; whether it stays near and converges.
bool converges(const Expression& f, const Expression& g, std::array<Number, 2>* point) {
  const std::array<double, 2> start{(*point)[0].to_double(), (*point)[1].to_double()};
  for (int round = 0; round < 12; ++round) {
    const high_precision::Jet a = high_precision::jet(f, *point),
                              b = high_precision::jet(g, *point);
    const Number determinant = a.d[0] * b.d[1] - a.d[1] * b.d[0];
    (*point)[0] = (*point)[0] - (a.value * b.d[1] - b.value * a.d[1]) / determinant;
    (*point)[1] = (*point)[1] - (b.value * a.d[0] - a.value * b.d[0]) / determinant;
  }
  const high_precision::Jet a = high_precision::jet(f, *point), b = high_precision::jet(g, *point);
  for (std::size_t k = 0; k < 2; ++k)
    if (!(std::fabs((*point)[k].to_double() - start[k]) < 1e-6)) return false;
  return std::fabs(a.value.to_double()) < 1e-50 && std::fabs(b.value.to_double()) < 1e-50;
}

/// Every crossing's box holds a zero that MPFR finds, different ones in different boxes; a point
/// that is said to be rounded is nearest.
void expect_right_crossings(const Encasement& e) {
  for (const Crossing& crossing : e.crossings) {
    std::array<Number, 2> point{Number(crossing.point[0]), Number(crossing.point[1])};
    const Expression f = expression_of(
                         e.curves[static_cast<std::size_t>(crossing.curves[0])].function),
                     g = expression_of(
                         e.curves[static_cast<std::size_t>(crossing.curves[1])].function);
    ASSERT_TRUE(converges(f, g, &point));
    for (std::size_t k = 0; k < 2; ++k) {
      const Number lo(crossing.box.lo[k]), hi(crossing.box.hi[k]);
      EXPECT_TRUE(lo < point[k] && point[k] < hi);
      if (crossing.rounded) {
        EXPECT_EQ(point[k].to_double(), crossing.point[k]);
      }
    }
  }
}

/// The zeros that Newton's iteration finds from the points of a grid, inside the region: each is in
/// the box of a crossing, or in one of an unresolved place.
void expect_complete(const Encasement& e, int steps) {
  const Box<2> box = e.region.bounding_box();
  const Expression f = expression_of(e.curves[0].function), g = expression_of(e.curves[1].function);
  const FilteredExpression<2> first(f), second(g);
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j) {
      Point<2> x{box.lo[0] + box.width(0) * i / steps, box.lo[1] + box.width(1) * j / steps};
      bool good = true;
      for (int round = 0; round < 40 && good; ++round) {
        const auto a = first.value_and_gradient(x), b = second.value_and_gradient(x);
        const double determinant = a.gradient[0] * b.gradient[1] - a.gradient[1] * b.gradient[0];
        x[0] -= (a.value * b.gradient[1] - b.value * a.gradient[1]) / determinant;
        x[1] -= (b.value * a.gradient[0] - a.value * b.gradient[0]) / determinant;
        good = std::isfinite(x[0] + x[1]);
      }
      std::array<Number, 2> point{Number(x[0]), Number(x[1])};
      if (!good || !box.contains(x) || !converges(f, g, &point)) continue;
      const auto holds = [&](const Box<2>& b) {
        bool inside = true;
        for (std::size_t k = 0; k < 2; ++k)
          inside = inside && !(point[k] < Number(b.lo[k])) && !(Number(b.hi[k]) < point[k]);
        return inside;
      };
      const bool known =
          std::any_of(e.crossings.begin(), e.crossings.end(),
                      [&](const Crossing& c) { return holds(c.box); }) ||
          std::any_of(e.degenerate.begin(), e.degenerate.end(),
                      [&](const Unresolved& u) { return u.has_box && holds(u.box); });
      EXPECT_TRUE(known) << x[0] << " " << x[1];
    }
}

int inside(const Encasement& e) { return encased::count(e, Location::Inside); }

TEST(Analytic, SimpleScenesAreCertified) {
  const int crossings[] = {2, 5, 2};
  int k = 0;
  for (const Scene& scene : simple_scenes()) {
    SCOPED_TRACE(scene.name);
    const Encasement e = run(scene);
    EXPECT_EQ(e.outcome, Outcome::Certified);
    EXPECT_EQ(inside(e), crossings[k++]);
    expect_right_crossings(e);
    expect_complete(e, 24);
  }
}

TEST(Analytic, ManyCrossingsAreFoundAndCertified) {
  for (const Scene& scene : {cosines(), waves()}) {
    SCOPED_TRACE(scene.name);
    const Encasement e = run(scene);
    EXPECT_EQ(e.outcome, Outcome::Certified);
    EXPECT_GE(inside(e), scene.name == "cosines" ? 90 : 20);
    expect_right_crossings(e);
    expect_complete(e, 30);
  }
}

TEST(Analytic, TheSuiteIsAnsweredWithAllSimpleCrossings) {
  for (const Scene& scene : suite()) {
    SCOPED_TRACE(scene.name);
    const Encasement e = run(scene);
    // Singular points of one of the curves.
    const bool singular = scene.name == "chebsuite_5_1" || scene.name == "chebsuite_9_1" ||
                          scene.name == "wagon_siam";
    EXPECT_EQ(e.outcome, singular ? Outcome::Degenerate : Outcome::Certified);
    for (const Unresolved& entry : e.degenerate) EXPECT_LT(entry.box.largest_width(), 1e-10);
    expect_right_crossings(e);
    expect_complete(e, 24);
  }
}

/// Certified but for narrow strips where the function of curve f has gaps.
void expect_gaps(const Scene& scene, double widest, int crossings) {
  SCOPED_TRACE(scene.name);
  const Encasement e = run(scene);
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  EXPECT_EQ(inside(e), crossings);
  for (const Unresolved& entry : e.degenerate) {
    EXPECT_EQ(entry.kind, Unresolved::Kind::NotAnalytic) << entry.reason;
    EXPECT_LT(std::min(entry.box.width(0), entry.box.width(1)), widest);
  }
  EXPECT_GT(encased::count(e, CellState::Certified), 0);
  expect_right_crossings(e);
  expect_complete(e, 24);
}

const Polynomial<2> kLine = Polynomial<2>::from_terms(
    {{{1, 0}, Rational(1)}, {{0, 1}, Rational(1, 3)}, {{0, 0}, Rational(-1, 7)}});

TEST(Analytic, PolesAndEdgesOfDomainsStayInTheirPlaces) {
  expect_gaps(scene("both sides", of(Operation::Log, of(Operation::Abs, x())) - y(), kLine, -2, 2),
              5e-3, 1);
  expect_gaps(scene("hole", sin(x()) / x() - y(), kLine, -2, 2), 5e-3, 1);
  expect_gaps(scene("cone", of(Operation::Sqrt, x().power(2) + y().power(2)) - c(1), kLine, -2, 2),
              1e-7, 2);
  expect_gaps(scene("isolated", of(Operation::Log, x().power(2) + y().power(2)), kLine, -2, 2),
              1e-7, 2);
  expect_gaps(
      scene("diamond", of(Operation::Abs, x()) + of(Operation::Abs, y()) - c(1), kLine, -2, 2), 0.1,
      2);
  expect_gaps(scene("logarithm", of(Operation::Log, x()) - y(), kLine, -1, 2), 1.5, 1);
}

TEST(Analytic, PolesHoldNoZeros) {
  const auto expect_certified = [](const Scene& scene, int crossings) {
    SCOPED_TRACE(scene.name);
    const Encasement e = run(scene);
    EXPECT_EQ(e.outcome, Outcome::Certified);
    EXPECT_EQ(inside(e), crossings);
    expect_right_crossings(e);
    expect_complete(e, 24);
  };
  expect_certified(scene("pole", c(1) / x() - y(), kLine, -2, 2), 0);
  expect_certified(scene("poles", of(Operation::Tan, x()) - y(), kLine, -4, 4), 1);
  expect_certified(scene("many poles", of(Operation::Tan, c(3) * x() + y()) - y(), kLine, -4, 4),
                   1);
  expect_certified(scene("isolated", c(1) - c(1) / (x().power(2) + y().power(2)), kLine, -2, 2), 2);
}

TEST(Analytic, AContactAmongPolesIsOpenOnlyThere) {
  // Three crossings in one, at the origin.
  const Encasement e = run(scene("triple", of(Operation::Tan, x()) - y(),
                                 Polynomial<2>::variable(0) - Polynomial<2>::variable(1), -5, 6));
  EXPECT_NE(e.outcome, Outcome::Certified);
  EXPECT_EQ(inside(e), 2);
  for (const auto* places : {&e.degenerate, &e.undecided})
    for (const Unresolved& entry : *places) {
      EXPECT_NE(entry.kind, Unresolved::Kind::NotAnalytic);
      EXPECT_TRUE((Box<2>{{-1e-4, -1e-4}, {1e-4, 1e-4}}).contains(entry.box));
    }
  const auto certified = encased::count(e, CellState::Certified);
  EXPECT_GE(certified, 10);
  EXPECT_LE(static_cast<int>(e.cells.size()) - certified, 2);
  expect_right_crossings(e);
}

TEST(Analytic, EqualExpressionsAreOneCurve) {
  const Expression f = sin(x()) - y();
  const Encasement e =
      run({"twice", {{"f", f}, {"g", conic(1, 1, -1)}, {"h", f}}, encased::square()});
  ASSERT_EQ(e.curves.size(), 2u);
  EXPECT_EQ(e.curves[0].name, "f & h");
  EXPECT_EQ(e.curves[0].sources, (std::vector<int>{0, 2}));
  ASSERT_EQ(e.degenerate.size(), 1u);
  EXPECT_EQ(e.degenerate[0].kind, Unresolved::Kind::SharedComponent);
}

TEST(Analytic, WhatIsNoCurveIsRefused) {
  const auto message = [](const Expression& f, const Region& region, double perturbation) {
    EncaseOptions options;
    options.perturbation = perturbation;
    const auto result = encase({{"f", f}}, region, options);
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(message(exp(c(1)) - c(2), encased::square(), 0),
            "curve 'f' is a constant: it has no x and no y");
  Region plane;
  plane.plane = true;
  EXPECT_EQ(message(sin(x()) - y(), plane, 0),
            "curve 'f' is no polynomial: it can be encased in a bounded region, not in the plane");
  EXPECT_EQ(message(sin(x()) - y(), encased::square(), 1e-9),
            "curve 'f' is no polynomial: only those can be perturbed");
}

}  // namespace
}  // namespace encase
