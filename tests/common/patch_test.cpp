// SPDX-License-Identifier: MIT
//
// Patches against rational arithmetic.
#include "common/patch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "common/random_polynomials.hpp"
#include "exact_bernstein.hpp"
#include "written.hpp"

namespace encase {
namespace {

using Random = std::mt19937_64;

/// A value, first and second derivatives.
struct Jet2 {
  Rational value, x, y, xx, yy, xy;
};

Polynomial<2> random_polynomial(int degree, Random& random) {
  std::vector<Polynomial<2>::Term> terms;
  for (const auto& e : dense_exponents<2>(degree))
    terms.push_back({e, Rational(symmetric_random(random))});
  return Polynomial<2>::from_terms(std::move(terms));
}

/// Bernstein's polynomials of a degree at u, exactly, or their derivatives with respect to s in
/// [-1,1], u = (s + 1) / 2.
std::vector<Rational> basis(int degree, const Rational& u, int derivative) {
  std::vector<Rational> b{Rational(1)};
  for (int n = 1; n <= degree - derivative; ++n) {
    b.emplace_back(0);
    for (int j = n; j >= 0; --j)
      b[j] = (j < n ? Rational(b[j] * (1 - u)) : Rational(0)) +
             (j > 0 ? Rational(b[j - 1] * u) : Rational(0));
  }
  for (int k = 1; k <= derivative; ++k) {
    // The derivative's coefficients are n / 2 times differences: weights of b[j - 1] and b[j].
    const int n = degree - derivative + k;
    b.emplace_back(0);
    for (int j = n; j >= 0; --j)
      b[j] = Rational(n, 2) * ((j > 0 ? b[j - 1] : Rational(0)) - (j < n ? b[j] : Rational(0)));
  }
  return b;
}

Rational dot(const Patch& patch, const std::vector<Rational>& of_x,
             const std::vector<Rational>& of_y) {
  const bool x_by_rows = patch.rows_axis == 0;
  Rational sum = 0;
  for (int i = 0; i < patch.count; ++i)
    for (int j = 0; j < patch.count; ++j)
      sum += Rational(patch.b[i][j]) * of_x[x_by_rows ? i : j] * of_y[x_by_rows ? j : i];
  return sum;
}

/// What the net says at (x, y) in [-1,1]^2.
Jet2 jet(const Patch& patch, const RationalPoint<2>& s) {
  const int n = patch.count - 1;
  std::array<std::array<std::vector<Rational>, 3>, 2> b;
  for (int i = 0; i < 2; ++i)
    for (int d = 0; d < 3; ++d) b[i][d] = basis(n, (s[i] + 1) / 2, d);
  return {dot(patch, b[0][0], b[1][0]), dot(patch, b[0][1], b[1][0]), dot(patch, b[0][0], b[1][1]),
          dot(patch, b[0][2], b[1][0]), dot(patch, b[0][0], b[1][2]), dot(patch, b[0][1], b[1][1])};
}

/// The exact polynomial's, in the coordinates of the box.
struct Exact {
  Polynomial<2> f, x, y, xx, yy, xy;
  Exact(const FilteredPolynomial<2>& polynomial)
      : f(Polynomial<2>::constant(1 / Rational(polynomial.scale())) * polynomial.exact()),
        x(f.derivative(0)),
        y(f.derivative(1)),
        xx(x.derivative(0)),
        yy(y.derivative(1)),
        xy(x.derivative(1)) {}
  Jet2 at(const Box<2>& box, const RationalPoint<2>& s) const {
    RationalPoint<2> p, h;
    for (int i = 0; i < 2; ++i) {
      const Rational lo(box.lo[i]), hi(box.hi[i]);
      h[i] = (hi - lo) / 2;
      p[i] = (lo + hi) / 2 + h[i] * s[i];
    }
    return {f(p),
            x(p) * h[0],
            y(p) * h[1],
            xx(p) * h[0] * h[0],
            yy(p) * h[1] * h[1],
            xy(p) * h[0] * h[1]};
  }
};

RationalPoint<2> random_point(Random& random) {
  RationalPoint<2> s;
  for (Rational& c : s) c = Rational(static_cast<int>(random() % 2001) - 1000, 1000);
  return s;
}

/// The polynomial is as far from the net as its radii say, or less, at some points; and the
/// extremes are those of the coefficients.
void expect_true(const Patch& patch, const Exact& exact, const Box<2>& box, Random& random) {
  ASSERT_TRUE(std::isfinite(patch.radius));
  double lo = HUGE_VAL, hi = -HUGE_VAL;
  for (int i = 0; i < patch.count; ++i)
    for (int j = 0; j < 8; ++j) {
      EXPECT_EQ(patch.b[i][j], patch.b[i][std::min(j, patch.count - 1)]);
      lo = std::min(lo, patch.b[i][j]);
      hi = std::max(hi, patch.b[i][j]);
    }
  EXPECT_EQ(patch.lo, lo);
  EXPECT_EQ(patch.hi, hi);
  const int rows = patch.rows_axis, lanes = 1 - rows;
  for (int round = 0; round < 4; ++round) {
    RationalPoint<2> s = random_point(random);
    if (round == 0) s = {Rational(-1), Rational(1)};
    if (round == 1) s[0] = 1;
    const Jet2 f = exact.at(box, s), net = jet(patch, s);
    const auto off = [](const Rational& a, const Rational& b) { return Rational(abs(a - b)); };
    EXPECT_LE(off(f.value, net.value), Rational(patch.radius));
    const Rational slope[2] = {off(f.x, net.x), off(f.y, net.y)};
    const Rational bend[2] = {off(f.xx, net.xx), off(f.yy, net.yy)};
    EXPECT_LE(slope[rows], Rational(patch.slope_radius[0]));
    EXPECT_LE(slope[lanes], Rational(patch.slope_radius[1]));
    EXPECT_LE(bend[rows], Rational(patch.bend_radius[0]));
    EXPECT_LE(bend[lanes], Rational(patch.bend_radius[1]));
    EXPECT_LE(off(f.xy, net.xy), Rational(patch.bend_radius[2]));
  }
}

/// A random box in [-1,1]^2 with centre and corners in few bits.
Box<2> random_box(int level, Random& random) {
  Box<2> box;
  for (int i = 0; i < 2; ++i) {
    const double width = std::ldexp(1.0, 1 - level);
    box.lo[i] = -1 + width * static_cast<double>(random() % (1ull << level));
    box.hi[i] = box.lo[i] + width;
  }
  return box;
}

class PatchOfDegree : public testing::TestWithParam<int> {};

TEST_P(PatchOfDegree, IsAsCloseAsItSays) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree));
  const FilteredPolynomial<2> f(random_polynomial(degree, random));
  const Exact exact(f);
  Kernel kernel;
  TiledPolynomial tiled(f, {{-1, -1}, {1, 1}}, kernel);
  Tile whole;
  tiled.expand({{-1, -1}, {1, 1}}, 53, &whole);
  for (int count = patch_count(degree); count <= Patch::kMaxCount; ++count)
    for (const int level : {0, 1, 3, 9}) {
      const Box<2> box = random_box(level, random);
      Patch patch;
      for (const Tile* tile :
           {static_cast<const Tile*>(&whole), level > 0 ? &tiled.at(box.center()) : &whole}) {
        if (box.width(0) > 2 * tile->half[0]) continue;
        expand(*tile, box, count, &patch);
        EXPECT_EQ(patch.count, count);
        EXPECT_EQ(patch.rows_axis, 0);
        expect_true(patch, exact, box, random);
      }
    }
}

TEST_P(PatchOfDegree, StaysCloseThroughHalvingsAndTurns) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 50);
  const FilteredPolynomial<2> f(random_polynomial(degree, random));
  const Exact exact(f);
  Kernel kernel;
  TiledPolynomial tiled(f, {{-1, -1}, {1, 1}}, kernel);
  for (int count = patch_count(degree); count <= Patch::kMaxCount; ++count) {
    Box<2> box = random_box(2, random);
    Patch patch, halves[2];
    expand(tiled.at(box.center()), box, count, &patch);
    for (int step = 0; step < 24; ++step) {
      const int axis = static_cast<int>(random() % 2), side = static_cast<int>(random() % 2);
      if (random() % 3 == 0) {
        turn(&patch);
        expect_true(patch, exact, box, random);
      }
      halve(patch, axis, true, &halves[0], &halves[1]);
      const double cut = box.center()[axis];
      Box<2> half[2] = {box, box};
      half[0].hi[axis] = half[1].lo[axis] = cut;
      expect_true(halves[1 - side], exact, half[1 - side], random);
      // In place: the patch becomes one of its halves.
      Patch other;
      if (side == 0)
        halve(patch, axis, true, &patch, &other);
      else
        halve(patch, axis, true, &other, &patch);
      for (int i = 0; i < count; ++i) EXPECT_EQ(patch.b[i], halves[side].b[i]);
      box = half[side];
      expect_true(patch, exact, box, random);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, PatchOfDegree,
                         testing::Values(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 15, 18, 25),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(Patch, HalvesOfProvedSignKeepWhatIsSaid) {
  const FilteredPolynomial<2> f(written::polynomial<2>("x - 1/4 + y/100"));
  Kernel kernel;
  const Box<2> box{{-1, -1}, {1, 1}};
  TiledPolynomial tiled(f, box, kernel);
  Patch patch, lower, upper, whole_lower, whole_upper;
  expand(tiled.at({0, 0}), box, 3, &patch);
  halve(patch, 0, false, &lower, &upper);
  halve(patch, 0, true, &whole_lower, &whole_upper);
  EXPECT_EQ(lower.sign(), Sign::Negative);
  EXPECT_EQ(upper.sign(), std::nullopt);
  for (const auto& [a, b] : {std::pair{&lower, &whole_lower}, std::pair{&upper, &whole_upper}}) {
    EXPECT_EQ(a->lo, b->lo);
    EXPECT_EQ(a->hi, b->hi);
    EXPECT_EQ(a->radius, b->radius);
  }
  for (int i = 0; i < 3; ++i) EXPECT_EQ(upper.b[i], whole_upper.b[i]);
}

TEST(Patch, OfATileThatClaimsNothingProvesNothing) {
  const FilteredPolynomial<2> f(written::polynomial<2>("x^3 + y^3 + 1")),
      g(written::polynomial<2>("x^3 - y^2 + 2"));
  Kernel kernel;
  const Box<2> box{{-1e300, -1e300}, {1e300, 1e300}};
  TiledPolynomial of_f(f, box, kernel), of_g(g, box, kernel);
  Tile tile_f, tile_g;
  of_f.expand(box, 53, &tile_f);
  of_g.expand(box, 53, &tile_g);
  Patch p, q;
  expand(tile_f, box, 4, &p);
  expand(tile_g, box, 4, &q);
  EXPECT_EQ(p.sign(), std::nullopt);
  EXPECT_FALSE(test_critical(p).excluded);
  SystemVerdict verdict;
  test_system(p, q, 0.8, &verdict);
  EXPECT_FALSE(verdict.excluded);
  EXPECT_FALSE(verdict.contracts);
}

/// Combinations of derivatives overflow long before the values do.
TEST(Patch, CombinationsThatOverflowProveNothing) {
  // The gradient is zero at the middle of the left side. In the combination that the Hessian
  // suggests everything there is infinity less infinity, and all else has one sign.
  const FilteredPolynomial<2> f(written::polynomial<2>("x^2 + 3 x y - y^2"));
  Kernel kernel;
  int overflows = 0;
  for (int e = 200; e <= 448; ++e) {
    const double size = std::ldexp(1.0, e);
    const Box<2> box{{0, -size}, {2 * size, size}};
    TiledPolynomial tiled(f, box, kernel);
    Tile tile;
    tiled.expand(box, 53, &tile);
    for (int count = 3; count <= 8; ++count) {
      Patch patch;
      expand(tile, box, count, &patch);
      EXPECT_FALSE(test_critical(patch).excluded) << e << " " << count;
      overflows += std::isfinite(patch.radius) && std::isinf(patch.magnitude() * patch.magnitude());
    }
  }
  EXPECT_GT(overflows, 100);
}

/// A polynomial that vanishes at a point, of a degree: (x - px) a + (y - py) b.
Polynomial<2> through(const RationalPoint<2>& point, int degree, Random& random) {
  const auto offset = [&](int i) {
    return Polynomial<2>::variable(i) + Polynomial<2>::constant(-point[i]);
  };
  return offset(0) * random_polynomial(degree - 1, random) +
         offset(1) * random_polynomial(degree - 1, random);
}

class SystemOfDegree : public testing::TestWithParam<int> {};

TEST_P(SystemOfDegree, VerdictsDoNotContradictAKnownZero) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 7);
  int contractions = 0, narrowed = 0;
  for (int round = 0; round < 40; ++round) {
    const RationalPoint<2> zero{Rational(symmetric_random(random)) / 3,
                                Rational(symmetric_random(random)) / 3};
    const FilteredPolynomial<2> f(through(zero, degree, random)), g(through(zero, degree, random));
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledPolynomial of_f(f, root, kernel), of_g(g, root, kernel);
    const int count = patch_count(degree);
    // Boxes with the zero at a corner, on a side, or inside (the double next to it).
    for (int level = 1; level < 40; level += 3) {
      const double width = std::ldexp(1.0, -level);
      Box<2> box;
      for (int i = 0; i < 2; ++i) {
        box.lo[i] = nearest_double(zero[i]) - width * (round % 3 == 0 ? 0.5 : (random() % 9) / 8.0);
        box.hi[i] = box.lo[i] + width;
      }
      RationalPoint<2> s;
      bool inside = true;
      for (int i = 0; i < 2; ++i) {
        const Rational lo(box.lo[i]), hi(box.hi[i]);
        inside = inside && lo <= zero[i] && zero[i] <= hi;
        s[i] = (zero[i] - (lo + hi) / 2) / ((hi - lo) / 2);
      }
      if (!inside) continue;
      Tile tile_f, tile_g;
      of_f.expand(box, 53, &tile_f);
      of_g.expand(box, 53, &tile_g);
      Patch p, q;
      expand(tile_f, box, count, &p);
      expand(tile_g, box, count, &q);
      if (round % 2 == 0) turn(&q);
      if (round % 5 == 0) turn(&p);
      EXPECT_EQ(p.sign(), std::nullopt);
      EXPECT_EQ(q.sign(), std::nullopt);
      SystemVerdict verdict;
      test_system(p, q, 0.8, &verdict);
      EXPECT_FALSE(verdict.excluded);
      // Up to what the chart is larger than the box where its centre is no double.
      const Rational slack = Rational(0x1p-49) + Rational(0x1p-52 / width);
      for (int i = 0; i < 2; ++i) {
        EXPECT_LE(Rational(verdict.zeros.lo[i]), s[i] + slack);
        EXPECT_GE(Rational(verdict.zeros.hi[i]), s[i] - slack);
        narrowed += verdict.zeros.hi[i] - verdict.zeros.lo[i] < 0.5;
      }
      contractions += verdict.contracts;
    }
  }
  EXPECT_GT(contractions, 20);
  EXPECT_GT(narrowed, 20);
}

TEST_P(SystemOfDegree, ContractionsBoundTheJacobian) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 70);
  int contractions = 0;
  for (int round = 0; round < 12; ++round) {
    const RationalPoint<2> zero{Rational(1, 7), Rational(-1, 5)};
    const FilteredPolynomial<2> f(through(zero, degree, random)), g(through(zero, degree, random));
    const Exact exact_f(f), exact_g(g);
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledPolynomial of_f(f, root, kernel), of_g(g, root, kernel);
    for (int level = 3; level < 12; level += 2) {
      Box<2> box;
      for (int i = 0; i < 2; ++i) {
        const double width = std::ldexp(1.0, -level);
        box.lo[i] = std::floor(zero[i].get_d() / width) * width;
        box.hi[i] = box.lo[i] + width;
      }
      Patch p, q;
      expand(of_f.at(box.center()), box, patch_count(degree), &p);
      expand(of_g.at(box.center()), box, patch_count(degree), &q);
      if (round % 2 == 1) {
        turn(&p);
        turn(&q);
      }
      SystemVerdict verdict;
      test_system(p, q, 0.8, &verdict);
      if (!verdict.contracts) continue;
      ++contractions;
      const Contraction<2>& c = verdict.contraction;
      for (int k = 0; k < 4; ++k) {
        const RationalPoint<2> s = random_point(random);
        const Jet2 a = exact_f.at(box, s), b = exact_g.at(box, s);
        const Rational jacobian[2][2] = {{a.x, a.y}, {b.x, b.y}};
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) {
            Rational entry = i == j ? -1 : 0;
            for (int m = 0; m < 2; ++m) entry += Rational(c.preconditioner[i][m]) * jacobian[m][j];
            EXPECT_LE(abs(entry), Rational(c.bound[i][j]));
          }
      }
      for (int i = 0; i < 2; ++i) {
        EXPECT_GT(c.weights[i], 0);
        EXPECT_LT(Rational(c.bound[i][0]) * Rational(c.weights[0]) +
                      Rational(c.bound[i][1]) * Rational(c.weights[1]),
                  Rational(c.weights[i]));
      }
    }
  }
  EXPECT_GT(contractions, 8);
}

INSTANTIATE_TEST_SUITE_P(Degrees, SystemOfDegree, testing::Values(1, 2, 3, 5, 7, 8, 11, 15, 18),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(CriticalPatch, BoxesWithALocalMaximumOrASingularPointAreKept) {
  Random random(9);
  int dropped = 0;
  for (int round = 0; round < 30; ++round) {
    const RationalPoint<2> at{Rational(symmetric_random(random)) / 3,
                              Rational(symmetric_random(random)) / 3};
    const auto offset = [&](int i) {
      return Polynomial<2>::variable(i) + Polynomial<2>::constant(-at[i]);
    };
    // c - (u^2 + u v + v^2) q with q > 0 near: |f| is largest at `at` for c > 0; for c = 0 it is a
    // singular point of the curve.
    const Rational c = round % 3 == 0 ? Rational(0) : Rational(1, 1 + round);
    const Polynomial<2> u = offset(0), v = offset(1);
    const Polynomial<2> q =
        Polynomial<2>::constant(Rational(8)) + random_polynomial(1 + round % 8, random);
    const FilteredPolynomial<2> f(Polynomial<2>::constant(c) +
                                  Polynomial<2>::constant(Rational(-1)) * (u * u + u * v + v * v) *
                                      q);
    Kernel kernel;
    TiledPolynomial tiled(f, {{-1, -1}, {1, 1}}, kernel);
    for (int level = 0; level < 36; level += 2) {
      const double width = std::ldexp(1.0, 1 - level);
      Box<2> box;
      for (int i = 0; i < 2; ++i) {
        box.lo[i] = -1 + width * std::floor((nearest_double(at[i]) + 1) / width);
        box.hi[i] = box.lo[i] + width;
      }
      Tile tile;
      tiled.expand(box, 53, &tile);
      Patch patch;
      expand(tile, box, patch_count(f.degree()), &patch);
      if (round % 2 == 0) turn(&patch);
      const bool inside = Rational(box.lo[0]) <= at[0] && at[0] <= Rational(box.hi[0]) &&
                          Rational(box.lo[1]) <= at[1] && at[1] <= Rational(box.hi[1]);
      if (inside) {
        EXPECT_FALSE(test_critical(patch).excluded);
      }
      // Beside it there is usually none.
      Box<2> beside = box;
      beside.lo[0] = box.hi[0];
      beside.hi[0] = box.hi[0] + width;
      tiled.expand(beside, 53, &tile);
      expand(tile, beside, patch_count(f.degree()), &patch);
      dropped += test_critical(patch).excluded;
    }
  }
  EXPECT_GT(dropped, 100);
}

TEST(InterpolationLoss, BoundsThePowers) {
  // s^k less its interpolant at the nodes of a patch, sampled; and its derivatives by differences.
  for (int k = 8; k <= Tile::kMaxDegree; ++k) {
    Kernel kernel;
    const FilteredPolynomial<2> f(written::polynomial<2>("x^" + std::to_string(k)));
    const Box<2> box{{-1, -1}, {1, 1}};
    TiledPolynomial tiled(f, box, kernel);
    Tile tile;
    tiled.expand(box, 53, &tile);
    Patch patch;
    expand(tile, box, 8, &patch);
    const InterpolationLoss& loss = interpolation_loss(k);
    const Exact exact(f);
    double value = 0, slope = 0, bend = 0;
    for (int m = -64; m <= 64; ++m) {
      const RationalPoint<2> s{Rational(m, 64), Rational(0)};
      const Jet2 a = exact.at(box, s), b = jet(patch, s);
      value = std::max(value, std::fabs(Rational(a.value - b.value).get_d()));
      slope = std::max(slope, std::fabs(Rational(a.x - b.x).get_d()));
      bend = std::max(bend, std::fabs(Rational(a.xx - b.xx).get_d()));
    }
    EXPECT_LE(value, loss.value + 1e-12);
    EXPECT_LE(slope, loss.slope + 1e-11);
    EXPECT_LE(bend, loss.bend + 1e-9);
    // Largest at the ends, where the bounds are sharp.
    EXPECT_GT(value, 0.95 * loss.value);
    EXPECT_GT(slope, 0.95 * loss.slope);
    EXPECT_GT(bend, 0.95 * loss.bend);
  }
}

}  // namespace
}  // namespace encase
