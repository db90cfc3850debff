// SPDX-License-Identifier: MIT
#include "3d/cut_net.hpp"

#include <gtest/gtest.h>

#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "exact_bernstein.hpp"
#include "written.hpp"

namespace encase {
namespace {

/// f in the coordinates [-1,1]^3 of a box, as `centered` has them.
Polynomial<3> in_chart(const Polynomial<3>& f, const Box<3>& box) {
  Polynomial<3> result;
  for (const auto& term : f.terms()) {
    Polynomial<3> product = Polynomial<3>::constant(term.coefficient);
    for (int i = 0; i < 3; ++i) {
      const Centered chart = centered(box.lo[i], box.hi[i]);
      const Polynomial<3> x =
          Polynomial<3>::constant(Rational(chart.center)) +
          Polynomial<3>::constant(Rational(chart.half)) * Polynomial<3>::variable(i);
      product = product * x.power(term.exponent[static_cast<std::size_t>(i)]);
    }
    result = result + product;
  }
  return result;
}

void expect_within_radius(const Bernstein<3>& net, const Polynomial<3>& f, double scale,
                          const Box<3>& box) {
  const auto exact = exact_bernstein::coefficients<3>(in_chart(f, box), net.degree);
  ASSERT_EQ(net.b.size(), exact.size());
  for (std::size_t k = 0; k < exact.size(); ++k)
    EXPECT_LE(abs(Rational(net.b[k]) * Rational(scale) - exact[k]),
              Rational(net.radius) * Rational(scale));
  EXPECT_LT(net.radius, 1e-12);
}

TEST(CutNet, PartsAreThePolynomialsOnTheirBoxes) {
  const Polynomial<3> f = written::polynomial<3>("x^3-2*x*y*z+y^2/3-z/7+1/9");
  const FilteredFunction<3> filtered(f);
  Kernel kernel;
  // With charts that are exact, and with ends and cuts that no short double is halfway between.
  for (const Box<3>& box : {Box<3>{{-1, -1, -1}, {1, 2, 1}}, {{-0.1, 0.3, -1.7}, {1.1, 0.9, 0.7}}})
    for (int axis = 0; axis < 3; ++axis)
      for (const double t : {0.25, 0.47, 1 / 3.0}) {
        Bernstein<3> net, lower, upper;
        filtered.expand(box, f.degree(), Kernel::kDoubleBits, kernel, &net);
        Box<3> below = box, above = box;
        const double at = box.lo[axis] + t * box.width(axis);
        below.hi[axis] = above.lo[axis] = at;
        cut(net, box, axis, at, &lower, &upper);
        expect_within_radius(lower, f, filtered.scale(), below);
        expect_within_radius(upper, f, filtered.scale(), above);
      }
}

TEST(CutNet, NothingIsClaimedWhereDoublesCannotTellTheEnds) {
  const FilteredFunction<3> f(written::polynomial<3>("x^3-y+z-1"));
  Kernel kernel;
  Bernstein<3> net, lower, upper;
  Box<3> box{{1, 0, 0}, {1 + 0x1p-48, 1, 1}};
  box.hi[0] += 0x1p-52;
  f.expand(box, 3, Kernel::kDoubleBits, kernel, &net);
  cut(net, box, 0, 1 + 0x1p-50, &lower, &upper);
  EXPECT_GT(lower.radius, 0.01);
}

}  // namespace
}  // namespace encase
