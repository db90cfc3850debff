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

#include "exact_bernstein.hpp"
#include "exact_patches.hpp"
#include "written.hpp"

namespace encase {
namespace {

class PatchOfDegree : public testing::TestWithParam<int> {};

TEST_P(PatchOfDegree, IsAsCloseAsItSays) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree));
  const FilteredFunction<2> f(random_polynomial(degree, random));
  const Exact exact(f);
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
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

TEST_P(PatchOfDegree, StaysCloseThroughHalvings) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 50);
  const FilteredFunction<2> f(random_polynomial(degree, random));
  const Exact exact(f);
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  for (int count = patch_count(degree); count <= Patch::kMaxCount; ++count) {
    Box<2> box = random_box(2, random);
    Patch patch, halves[2];
    expand(tiled.at(box.center()), box, count, &patch);
    for (int step = 0; step < 24; ++step) {
      const int axis = static_cast<int>(random() % 2), side = static_cast<int>(random() % 2);
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
  const FilteredFunction<2> f(written::polynomial<2>("x - 1/4 + y/100"));
  Kernel kernel;
  const Box<2> box{{-1, -1}, {1, 1}};
  TiledFunction tiled(f, box, kernel);
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
  const FilteredFunction<2> f(written::polynomial<2>("x^3 + y^3 + 1"));
  Kernel kernel;
  const Box<2> box{{-1e300, -1e300}, {1e300, 1e300}};
  TiledFunction of_f(f, box, kernel);
  Tile tile;
  of_f.expand(box, 53, &tile);
  Patch p;
  expand(tile, box, 4, &p);
  EXPECT_EQ(p.sign(), std::nullopt);
  EXPECT_FALSE(test_critical(p).excluded);
}

/// Combinations of derivatives overflow long before the values do.
TEST(Patch, CombinationsThatOverflowProveNothing) {
  // The gradient is zero at the middle of the left side.
  const FilteredFunction<2> f(written::polynomial<2>("x^2 + 3 x y - y^2"));
  Kernel kernel;
  int overflows = 0;
  for (int e = 200; e <= 448; ++e) {
    const double size = std::ldexp(1.0, e);
    const Box<2> box{{0, -size}, {2 * size, size}};
    TiledFunction tiled(f, box, kernel);
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
    const FilteredFunction<2> f(Polynomial<2>::constant(c) + Polynomial<2>::constant(Rational(-1)) *
                                                                 (u * u + u * v + v * v) * q);
    Kernel kernel;
    TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
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
      if (round % 2 == 0) {
        // The same box as a half: the rows run along y.
        Box<2> twice = box;
        twice.hi[0] += width;
        Tile tile_of_twice;
        tiled.expand(twice, 53, &tile_of_twice);
        Patch other;
        expand(tile_of_twice, twice, patch_count(f.degree()), &patch);
        halve(patch, 0, true, &patch, &other);
      }
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

/// There the least slope is zero, and only the bounds keep what is left by roundings from proving
/// that it is not.
TEST(CriticalPatch, BoxesWithALocalMaximumOnTheBorderAreKept) {
  Random random(10);
  for (int round = 0; round < 300; ++round) {
    const double width = std::ldexp(1.0, -1 - round % 7);
    const int axis = static_cast<int>(random() % 2);
    Point<2> at;
    Box<2> box;
    for (int i = 0; i < 2; ++i) {
      at[i] = std::ldexp(std::floor(std::ldexp(symmetric_random(random) / 3, 20)), -20);
      const auto eighths = static_cast<double>(random() % 9);
      box.lo[i] = at[i] - width * (i == axis ? 8 * static_cast<double>(random() % 2) : eighths) / 8;
      box.hi[i] = box.lo[i] + width;
    }
    const Polynomial<2> u = Polynomial<2>::variable(0) + Polynomial<2>::constant(-Rational(at[0]));
    const Polynomial<2> v = Polynomial<2>::variable(1) + Polynomial<2>::constant(-Rational(at[1]));
    const Polynomial<2> q =
        Polynomial<2>::constant(Rational(8)) + random_polynomial(round % 9, random);
    const FilteredFunction<2> f(Polynomial<2>::constant(Rational(1)) +
                                Polynomial<2>::constant(Rational(-1)) * (u * u + u * v + v * v) *
                                    q);
    Kernel kernel;
    TiledFunction tiled(f, {{-2, -2}, {2, 2}}, kernel);
    Tile tile;
    tiled.expand(box, 53, &tile);
    Patch patch, halves[2];
    expand(tile, box, patch_count(f.degree()), &patch);
    EXPECT_FALSE(test_critical(patch).excluded) << round;
    // Of the half with the maximum the rows run along the other axis.
    const bool upper = at[axis] == box.hi[axis];
    halve(patch, axis, true, &halves[0], &halves[1]);
    EXPECT_FALSE(test_critical(halves[upper]).excluded) << round;
  }
}

}  // namespace
}  // namespace encase
