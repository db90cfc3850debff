// SPDX-License-Identifier: MIT
#include "common/box_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/random_polynomials.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

template <int D>
FilteredFunction<D> filtered(const std::string& text) {
  return FilteredFunction<D>(polynomial<D>(text));
}

const Box<2> kSquare{{-1, -1}, {1, 1}};

Box<2> around(double x, double y, double radius) {
  return {{x - radius, y - radius}, {x + radius, y + radius}};
}

TEST(SignOnBox, IsProvedOnlyAwayFromTheCurve) {
  Kernel kernel;
  const auto circle = filtered<2>("x^2 + y^2 - 1");
  EXPECT_EQ(sign_on_box<2>(circle, around(0, 0, 0.5), kernel), Sign::Negative);
  EXPECT_EQ(sign_on_box<2>(circle, around(2, 0, 0.5), kernel), Sign::Positive);
  EXPECT_EQ(sign_on_box<2>(circle, around(1, 0, 0.5), kernel), std::nullopt);
  // The circle touches the box from outside at (1, 0): the closed box holds a zero.
  EXPECT_EQ(sign_on_box<2>(circle, Box<2>{{1, -0.25}, {2, 0.25}}, kernel), std::nullopt);
  EXPECT_EQ(sign_on_box<3>(filtered<3>("x + y + z - 4"), Box<3>{{0, 0, 0}, {1, 1, 1}}, kernel),
            Sign::Negative);
  EXPECT_EQ(sign_on_box<1>(filtered<1>("x^2 - 2"), Box<1>{{1.5}, {2}}, kernel), Sign::Positive);
}

TEST(SignOnBox, MpfrDecidesWhatRoundingHides) {
  const auto f = filtered<2>("(x - 1/3)^2 + (y - 1/7)^2");
  const Box<2> box = around(0.3333333, 0.14286, 0x1p-30);
  Kernel kernel;
  EXPECT_EQ(sign_on_box<2>(f, box, kernel), Sign::Positive);
  EXPECT_EQ(kernel.decisions.by_double, 1);
  const Box<2> near = around(1.0 / 3 + 0x1p-35, 1.0 / 7, 0x1p-40);
  EXPECT_EQ(sign_on_box<2>(f, near, kernel), Sign::Positive);
  EXPECT_EQ(kernel.decisions.by_mpfr, 1);
  kernel.max_bits = 53;
  EXPECT_EQ(sign_on_box<2>(f, near, kernel), std::nullopt);
  kernel.max_bits = 848;
  kernel.start_bits = 106;
  EXPECT_EQ(sign_on_box<2>(f, box, kernel), Sign::Positive);
  EXPECT_EQ(kernel.decisions.by_mpfr, 2);
}

TEST(NoCommonZero, CurvesThatBothPassButDoNotMeetAreExcluded) {
  Kernel kernel;
  const auto f = filtered<2>("y - x + x^2/50"), g = filtered<2>("y - x + x^2/50 - 1/8");
  EXPECT_EQ(sign_on_box<2>(f, kSquare, kernel), std::nullopt);
  EXPECT_TRUE(no_common_zero<2>({&f, &g}, kSquare, kernel));
  const auto h = filtered<2>("y + x");
  EXPECT_FALSE(no_common_zero<2>({&f, &h}, kSquare, kernel));
}

TEST(ExactlyOneZero, HoldsWhereTheZeroIsInside) {
  Kernel kernel;
  const auto line = filtered<2>("y - x"), circle = filtered<2>("x^2 + y^2 - 1");
  const System<2> system{&line, &circle};
  const double r = std::sqrt(0.5);
  EXPECT_TRUE(exactly_one_zero<2>(system, around(r, r, 0.1), kernel));
  EXPECT_TRUE(exactly_one_zero<2>(system, around(r, r, 1e-9), kernel));
  EXPECT_TRUE(exactly_one_zero<2>(system, around(r + 0.03, r - 0.02, 0.1), kernel));
  EXPECT_FALSE(exactly_one_zero<2>(system, around(0, 0, 1), kernel));  // two
  EXPECT_FALSE(exactly_one_zero<2>(system, around(r + 0.2, r, 0.1), kernel));
  EXPECT_TRUE(at_most_one_zero<2>(system, around(r + 0.2, r, 0.1), kernel));
  EXPECT_FALSE(at_most_one_zero<2>(system, around(0, 0, 1), kernel));
}

TEST(ExactlyOneZero, FailsWhereTheZeroIsOnTheBoundary) {
  Kernel kernel;
  const auto f = filtered<2>("x + y/3"), g = filtered<2>("y - x/5");
  EXPECT_TRUE(exactly_one_zero<2>({&f, &g}, around(0, 0, 1), kernel));
  EXPECT_FALSE(exactly_one_zero<2>({&f, &g}, Box<2>{{0, -1}, {2, 1}}, kernel));
  EXPECT_FALSE(exactly_one_zero<2>({&f, &g}, Box<2>{{0, 0}, {1, 1}}, kernel));
  EXPECT_TRUE(at_most_one_zero<2>({&f, &g}, Box<2>{{0, 0}, {1, 1}}, kernel));
}

TEST(ExactlyOneZero, FailsAtADoubleZero) {
  Kernel kernel;
  const auto line = filtered<2>("y"), parabola = filtered<2>("y - x^2"),
             node = filtered<2>("x^2 - y^2 - x^3"), other = filtered<2>("y - 2x");
  for (const double radius : {1.0, 1e-3, 1e-12}) {
    EXPECT_FALSE(exactly_one_zero<2>({&line, &parabola}, around(0, 0, radius), kernel));
    EXPECT_FALSE(at_most_one_zero<2>({&line, &parabola}, around(0, 0, radius), kernel));
    EXPECT_FALSE(at_most_one_zero<2>({&node, &other}, around(0, 0, radius), kernel));
    EXPECT_FALSE(no_common_zero<2>({&line, &parabola}, around(0, 0, radius), kernel));
  }
}

TEST(ExactlyOneZero, HoldsInOneAndThreeVariables) {
  Kernel kernel;
  const auto f = filtered<1>("x^2 - 2");
  const double root = std::sqrt(2.0);
  EXPECT_TRUE(exactly_one_zero<1>({&f}, Box<1>{{1}, {2}}, kernel));
  EXPECT_FALSE(exactly_one_zero<1>({&f}, Box<1>{{-2}, {2}}, kernel));
  EXPECT_TRUE(exactly_one_zero<1>({&f}, Box<1>{{root - 1e-14}, {root + 1e-14}}, kernel));
  EXPECT_FALSE(exactly_one_zero<1>({&f}, Box<1>{{1}, {1.25}}, kernel));

  const auto a = filtered<3>("x^2 + y^2 + z^2 - 1"), b = filtered<3>("x - y"),
             c = filtered<3>("y - z");
  const double r = std::sqrt(1.0 / 3);
  EXPECT_TRUE(exactly_one_zero<3>(
      {&a, &b, &c}, {{r - 0.1, r - 0.1, r - 0.1}, {r + 0.1, r + 0.15, r + 0.1}}, kernel));
  EXPECT_FALSE(exactly_one_zero<3>({&a, &b, &c}, {{-1, -1, -1}, {1, 1, 1}}, kernel));
  EXPECT_TRUE(no_common_zero<3>({&a, &b, &c}, {{0.25, 0.75, 0}, {0.5, 1, 0.5}}, kernel));
}

TEST(ExactlyOneZero, BoxesWithoutADoubleCentreAreNotTrustedTooFar) {
  // The zero is at the corner or just beyond it; nets of such boxes cover slightly more.
  const double e = 0x1p-52;
  Kernel kernel;
  const auto f = filtered<2>("x - 1"), g = filtered<2>("y - 1");
  EXPECT_FALSE(exactly_one_zero<2>({&f, &g}, Box<2>{{1, 1}, {1 + 3 * e, 1 + 3 * e}}, kernel));
  EXPECT_FALSE(
      exactly_one_zero<2>({&f, &g}, Box<2>{{1 + e, 1 + e}, {1 + 4 * e, 1 + 4 * e}}, kernel));
  EXPECT_TRUE(exactly_one_zero<2>(
      {&f, &g}, Box<2>{{1 - 100 * e, 1 - 100 * e}, {1 + 75 * e, 1 + 83 * e}}, kernel));
}

/// Lines u = a_i and v = b_j with u = (3 x + 4 y) / 5, v = (4 x - 3 y) / 5, as two polynomials. The
/// common zeros are exactly known.
struct Grid {
  std::vector<Rational> a, b;
  FilteredFunction<2> f, g;

  static Polynomial<2> product(const Polynomial<2>& form, const std::vector<Rational>& values) {
    Polynomial<2> result = Polynomial<2>::constant(1);
    for (const Rational& value : values) result = result * (form - Polynomial<2>::constant(value));
    return result;
  }
  Grid(std::vector<Rational> a_values, std::vector<Rational> b_values)
      : a(std::move(a_values)),
        b(std::move(b_values)),
        f(product(polynomial<2>("3/5 x + 4/5 y"), a)),
        g(product(polynomial<2>("4/5 x - 3/5 y"), b)) {}

  /// The numbers of zeros in the closed box and in its interior.
  std::pair<int, int> count(const Box<2>& box) const {
    int closed = 0, open = 0;
    for (const Rational& u : a)
      for (const Rational& v : b) {
        const Rational x = (3 * u + 4 * v) / 5, y = (4 * u - 3 * v) / 5;
        closed += box.lo[0] <= x && x <= box.hi[0] && box.lo[1] <= y && y <= box.hi[1];
        open += box.lo[0] < x && x < box.hi[0] && box.lo[1] < y && y < box.hi[1];
      }
    return {closed, open};
  }
};

TEST(BoxTests, ClaimsOnRandomBoxesAreTrue) {
  const Grid grid({Rational(-3, 4), Rational(-1, 8), Rational(1, 3), Rational(1, 2)},
                  {Rational(-2, 3), Rational(1, 10), Rational(11, 100)});
  const System<2> system{&grid.f, &grid.g};
  std::mt19937_64 generator(1);
  int excluded = 0, single = 0, at_most = 0;
  for (int round = 0; round < 3000; ++round) {
    const double size = std::ldexp(1.0, -static_cast<int>(generator() % 12));
    Point<2> center{symmetric_random(generator), symmetric_random(generator)};
    if (round % 2) {  // near a zero, which may be at any place in or beside the box
      const Rational u = grid.a[generator() % 4], v = grid.b[generator() % 3];
      center = {Rational((3 * u + 4 * v) / 5).get_d() + size * symmetric_random(generator),
                Rational((4 * u - 3 * v) / 5).get_d() + size * symmetric_random(generator)};
    }
    const double w = size * 0.75 * std::fabs(symmetric_random(generator)),
                 h = size * 0.75 * std::fabs(symmetric_random(generator));
    const Box<2> box{{center[0] - w, center[1] - h}, {center[0] + w, center[1] + h}};
    const auto [closed, open] = grid.count(box);
    Kernel kernel;
    if (no_common_zero<2>(system, box, kernel)) {
      ++excluded;
      ASSERT_EQ(closed, 0);
    }
    const bool one = exactly_one_zero<2>(system, box, kernel);
    if (one) {
      ++single;
      ASSERT_EQ(closed, 1);
      ASSERT_EQ(open, 1);
    }
    const bool few = at_most_one_zero<2>(system, box, kernel);
    if (few) {
      ++at_most;
      ASSERT_LE(closed, 1);
    }
    EXPECT_TRUE(few || !one);
  }
  // The claims are not vacuous.
  EXPECT_GT(excluded, 500);
  EXPECT_GT(single, 50);
  EXPECT_GT(at_most, single + 100);
}

TEST(Contraction, WeightsAreContracted) {
  const auto f = filtered<3>("x + y^2/9 - z/10"), g = filtered<3>("y - x z/8"),
             h = filtered<3>("z + x y/7 - 1/3");
  SystemNets<3> nets;
  Kernel kernel;
  int k = 0;
  for (const auto* p : {&f, &g, &h})
    p->expand({{-1, -1, -1}, {1, 1, 1}}, 2, 53, kernel, &nets[static_cast<std::size_t>(k++)]);
  const auto c = contraction<3>(nets);
  ASSERT_TRUE(c.has_value());
  for (std::size_t i = 0; i < 3; ++i) {
    double image = 0;
    for (std::size_t j = 0; j < 3; ++j) image += c->bound[i][j] * c->weights[j];
    EXPECT_GT(c->weights[i], 0);
    EXPECT_LT(image, c->weights[i]);
  }
  EXPECT_FALSE(contraction<3>(nets, 0.01).has_value());
}

TEST(NoRelevantCriticalPoint, MaximaAndSingularPointsRemain) {
  Kernel kernel;
  const auto proved = [&](const std::string& text, const Box<2>& box) {
    return no_relevant_critical_point(filtered<2>(text), box, kernel);
  };
  for (const double radius : {0.25, 1e-3, 1e-10}) {
    const Box<2> box = around(0, 0, radius);
    // |f| has a local maximum: a loop may run around it.
    EXPECT_FALSE(proved("x^2 + 2y^2 - 1", box));
    EXPECT_FALSE(proved("1 - x^2 - x y - y^2", box));
    EXPECT_FALSE(proved("1 - x^4 - y^4", box));
    // A whole line of maxima.
    EXPECT_FALSE(proved("1 - x^2", box));
    // Singular points of the curve: a node, a cusp, an isolated point, a double line.
    EXPECT_FALSE(proved("x^2 - y^2", box));
    EXPECT_FALSE(proved("y^2 - x^3", box));
    EXPECT_FALSE(proved("x^2 + y^2", box));
    EXPECT_FALSE(proved("(x - y)^2", box));
  }
}

TEST(NoRelevantCriticalPoint, MinimaSaddlesAndRegularPointsAreDropped) {
  Kernel kernel;
  const auto proved = [&](const std::string& text, const Box<2>& box) {
    return no_relevant_critical_point(filtered<2>(text), box, kernel);
  };
  const Box<2> box = around(0, 0, 0.25);
  EXPECT_TRUE(proved("x^2 + y^2 + 1", box));    // a minimum of |f|
  EXPECT_TRUE(proved("-x^2 - y^2 - 1", box));   // the same
  EXPECT_TRUE(proved("x^2 - y^2 + 1/2", box));  // a saddle above
  EXPECT_TRUE(proved("x^2 - y^2 - 1/2", box));  // and below
  EXPECT_TRUE(proved("x y + 1", box));          // seen only by the Hessian's determinant
  EXPECT_TRUE(proved("x^2 + y^2 - 1", around(0.75, 0.5, 0.25)));
  EXPECT_TRUE(proved("y - x^2", box));
  // Both partial derivatives vanish in the box, but not together.
  EXPECT_TRUE(proved("(x - y)^2 + (x - y)/4 + (x + y - 1)^2/4", box));
}

}  // namespace
}  // namespace encase
