// SPDX-License-Identifier: MIT
//
// Cubic nets of two polynomials against rational arithmetic.
#include "common/cubic_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "common/subdivision.hpp"
#include "exact_nets.hpp"
#include "written.hpp"

namespace encase {
namespace {

std::array<CubicSource, 2> sources_on(const Tile& f, const Tile& g, const Box<2>& box) {
  std::array<CubicSource, 2> sources;
  expand(f, box, &sources[0]);
  expand(g, box, &sources[1]);
  return sources;
}

CubicSystem on_box(const Tile& f, const Tile& g, const Box<2>& box) {
  CubicSystem system;
  cut_off(sources_on(f, g, box), &system);
  return system;
}

/// What the net of polynomial k says at s in [-1,1]^2: value and derivatives in x and y.
std::array<Rational, 3> jet(const CubicSystem& system, int k, const RationalPoint<2>& s) {
  std::array<Rational, 3> result{0, 0, 0};
  for (int d = 0; d < 3; ++d) {
    const auto of_x = basis(3, (s[0] + 1) / 2, d == 1), of_y = basis(3, (s[1] + 1) / 2, d == 2);
    const auto &rows = system.rows_axis == 0 ? of_x : of_y,
               &lanes = system.rows_axis == 0 ? of_y : of_x;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        result[d] += Rational(system.b[i][4 * k + j]) * rows[i] * lanes[j];
  }
  return result;
}

/// The polynomials are as far from the nets as the radii say, or less, at some points; and the
/// extremes are those of the coefficients. Returns the share of the radii that is needed.
double expect_true(const CubicSystem& system, const std::array<const Exact*, 2>& exact,
                   const Box<2>& box, Random& random) {
  double needed = 0;
  for (int k = 0; k < 2; ++k) {
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int i = 0; i < 4; ++i)
      for (int j = 4 * k; j < 4 * k + 4; ++j) {
        lo = std::min(lo, system.b[i][j]);
        hi = std::max(hi, system.b[i][j]);
      }
    EXPECT_EQ(system.lo[k], lo);
    EXPECT_EQ(system.hi[k], hi);
    for (int round = 0; round < 4; ++round) {
      RationalPoint<2> s = random_point(random);
      if (round == 0) s = {Rational(-1), Rational(1)};
      if (round == 1) s[0] = 1;
      if (round == 2) s[1] = -1;
      const Jet2 f = exact[k]->at(box, s);
      const auto net = jet(system, k, s);
      const Rational off[3] = {abs(f.value - net[0]), abs(f.x - net[1]), abs(f.y - net[2])};
      const auto& slope = system.slope_radius[k];
      const double radius[3] = {system.radius[k], slope[system.rows_axis],
                                slope[1 - system.rows_axis]};
      for (int d = 0; d < 3; ++d) {
        EXPECT_LE(off[d], Rational(radius[d]));
        needed = std::max(needed, off[d].get_d() / radius[d]);
      }
    }
  }
  return needed;
}

/// What the Chebyshev net says at s: value and derivatives in x and y.
std::array<Rational, 3> jet(const CubicSource& source, const RationalPoint<2>& s) {
  std::array<std::array<Rational, 8>, 2> t, slope;
  for (int k = 0; k < 2; ++k) {
    t[k] = {1, s[k]};
    slope[k] = {0, 1};
    for (int i = 2; i < 8; ++i) {
      t[k][i] = 2 * s[k] * t[k][i - 1] - t[k][i - 2];
      slope[k][i] = 2 * t[k][i - 1] + 2 * s[k] * slope[k][i - 1] - slope[k][i - 2];
    }
  }
  std::array<Rational, 3> result{0, 0, 0};
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      const int x = source.rows_axis == 0 ? i : j, y = source.rows_axis == 0 ? j : i;
      const Rational c(source.c[i][j]);
      result[0] += c * t[0][x] * t[1][y];
      result[1] += c * slope[0][x] * t[1][y];
      result[2] += c * t[0][x] * slope[1][y];
    }
  return result;
}

/// The polynomial is as far from the source's net as its radii say, or less, at some points; and
/// its size is that of the coefficients, of which there are no more than it says. Returns the share
/// of the radii that is needed.
double expect_true(const CubicSource& source, const Exact& exact, const Box<2>& box,
                   Random& random) {
  double sum = 0, needed = 0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) {
      sum += std::fabs(source.c[i][j]);
      if (std::max(i, j) >= source.count) {
        EXPECT_EQ(source.c[i][j], 0);
      }
    }
  EXPECT_GE(source.size, sum);
  EXPECT_LE(source.size, 1.001 * sum + 1e-300);
  EXPECT_GE(source.radius, source.left_out);
  for (int round = 0; round < 4; ++round) {
    RationalPoint<2> s = random_point(random);
    if (round == 0) s = {Rational(1), Rational(1)};
    if (round == 1) s[1] = -1;
    const Jet2 f = exact.at(box, s);
    const auto net = jet(source, s);
    const Rational off[3] = {abs(f.value - net[0]), abs(f.x - net[1]), abs(f.y - net[2])};
    const double radius[3] = {source.radius, source.slope_radius[0], source.slope_radius[1]};
    for (int d = 0; d < 3; ++d) {
      EXPECT_LE(off[d], Rational(radius[d]));
      needed = std::max(needed, off[d].get_d() / radius[d]);
    }
  }
  return needed;
}

/// The part that halvings lead to is what its number says.
void expect_same_by_number(const std::array<CubicSource, 2>& from,
                           const std::array<std::int64_t, 2>& number,
                           const std::array<CubicSource, 2>& restricted,
                           const CubicSystem& system) {
  std::array<CubicSource, 2> by_number;
  CubicSystem net;
  restrict_to(from, number, &by_number, &net);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(by_number[k].c, restricted[k].c);
    EXPECT_EQ(by_number[k].radius, restricted[k].radius);
    EXPECT_EQ(by_number[k].slope_radius, restricted[k].slope_radius);
  }
  EXPECT_EQ(net.b, system.b);
  EXPECT_EQ(net.radius, system.radius);
  EXPECT_EQ(net.slope_radius, system.slope_radius);
}

class CubicsOfDegree : public testing::TestWithParam<int> {};

/// Sources on parts of tiles, and on parts of their boxes, again and again.
TEST_P(CubicsOfDegree, SourcesAreAsCloseAsTheySay) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 90);
  const FilteredFunction<2> f(random_polynomial(degree, random)),
      g(random_polynomial(degree / 2, random));
  const Exact exact_f(f), exact_g(g);
  const std::array<const Exact*, 2> exact{&exact_f, &exact_g};
  Kernel kernel;
  const Box<2> root{{-1, -1}, {1, 1}};
  TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
  double needed = 0;
  for (int level = 0; level < 5; ++level) {
    const Box<2> whole = random_box(level / 2, random);
    Tile tile_f, tile_g;
    of_f.expand(whole, 53, &tile_f);
    of_g.expand(whole, 53, &tile_g);
    // Halvings lead to the parts of the first steps, the last one is any.
    Box<2> box = whole;
    std::array<CubicSource, 2> sources = sources_on(tile_f, tile_g, whole);
    for (int step = 0; step < 5; ++step) {
      Box<2> part = box;
      std::array<std::int64_t, 2> number;
      for (int i = 0; i < 2; ++i) {
        const int count = 1 << (random() % 4), index = static_cast<int>(random()) & (count - 1);
        number[i] = count + index;
        part.lo[i] = box.lo[i] + box.width(i) * index / count;
        part.hi[i] = part.lo[i] + box.width(i) / count;
        if (step == 4) part.lo[i] += 0.37 * part.width(i);
      }
      std::array<CubicSource, 2> restricted;
      CubicSystem system, cut;
      restrict_to(sources, part_of(chart_of(box), part), &restricted, &system);
      if (step < 4) expect_same_by_number(sources, number, restricted, system);
      cut_off(restricted, &cut);
      EXPECT_EQ(system.b, cut.b);
      EXPECT_EQ(system.radius, cut.radius);
      EXPECT_EQ(system.slope_radius, cut.slope_radius);
      const auto fresh = sources_on(tile_f, tile_g, part);
      for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(restricted[k].rows_axis, 1 - sources[k].rows_axis);
        expect_true(restricted[k], *exact[k], part, random);
        const double share = expect_true(fresh[k], *exact[k], part, random);
        if (k == 0) needed = std::max(needed, share);
      }
      expect_true(system, exact, part, random);
      sources = restricted;
      box = part;
    }
  }
  // The bounds are not idle.
  if (degree >= 8) {
    EXPECT_GT(needed, 0.1);
  }
}

TEST_P(CubicsOfDegree, AreAsCloseAsTheySay) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree));
  const FilteredFunction<2> f(random_polynomial(degree, random)),
      g(random_polynomial(std::max(0, degree - 1), random));
  const Exact exact_f(f), exact_g(g);
  const std::array<const Exact*, 2> exact{&exact_f, &exact_g};
  Kernel kernel;
  const Box<2> root{{-1, -1}, {1, 1}};
  TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
  double needed = 0;
  for (int round = 0; round < 4; ++round) {
    Box<2> base = random_box(round % 4, random);
    Tile tile_f, tile_g;
    of_f.expand(base, 53, &tile_f);
    of_g.expand(base, 53, &tile_g);
    const auto sources = sources_on(tile_f, tile_g, base);
    for (int k = 0; k < 2; ++k) expect_true(sources[k], *exact[k], base, random);
    // A part, often at the border, where fourth derivatives are largest.
    Box<2> box = base;
    for (int i = 0; i < 2; ++i) {
      const double width = base.width(i) * std::ldexp(1.0, -static_cast<int>(random() % 5));
      const double room = (base.width(i) - width) / 8;
      box.lo[i] = base.lo[i] + room * static_cast<double>(random() % 2 == 0 ? 0 : random() % 9);
      box.hi[i] = box.lo[i] + width;
    }
    CubicSystem system;
    std::array<CubicSource, 2> restricted;
    restrict_to(sources, part_of(chart_of(base), box), &restricted, &system);
    EXPECT_EQ(system.rows_axis, sources[0].rows_axis);
    needed = std::max(needed, expect_true(system, exact, box, random));
    // Halves and parts of it.
    for (int step = 0; step < 9; ++step) {
      const int axis = static_cast<int>(random() % 2), side = static_cast<int>(random() % 2);
      const double middle = box.center()[axis];
      Box<2> inner = box;
      (side == 0 ? inner.hi : inner.lo)[axis] = middle;
      CubicSystem halves[2];
      const auto excluded = halve(system, axis, &halves[0], &halves[1]);
      if (!excluded[side]) expect_true(halves[side], exact, inner, random);
      if (step % 3 == 2 || excluded[side]) {
        inner = box;
        inner.lo[axis] += 0.25 * box.width(axis);
        inner.hi[1 - axis] -= 0.125 * box.width(1 - axis);
        CubicSystem part;
        restrict_to(system, part_of(chart_of(box), inner), &part);
        EXPECT_EQ(part.rows_axis, system.rows_axis);
        system = part;
      } else {
        // In place: the system becomes one of its halves.
        CubicSystem other;
        halve(system, axis, side == 0 ? &system : &other, side == 0 ? &other : &system);
        EXPECT_EQ(system.b, halves[side].b);
      }
      box = inner;
      expect_true(system, exact, box, random);
    }
  }
  // The bounds are not idle.
  if (degree >= 4) {
    EXPECT_GT(needed, 0.02);
  }
}

TEST_P(CubicsOfDegree, SignsAreTheirs) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 30);
  int of_sources = 0, of_halves = 0;
  for (int round = 0; round < 10; ++round) {
    const FilteredFunction<2> f(random_polynomial(degree, random)),
        g(random_polynomial(degree, random));
    const Exact exact[2] = {Exact(f), Exact(g)};
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
    const Box<2> box = random_box(2 + round % 3, random);
    Tile tile_f, tile_g;
    of_f.expand(box, 53, &tile_f);
    of_g.expand(box, 53, &tile_g);
    const auto sources = sources_on(tile_f, tile_g, box);
    const auto signs_seen = [&](int k, double lo, double hi) {
      int seen = 0;  // bit 0: positive, bit 1: negative
      for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) {
          const Rational value =
              exact[k].at(box, {Rational(lo + (hi - lo) * (i + 3) / 6), Rational(j, 3)}).value;
          seen |= value > 0 ? 1 : value < 0 ? 2 : 3;
        }
      return seen;
    };
    for (int k = 0; k < 2; ++k)
      if (sources[k].has_sign()) {
        EXPECT_NE(signs_seen(k, -1, 1), 3);
        ++of_sources;
      }
    CubicSystem system, halves[2];
    cut_off(sources, &system);
    if (system.excluded()) {
      EXPECT_TRUE(signs_seen(0, -1, 1) != 3 || signs_seen(1, -1, 1) != 3);
    }
    const auto excluded = halve(system, 0, &halves[0], &halves[1]);
    for (int side = 0; side < 2; ++side) {
      if (!excluded[side]) continue;
      ++of_halves;
      EXPECT_TRUE(signs_seen(0, side - 1, side) != 3 || signs_seen(1, side - 1, side) != 3);
    }
  }
  if (degree >= 1) {
    EXPECT_GT(of_sources, 0);
    EXPECT_GT(of_halves, 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, CubicsOfDegree,
                         testing::Values(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 15, 18, 25),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(CubicSystem, PartsHaveTheNumbersThatHalvingsLeadTo) {
  const FilteredFunction<2> f(written::polynomial<2>("x^7 + x y - y^5/3 + 1/7")),
      g(written::polynomial<2>("x^3 y^4 - y^2 + x/2"));
  Kernel kernel;
  const Box<2> box{{-1, -0.5}, {1, 0.5}};
  TiledFunction of_f(f, box, kernel), of_g(g, box, kernel);
  const auto sources = sources_on(of_f.at({0, 0}), of_g.at({0, 0}), box);
  Random random(5);
  Box<2> part = box;
  std::array<std::int64_t, 2> number{1, 1};
  for (int step = 0; step < 40; ++step) {
    const int axis = step % 2;
    const bool upper = random() % 2 == 1;
    Box<2> half[2];
    ASSERT_TRUE(halve_box(part, axis, &half[0], &half[1]));
    part = half[upper];
    number[axis] = number_of_half(number[axis], upper);
    std::array<CubicSource, 2> restricted;
    CubicSystem system;
    restrict_to(sources, part_of(chart_of(box), part), &restricted, &system);
    expect_same_by_number(sources, number, restricted, system);
  }
  // They end before they overflow.
  for (int step = 0; step < 100; ++step) {
    number[0] = number_of_half(number[0], true);
    EXPECT_GE(number[0], 0);
  }
  EXPECT_EQ(number[0], 0);
}

TEST(CubicSystem, OfTilesThatClaimNothingProvesNothing) {
  const FilteredFunction<2> f(written::polynomial<2>("x^3 + y^3 + 1")),
      g(written::polynomial<2>("x^3 - y^2 + 2"));
  Kernel kernel;
  const Box<2> box{{-1e300, -1e300}, {1e300, 1e300}};
  TiledFunction of_f(f, box, kernel), of_g(g, box, kernel);
  Tile tile_f, tile_g;
  of_f.expand(box, 53, &tile_f);
  of_g.expand(box, 53, &tile_g);
  for (const CubicSource& source : sources_on(tile_f, tile_g, box)) EXPECT_FALSE(source.has_sign());
  CubicSystem system = on_box(tile_f, tile_g, box), lower, upper;
  EXPECT_FALSE(system.excluded());
  EXPECT_EQ(halve(system, 1, &lower, &upper), (std::array<bool, 2>{false, false}));
  SystemVerdict verdict;
  test_system(system, 0.8, &verdict);
  EXPECT_FALSE(verdict.excluded);
  EXPECT_FALSE(verdict.contracts);
}

TEST(CubicSystem, VariationIsAlongTheAxes) {
  const FilteredFunction<2> f(written::polynomial<2>("x + 3 y")),
      g(written::polynomial<2>("x/2 + y"));
  Kernel kernel;
  const Box<2> box{{-1, -1}, {1, 1}};
  TiledFunction of_f(f, box, kernel), of_g(g, box, kernel);
  CubicSystem system = on_box(of_f.at({0, 0}), of_g.at({0, 0}), box), upper;
  for (const double part : {1.0, 0.5}) {
    const auto v = relative_variation(system);
    const double along_x = part * 2.0 / 3, of_f_size = system.magnitude(0) * f.scale(),
                 of_g_size = system.magnitude(1) * g.scale();
    EXPECT_NEAR(v[0], along_x * (1 / of_f_size + 0.5 / of_g_size), 1e-12);
    EXPECT_NEAR(v[1], 2.0 / 3 * (3 / of_f_size + 1 / of_g_size), 1e-12);
    EXPECT_FALSE(halve(system, 0, &system, &upper)[0]);
  }
}

class SystemOfDegree : public testing::TestWithParam<int> {};

TEST_P(SystemOfDegree, VerdictsDoNotContradictAKnownZero) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 7);
  int contractions = 0, narrowed = 0;
  for (int round = 0; round < 40; ++round) {
    const RationalPoint<2> zero{Rational(symmetric_random(random)) / 3,
                                Rational(symmetric_random(random)) / 3};
    const FilteredFunction<2> f(through(zero, degree, random)), g(through(zero, degree, random));
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
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
      const CubicSystem system = on_box(tile_f, tile_g, box);
      EXPECT_FALSE(system.excluded());
      SystemVerdict verdict;
      test_system(system, 0.8, &verdict);
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
    const FilteredFunction<2> f(through(zero, degree, random)), g(through(zero, degree, random));
    const Exact exact_f(f), exact_g(g);
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
    for (int level = 3; level < 12; level += 2) {
      Box<2> box;
      for (int i = 0; i < 2; ++i) {
        const double width = std::ldexp(1.0, -level);
        box.lo[i] = std::floor(zero[i].get_d() / width) * width;
        box.hi[i] = box.lo[i] + width;
      }
      CubicSystem system = on_box(of_f.at(box.center()), of_g.at(box.center()), box);
      if (round % 2 == 1) {
        // One of its halves: the rows run along y.
        CubicSystem upper;
        if (halve(system, 0, &system, &upper)[0]) continue;
        box.hi[0] = box.center()[0];
      }
      SystemVerdict verdict;
      test_system(system, 0.8, &verdict);
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

}  // namespace
}  // namespace encase
