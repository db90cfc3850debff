// SPDX-License-Identifier: MIT
//
// Poles, edges and ends of functions: what is certified must not meet them. The encasements are
// made by hand; the checker has to notice what is wrong with them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "analytic_scenes.hpp"
#include "verified.hpp"

namespace encase {
namespace {

using namespace verified;
using analytic::c;
using analytic::of;
using analytic::x;
using analytic::y;

Unresolved not_analytic(const Box<2>& box) {
  Unresolved u;
  u.kind = Unresolved::Kind::NotAnalytic;
  u.box = box;
  u.has_box = true;
  u.curves = {0};
  u.reason = "curve 'c0' is not analytic there";
  return u;
}

/// One cell.
Encasement whole(const Function<2>& f, const Box<2>& unresolved) {
  hand_made::Recipe recipe;
  recipe.curves = {f};
  recipe.corners = kSquare;
  recipe.degenerate = {not_analytic(unresolved)};
  return hand_made::build(recipe);
}

/// Cut at x = -0.25 and x = 0.25, and between at y = -0.25 and y = 0.25: cell 2 is the one in the
/// middle.
Encasement in_nine(const Function<2>& f, const Box<2>& unresolved) {
  hand_made::Recipe recipe;
  recipe.curves = {f};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0, 0.25}, {1, 0, -0.25}, {0, 1, 0.25}, {0, 1, -0.25}};
  recipe.history = {{0, ~0, 1}, {1, 2, ~4}, {2, ~1, 3}, {3, ~2, ~3}};
  recipe.degenerate = {not_analytic(unresolved)};
  return hand_made::build(recipe);
}

/// What a search that takes no notice of poles would answer: all is certified.
void claim_all(Encasement& e, int leaf) {
  e.degenerate.clear();
  e.outcome = Outcome::Certified;
  for (Cell& cell : e.cells) cell.state = CellState::Certified;
  for (CriticalCover& cover : e.critical_covers)
    for (int& token : cover.tokens)
      if (token == cover::kUnresolved) token = leaf;
}

/// log(9 (x^2 + y^2)): its zero set is a circle of radius 1/3, and it has no critical point.
Expression oval() { return of(Operation::Log, c(9) * (x().power(2) + y().power(2))); }

TEST(NotAnalytic, AnOvalNeedsNoCriticalPoint) {
  const Encasement e = whole(oval(), {{-0.125, -0.125}, {0.125, 0.125}});
  EXPECT_EQ(e.outcome, Outcome::Degenerate);
  EXPECT_TRUE(e.line_crossings.empty());
  expect_accepted(e);
  expect_objection(
      e, [](auto& m) { m.cells[0].state = CellState::Certified; }, "meets the box of degenerate");
  expect_objection(
      e, [](auto& m) { claim_all(m, cover::kUnresolved); }, "is in no unresolved box");
  expect_objection(
      e, [](auto& m) { claim_all(m, cover::kExcluded); }, "is not proved free of critical points");
  expect_objection(
      e, [](auto& m) { claim_all(m, cover::kOutside); }, "is not outside the region used");
  expect_objection(
      e,
      [](auto& m) {
        claim_all(m, 0);
        m.critical_regions.push_back({0, Sign::Negative, {{{-0.125, -0.125}, {0.125, 0.125}}}});
      },
      "is not proved to have its sign");
}

TEST(NotAnalytic, CellsBesideThePoleAreCertified) {
  const Encasement e = in_nine(oval(), {{-0.125, -0.125}, {0.125, 0.125}});
  expect_accepted(e);
  for (int k = 0; k < 5; ++k)
    EXPECT_EQ(e.cells[k].state, k == 2 ? CellState::Degenerate : CellState::Certified);
  expect_objection(
      e, [](auto& m) { m.degenerate[0].box.hi[0] = 0.3; }, "meets the box of degenerate");
  expect_objection(
      e, [](auto& m) { m.degenerate[0].box.hi[0] = -0.0625; }, "is in no unresolved box");
  expect_objection(
      e, [](auto& m) { m.degenerate[0].curves.clear(); }, "is in no unresolved box");
  expect_objection(
      e, [](auto& m) { m.degenerate[0].proved = true; }, "there is no proof");
  // The circle is cut eight times.
  EXPECT_EQ(e.line_crossings.size(), 8u);
}

/// Functions with something at x = 0, for all y.
std::vector<Function<2>> broken_at_zero() {
  return {x() / x() - c(1, 2),
          analytic::exp(c(1) / x()) + c(1),
          of(Operation::Abs, x()) - c(1, 2),
          of(Operation::Sqrt, x()) - c(1, 2),
          of(Operation::Log, x()) + c(1, 2),
          Expression::apply(Operation::Max, x(), -x()) - c(1, 2),
          Expression::apply(Operation::Min, x(), c(0)) + c(1, 2),
          of(Operation::Asin, x() + c(1)) + c(1, 2),
          analytic::sin(x().power(-2)) - c(4),
          analytic::sin(c(1) / x()) - c(2)};
}

TEST(NotAnalytic, NoCellAcrossABreakIsAccepted) {
  for (const Function<2>& f : broken_at_zero()) {
    SCOPED_TRACE(f.to_string());
    const Encasement e = whole(f, {{-1, -1}, {1, 1}});
    expect_accepted(e);
    Encasement mutant = e;
    claim_all(mutant, cover::kExcluded);
    expect_objection(mutant, "is not proved absent from line");
    expect_objection(mutant, "is not proved free of critical points");
  }
}

TEST(NotAnalytic, ASignChangeWithoutAZeroIsNoCrossing) {
  // 1/x changes sign on the upper and the lower side of the square at x = 0, and so does the
  // numerator here.
  const Encasement e = whole(x() / x().power(2), {{-1, -1}, {1, 1}});
  expect_accepted(e);
  expect_objection(
      e, [](auto& m) { claim_all(m, cover::kExcluded); }, "is not proved absent from line");
  expect_objection(
      e,
      [](auto& m) {
        claim_all(m, cover::kExcluded);
        m.line_crossings = {{0, 0, -0x1p-20, 0x1.8p-20}, {2, 0, -0x1p-20, 0x1.8p-20}};
        m.cells[0].word = {0, 1};
        m.cells[0].branches = {{0, 0, 1}};
      },
      "is not proved to be one simple root");
}

TEST(NotAnalytic, APoleHoldsNoZeros) {
  // Hyperbolas on both sides of x = 0, in two cells.
  hand_made::Recipe recipe;
  recipe.curves = {c(1, 5) / x() - y()};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0.125, 0}};
  recipe.history = {{0, ~0, ~1}};
  expect_accepted(hand_made::build(recipe));
}

TEST(NotAnalytic, PairsMeetNowhereElse) {
  // The second curve is analytic at the first one's pole; it crosses the circle twice.
  hand_made::Recipe recipe;
  recipe.curves = {oval(), y() - analytic::sin(x())};
  recipe.corners = kSquare;
  recipe.splitting_lines = {{1, 0, 0.1875}, {1, 0, -0.1875}};
  recipe.history = {{0, ~0, 1}, {1, ~1, ~2}};
  recipe.degenerate = {not_analytic({{-0.125, -0.125}, {0.125, 0.125}})};
  for (const double s : {1.0, -1.0})
    recipe.crossings.push_back({{0, 1}, {s * 0.23680315476076866, s * 0.23459619989773609}});
  const Encasement e = hand_made::build(recipe);
  expect_accepted(e);
  expect_objection(
      e, [](auto& m) { m.degenerate[0].curves = {1}; }, "is in no unresolved box of the curve");
  expect_objection(
      e, [](auto& m) { m.degenerate.clear(); }, "is in no unresolved box of the pair");
}

}  // namespace
}  // namespace encase
