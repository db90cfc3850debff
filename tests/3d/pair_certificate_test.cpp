// SPDX-License-Identifier: MIT
#include "3d/pair_certificate.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>

#include "common/random_polynomials.hpp"
#include "written.hpp"

namespace encase {
namespace {

using Surface3 = FilteredFunction<3>;

Surface3 surface(const std::string& text) { return Surface3(written::polynomial<3>(text)); }

Box<3> cube(double lo, double hi) { return {{lo, lo, lo}, {hi, hi, hi}}; }

std::optional<PairCertificate> apart(const Surface3& f, const Surface3& g, const Box<3>& box) {
  Kernel kernel;
  Bernstein<3> net_f, net_g;
  const int degree = std::max(f.degree(), g.degree());
  f.expand(box, degree, Kernel::kDoubleBits, kernel, &net_f);
  g.expand(box, degree, Kernel::kDoubleBits, kernel, &net_g);
  return find_apart(net_f, net_g, box, f.scale(), g.scale());
}

std::optional<PairCertificate> local(const Surface3& f, const Surface3& g, const Box<3>& box) {
  Kernel kernel;
  return find_local(f, g, box, Kernel::kDoubleBits, kernel);
}

bool proved(const PairCertificate& c, const Surface3& f, const Surface3& g) {
  Kernel kernel;
  return holds(c, f, g, kernel);
}

TEST(PairCertificate, SurfacesThatDoNotMeetAreApart) {
  const Surface3 inner = surface("x^2+y^2+z^2-1"), outer = surface("x^2+y^2+z^2-2");
  const auto c = apart(inner, outer, cube(-3, 3));
  ASSERT_TRUE(c);
  EXPECT_TRUE(proved(*c, inner, outer));
  PairCertificate swapped = *c;
  std::swap(swapped.alpha, swapped.beta);
  EXPECT_FALSE(proved(swapped, inner, outer));
  // Of different degrees and scales.
  const Surface3 far = surface("4096*(x^4+y^4+z^4-100)"), near = surface("(x+y+z)/1000");
  const auto mixed = apart(far, near, {{3.5, -1, -1}, {4, 1, 1}});
  ASSERT_TRUE(mixed);
  EXPECT_TRUE(proved(*mixed, far, near));
}

TEST(PairCertificate, SurfacesThatMeetAreNotApart) {
  const Surface3 f = surface("x^2+y^2+z^2-1");
  EXPECT_FALSE(apart(f, surface("x"), cube(-2, 2)));
  EXPECT_FALSE(apart(f, surface("x-1"), cube(-2, 2)));  // touch in a point
  EXPECT_FALSE(apart(f, surface("x-1+1/1000000000000"), cube(-2, 2)));
  EXPECT_FALSE(apart(f, f, cube(-2, 2)));
}

TEST(PairCertificate, ArcsGrowAlongTheDirection) {
  // A quarter of the circle x^2 + y^2 = 1, z = 0.
  const Surface3 f = surface("x^2+y^2+z^2-1"), g = surface("z");
  const Box<3> box{{0.1, 0.1, -0.5}, {1.2, 1.2, 0.5}};
  const auto c = local(f, g, box);
  ASSERT_TRUE(c);
  EXPECT_TRUE(proved(*c, f, g));
  // grad f x grad g = (2y, -2x, 0).
  for (const double t : {0.2, 0.8, 1.3}) {
    EXPECT_GT(std::sin(t) * c->direction[0] - std::cos(t) * c->direction[1], 0);
  }
  PairCertificate bad = *c;
  for (double& w : bad.direction) w = -w;
  EXPECT_FALSE(proved(bad, f, g));
  bad = *c;
  bad.box = cube(-1.2, 1.2);
  EXPECT_FALSE(proved(bad, f, g));
  bad = *c;
  bad.kind = PairCertificate::Kind::Listed;
  EXPECT_FALSE(proved(bad, f, g));
}

TEST(PairCertificate, IsNotFoundForClosedCurvesNorContacts) {
  const Surface3 f = surface("x^2+y^2+z^2-1");
  EXPECT_FALSE(local(f, surface("z"), cube(-2, 2)));                             // a circle
  EXPECT_FALSE(local(f, surface("x^2+y^2-1/10000"), cube(-2, 2)));               // two small ones
  EXPECT_FALSE(local(f, surface("x-1"), {{0.5, -0.4, -0.3}, {1.5, 0.4, 0.3}}));  // a contact
  EXPECT_FALSE(local(surface("x^2+y^2-1"), surface("y^2+z^2-1"), cube(-2, 2)));  // crossing
  EXPECT_FALSE(local(f, f, cube(-2, 2)));
}

TEST(PairCertificate, InequalityHoldsAtRandomPointsExactly) {
  std::mt19937_64 generator(11);
  int found = 0;
  for (int degree = 1; degree <= 4; ++degree) {
    RandomOptions options;
    options.degree = degree;
    options.seed = 2;
    const auto polynomials = random_polynomials<3>(options);
    const Polynomial<3>&f = polynomials[0], &g = polynomials[1];
    for (int k = 0; k < 40; ++k) {
      Box<3> box;
      for (int i = 0; i < 3; ++i) {
        box.lo[i] = symmetric_random(generator);
        box.hi[i] = box.lo[i] + 0.3 * (1.5 + symmetric_random(generator));
      }
      const auto c = local(Surface3(f), Surface3(g), box);
      if (!c) continue;
      ++found;
      EXPECT_TRUE(proved(*c, Surface3(f), Surface3(g)));
      Polynomial<3> claim = Polynomial<3>::constant(Rational(c->alpha)) * f +
                            Polynomial<3>::constant(Rational(c->beta)) * g;
      for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        claim = claim + Polynomial<3>::constant(Rational(c->direction[i])) *
                            (f.derivative(a) * g.derivative(b) - f.derivative(b) * g.derivative(a));
      }
      for (int p = 0; p < 10; ++p) {
        RationalPoint<3> at;
        for (int i = 0; i < 3; ++i) {
          const Rational t(static_cast<unsigned long>(generator() % 1025), 1024);
          at[i] = Rational(box.lo[i]) + t * (Rational(box.hi[i]) - Rational(box.lo[i]));
        }
        EXPECT_GT(claim(at), 0);
      }
    }
  }
  EXPECT_GT(found, 60);
}

TEST(PairCertificate, ExpressionsHaveThemToo) {
  const Expression x = Expression::variable(0), y = Expression::variable(1),
                   z = Expression::variable(2);
  const Surface3 f(Function<3>(z - Expression::apply(Operation::Sin, x + y))), g = surface("x-y");
  const auto c = local(f, g, cube(-0.3, 0.3));
  ASSERT_TRUE(c);
  EXPECT_TRUE(proved(*c, f, g));
  EXPECT_GT(std::abs(c->direction[0] + c->direction[1]), 0);
}

}  // namespace
}  // namespace encase
