// SPDX-License-Identifier: MIT
//
// Tiles against rational arithmetic.
#include "common/tile.hpp"

#include <gtest/gtest.h>

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

/// Of full degree, with doubles for coefficients, or with thirds of them, which are none.
Polynomial<2> random_polynomial(int degree, bool doubles, Random& random) {
  std::vector<Polynomial<2>::Term> terms;
  for (const auto& e : dense_exponents<2>(degree)) {
    const Rational c(symmetric_random(random));
    terms.push_back({e, doubles ? c : c / 3});
  }
  return Polynomial<2>::from_terms(std::move(terms));
}

/// f as FilteredPolynomial scales it.
Polynomial<2> scaled(const FilteredPolynomial<2>& f) {
  return Polynomial<2>::constant(1 / Rational(f.scale())) * f.exact();
}

/// f in the tile's coordinates.
Polynomial<2> composed(const FilteredPolynomial<2>& f, const Tile& tile) {
  return exact_bernstein::compose<2>(scaled(f),
                                     {Rational(tile.center[0]), Rational(tile.center[1])},
                                     {Rational(tile.half[0]), Rational(tile.half[1])});
}

/// What the tile says of f is true: the differences of the coefficients, weighted for |s_k| <=
/// kReach, add up to no more than the errors of the value and the derivatives; and the sums of the
/// coefficients are what they say.
void expect_true(const Tile& tile, const FilteredPolynomial<2>& f) {
  ASSERT_EQ(tile.degree, std::min(f.degree(), Tile::kMaxDegree));
  ASSERT_TRUE(std::isfinite(tile.error));
  const Rational reach(Tile::kReach);
  std::vector<Rational> power{Rational(1)};
  for (int k = 0; k < 2 * f.degree() + 2 * Tile::kRow; ++k) power.push_back(power.back() * reach);
  const int rows = std::max(f.degree(), Tile::kMaxDegree) + 1;
  std::vector<Rational> off(static_cast<std::size_t>(rows * rows), Rational(0));
  Rational sum = 0, slope = 0, bend = 0;
  for (int i = 0; i < Tile::kRow; ++i)
    for (int j = 0; j < Tile::kRow; ++j) {
      if (i + j > tile.degree) {
        EXPECT_EQ(tile.a[i][j], 0.0);
        continue;
      }
      const Rational a(tile.a[i][j]), size = abs(a) * power[i + j];
      off[i * rows + j] = -a;
      sum += size;
      slope += (i + j) * size;
      bend += (i + j) * (i + j) * size;
    }
  EXPECT_LE(sum, Rational(tile.sum));
  EXPECT_LE(slope, Rational(tile.slope));
  EXPECT_LE(bend, Rational(tile.bend));
  const Polynomial<2> exact = composed(f, tile);
  for (const auto& term : exact.terms())
    off[term.exponent[0] * rows + term.exponent[1]] += term.coefficient;
  Rational error = 0, slope_error[2] = {0, 0}, bend_error[3] = {0, 0, 0};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      const Rational size = abs(off[i * rows + j]) * power[i + j];
      error += size;
      slope_error[0] += i * size;
      slope_error[1] += j * size;
      bend_error[0] += i * (i - 1) * size;
      bend_error[1] += j * (j - 1) * size;
      bend_error[2] += i * j * size;
    }
  EXPECT_LE(error, Rational(tile.error));
  for (const Rational& e : slope_error) EXPECT_LE(e, Rational(tile.slope_error));
  for (const Rational& e : bend_error) EXPECT_LE(e, Rational(tile.bend_error));
}

/// A box with corners that are multiples of 2^-40 near (x, y).
Box<2> box_near(double x, double y, double width, Random& random) {
  Box<2> box;
  for (int i = 0; i < 2; ++i) {
    box.lo[i] = std::ldexp(std::round(std::ldexp(i == 0 ? x : y, 40)), -40);
    box.hi[i] = box.lo[i] + width * (1.5 + 0.5 * symmetric_random(random));
  }
  return box;
}

class TileOfDegree : public testing::TestWithParam<int> {};

TEST_P(TileOfDegree, IsAsCloseAsItSays) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree));
  for (const bool doubles : {true, false}) {
    const FilteredPolynomial<2> f(random_polynomial(degree, doubles, random));
    Kernel kernel;
    TiledPolynomial tiled(f, {{-1, -1}, {1, 1}}, kernel);
    for (const Box<2>& box :
         {Box<2>{{-1, -1}, {1, 1}}, box_near(0.9, -1, 0.1, random),
          box_near(symmetric_random(random), symmetric_random(random), 1e-5, random),
          box_near(0.25, 3, 0x1p-45, random)}) {
      // (Rational arithmetic takes long for high degrees.)
      if (degree > 30 && (doubles || box.width(0) < 0.05)) continue;
      for (const int bits : {53, 106}) {
        if (degree > 50 && bits > 53) continue;
        Tile tile;
        tiled.expand(box, bits, &tile);
        EXPECT_EQ(tile.bits, bits);
        expect_true(tile, f);
      }
    }
  }
}

TEST_P(TileOfDegree, ValuesAreAsCloseAsTheySay) {
  const int degree = GetParam();
  Random random(static_cast<std::uint64_t>(degree) + 100);
  for (const bool doubles : {true, false}) {
    const FilteredPolynomial<2> f(random_polynomial(degree, doubles, random));
    const Polynomial<2> exact = scaled(f);
    Kernel kernel;
    const Box<2> root{{-1.5, -1}, {1, 2}};
    TiledPolynomial tiled(f, root, kernel);
    for (int round = 0; round < 6; ++round) {
      Point<2> point{-0.25 + 1.25 * symmetric_random(random), 0.5 + 1.5 * symmetric_random(random)};
      if (round == 0) point = {0, 0};
      if (round == 1) point = root.hi;
      const Tile& tile = tiled.at(point);
      const double value = tiled.value(point);
      const Rational off = abs(Rational(
          Rational(value) - exact(RationalPoint<2>{Rational(point[0]), Rational(point[1])})));
      EXPECT_LE(off, Rational(tile.value_error) + Rational(0x1p-52 * std::fabs(value)));
      // It is far better than doubles: a claim that matters.
      EXPECT_LE(tile.value_error, 0x1p-80 * (degree + 1) * (degree + 1) * std::pow(3.5, degree));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, TileOfDegree,
                         testing::Values(0, 1, 2, 3, 5, 7, 8, 9, 12, 15, 16, 20, 31, 40, 60),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(Tile, PreciseValuesHoldWhereTheyCancel) {
  // (x - y)^9 + (x - 1/3)^20 next to x = y = 1/3: all digits of doubles cancel.
  Random random(3);
  const FilteredPolynomial<2> f(written::polynomial<2>("(x - y)^9 + (x - 1/3)^20 + (y - 1/3)^12"));
  const Polynomial<2> exact = scaled(f);
  Kernel kernel;
  TiledPolynomial tiled(f, {{-1, -1}, {1, 1}}, kernel);
  for (int round = 0; round < 20; ++round) {
    const double spread = std::ldexp(1.0, -2 * round);
    const Point<2> point{1 / 3.0 + spread * symmetric_random(random),
                         1 / 3.0 + spread * symmetric_random(random)};
    const double value = tiled.value(point);
    const Rational off = abs(Rational(
        Rational(value) - exact(RationalPoint<2>{Rational(point[0]), Rational(point[1])})));
    EXPECT_LE(off, Rational(tiled.at(point).value_error) + Rational(0x1p-52 * std::fabs(value)));
  }
}

TEST(Tile, TheTreeHasATileForEveryPoint) {
  Random random(4);
  for (const int degree : {3, 9, 25}) {
    const FilteredPolynomial<2> f(random_polynomial(degree, true, random));
    Kernel kernel;
    const Box<2> root{{-2, -1}, {1, 3}};
    TiledPolynomial tiled(f, root, kernel);
    std::vector<Point<2>> points{root.lo, root.hi, root.center(), {-2, 3}};
    for (int k = 0; k < 40; ++k)
      points.push_back({-0.5 + 1.5 * symmetric_random(random), 1 + 2 * symmetric_random(random)});
    for (const Point<2>& point : points) {
      const Tile& tile = tiled.at(point);
      for (int i = 0; i < 2; ++i)
        EXPECT_LE(std::fabs(point[i] - tile.center[i]), tile.half[i] * Tile::kReach);
      const auto jet = value_and_gradient(tile, {(point[0] - tile.center[0]) / tile.half[0],
                                                 (point[1] - tile.center[1]) / tile.half[1]});
      EXPECT_NEAR(jet[0], tiled.value(point), tile.error + 1e-13 * tile.sum);
    }
    expect_true(tiled.at({0.3, 0.4}), f);
  }
}

TEST(Tile, CoefficientsFarOutsideTheRangeOfDoublesAreScaled) {
  Random random(5);
  const Polynomial<2> exact = random_polynomial(6, false, random);
  Rational scale;
  mpz_ui_pow_ui(scale.get_num_mpz_t(), 2, 1500);
  for (const Rational& c : {scale, Rational(1 / scale)}) {
    // A power of two: the scaled polynomials are the same.
    const FilteredPolynomial<2> f(Polynomial<2>::constant(c) * exact), g(exact);
    Kernel kernel;
    const Box<2> box{{-1, -1}, {1, 1}};
    TiledPolynomial of_f(f, box, kernel), of_g(g, box, kernel);
    const Point<2> point{0.3, 0.4};
    EXPECT_EQ(of_f.value(point), of_g.value(point));
    EXPECT_EQ(of_f.at(point).a, of_g.at(point).a);
    EXPECT_EQ(of_f.at(point).error, of_g.at(point).error);
    expect_true(of_f.at(point), g);
  }
}

TEST(Tile, NothingIsClaimedWhereNumbersOverflow) {
  const FilteredPolynomial<2> f(written::polynomial<2>("x^5 y - 2 x^2 + y^4 - 1"));
  Kernel kernel;
  TiledPolynomial tiled(f, {{-1e300, -1e300}, {1e300, 1e300}}, kernel);
  for (const int bits : {53, 106}) {
    Tile tile;
    tiled.expand({{-1e300, -1e300}, {1e300, 1e300}}, bits, &tile);
    EXPECT_EQ(tile.error, HUGE_VAL);
    EXPECT_EQ(tile.bend_error, HUGE_VAL);
    EXPECT_EQ(tile.sum, 0);
    for (const auto& row : tile.a)
      for (const double a : row) EXPECT_EQ(a, 0.0);
  }
  // Near the end of the range but within it, claims are true.
  Tile tile;
  tiled.expand({{1e30, -3e30}, {2e30, 1e30}}, 53, &tile);
  expect_true(tile, f);
}

TEST(Tile, ClaimsHoldNextToWhatUnderflows) {
  const FilteredPolynomial<2> f(written::polynomial<2>("x^5 y - 2 x^2 + y^4 - x/3"));
  Kernel kernel;
  const double tiny = 0x1p-1000;
  TiledPolynomial tiled(f, {{-1, -1}, {1, 1}}, kernel);
  Tile tile;
  for (const int bits : {53, 106}) {
    tiled.expand({{-tiny, 0}, {tiny, tiny}}, bits, &tile);
    expect_true(tile, f);
  }
}

}  // namespace
}  // namespace encase
