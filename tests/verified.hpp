// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "hand_made_encasement.hpp"
#include "objections.hpp"

/// Encasements to verify, most of them made by hand, and what verification says of them.
namespace encase::verified {

using hand_made::polynomial;

inline const std::vector<Point<2>> kSquare{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

/// a x + b y + c
inline Polynomial<2> linear(const Rational& a, const Rational& b, const Rational& c) {
  return polynomial({{{1, 0}, a}, {{0, 1}, b}, {{0, 0}, c}});
}
/// x^2 + y^2 - r2
inline Polynomial<2> circle(const Rational& r2) {
  return polynomial({{{2, 0}, 1}, {{0, 2}, 1}, {{0, 0}, Rational(-r2)}});
}

/// Two lines that cross once, in one cell.
inline Encasement two_lines() {
  hand_made::Recipe recipe;
  recipe.curves = {linear(1, Rational(-1, 3), Rational(-1, 7)),
                   linear(1, Rational(1, 5), Rational(1, 9))};
  recipe.corners = kSquare;
  const double y = -(1.0 / 7 + 1.0 / 9) / (1.0 / 3 + 1.0 / 5);
  recipe.crossings = {{{0, 1}, {y / 3 + 1.0 / 7, y}}};
  return hand_made::build(recipe);
}

/// A circle of radius 3/4 and a line y = x/5 + 1/20 through it. The first cut leaves the circle's
/// centre, a critical region, in the left cell, where it needs a certificate; the second one makes
/// a T-junction at the right.
///
///     +---------+-----+
///     |         |  2  |
///     |    0    +-----+
///     |         |  1  |
///     +---------+-----+
inline Encasement circle_and_line() {
  hand_made::Recipe recipe;
  recipe.curves = {circle(Rational(9, 16)), linear(Rational(-1, 5), 1, Rational(-1, 20))};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0, -0.375}, {0.125, 1, -0.875}};
  recipe.history = {{0, ~0, 1}, {1, ~1, ~2}};
  // 26/25 x^2 + x/50 + 1/400 - 9/16 = 0
  for (const double s : {1.0, -1.0}) {
    const double x = (-0.02 + s * std::sqrt(0.0004 + 4 * 1.04 * 0.56)) / 2.08;
    recipe.crossings.push_back({{0, 1}, {x, x / 5 + 0.05}});
  }
  return hand_made::build(recipe);
}

/// Two lines that do not meet, in one relaxed cell whose left and right edges are cut.
inline Encasement relaxed() {
  hand_made::Recipe recipe;
  recipe.curves = {linear(Rational(1, 7), 1, Rational(-1, 10)),
                   linear(Rational(1, 8), 1, Rational(1, 10))};
  recipe.corners = kSquare;
  Encasement e = hand_made::build(recipe);
  e.cells[0].state = CellState::Relaxed;
  return e;
}

/// A node at the origin, reported.
inline Encasement node() {
  hand_made::Recipe recipe;
  recipe.curves = {polynomial({{{2, 0}, 1}, {{0, 2}, -2}})};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0, -0.25}, {1, 0, 0.25}, {0, 1, -0.0625}, {0, 1, 0.0625}};
  recipe.history = {{0, 1, 2}, {1, 3, ~0}, {2, ~1, ~2}, {3, ~3, ~4}};
  Unresolved singular;
  singular.kind = Unresolved::Kind::SingularPoint;
  singular.box = {{-0.125, -0.125}, {0.125, 0.125}};
  singular.has_box = true;
  singular.curves = {0};
  recipe.degenerate = {singular};
  return hand_made::build(recipe);
}

/// The diagonals of the square meet its corners, so that a larger polygon is used: the second line
/// crosses the diagonal x = y in the corner itself, the third beyond it.
inline Encasement diagonals() {
  hand_made::Recipe recipe;
  recipe.curves = {linear(1, -1, 0), linear(1, 1, -2)};
  recipe.asked_corners = kSquare;
  const double a = 1 + 0x1p-31, b = 1 + 0x1p-32;
  recipe.corners = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  recipe.crossings = {{{0, 1}, {1, 1}}};
  recipe.crossing_radius = 0x1p-40;
  Encasement e = hand_made::build(recipe);
  e.crossings[0].location = Location::OnBoundary;
  e.crossings[0].rounded = true;
  return e;
}

/// A circle, two lines through it and a far small circle, with a shared cover.
inline Encasement four_curves() {
  const auto far = polynomial({{{2, 0}, 1},
                               {{0, 2}, 1},
                               {{1, 0}, Rational(-8, 5)},
                               {{0, 1}, Rational(-8, 5)},
                               {{0, 0}, Rational(32, 25) - Rational(1, 100)}});
  const std::vector<NamedCurve> curves{{"circle", circle(Rational(1, 4))},
                                       {"rising", linear(Rational(-1, 5), 1, Rational(-1, 20))},
                                       {"falling", linear(1, Rational(1, 3), Rational(1, 9))},
                                       {"far", far}};
  return encase(curves, make_region(-1, 1, -1, 1).value()).value();
}

inline void expect_accepted(const Encasement& e) {
  const Verification verification = verify(e);
  EXPECT_TRUE(verification.ok()) << text(verification);
  EXPECT_GT(verification.claims, 0);
}

/// That the mutant is objected to, for a reason that `reason` is part of.
inline void expect_objection(const Encasement& mutant, const std::string& reason) {
  const Verification verification = verify(mutant);
  EXPECT_FALSE(verification.ok()) << "expected: " << reason;
  EXPECT_NE(text(verification).find(reason), std::string::npos)
      << "expected: " << reason << "\ngot: " << text(verification);
}

inline void expect_objection(Encasement e, const std::function<void(Encasement&)>& mutate,
                             const std::string& reason) {
  mutate(e);
  expect_objection(e, reason);
}

}  // namespace encase::verified
