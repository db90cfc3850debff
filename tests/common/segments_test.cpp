// SPDX-License-Identifier: MIT
#include "common/segments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/components.hpp"
#include "common/random_polynomials.hpp"
#include "common/substitute.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

constexpr int kMaxNodes = 400;

FilteredFunction<2> filtered(const std::string& text) {
  return FilteredFunction<2>(polynomial<2>(text));
}

Line line(const Rational& a, const Rational& b, const Rational& c) {
  return Line::from_rationals({a, b, c});
}

const Line kXAxis = line(0, 1, 0);

std::optional<std::vector<RootInterval>> isolate(const FilteredFunction<2>& f, const Line& on,
                                                 double lo, double hi) {
  Kernel kernel;
  return isolate_on_line(f, on, lo, hi, kMaxNodes, kernel);
}

int exact_count(const FilteredFunction<2>& f, const Line& on, double lo, double hi) {
  return count_real_roots(restrict_exactly(f.polynomial().exact(), on), Rational(lo), Rational(hi));
}

/// The intervals are in order, disjoint, within [lo, hi], and each has one root, none at its ends.
void expect_isolated(const std::vector<RootInterval>& roots, const FilteredFunction<2>& f,
                     const Line& on, double lo, double hi) {
  const Polynomial<1> exact = restrict_exactly(f.polynomial().exact(), on);
  Kernel kernel;
  double last = lo;
  for (const RootInterval& root : roots) {
    EXPECT_LE(last, root.lo);
    EXPECT_LT(root.lo, root.hi);
    last = root.hi;
    EXPECT_EQ(count_real_roots(exact, Rational(root.lo), Rational(root.hi)), 1);
    EXPECT_NE(exact({Rational(root.lo)}), 0);
    EXPECT_NE(exact({Rational(root.hi)}), 0);
    EXPECT_TRUE(one_root_on_line(f, on, root.lo, root.hi, kernel));
  }
  EXPECT_LE(last, hi);
}

TEST(IsolateOnLine, FindsAsManyRootsAsExactArithmetic) {
  const Line lines[] = {kXAxis, line(1, 0, Rational(-1, 3)), line(0.3, -0.7, 0.11),
                        line(Rational(5, 3), Rational(1, 7), Rational(-1, 10)),
                        line(-1e-3, 1e-3, 2e-7)};
  int total = 0;
  for (int degree = 1; degree <= 12; ++degree) {
    RandomOptions options;
    options.degree = degree;
    options.count = 3;
    options.seed = static_cast<unsigned>(100 + degree);
    for (const Polynomial<2>& exact : random_polynomials<2>(options)) {
      const FilteredFunction<2> f(exact);
      for (const Line& on : lines)
        for (const auto& [lo, hi] : {std::pair{-1.0, 1.0}, {-0.3, 0.1}, {0.1, 7.3}}) {
          const auto roots = isolate(f, on, lo, hi);
          ASSERT_TRUE(roots.has_value()) << "degree " << degree;
          EXPECT_EQ(static_cast<int>(roots->size()), exact_count(f, on, lo, hi));
          expect_isolated(*roots, f, on, lo, hi);
          total += static_cast<int>(roots->size());
        }
    }
  }
  EXPECT_GT(total, 500);
}

TEST(IsolateOnLine, CloseRootsAreTold) {
  for (const std::string gap : {"1e-6", "1e-12"}) {
    const auto f = filtered("(y - x^2 + 1/4) - " + gap + "^2/3");
    const auto g = filtered("(x - 1/3)^2 + y - " + gap + "^2");  // two roots 2 gap apart
    for (const FilteredFunction<2>* h : {&f, &g}) {
      const auto roots = isolate(*h, kXAxis, -1, 1);
      ASSERT_TRUE(roots.has_value()) << gap;
      EXPECT_EQ(roots->size(), 2u);
      expect_isolated(*roots, *h, kXAxis, -1, 1);
    }
  }
}

TEST(IsolateOnLine, RootsOnTheCutsOfTheSubdivisionAreFound) {
  const auto f = filtered("(x + 1/2) x (x - 1/2) (x - 3/4) + y");
  const auto roots = isolate(f, kXAxis, -1, 1);
  ASSERT_TRUE(roots.has_value());
  EXPECT_EQ(roots->size(), 4u);
  expect_isolated(*roots, f, kXAxis, -1, 1);
}

TEST(IsolateOnLine, MultipleRootIsNotSettled) {
  EXPECT_FALSE(isolate(filtered("y - x^2"), kXAxis, -1, 1));
  EXPECT_FALSE(isolate(filtered("y - (x - 1/3)^2"), kXAxis, -1, 1));
  EXPECT_FALSE(isolate(filtered("y - (x - 1/3)^3"), kXAxis, -1, 1));
  EXPECT_FALSE(isolate(filtered("x^2 + y^2 - 1"), line(1, 0, -1), -1, 1));
  // Away from the multiple root there is nothing to object to.
  const auto roots = isolate(filtered("y - (x - 1/3)^2 (x - 3/4)"), kXAxis, 0.5, 1);
  ASSERT_TRUE(roots.has_value());
  EXPECT_EQ(roots->size(), 1u);
}

TEST(IsolateOnLine, RootAtAnEndIsNotSettled) {
  const auto f = filtered("x^2 - y - 1");
  EXPECT_FALSE(isolate(f, kXAxis, -1, 0.5));
  EXPECT_FALSE(isolate(f, kXAxis, 0, 1));
  const auto inside = isolate(f, kXAxis, 0, std::nextafter(1, 2));
  ASSERT_TRUE(inside.has_value());
  EXPECT_EQ(inside->size(), 1u);
  const auto outside = isolate(f, kXAxis, 0, std::nextafter(1, 0));
  ASSERT_TRUE(outside.has_value());
  EXPECT_TRUE(outside->empty());
}

TEST(IsolateOnLine, RootNearAnEndOfTheEnlargedIntervalIsTold) {
  // [-0.999, 0.999] is enlarged to [-1, 1]; the roots are at 1 or a rounding error beside it.
  const auto f = filtered("x^2 + y^2 - 1");
  for (const double y : {0.0, 1e-30, 1e-17, 1e-9}) {
    const auto roots = isolate(f, line(0, 1, -y), -0.999, 0.999);
    ASSERT_TRUE(roots.has_value()) << y;
    EXPECT_TRUE(roots->empty());
  }
}

TEST(IsolateOnLine, CurveThatContainsTheLineIsNotSettled) {
  EXPECT_FALSE(isolate(filtered("y (x^2 + y - 1/2)"), kXAxis, -1, 1));
  EXPECT_FALSE(isolate(filtered("(x/3 + y/7 - 1/10) x"),
                       line(Rational(1, 3), Rational(1, 7), Rational(-1, 10)), -1, 1));
}

TEST(IsolateOnLine, EmptyAndUnboundedIntervalsAreRefused) {
  const auto f = filtered("x^2 - y - 1/2");
  EXPECT_FALSE(isolate(f, kXAxis, 1, -1));
  EXPECT_FALSE(isolate(f, kXAxis, 1, 1));
  EXPECT_FALSE(isolate(f, kXAxis, -HUGE_VAL, 1));
  EXPECT_FALSE(isolate(f, kXAxis, std::nan(""), 1));
}

TEST(IsolateOnLine, NodesAreLimited) {
  const auto f = filtered("(x + 3/4) (x + 1/3) x (x - 1/5) (x - 4/5) + y");
  Kernel kernel;
  EXPECT_TRUE(isolate_on_line(f, kXAxis, -1, 1, 400, kernel));
  EXPECT_FALSE(isolate_on_line(f, kXAxis, -1, 1, 3, kernel));
}

TEST(OneRootOnLine, FailsForNoneTwoThreeAndMultipleRoots) {
  const auto f = filtered("(x + 1/2) (x - 1/4) (x - 3/4) + y");
  Kernel kernel;
  EXPECT_TRUE(one_root_on_line(f, kXAxis, 0, 0.5, kernel));
  EXPECT_TRUE(one_root_on_line(f, kXAxis, 0.2, 0.3, kernel));
  EXPECT_FALSE(one_root_on_line(f, kXAxis, 0.3, 0.7, kernel));
  EXPECT_FALSE(one_root_on_line(f, kXAxis, 0, 1, kernel));
  EXPECT_FALSE(one_root_on_line(f, kXAxis, -1, 1, kernel));
  EXPECT_FALSE(one_root_on_line(f, kXAxis, 0.25, 0.5, kernel));
  EXPECT_FALSE(one_root_on_line(filtered("x^3 - y"), kXAxis, -1, 1, kernel));
  EXPECT_FALSE(one_root_on_line(f, kXAxis, 0.5, 0, kernel));
}

TEST(OneRootOnLine, ExtremaAndRootsBesideTheIntervalDoNotDisturb) {
  Kernel kernel;
  // Two complex roots near the line, between an end and the root.
  const auto f = filtered("(x - 9/10) ((x + 1/5)^2 + 1/10^6) + y");
  EXPECT_TRUE(one_root_on_line(f, kXAxis, -1, 1, kernel));
  EXPECT_FALSE(one_root_on_line(f, kXAxis, -1, 0.8, kernel));
  // Another root just before the lower end.
  const auto g = filtered("(x - 1/3) (x - 1/2) + y");
  EXPECT_TRUE(one_root_on_line(g, kXAxis, std::nextafter(1.0 / 3, 1), 1, kernel));
  EXPECT_FALSE(one_root_on_line(g, kXAxis, std::nextafter(1.0 / 3, 0), 1, kernel));
}

TEST(NoRoot, OnLinesAndSegmentsIncludesTheEnds) {
  const auto f = filtered("x^2 + y^2 - 1");
  Kernel kernel;
  EXPECT_TRUE(no_root_on_line(f, kXAxis, -0.9999999, 0.9999999, kernel));
  EXPECT_FALSE(no_root_on_line(f, kXAxis, -0.5, 1, kernel));
  EXPECT_FALSE(no_root_on_line(f, kXAxis, -2, 0, kernel));
  EXPECT_FALSE(no_root_on_line(f, kXAxis, -2, 2, kernel));  // two roots: equal signs at the ends
  EXPECT_TRUE(no_root_on_line(f, kXAxis, 1.0000001, 5, kernel));
  EXPECT_TRUE(no_root_on_line(f, kXAxis, 0.5, 0.5, kernel));
  EXPECT_FALSE(no_root_on_line(f, kXAxis, 1, 1, kernel));
  EXPECT_TRUE(no_root_on_line(f, line(0, 1, -1.0000001), -1, 1, kernel));
  EXPECT_FALSE(no_root_on_line(f, line(0, 1, -1), -1, 1, kernel));  // touches

  EXPECT_TRUE(no_root_on_segment(f, {-0.7, 0.7}, {0.7, -0.7}, kernel));
  EXPECT_FALSE(no_root_on_segment(f, {0, 0}, {0.8, 0.8}, kernel));
  EXPECT_FALSE(no_root_on_segment(f, {0, 0}, {1, 0}, kernel));
  EXPECT_FALSE(no_root_on_segment(f, {-2, 0.1}, {2, 0.1}, kernel));
  EXPECT_TRUE(no_root_on_segment(f, {0, 2}, {2, 0}, kernel));
  EXPECT_FALSE(no_root_on_segment(f, {0, HUGE_VAL}, {2, 0}, kernel));
}

TEST(NoRoot, ZeroJustBeyondTheEndDoesNotDisturb) {
  // Near the end the values are below any fixed threshold.
  const auto f = filtered("x - 1/3 + y");
  Kernel kernel;
  const double below = std::nextafter(1.0 / 3, 0);
  EXPECT_TRUE(no_root_on_line(f, kXAxis, -1, below, kernel));
  EXPECT_FALSE(no_root_on_line(f, kXAxis, -1, std::nextafter(1.0 / 3, 1), kernel));
}

TEST(RefineOnLine, ShrinksToNeighbouringDoublesAndKeepsTheRoot) {
  for (const std::string text : {"x^3 - y/3 + x - 1/3", "x^2 - 2 + y", "10^6 (x - 1/7) + x y"}) {
    const auto f = filtered(text);
    const Line on = line(Rational(1, 50), 1, Rational(-1, 100));
    const Polynomial<1> exact = restrict_exactly(f.polynomial().exact(), on);
    auto roots = isolate(f, on, 0.0625, 2);
    ASSERT_TRUE(roots.has_value());
    ASSERT_EQ(roots->size(), 1u);
    RootInterval root = roots->front();
    Kernel kernel;
    int steps = 0;
    for (RootInterval before = root; refine_on_line(f, on, &root, kernel); before = root) {
      ASSERT_LE(before.lo, root.lo);
      ASSERT_LE(root.hi, before.hi);
      if (before.hi - before.lo > 1e-14) {
        ASSERT_LE(root.hi - root.lo, 0.57 * (before.hi - before.lo));
      }
      ASSERT_EQ(count_real_roots(exact, Rational(root.lo), Rational(root.hi)), 1);
      ASSERT_LT(++steps, 60);
    }
    EXPECT_LE(root.hi, std::nextafter(std::nextafter(root.lo, 2), 2));
  }
}

TEST(RefineOnLine, RootAtADoubleIsKeptInside) {
  const auto f = filtered("x - 1/2 + y");
  RootInterval root{0, 1};
  Kernel kernel;
  for (int i = 0; i < 40 && refine_on_line(f, kXAxis, &root, kernel); ++i) {
    EXPECT_LT(root.lo, 0.5);
    EXPECT_GT(root.hi, 0.5);
  }
  EXPECT_LT(root.hi - root.lo, 1e-9);
}

TEST(SignOnLine, IsExactAtEveryParameter) {
  const auto f = filtered("x^2 + y^2 - 1");
  Kernel kernel;
  EXPECT_EQ(sign_on_line(f, kXAxis, 1, kernel), Sign::Zero);
  EXPECT_EQ(kernel.decisions.by_exact, 1);
  EXPECT_EQ(sign_on_line(f, kXAxis, std::nextafter(1, 2), kernel), Sign::Positive);
  EXPECT_EQ(sign_on_line(f, kXAxis, std::nextafter(1, 0), kernel), Sign::Negative);
  // On y = 1/3 x the other coordinate is no double.
  std::mt19937_64 generator(3);
  const Line third = line(Rational(-1, 3), 1, 0);
  const Polynomial<1> exact = restrict_exactly(f.polynomial().exact(), third);
  for (int i = 0; i < 100; ++i) {
    const double at = std::sqrt(0.9) + std::ldexp(symmetric_random(generator), -(i % 53));
    EXPECT_EQ(sign_on_line(f, third, at, kernel), sign_of(sgn(exact({Rational(at)}))));
  }
}

TEST(PointOnLine, EnclosesTheExactPoint) {
  for (const Line& on : {line(Rational(1, 3), Rational(-5, 7), Rational(1, 10)),
                         line(Rational(5, 3), Rational(1, 7), 3), line(0.1, 0.3, -0.7)})
    for (const double t : {-1.7, 0.1, 1e6}) {
      const RationalPoint<2> exact = point_on_line(on, Rational(t));
      const auto enclosed = point_on_line(on, Interval(t));
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LE(Rational(enclosed[i].lo), exact[i]);
        EXPECT_GE(Rational(enclosed[i].hi), exact[i]);
        EXPECT_LT(enclosed[i].width(), 1e-13 * (1 + std::fabs(enclosed[i].mid()) + std::fabs(t)));
      }
      const auto c = on.exact();
      EXPECT_EQ(c[0] * exact[0] + c[1] * exact[1] + c[2], 0);
    }
}

TEST(Meet, EnclosesTheExactPointAndParallelsClaimNothing) {
  const Line first = line(Rational(1, 3), Rational(1, 7), Rational(-1, 10)),
             second = line(0.1, -0.7, 0.3);
  const RationalPoint<2> exact = exact_meet(first, second);
  const auto enclosed = meet(first, second);
  for (const Line& on : {first, second}) {
    const auto c = on.exact();
    EXPECT_EQ(c[0] * exact[0] + c[1] * exact[1] + c[2], 0);
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LE(Rational(enclosed[i].lo), exact[i]);
    EXPECT_GE(Rational(enclosed[i].hi), exact[i]);
    EXPECT_LT(enclosed[i].width(), 1e-13);
  }
  const auto parallel = meet(line(0.1, 0.3, 1), line(0.1, 0.3, 2));
  EXPECT_EQ(parallel[0].lo, -HUGE_VAL);
  EXPECT_EQ(parallel[0].hi, HUGE_VAL);
}

TEST(Side, OfAPointIsExact) {
  Kernel kernel;
  const Line third = line(Rational(1, 3), -1, 0);
  const Line doubles = line(0.1, -0.1, 0);
  EXPECT_EQ(side(doubles, Point<2>{0.7, 0.7}, kernel), Sign::Zero);
  EXPECT_EQ(side(doubles, Point<2>{0.7, std::nextafter(0.7, 1)}, kernel), Sign::Negative);
  EXPECT_EQ(side(doubles, Point<2>{std::nextafter(0.7, 1), 0.7}, kernel), Sign::Positive);
  EXPECT_EQ(kernel.decisions.by_exact, 3);
  EXPECT_EQ(side(doubles, Point<2>{1, 0}, kernel), Sign::Positive);
  EXPECT_EQ(kernel.decisions.by_double, 1);
  // 1/3 rounded to a double is less than 1/3.
  EXPECT_EQ(side(third, Point<2>{1, 1.0 / 3}, kernel), Sign::Positive);
  EXPECT_EQ(side(third, RationalPoint<2>{1, Rational(1, 3)}, kernel), Sign::Zero);
  EXPECT_EQ(
      side(third, RationalPoint<2>{1, Rational("333333333333333333334/1000000000000000000000")},
           kernel),
      Sign::Negative);
  EXPECT_EQ(side(third, RationalPoint<2>{Rational(1, 2), 1}, kernel), Sign::Negative);
}

TEST(Side, OfTheMeetingPointOfTwoLinesIsExact) {
  Kernel kernel;
  // Both meet at (1/3, 1/7).
  const Line first = line(1, 1, Rational(-10, 21)), second = line(1, -1, Rational(-4, 21));
  EXPECT_EQ(side(line(3, 0, -1), first, second, kernel), Sign::Zero);
  EXPECT_EQ(side(line(0, 7, -1), second, first, kernel), Sign::Zero);
  EXPECT_EQ(side(line(1, 0, -1.0 / 3), first, second, kernel), Sign::Positive);
  EXPECT_EQ(kernel.decisions.by_exact, 3);
  EXPECT_EQ(side(line(1, 0, -1), first, second, kernel), Sign::Negative);
  EXPECT_EQ(kernel.decisions.by_double, 1);
}

TEST(Side, OfABoxIsToldUnlessItMeetsTheLine) {
  Kernel kernel;
  const Line diagonal = line(1, 1, -1);
  EXPECT_EQ(side(diagonal, Box<2>{{0, 0}, {0.4, 0.5}}, kernel), Sign::Negative);
  EXPECT_EQ(side(diagonal, Box<2>{{0.6, 0.5}, {1, 1}}, kernel), Sign::Positive);
  EXPECT_EQ(side(diagonal, Box<2>{{0, 0}, {0.5, 0.5}}, kernel), std::nullopt);
  EXPECT_EQ(side(diagonal, Box<2>{{0.5, 0.5}, {1, 1}}, kernel), std::nullopt);
  EXPECT_EQ(side(diagonal, Box<2>{{0, 0}, {1, 1}}, kernel), std::nullopt);
  EXPECT_EQ(side(line(-1, 2, 0), Box<2>{{1, -1}, {2, 0.25}}, kernel), Sign::Negative);
}

}  // namespace
}  // namespace encase
