// SPDX-License-Identifier: MIT
//
// Tiles against rational arithmetic.
#include "common/tile.hpp"

#include <gtest/gtest.h>
#include <hwy/highway.h>

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

/// Of full degree, with doubles for coefficients, or with thirds of them, which are none.
Polynomial<2> random_polynomial(int degree, bool doubles, Random& random) {
  std::vector<Polynomial<2>::Term> terms;
  for (const auto& e : dense_exponents<2>(degree)) {
    const Rational c(symmetric_random(random));
    terms.push_back({e, doubles ? c : c / 3});
  }
  return Polynomial<2>::from_terms(std::move(terms));
}

/// f as FilteredFunction scales it.
Polynomial<2> scaled(const FilteredFunction<2>& f) {
  return Polynomial<2>::constant(1 / Rational(f.scale())) * f.polynomial().exact();
}

/// f in the tile's coordinates.
Polynomial<2> composed(const FilteredFunction<2>& f, const Tile& tile) {
  return exact_bernstein::compose<2>(scaled(f),
                                     {Rational(tile.center[0]), Rational(tile.center[1])},
                                     {Rational(tile.half[0]), Rational(tile.half[1])});
}

/// What the tile says of f is true: the differences of the coefficients, weighted for |s_k| <=
/// kReach, add up to no more than the errors of the value and the derivatives; and the sums of the
/// coefficients are what they say.
void expect_true(const Tile& tile, const FilteredFunction<2>& f) {
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

std::vector<Point<2>> random_points(const Box<2>& box, int count, Random& random) {
  std::vector<Point<2>> points;
  for (int k = 0; k < count; ++k) {
    Point<2> point;
    for (int i = 0; i < 2; ++i)
      point[i] = box.lo[i] + box.width(i) * (0.5 + 0.5 * symmetric_random(random));
    points.push_back(point);
  }
  return points;
}

/// The values at the points, eight at a time.
std::vector<double> values_at(const TiledFunction& f, const std::vector<Point<2>>& points) {
  std::vector<double> values(points.size());
  for (std::size_t k = 0; k < points.size(); k += 8)
    f.values(&points[k], static_cast<int>(std::min<std::size_t>(8, points.size() - k)), &values[k]);
  return values;
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
    const FilteredFunction<2> f(random_polynomial(degree, doubles, random));
    Kernel kernel;
    TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
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
    const FilteredFunction<2> f(random_polynomial(degree, doubles, random));
    const Polynomial<2> exact = scaled(f);
    Kernel kernel;
    const Box<2> root{{-1.5, -1}, {1, 2}};
    TiledFunction tiled(f, root, kernel);
    std::vector<Point<2>> points = random_points(root, 6, random);
    points[0] = {0, 0};
    points[1] = root.hi;
    const std::vector<double> values = values_at(tiled, points);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Tile& tile = tiled.at(points[k]);
      const Rational at_point =
          exact(RationalPoint<2>{Rational(points[k][0]), Rational(points[k][1])});
      for (const double value : {tiled.value(points[k]), values[k]}) {
        const Rational off = abs(Rational(Rational(value) - at_point));
        EXPECT_LE(off, Rational(tile.value_error) + Rational(0x1p-52 * std::fabs(value)));
      }
      // It is far better than doubles: a claim that matters.
      EXPECT_LE(tile.value_error, 0x1p-86 * (degree + 1) * (degree + 1) * std::pow(3.5, degree));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, TileOfDegree,
                         testing::Values(0, 1, 2, 3, 5, 7, 8, 9, 12, 15, 16, 20, 31, 40, 60),
                         [](const auto& test) { return std::to_string(test.param); });

TEST(Tile, PreciseValuesHoldWhereTheyCancel) {
  // (x - y)^9 + (x - 1/3)^20 next to x = y = 1/3: all digits of doubles cancel.
  Random random(3);
  const FilteredFunction<2> f(written::polynomial<2>("(x - y)^9 + (x - 1/3)^20 + (y - 1/3)^12"));
  const Polynomial<2> exact = scaled(f);
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  for (int round = 0; round < 20; ++round) {
    const double spread = std::ldexp(1.0, -2 * round);
    const Point<2> point{1 / 3.0 + spread * symmetric_random(random),
                         1 / 3.0 + spread * symmetric_random(random)};
    double batch;
    tiled.values(&point, 1, &batch);
    for (const double value : {tiled.value(point), batch}) {
      const Rational off = abs(Rational(
          Rational(value) - exact(RationalPoint<2>{Rational(point[0]), Rational(point[1])})));
      EXPECT_LE(off, Rational(tiled.at(point).value_error) + Rational(0x1p-52 * std::fabs(value)));
    }
  }
}

TEST(Tile, TheTreeHasATileForEveryPoint) {
  Random random(4);
  for (const int degree : {3, 9, 25}) {
    const FilteredFunction<2> f(random_polynomial(degree, true, random));
    Kernel kernel;
    const Box<2> root{{-2, -1}, {1, 3}};
    TiledFunction tiled(f, root, kernel);
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

TEST(Tile, TilesOfTheTreeAreAsGoodAsTilesOfTheirOwn) {
  Random random(6);
  // The last root has centres that are no halves of another: nothing is halved there. In the one
  // before tiles near the middle would lose too much if they came from halving.
  const Box<2> roots[] = {{{-1.03125, -1.03125}, {1.0625, 1.0625}},
                          {{2.5, -1}, {4.5, 1}},
                          {{-40, -40}, {40, 40}},
                          {{-1, -0.1}, {1.1, 1 / 3.0}}};
  for (const int degree : {16, 20, 24, 30, 31})
    for (const Box<2>& root : roots) {
      const FilteredFunction<2> f(random_polynomial(degree, degree % 4 == 0, random));
      Kernel kernel;
      TiledFunction tiled(f, root, kernel);
      std::vector<Point<2>> points = random_points(root, 4, random);
      points.push_back(root.lo);
      points.push_back(root.center());
      bool first = true;
      for (const Point<2>& point : points) {
        const Tile& tile = tiled.at(point);
        Box<2> box;
        for (int i = 0; i < 2; ++i) {
          box.lo[i] = tile.center[i] - tile.half[i];
          box.hi[i] = tile.center[i] + tile.half[i];
        }
        Tile own;
        tiled.expand(box, 53, &own);
        if (own.center != tile.center || own.half != tile.half) continue;
        EXPECT_LE(tile.sum, own.sum * 1.0001);
        // (What halving in doubles may lose.)
        const double lost = 0x1p-36 * tile.sum;
        EXPECT_LE(tile.error, own.error * 1.07 + lost);
        EXPECT_LE(tile.slope_error, own.slope_error * 1.5 + degree * lost * 1.01);
        EXPECT_LE(tile.value_error, own.value_error);
        for (std::size_t k = 0; k < own.high_terms.size(); ++k)
          EXPECT_NEAR(tile.high_terms[k], own.high_terms[k], 1e-10 * own.high_terms[k]);
        if (first || degree == 16) expect_true(tile, f);
        first = false;
      }
    }
}

TEST(Tile, HalvingLosesLittleWhereNumbersCancel) {
  // A polynomial that is flat around a point: the tiles there have small coefficients, those of
  // the rectangles that they are quarters of have large ones.
  Random random(7);
  const FilteredFunction<2> f(written::polynomial<2>(
      "((x - 5/8)^2 + (y - 3/8)^2)^9 + (x - 1/3)^6 (x + y - 1)^6 (x - y + 1/16)^8"));
  for (const Box<2>& root : {Box<2>{{-1, -1}, {1, 1}}, Box<2>{{-8, -8}, {8, 8}}}) {
    Kernel kernel;
    TiledFunction tiled(f, root, kernel);
    for (const Point<2>& point :
         {Point<2>{0.625, 0.375}, Point<2>{0.626, 0.374}, Point<2>{1 / 3.0, 0.39}, root.hi})
      expect_true(tiled.at(point), f);
  }
}

TEST(Tile, HalvingInDoublesLosesNoMoreThanItSays) {
  Random random(12);
  for (const int degree : {13, 15, 20}) {
    // Terms of a high degree that no tile of the whole box can have, and little that cancels.
    const auto power = [&](const char* variable) {
      return written::polynomial<2>("300 " + std::string(variable) + "^" + std::to_string(degree));
    };
    const FilteredFunction<2> f(random_polynomial(degree, degree % 2 == 0, random) + power("x") +
                                power("y"));
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledFunction tiled(f, root, kernel);
    int in_doubles = 0;
    for (const Point<2>& point : random_points(root, 8, random)) {
      const Tile& tile = tiled.at(point);
      expect_true(tile, f);
      // Others have been rounded only once.
      in_doubles += tile.error > 0x1p-51 * tile.sum;
    }
    EXPECT_GT(in_doubles, 2) << degree;
  }
}

TEST(Tile, HighTermsBoundThoseAroundAnyPoint) {
  Random random(8);
  const FilteredFunction<2> f(random_polynomial(13, true, random));
  Kernel kernel;
  TiledFunction tiled(f, {{-0.5, -0.5}, {0.5, 0.5}}, kernel);
  const Tile& tile = tiled.at({0, 0});
  for (int k = 8; k <= 15; ++k) {
    double expected = 0;
    for (int i = k; i <= tile.degree; ++i) {
      double binomial = 1;
      for (int m = 0; m < k; ++m) binomial = binomial * (i - m) / (m + 1);
      for (int j = 0; i + j <= tile.degree; ++j)
        expected += binomial * (std::fabs(tile.a[i][j]) + std::fabs(tile.a[j][i]));
    }
    EXPECT_GE(tile.high_terms[k - 8], expected);
    EXPECT_LE(tile.high_terms[k - 8], expected * 1.001);
  }
}

TEST(Tile, AValueDoesNotDependOnTheOtherPoints) {
  Random random(9);
  for (const int degree : {0, 1, 3, 8, 20}) {
    const FilteredFunction<2> f(random_polynomial(degree, false, random));
    Kernel kernel;
    const Box<2> root{{-1, -1}, {1, 1}};
    TiledFunction tiled(f, root, kernel);
    std::vector<Point<2>> points = random_points(root, 8, random);
    const std::vector<double> values = values_at(tiled, points);
    for (int k = 0; k < 8; ++k) {
      double alone;
      tiled.values(&points[k], 1, &alone);
      EXPECT_EQ(alone, values[k]);
    }
    // What is not asked for is not written; a point out of range spoils no other.
    points[2] = {1e300, -1e300};
    double some[4] = {0, 0, 0, 7};
    tiled.values(points.data(), 3, some);
    EXPECT_EQ(some[0], values[0]);
    EXPECT_EQ(some[1], values[1]);
    EXPECT_EQ(some[3], 7);
  }
}

TEST(Tile, ValuesAndGradientsAtEightPoints) {
  Random random(10);
  for (const int degree : {0, 1, 3, 8, 15, 20}) {
    const FilteredFunction<2> f(random_polynomial(degree, true, random));
    Kernel kernel;
    TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
    const Tile& tile = tiled.at({0.3, -0.4});
    const std::vector<Point<2>> points = random_points({{-1, -1}, {1, 1}}, 8, random);
    double value[8], ds[8], dt[8];
    values_and_gradients(tile, points.data(), 8, value, ds, dt);
    for (int k = 0; k < 8; ++k) {
      const auto jet = value_and_gradient(tile, points[k]);
      EXPECT_NEAR(value[k], jet[0], 1e-14 * tile.sum);
      EXPECT_NEAR(ds[k], jet[1], 1e-14 * tile.slope);
      EXPECT_NEAR(dt[k], jet[2], 1e-14 * tile.slope);
      double alone[3];
      values_and_gradients(tile, &points[k], 1, alone, alone + 1, alone + 2);
      EXPECT_EQ(alone[0], value[k]);
      EXPECT_EQ(alone[1], ds[k]);
      EXPECT_EQ(alone[2], dt[k]);
    }
  }
}

TEST(Tile, AreTheSameForEveryInstructionSet) {
  const auto answers = [] {
    std::vector<double> all;
    Random random(11);
    const Box<2> root{{-1.03125, -1.03125}, {1.0625, 1.0625}};
    for (const int degree : {0, 3, 7, 8, 15, 16, 20, 23, 30, 35}) {
      const FilteredFunction<2> f(random_polynomial(degree, false, random));
      Kernel kernel;
      TiledFunction tiled(f, root, kernel);
      const std::vector<Point<2>> points = random_points(root, 8, random);
      for (const Point<2>& point : points) {
        const Tile& tile = tiled.at(point);
        for (const auto& row : tile.a) all.insert(all.end(), row.begin(), row.end());
        all.insert(all.end(), tile.high_terms.begin(), tile.high_terms.end());
        all.insert(all.end(), {tile.sum, tile.slope, tile.bend, tile.error, tile.slope_error,
                               tile.bend_error, tile.value_error, tiled.value(point)});
      }
      double value[8], ds[8], dt[8];
      tiled.values(points.data(), 8, value);
      all.insert(all.end(), value, value + 8);
      values_and_gradients(tiled.at({0, 0}), points.data(), 8, value, ds, dt);
      all.insert(all.end(), value, value + 8);
      all.insert(all.end(), ds, ds + 8);
      all.insert(all.end(), dt, dt + 8);
    }
    return all;
  };
  const std::vector<double> expected = answers();
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_EQ(answers(), expected) << hwy::TargetName(rest & -rest);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(Tile, CoefficientsFarOutsideTheRangeOfDoublesAreScaled) {
  Random random(5);
  const Polynomial<2> exact = random_polynomial(6, false, random);
  Rational scale;
  mpz_ui_pow_ui(scale.get_num_mpz_t(), 2, 1500);
  for (const Rational& c : {scale, Rational(1 / scale)}) {
    // A power of two: the scaled polynomials are the same.
    const FilteredFunction<2> f(Polynomial<2>::constant(c) * exact), g(exact);
    Kernel kernel;
    const Box<2> box{{-1, -1}, {1, 1}};
    TiledFunction of_f(f, box, kernel), of_g(g, box, kernel);
    const Point<2> point{0.3, 0.4};
    EXPECT_EQ(of_f.value(point), of_g.value(point));
    EXPECT_EQ(of_f.at(point).a, of_g.at(point).a);
    EXPECT_EQ(of_f.at(point).error, of_g.at(point).error);
    expect_true(of_f.at(point), g);
  }
}

TEST(Tile, NothingIsClaimedWhereNumbersOverflow) {
  const FilteredFunction<2> f(written::polynomial<2>("x^5 y - 2 x^2 + y^4 - 1"));
  Kernel kernel;
  TiledFunction tiled(f, {{-1e300, -1e300}, {1e300, 1e300}}, kernel);
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
  const FilteredFunction<2> f(written::polynomial<2>("x^5 y - 2 x^2 + y^4 - x/3"));
  Kernel kernel;
  const double tiny = 0x1p-1000;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  Tile tile;
  for (const int bits : {53, 106}) {
    tiled.expand({{-tiny, 0}, {tiny, tiny}}, bits, &tile);
    expect_true(tile, f);
  }
}

}  // namespace
}  // namespace encase
