// SPDX-License-Identifier: MIT
//
// Nets of two polynomials against rational arithmetic.
#include "common/system_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "common/subdivision.hpp"
#include "exact_patches.hpp"
#include "written.hpp"

namespace encase {
namespace {

SystemNet on_box(const Tile& f, const Tile& g, const Box<2>& box) {
  SystemNet net;
  const int count = std::max(patch_count(f.degree), patch_count(g.degree));
  expand(f, box, count, &net.of[0]);
  expand(g, box, count, &net.of[1]);
  return net;
}

/// The same, from tiles of the box's own.
SystemNet expanded_on(const FilteredFunction<2>& f, const FilteredFunction<2>& g,
                      const Box<2>& box) {
  Kernel kernel;
  Tile tile_f, tile_g;
  TiledFunction(f, box, kernel).expand(box, 53, &tile_f);
  TiledFunction(g, box, kernel).expand(box, 53, &tile_g);
  return on_box(tile_f, tile_g, box);
}

/// Quarter k + 2 m of a box, as `quarter` numbers them.
Box<2> quarter_of(const Box<2>& box, int rows_axis, int number) {
  Box<2> part = box;
  for (int i = 0; i < 2; ++i) {
    const int axis = i == 0 ? rows_axis : 1 - rows_axis;
    ((number >> i) % 2 == 0 ? part.hi : part.lo)[axis] = box.center()[axis];
  }
  return part;
}

class NetsOfDegree : public testing::TestWithParam<int> {};

TEST_P(NetsOfDegree, AreAsCloseAsTheySay) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 90);
  // (A common zero, around which nothing is excluded.)
  const RationalPoint<2> zero{Rational(1, 7), Rational(-1, 5)};
  const auto some = [&](int n) {
    return n == 0 ? random_polynomial(n, random) : through(zero, n, random);
  };
  const FilteredFunction<2> f(some(degree)), g(some((degree + 1) / 2));
  const Exact exact[2] = {Exact(f), Exact(g)};
  Kernel kernel;
  const Box<2> root{{-1, -1}, {1, 1}};
  TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
  double needed = 0;
  int quarters_seen = 0;
  for (int round = 0; round < 6; ++round) {
    Box<2> box = round % 2 == 0 ? root : random_box(round / 2, random);
    Tile tile_f, tile_g;
    of_f.expand(box, 53, &tile_f);
    of_g.expand(box, 53, &tile_g);
    SystemNet net = on_box(tile_f, tile_g, box);
    // Quarters of it, and parts.
    for (int step = 0; step < 6; ++step) {
      Box<2> inner = box;
      SystemNet next;
      const int rows_axis = net.of[0].rows_axis;
      std::array<bool, 2> empty{false, false};
      SystemNet quarters[4];
      const auto excluded = quarter(net, &empty, quarters);
      std::vector<int> kept;
      for (int q = 0; q < 4; ++q)
        if (!empty[q % 2] && !excluded[q]) kept.push_back(q);
      if (step % 3 == 2 || kept.empty()) {
        for (int i = 0; i < 2; ++i) {
          inner.lo[i] += box.width(i) * static_cast<double>(random() % 5) / 8;
          inner.hi[i] -= box.width(i) * static_cast<double>(random() % 3) / 8;
        }
        restrict_to(net, part_of(chart_of(box), inner), &next);
      } else {
        const int q = kept[random() % kept.size()];
        inner = quarter_of(box, rows_axis, q);
        next = quarters[q];
        ++quarters_seen;
      }
      box = inner;
      net = next;
      for (int k = 0; k < 2; ++k) {
        EXPECT_EQ(net.of[k].rows_axis, 1 - rows_axis);
        const double share = expect_true(net.of[k], exact[k], box, random, false);
        if (k == 0) needed = std::max(needed, share);
      }
    }
  }
  if (degree >= 1) {
    EXPECT_GT(quarters_seen, 5);
  }
  // The bounds are not idle.
  if (degree >= 8) {
    EXPECT_GT(needed, 0.1);
  }
}

TEST_P(NetsOfDegree, ExcludeWhatTheyMay) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 30);
  int empty_halves = 0, excluded_quarters = 0;
  for (int round = 0; round < 12; ++round) {
    const FilteredFunction<2> f(random_polynomial(degree, random)),
        g(random_polynomial(degree, random));
    const Exact exact[2] = {Exact(f), Exact(g)};
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledFunction of_f(f, root, kernel), of_g(g, root, kernel);
    const Box<2> box = random_box(round % 3, random);
    Tile tile_f, tile_g;
    of_f.expand(box, 53, &tile_f);
    of_g.expand(box, 53, &tile_g);
    const auto one_keeps_a_sign = [&](const Box<2>& part) {
      bool keeps[2];
      for (int k = 0; k < 2; ++k) {
        int seen = 0;  // bit 0: positive, bit 1: negative
        for (int i = -3; i <= 3; ++i)
          for (int j = -3; j <= 3; ++j) {
            const Rational value = exact[k].at(part, {Rational(i, 3), Rational(j, 3)}).value;
            seen |= value > 0 ? 1 : value < 0 ? 2 : 3;
          }
        keeps[k] = seen != 3;
      }
      return keeps[0] || keeps[1];
    };
    const SystemNet net = on_box(tile_f, tile_g, box);
    if (net.excluded()) {
      EXPECT_TRUE(one_keeps_a_sign(box));
    }
    const bool given = round % 4 == 3;
    std::array<bool, 2> empty{given, false};
    SystemNet quarters[4];
    const auto excluded = quarter(net, &empty, quarters);
    EXPECT_TRUE(empty[0] || !given);
    for (int k = 0; k < 2; ++k) {
      if (empty[k] && !(k == 0 && given)) {
        ++empty_halves;
        Box<2> half = box;
        (k == 0 ? half.hi : half.lo)[net.of[0].rows_axis] = box.center()[net.of[0].rows_axis];
        EXPECT_TRUE(one_keeps_a_sign(half));
      }
      for (int q = k; q < 4 && !empty[k]; q += 2) {
        if (!excluded[q]) continue;
        ++excluded_quarters;
        EXPECT_TRUE(one_keeps_a_sign(quarter_of(box, net.of[0].rows_axis, q)));
      }
    }
  }
  EXPECT_GT(empty_halves, 2);
  if (degree >= 1) {
    EXPECT_GT(excluded_quarters, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, NetsOfDegree,
                         testing::Values(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 15, 18, 25),
                         [](const auto& test) { return std::to_string(test.param); });

/// Nets of any numbers that are exact themselves: what their parts lack is rounding.
TEST(SystemNet, RoundingsAreWithinTheRadii) {
  Random random(11);
  double needed = 0;
  for (int round = 0; round < 40; ++round) {
    SystemNet net;
    for (Patch& patch : net.of) {
      patch.count = 3 + round % 6;
      patch.rows_axis = round % 2;
      for (int i = 0; i < patch.count; ++i)
        for (int j = 0; j < 8; ++j)
          patch.b[i][j] = j < patch.count ? symmetric_random(random) : patch.b[i][j - 1];
      patch.lo = -1;
      patch.hi = 1;
    }
    const double origin = 0.5 * symmetric_random(random);
    Part part{{origin, -0.25}, {(1 - std::fabs(origin)) * 0.9, 0.7}};
    SystemNet parts[4];
    std::array<bool, 2> empty{false, false};
    std::array<bool, 4> excluded{};
    if (round % 3 == 0) {
      excluded = quarter(net, &empty, parts);
      part = {{0.5, -0.5}, {0.5, 0.5}};
    } else {
      restrict_to(net, part, &parts[0]);
    }
    // The quarter that is the upper one in x.
    const int q = round % 3 > 0 ? 0 : net.of[0].rows_axis == 0 ? 1 : 2;
    if (empty[q % 2] || excluded[q]) continue;
    for (int k = 0; k < 2; ++k)
      for (int point = 0; point < 4; ++point) {
        const RationalPoint<2> s = random_point(random);
        RationalPoint<2> there;
        for (int i = 0; i < 2; ++i)
          there[i] = Rational(part.origin[i]) + Rational(part.half[i]) * s[i];
        const Jet2 of_whole = jet(net.of[k], there), of_part = jet(parts[q].of[k], s);
        const Patch& patch = parts[q].of[k];
        const Rational off = abs(of_whole.value - of_part.value);
        EXPECT_GT(patch.radius, 0);
        EXPECT_LE(off, Rational(patch.radius));
        needed = std::max(needed, off.get_d() / patch.radius);
        const int rows = patch.rows_axis;
        const Rational slope[2] = {abs(of_whole.x * Rational(part.half[0]) - of_part.x),
                                   abs(of_whole.y * Rational(part.half[1]) - of_part.y)};
        EXPECT_LE(slope[rows], Rational(patch.slope_radius[0]));
        EXPECT_LE(slope[1 - rows], Rational(patch.slope_radius[1]));
      }
  }
  EXPECT_GT(needed, 0.001);
}

TEST(SystemNet, OfTilesThatClaimNothingProvesNothing) {
  const FilteredFunction<2> f(written::polynomial<2>("x^3 + y^3 + 1")),
      g(written::polynomial<2>("x^3 - y^2 + 2"));
  const SystemNet net = expanded_on(f, g, Box<2>{{-1e300, -1e300}, {1e300, 1e300}});
  EXPECT_FALSE(net.excluded());
  std::array<bool, 2> empty{false, false};
  SystemNet quarters[4], part;
  EXPECT_EQ(quarter(net, &empty, quarters), (std::array<bool, 4>{}));
  EXPECT_EQ(empty, (std::array<bool, 2>{}));
  restrict_to(net, {{0.25, 0}, {0.5, 1}}, &part);
  EXPECT_FALSE(part.excluded());
  SystemVerdict verdict;
  test_system(net, 0.8, &verdict);
  EXPECT_FALSE(verdict.excluded);
  EXPECT_FALSE(verdict.contracts);
}

TEST(SystemNet, OnAPartWithoutWidthProvesNothing) {
  const FilteredFunction<2> f(written::polynomial<2>("x + y + 5")),
      g(written::polynomial<2>("x - y + 7"));
  Kernel kernel;
  const Box<2> box{{-1, -1}, {1, 1}};
  TiledFunction of_f(f, box, kernel), of_g(g, box, kernel);
  const SystemNet net = on_box(of_f.at({0, 0}), of_g.at({0, 0}), box);
  EXPECT_TRUE(net.excluded());
  SystemNet part;
  restrict_to(net, {{-1, 0}, {0x1p-60, 1}}, &part);
  EXPECT_FALSE(part.excluded());
  for (const Patch& patch : part.of) EXPECT_FALSE(std::isfinite(patch.radius));
}

TEST(SystemNet, OnAPartOfHugeNetsProvesNothing) {
  const FilteredFunction<2> f(written::polynomial<2>("x^10 + y^10 + 1")),
      g(written::polynomial<2>("x^3 + y"));
  for (const int exponent : {50, 65}) {
    const double size = std::ldexp(1.0, exponent);
    const SystemNet net = expanded_on(f, g, Box<2>{{-size, -size}, {size, size}});
    ASSERT_TRUE(std::isfinite(net.of[0].radius));
    SystemNet part;
    restrict_to(net, {{0.25, 0}, {0.5, 1}}, &part);
    EXPECT_EQ(std::isfinite(part.of[0].radius), net.of[0].magnitude() < 0x1p600) << exponent;
    EXPECT_EQ(net.of[0].magnitude() < 0x1p600, exponent == 50);
    EXPECT_TRUE(std::isfinite(part.of[1].radius));
  }
}

TEST(SystemNet, VariationIsAlongTheAxes) {
  const FilteredFunction<2> f(written::polynomial<2>("x + 3 y")),
      g(written::polynomial<2>("x/2 + y"));
  Kernel kernel;
  const Box<2> box{{-1, -1}, {1, 1}};
  TiledFunction of_f(f, box, kernel), of_g(g, box, kernel);
  SystemNet net = on_box(of_f.at({0, 0}), of_g.at({0, 0}), box), half;
  // The nets of lines have three coefficients in either direction.
  for (const double part : {1.0, 0.5}) {
    const auto v = relative_variation(net);
    const double of_f_size = net.of[0].magnitude() * f.scale(),
                 of_g_size = net.of[1].magnitude() * g.scale();
    EXPECT_NEAR(v[0], part * (1 / of_f_size + 0.5 / of_g_size), 1e-12);
    EXPECT_NEAR(v[1], 3 / of_f_size + 1 / of_g_size, 1e-12);
    restrict_to(net, {{-0.5, 0}, {0.5, 1}}, &half);
    net = half;
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
      const SystemNet system = on_box(tile_f, tile_g, box);
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
      SystemNet system = on_box(of_f.at(box.center()), of_g.at(box.center()), box);
      if (round % 2 == 1) {
        // One of its quarters: the rows run along y.
        std::array<bool, 2> empty{false, false};
        SystemNet quarters[4];
        const int q = round / 2 % 4;
        if (quarter(system, &empty, quarters)[q] || empty[q % 2]) continue;
        system = quarters[q];
        box = quarter_of(box, 0, q);
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
