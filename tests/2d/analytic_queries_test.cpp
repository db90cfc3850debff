// SPDX-License-Identifier: MIT
//
// What is asked of encasements of curves that are not polynomials, beyond what can be proved.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "analytic_scenes.hpp"
#include "encase/arrangement.hpp"
#include "encase/crossing.hpp"
#include "encase/tracing.hpp"
#include "objections.hpp"

namespace encase {
namespace {

using analytic::c;
using analytic::cos;
using analytic::of;
using analytic::sin;
using analytic::x;
using analytic::y;
using Feature = Arrangement::Feature;

const Polynomial<2> kX = Polynomial<2>::variable(0), kY = Polynomial<2>::variable(1);
Polynomial<2> constant(const Rational& value) { return Polynomial<2>::constant(value); }

Encasement encased(const Function<2>& f, const Function<2>& g, const Rational& half) {
  const Region region = make_region(-half, half, -half, half).value();
  return encase({{"f", f}, {"g", g}}, region).value();
}

/// sin(3 x) = y and cos(2 x) = y + 1/10.
Encasement sine_and_cosine() {
  return encased(y() - sin(c(3) * x()), y() + c(1, 10) - cos(c(2) * x()), 4);
}

TEST(AnalyticRefine, GoesAsFarAsMemoryAllows) {
  const Encasement e = sine_and_cosine();
  ASSERT_EQ(e.outcome, Outcome::Certified);
  ASSERT_FALSE(e.crossings.empty());
  for (const int bits : {10, 60, 1000, 5000}) {
    const auto box = refine(e, 0, bits);
    ASSERT_TRUE(box.ok()) << box.error().message;
    Rational width = 1;
    width >>= static_cast<unsigned long>(bits);
    for (int i = 0; i < 2; ++i) EXPECT_LE(box.value().hi[i] - box.value().lo[i], width);
  }
  const auto too_much = refine(e, 0, (1 << 20) + 1);
  ASSERT_FALSE(too_much.ok());
  EXPECT_EQ(too_much.error().code, Error::Code::Undecided);
  EXPECT_EQ(too_much.error().message,
            "crossings of curves that are no polynomials can be refined to 1048576 bits at most");
}

TEST(AnalyticRefine, ABoxWithAPoleIsNotRefined) {
  // tan is not differentiable in the box that is claimed to hold a crossing.
  Encasement e = sine_and_cosine();
  e.curves[0].function = y() - of(Operation::Tan, x());
  e.crossings[0].box = {{1.5, 0}, {1.625, 1}};
  const auto box = refine(e, 0, 60);
  ASSERT_FALSE(box.ok());
}

TEST(AnalyticCompare, TellsDifferentCoordinatesApart) {
  const Encasement e = sine_and_cosine();
  const int n = static_cast<int>(e.crossings.size());
  ASSERT_GE(n, 3);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const auto sign = compare_coordinate(e, 0, i, j);
      ASSERT_TRUE(sign.ok()) << sign.error().message;
      const double a = e.crossings[i].point[0], b = e.crossings[j].point[0];
      EXPECT_EQ(sign.value(), a < b ? Sign::Negative : a > b ? Sign::Positive : Sign::Zero);
    }
}

TEST(AnalyticCompare, LeavesEqualCoordinatesUndecided) {
  // Symmetric in y: crossings have pairwise the same x.
  const Encasement e =
      encased(kY * kY - constant(Rational(1, 2)), cos(c(2) * x()) - y().power(2), 1);
  ASSERT_EQ(e.outcome, Outcome::Certified);
  int equal = 0;
  for (int i = 0; i < static_cast<int>(e.crossings.size()); ++i)
    for (int j = 0; j < i; ++j) {
      const auto sign = compare_coordinate(e, 0, i, j);
      if (std::fabs(e.crossings[i].point[0] - e.crossings[j].point[0]) > 0.1) {
        EXPECT_TRUE(sign.ok());
        continue;
      }
      ++equal;
      ASSERT_FALSE(sign.ok());
      EXPECT_EQ(sign.error().code, Error::Code::Undecided);
      EXPECT_NE(
          sign.error().message.find("agree to 3200 bits; whether they are equal is not proved"),
          std::string::npos)
          << sign.error().message;
    }
  EXPECT_EQ(equal, 2);
}

TEST(AnalyticLocate, ACrossingOnTheBoundaryIsLeftOpen) {
  // x = 1 is a side of the region; sin(pi x) = y meets y = x - 1 there, in a point of the side.
  const Expression pi = Expression::pi();
  const Encasement e = encased(y() - sin(pi * x()), kY - kX + constant(1), 1);
  EXPECT_EQ(e.outcome, Outcome::Undecided);
  ASSERT_EQ(e.undecided.size(), 1u);
  const Unresolved& open = e.undecided[0];
  EXPECT_EQ(open.kind, Unresolved::Kind::Budget);
  EXPECT_TRUE(open.has_box);
  EXPECT_EQ(open.curves, (std::vector<int>{0, 1}));
  EXPECT_TRUE(open.box.contains(Point<2>{1, 0}));
  EXPECT_LT(open.box.largest_width(), 1e-9);
  for (const Crossing& crossing : e.crossings) EXPECT_NE(crossing.location, Location::OnBoundary);
  EXPECT_TRUE(verify(e).ok()) << text(verify(e));

  // Nobody may say more.
  int id = -1;
  for (std::size_t k = 0; k < e.crossings.size(); ++k)
    if (open.box.contains(e.crossings[k].box)) id = static_cast<int>(k);
  ASSERT_GE(id, 0);
  for (const Location location : {Location::OnBoundary, Location::Outside}) {
    Encasement mutant = e;
    mutant.crossings[id].location = location;
    EXPECT_NE(text(verify(mutant)).find("The location of crossing"), std::string::npos);
  }
  Encasement mutant = e;
  mutant.undecided.clear();
  EXPECT_NE(text(verify(mutant)).find("The location of crossing"), std::string::npos);
  mutant = e;
  mutant.undecided[0].box = {{0.5, 0.875}, {0.625, 0.9375}};
  EXPECT_NE(text(verify(mutant)).find("The location of crossing"), std::string::npos);
  mutant = e;
  mutant.undecided[0].curves = {0};
  EXPECT_NE(text(verify(mutant)).find("The location of crossing"), std::string::npos);
  mutant = e;
  mutant.cells[e.crossings[id].cell].state = CellState::Certified;
  EXPECT_FALSE(verify(mutant).ok());
}

TEST(AnalyticLocate, ACrossingNearTheBoundaryIsTold) {
  // The curves meet 2^-40 inside or outside of x = 1.
  for (const int side : {-1, 1}) {
    const Rational at = 1 + side * Rational(0x1p-40);
    const Encasement e = encased(sin(y()) * c(1, 3) + Expression(kX - constant(at)), kY, 1);
    EXPECT_EQ(e.outcome, Outcome::Certified);
    ASSERT_EQ(e.crossings.size(), 1u);
    EXPECT_EQ(e.crossings[0].location, side < 0 ? Location::Inside : Location::Outside);
    EXPECT_TRUE(verify(e).ok()) << text(verify(e));
  }
}

TEST(AnalyticPointLocator, LeavesPointsOnCurvesOpen) {
  // exp(x) - 1 = y passes through the origin, where no value on the way is irrational but exp's.
  const Encasement e =
      encased(of(Operation::Exp, x()) - c(1) - y(), kX + kY - constant(Rational(1, 2)), 1);
  ASSERT_EQ(e.outcome, Outcome::Certified);
  const Arrangement a = arrange(e).value();
  const PointLocator locator(e, a);
  EXPECT_EQ(locator.locate(Point<2>{0.5, 0.0}).kind, Feature::Kind::Edge);  // of the line
  EXPECT_EQ(locator.locate(Point<2>{-0.5, 0.5}).kind, Feature::Kind::Face);
  for (const auto& [p, q] : {std::pair(Point<2>{0.25, 0.2840254166877415}, Point<2>{0.25, 0.29})}) {
    EXPECT_EQ(locator.locate(p).kind, Feature::Kind::Face);
    EXPECT_EQ(locator.locate(q).kind, Feature::Kind::Face);
  }
}

TEST(AnalyticPointLocator, NeverGuesses) {
  // log(exp(x)) = x, but no precision shows that.
  const Expression f = of(Operation::Log, of(Operation::Exp, x())) - y();
  const Encasement e = encased(f, kX + constant(2) * kY - constant(Rational(1, 7)), 1);
  ASSERT_EQ(e.outcome, Outcome::Certified) << e.undecided.size();
  const Arrangement a = arrange(e).value();
  const PointLocator locator(e, a);
  for (const Point<2>& p : {Point<2>{0.25, 0.25}, Point<2>{-0.75, -0.75}}) {
    EXPECT_EQ(locator.locate(p), (Feature{Feature::Kind::Undecided, -1}));
    EXPECT_EQ(locator.locate(RationalPoint<2>{Rational(p[0]), Rational(p[1])}),
              (Feature{Feature::Kind::Undecided, -1}));
    EXPECT_EQ(locator.locate(Point<2>{p[0], p[1] + 0x1p-50}).kind, Feature::Kind::Face);
  }
  // Where arithmetic alone leads to the value, zero is proved.
  const Encasement rational = encased(c(1) / (x() + c(4)) - y(), kX, 1);
  ASSERT_EQ(rational.outcome, Outcome::Certified);
  const Arrangement b = arrange(rational).value();
  const PointLocator exact(rational, b);
  EXPECT_EQ(exact.locate(RationalPoint<2>{Rational(1, 2), Rational(2, 9)}).kind,
            Feature::Kind::Edge);
  EXPECT_EQ(exact.locate(RationalPoint<2>{Rational(0), Rational(1, 4)}).kind,
            Feature::Kind::Vertex);
  EXPECT_EQ(exact.locate(RationalPoint<2>{Rational(1), Rational(1, 5)}).kind,
            Feature::Kind::Vertex);
}

TEST(AnalyticPoles, AreKeptApart) {
  for (const Expression& f : {sin(x()) / x() - y(), y() - of(Operation::Log, x() + c(1, 3)),
                              of(Operation::Abs, x()) - y() - c(1, 3),
                              Expression::apply(Operation::Max, x(), y()) - c(1, 2)}) {
    SCOPED_TRACE(f.to_string());
    const Encasement e = encased(f, kX - kY * constant(3) - constant(Rational(1, 4)), 2);
    EXPECT_EQ(e.outcome, Outcome::Degenerate);
    EXPECT_TRUE(verify(e).ok()) << text(verify(e));
    EXPECT_FALSE(e.degenerate.empty());
    for (const Unresolved& u : e.degenerate) EXPECT_EQ(u.kind, Unresolved::Kind::NotAnalytic);
    EXPECT_TRUE(std::any_of(e.cells.begin(), e.cells.end(),
                            [](const Cell& cell) { return cell.state == CellState::Certified; }));
    // None of it may be left out.
    for (std::size_t k = 0; k < e.degenerate.size(); ++k) {
      Encasement mutant = e;
      mutant.degenerate.erase(mutant.degenerate.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_FALSE(verify(mutant, {848, 1}).ok());
    }
  }
}

}  // namespace
}  // namespace encase
