// SPDX-License-Identifier: MIT
//
// What boxes and segments prove about expressions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analytic_scenes.hpp"
#include "common/analytic_gaps.hpp"
#include "common/box_tests.hpp"
#include "common/segments.hpp"
#include "common/subdivision.hpp"

namespace encase {
namespace {

using namespace analytic;
constexpr double kPi = std::numbers::pi;

FilteredFunction<2> filtered(const Expression& f) { return FilteredFunction<2>(Function<2>(f)); }

Box<2> around(double x, double y, double radius) {
  return {{x - radius, y - radius}, {x + radius, y + radius}};
}

const Line kAxis{{0, 1}, 0, nullptr};  // y = 0, parametrised by x

TEST(ExpressionProofs, SignsOnBoxes) {
  Kernel kernel;
  EXPECT_EQ(sign_on_box(filtered(sin(x() * y()) + c(2)), around(0, 0, 3), kernel), Sign::Positive);
  EXPECT_EQ(sign_on_box(filtered(sin(x()) - c(101, 100)), around(0, 0, 5), kernel), Sign::Negative);
  EXPECT_EQ(sign_on_box(filtered(sin(x())), around(0, 0, 5), kernel), std::nullopt);
  EXPECT_EQ(sign_on_box(filtered(of(Operation::Log, x())), around(0.5, 0, 0.6), kernel),
            std::nullopt);
  EXPECT_EQ(sign_on_box(filtered(of(Operation::Log, x())), around(0.5, 0, 0.4), kernel),
            Sign::Negative);
}

TEST(ExpressionProofs, SignsAtPoints) {
  Kernel kernel;
  const Expression f = sin(x()) * c(2) - c(1);  // zero at pi/6
  const Rational near(kPi / 6);
  const Sign below = filtered(f).sign_at({Rational(near - Rational(1, 1000000000)), 0}, kernel);
  EXPECT_EQ(below, Sign::Negative);
  EXPECT_NE(filtered(f).sign_at({near, 0}, kernel), Sign::Zero);
  EXPECT_GT(kernel.decisions.by_mpfr, 0);
  // Not told apart, and exactly zero.
  EXPECT_EQ(filtered(sin(x()) - y()).sign_at({0, 0}, kernel), Sign::Zero);
  EXPECT_EQ(filtered(c(1) / x() - y()).sign_at({Rational(1, 3), 3}, kernel), Sign::Zero);
  EXPECT_EQ(filtered(of(Operation::Log, x())).sign_at({-1, 0}, kernel), Sign::Zero);
}

TEST(ExpressionProofs, RootsOnLines) {
  Kernel kernel;
  const auto f = filtered(sin(x()) + y());
  const auto roots = isolate_on_line(f, kAxis, -1, 7, 1000, kernel);
  ASSERT_TRUE(roots);
  ASSERT_EQ(roots->size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const double root = kPi * static_cast<double>(k);
    EXPECT_LT((*roots)[k].lo, root);
    EXPECT_GT((*roots)[k].hi, root);
    EXPECT_TRUE(one_root_on_line(f, kAxis, (*roots)[k].lo, (*roots)[k].hi, kernel));
  }
  EXPECT_FALSE(one_root_on_line(f, kAxis, -1, 7, kernel));
  EXPECT_FALSE(one_root_on_line(f, kAxis, 1, 2, kernel));
  EXPECT_TRUE(no_root_on_line(f, kAxis, 0.01, 3.1, kernel));
  EXPECT_FALSE(no_root_on_line(f, kAxis, 0.01, 3.2, kernel));
  EXPECT_TRUE(no_root_on_segment(f, {0.1, 0}, {3, 0.1}, kernel));
  RootInterval root{3, 3.3};
  while (refine_on_line(f, kAxis, &root, kernel)) continue;
  EXPECT_LT(root.hi - root.lo, 1e-14);
  EXPECT_LE(root.lo, kPi);
  EXPECT_LE(kPi, root.hi);
  // A double root, and a pole between signs that differ.
  EXPECT_FALSE(isolate_on_line(filtered(sin(x()).power(2)), kAxis, -1, 1, 500, kernel));
  EXPECT_FALSE(one_root_on_line(filtered(c(1) / x()), kAxis, -1, 1.25, kernel));
}

TEST(ExpressionProofs, CommonZeros) {
  Kernel kernel;
  const auto f = filtered(sin(x()) - y()), g = filtered(exp(y()) - x() - c(1));
  const double at = 0;  // both pass the origin with the slope 1, and touch
  EXPECT_FALSE((exactly_one_zero<2>({&f, &g}, around(at, at, 1e-3), kernel)));
  const auto h = filtered(cos(x() + y()));
  const double half = 0.83171119 / 1;  // sin(x) = pi/2 - x
  EXPECT_TRUE((exactly_one_zero<2>({&f, &h}, around(half, std::sin(half), 1e-3), kernel)));
  EXPECT_TRUE((at_most_one_zero<2>({&f, &h}, around(half, std::sin(half), 1e-2), kernel)));
  EXPECT_FALSE((exactly_one_zero<2>({&f, &h}, around(half + 0.1, std::sin(half), 1e-3), kernel)));
  EXPECT_TRUE((no_common_zero<2>({&f, &h}, around(half + 0.1, std::sin(half), 1e-2), kernel)));
  EXPECT_TRUE(no_relevant_critical_point(f, around(1, 1, 0.2), kernel));
  const auto hill = filtered(cos(x()) * cos(y()) + c(1));
  EXPECT_FALSE(no_relevant_critical_point(hill, around(0, 0, 0.1), kernel));
}

TEST(Gaps, AreWhereTheFunctionIsNotAnalytic) {
  const Box<2> root = subdivision_root<2>({{-2, -2}, {2, 2}});
  const auto gaps = [&](const Expression& f) {
    Kernel kernel;
    return find_gaps(FilteredFunction<2>(Function<2>(f)), root, kernel);
  };
  EXPECT_TRUE(gaps(sin(x() * y()) / (c(2) + cos(x()))).empty());
  // A line: one strip; a point: tiny boxes; a diagonal: a chain.
  for (const Expression& f : {of(Operation::Abs, x()), of(Operation::Sqrt, x()) - y(),
                              x() / x().power(2), sin(x()) / x() - y()}) {
    const auto strip = gaps(f);
    ASSERT_EQ(strip.size(), 1u) << f.to_string();
    EXPECT_LT(strip[0].hi[0], 1e-3 * root.width(0)) << f.to_string();
    EXPECT_TRUE(strip[0].contains(Point<2>{0, 0.5}));
  }
  // Poles near which the numerator has no zero.
  for (const Expression& f :
       {c(1) / x(), c(1) / x() - y(), y() - of(Operation::Tan, c(2) * x()), x().power(-2) - c(4),
        c(1) - c(1) / (x().power(2) + y().power(2)), y() - of(Operation::Tan, c(3) * x() + y())})
    EXPECT_TRUE(gaps(f).empty()) << f.to_string();
  // One at which a curve ends: y = x at the origin.
  const auto hole = gaps((x().power(2) - x() * y()) / (x().power(2) + y().power(2)));
  ASSERT_FALSE(hole.empty());
  for (const Box<2>& box : hole) EXPECT_TRUE(around(0, 0, 1e-6).contains(box));
  for (const Box<2>& box : gaps(of(Operation::Sqrt, x().power(2) + y().power(2))))
    EXPECT_LT(box.largest_width(), 1e-7);
  const auto chain = gaps(of(Operation::Abs, x() - y()));
  for (int k = -10; k <= 10; ++k) {
    const Point<2> at{0.1 * k, 0.1 * k};
    EXPECT_TRUE(std::any_of(chain.begin(), chain.end(),
                            [&](const Box<2>& box) { return box.contains(at); }));
  }
  for (const Box<2>& box : chain) EXPECT_LT(box.largest_width(), 0.25);
  EXPECT_LE(gathered(chain, root).size(), 60u);
  // No value at all.
  EXPECT_EQ(gaps(of(Operation::Sqrt, -c(1) - x().power(2))).size(), 1u);
}

}  // namespace
}  // namespace encase
