// SPDX-License-Identifier: MIT
#include "3d/graph_certificate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "common/random_polynomials.hpp"
#include "exact_bernstein.hpp"
#include "written.hpp"

namespace encase {
namespace {

using Surface3 = FilteredFunction<3>;

Surface3 surface(const std::string& text) { return Surface3(written::polynomial<3>(text)); }

Box<3> cube(double lo, double hi) { return {{lo, lo, lo}, {hi, hi, hi}}; }

std::optional<GraphCertificate> graph(const Surface3& f, const Box<3>& box) {
  Kernel kernel;
  Bernstein<3> net;
  f.expand(box, f.degree(), Kernel::kDoubleBits, kernel, &net);
  NetColumns<5> columns;
  field_columns(net, &columns);
  return find_graph(columns, box);
}

bool proved(const GraphCertificate& c, const Surface3& f) {
  Kernel kernel;
  return holds(c, f, kernel);
}

const std::string kTorus = "(x^2+y^2+z^2+3)^2-16*(x^2+y^2)";  // radii 2 and 1

/// V . grad f + multiplier f, exactly.
Polynomial<3> claim(const GraphCertificate& c, const Polynomial<3>& f) {
  const auto constant = [](double value) { return Polynomial<3>::constant(Rational(value)); };
  Polynomial<3> sum = constant(c.multiplier) * f;
  for (int i = 0; i < 3; ++i) {
    const Polynomial<3> v =
        constant(c.direction[i]) +
        constant(c.spread) * (Polynomial<3>::variable(i) - constant(c.center[i]));
    sum = sum + v * f.derivative(i);
  }
  return sum;
}

/// A random point of a box, with few digits.
RationalPoint<3> random_point(const Box<3>& box, std::mt19937_64& generator) {
  RationalPoint<3> p;
  for (int i = 0; i < 3; ++i) {
    const Rational t(static_cast<unsigned long>(generator() % 1025), 1024);
    p[i] = Rational(box.lo[i]) + t * (Rational(box.hi[i]) - Rational(box.lo[i]));
  }
  return p;
}

TEST(GraphCertificate, QuadricsNeedOneBox) {
  for (const char* text :
       {"x^2+y^2+z^2-1", "x^2+y^2-1", "x^2+2*y^2-z^2-1", "x^2+y^2-z^2+1", "x*y-z", "x-y+3*z-1",
        "x^2-y", "3*x^2+2*x*y+y^2+5*z^2-x-2", "z^2-1/100"}) {
    const Surface3 f = surface(text);
    const auto c = graph(f, cube(-2, 2));
    ASSERT_TRUE(c) << text;
    EXPECT_TRUE(proved(*c, f)) << text;
  }
}

TEST(GraphCertificate, LinesAreParallelWhereTheyCanBe) {
  const auto plane = graph(surface("x-y+3*z-1"), cube(-2, 2));
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->spread, 0);
  const auto cap = graph(surface("x^2+y^2+z^2-1"), {{-0.5, -0.5, 0.5}, {0.5, 0.5, 1.5}});
  ASSERT_TRUE(cap);
  EXPECT_EQ(cap->spread, 0);
  EXPECT_GT(cap->direction[2], 0);
  const auto sphere = graph(surface("x^2+y^2+z^2-1"), cube(-2, 2));
  ASSERT_TRUE(sphere);
  EXPECT_NE(sphere->spread, 0);
}

TEST(GraphCertificate, IsNotFoundForWhatIsNoGraph) {
  // A handle, two closed components, a closed one beside a sheet, three sheets, singular points.
  for (const char* text : {kTorus.c_str(), "((x-1)^2+y^2+z^2-1/4)*((x+1)^2+y^2+z^2-1/4)-1/1000",
                           "(x^2+y^2+z^2-1/4)*(x-1)-1/1000", "z*(z^2-1/4)", "x^2+y^2-z^2", "x*y*z",
                           "x^2-y^2*z", "(x^2+y^2+z^2-1)^2"})
    EXPECT_FALSE(graph(surface(text), cube(-4, 4))) << text;
  // Even where it is as thin as a cone's neck of 1e-4.
  EXPECT_FALSE(graph(surface("(x^2+y^2-z^2-1/100000000)*(z-3)"), cube(-4, 4)));
}

TEST(GraphCertificate, IsRefusedIfItsNumbersAreOthers) {
  const Surface3 f = surface("x^2+y^2+z^2-1");
  const GraphCertificate good = *graph(f, cube(-2, 2));
  ASSERT_TRUE(proved(good, f));
  for (int i = 0; i < 3; ++i) {
    GraphCertificate moved = good;
    moved.center[i] += 1.5;
    EXPECT_FALSE(proved(moved, f));
  }
  GraphCertificate bad = good;
  bad.spread = -bad.spread;
  EXPECT_FALSE(proved(bad, f));
  bad = good;
  bad.multiplier = 0;
  EXPECT_FALSE(proved(bad, f));
  bad = good;
  bad.multiplier = std::nan("");
  EXPECT_FALSE(proved(bad, f));
  bad = good;
  bad.direction[0] = HUGE_VAL;
  EXPECT_FALSE(proved(bad, f));
  // The claim is about the surface: another one through the same box does not have it.
  EXPECT_FALSE(proved(good, surface(kTorus)));
}

TEST(GraphCertificate, InequalityHoldsAtRandomPointsExactly) {
  std::mt19937_64 generator(5);
  int certificates = 0;
  for (int degree = 2; degree <= 5; ++degree) {
    RandomOptions options;
    options.degree = degree;
    options.count = 1;
    options.seed = 3;
    const Polynomial<3> f = random_polynomials<3>(options)[0];
    const Surface3 filtered(f);
    for (int k = 0; k < 40; ++k) {
      Box<3> box;
      for (int i = 0; i < 3; ++i) {
        box.lo[i] = symmetric_random(generator);
        box.hi[i] = box.lo[i] + 0.4 * (1 + 0.5 * symmetric_random(generator));
      }
      const auto c = graph(filtered, box);
      if (!c) continue;
      ++certificates;
      EXPECT_TRUE(proved(*c, filtered));
      const Polynomial<3> positive = claim(*c, f);
      for (int p = 0; p < 20; ++p) EXPECT_GT(positive(random_point(box, generator)), 0);
      for (int corner = 0; corner < 8; ++corner) {
        RationalPoint<3> p;
        for (int i = 0; i < 3; ++i) p[i] = Rational((corner >> i) % 2 != 0 ? box.hi[i] : box.lo[i]);
        EXPECT_GT(positive(p), 0);
      }
    }
  }
  EXPECT_GT(certificates, 60);
}

TEST(GraphCertificate, LinesMeetTheSurfaceAtMostOnce) {
  const Polynomial<3> f = written::polynomial<3>(kTorus);
  const Surface3 filtered(f);
  std::mt19937_64 generator(7);
  int lines = 0, met = 0;
  for (int k = 0; k < 300; ++k) {
    Box<3> box;
    for (int i = 0; i < 3; ++i) {
      box.lo[i] = 3 * symmetric_random(generator);
      box.hi[i] = box.lo[i] + 1.2;
    }
    const auto c = graph(filtered, box);
    if (!c) continue;
    // Along V(x) from a point of the box, as far as the line stays in it.
    const Point<3> start{box.lo[0] + 0.6, box.lo[1] + 0.6, box.lo[2] + 0.6};
    Point<3> v;
    for (int i = 0; i < 3; ++i) v[i] = c->direction[i] + c->spread * (start[i] - c->center[i]);
    int changes = 0;
    double before = 0;
    for (int step = -400; step <= 400; ++step) {
      Point<3> at = start;
      for (int i = 0; i < 3; ++i) at[i] += 0.005 * step * v[i];
      // Beyond the pole V turns round; the line ends there.
      double ahead = 0;
      for (int i = 0; i < 3; ++i)
        ahead += v[i] * (c->direction[i] + c->spread * (at[i] - c->center[i]));
      if (!box.contains(at) || ahead <= 0) continue;
      const double value = filtered.approximate(at);
      if (before != 0 && (value > 0) != (before > 0)) {
        ++changes;
        EXPECT_GT(value, 0);
      }
      before = value;
    }
    ++lines;
    met += changes;
    EXPECT_LE(changes, 1);
  }
  EXPECT_GT(lines, 50);
  EXPECT_GT(met, 10);
}

TEST(GraphCertificate, ColumnsAreTheDerivativesWithinTheirRadius) {
  for (const char* text : {"x^3-2*x*y*z+y^2/3-z/7+1/9", "x^5+y^4*z-3*x*y-1/3", "x+y/3-z"}) {
    const Polynomial<3> f = written::polynomial<3>(text);
    const int n = f.degree();
    // On [-1,1]^3 the chart's coordinates are x, y, z.
    Kernel kernel;
    Bernstein<3> net;
    const Surface3 filtered(f);
    filtered.expand(cube(-1, 1), n, Kernel::kDoubleBits, kernel, &net);
    NetColumns<5> columns;
    field_columns(net, &columns);
    Polynomial<3> euler;
    std::array<Polynomial<3>, 5> expected;
    for (int i = 0; i < 3; ++i) {
      expected[static_cast<std::size_t>(i)] = f.derivative(i);
      euler = euler + Polynomial<3>::variable(i) * f.derivative(i);
    }
    expected[3] = euler;
    expected[4] = f;
    for (std::size_t i = 0; i < 5; ++i) {
      const auto exact = exact_bernstein::coefficients<3>(expected[i], {n, n, n});
      for (std::size_t k = 0; k < exact.size(); ++k)
        EXPECT_LE(abs(Rational(columns.columns[i][k]) * Rational(filtered.scale()) - exact[k]),
                  Rational(columns.radius[i]) * Rational(filtered.scale()));
    }
  }
}

TEST(GraphCertificate, PrecisionClimbsWhereRoundingHidesTheSign) {
  // A sphere of radius 2^-45 around (1, 1, 1): its equation's terms cancel.
  const auto square = [](int axis) {
    return (Polynomial<3>::variable(axis) - Polynomial<3>::constant(1)).power(2);
  };
  const Polynomial<3> f =
      square(0) + square(1) + square(2) - Polynomial<3>::constant(Rational(0x1p-90));
  GraphCertificate radial;
  radial.box = cube(1 - 0x1p-44, 1 + 0x1p-44);
  radial.spread = 1;
  radial.center = {1, 1, 1};
  radial.multiplier = -2;  // 2 r^2 - 2 (r^2 - 2^-90)
  Kernel kernel;
  EXPECT_TRUE(holds(radial, Surface3(f), kernel));
  EXPECT_GT(kernel.decisions.by_mpfr, 0);
  Kernel capped;
  capped.max_bits = Kernel::kDoubleBits;
  EXPECT_FALSE(holds(radial, Surface3(f), capped));
}

TEST(GraphCertificate, ExpressionsHaveThemToo) {
  const Expression x = Expression::variable(0), y = Expression::variable(1),
                   z = Expression::variable(2);
  const Surface3 f(Function<3>(z - Expression::apply(Operation::Sin, x + y)));
  const auto c = graph(f, cube(-0.5, 0.5));
  ASSERT_TRUE(c);
  EXPECT_TRUE(proved(*c, f));
}

}  // namespace
}  // namespace encase
