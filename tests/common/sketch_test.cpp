// SPDX-License-Identifier: MIT
//
// Sketches against the polynomials that they stand for, and points against a line.
#include "common/sketch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/random_polynomials.hpp"
#include "common/tile_samples.hpp"

namespace encase {
namespace {

TEST(Sketch, HasAboutTheValuesAndSlopesOfThePolynomial) {
  for (const int degree : {2, 5, 9, 15}) {
    RandomOptions options;
    options.degree = degree;
    const FilteredFunction<2> f(random_polynomials<2>(options)[0]);
    Kernel kernel;
    const Box<2> box{{0.1, -0.4}, {0.35, -0.2}};
    TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
    Sketch sketch;
    ASSERT_TRUE(make_sketch(tiled, box, &sketch));
    EXPECT_LE(sketch.degree, degree);
    std::mt19937_64 random(degree);
    alignas(64) Sketch::Lanes s, t;
    SketchSlopes at_points;
    for (int k = 0; k < Sketch::kLanes; ++k) {
      s[k] = symmetric_random(random);
      t[k] = symmetric_random(random);
    }
    slopes(sketch, s, t, &at_points);
    // One constant factor for values and gradients, up to what is neglected.
    double ratio = 0, largest = 0;
    std::vector<double> values;
    for (int k = 0; k < Sketch::kLanes; ++k) {
      const Point<2> at{sketch.center[0] + s[k] / sketch.scale[0],
                        sketch.center[1] + t[k] / sketch.scale[1]};
      values.push_back(tiled.value(at));
      if (std::fabs(values.back()) > largest) {
        largest = std::fabs(values.back());
        ratio = at_points.value[k] / values.back();
      }
    }
    EXPECT_GT(ratio, 0);
    for (int k = 0; k < Sketch::kLanes; ++k) {
      EXPECT_NEAR(at_points.value[k], ratio * values[k], 0.01 * ratio * largest) << degree;
      for (int i = 0; i < 2; ++i) {
        constexpr double kStep = 1e-5;
        alignas(64) Sketch::Lanes a = s, b = t;
        (i == 0 ? a : b)[k] += kStep;
        SketchSlopes moved;
        slopes(sketch, a, b, &moved);
        EXPECT_NEAR((i == 0 ? at_points.s : at_points.t)[k],
                    (moved.value[k] - at_points.value[k]) / kStep, 1e-3);
      }
    }
  }
}

TEST(Sketch, CountsTheSignChangesOnASegment) {
  RandomOptions options;
  options.degree = 12;
  const FilteredFunction<2> f(random_polynomials<2>(options)[0]);
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  const Box<2> box{{-0.3, -0.3}, {0.2, 0.4}};
  Sketch sketch;
  ASSERT_TRUE(make_sketch(tiled, box, &sketch));
  std::mt19937_64 random(3);
  int differences = 0, total = 0;
  for (int k = 0; k < 200; ++k) {
    const auto point = [&] {
      const Point<2> c = box.center();
      return Point<2>{c[0] + 0.5 * box.width(0) * symmetric_random(random),
                      c[1] + 0.5 * box.width(1) * symmetric_random(random)};
    };
    const Point<2> from = point(), to = point();
    const int count = count_sign_changes(tiled, from, to);
    total += count;
    if (count_sign_changes(sketch, from, to) != count) ++differences;
  }
  EXPECT_GT(total, 50);
  EXPECT_LE(differences, 10);
}

TEST(Sketch, IsNotMadeFarBeyondATile) {
  RandomOptions options;
  options.degree = 25;
  const FilteredFunction<2> f(random_polynomials<2>(options)[0]);
  Kernel kernel;
  TiledFunction tiled(f, {{-1, -1}, {1, 1}}, kernel);
  Sketch sketch;
  EXPECT_FALSE(make_sketch(tiled, {{-1, -1}, {1, 1}}, &sketch));
  EXPECT_FALSE(make_sketch(tiled, {{0.5, -1}, {0.5, 1}}, &sketch));
}

TEST(PointGroups, AreDividedByALine) {
  std::mt19937_64 random(1);
  PointGroups points;
  points.reset(3, 150, {2, 2});
  ASSERT_EQ(points.size(), 152);
  for (int k = 0; k < 150; ++k)
    points.place(k, {symmetric_random(random), symmetric_random(random)});
  for (int k = 0; k < 150; ++k) points.join(k % 7 == 0 ? 2 : k % 2, k);
  Line line;
  line.normal = {0.3, -0.8};
  line.offset = 0.1;
  constexpr int kNear = 40;
  std::vector<double> heights(kNear);
  std::vector<int> positive(3), expected(3, 0);
  const double least = divide(points, line, kNear, heights.data(), positive.data());
  double closest = HUGE_VAL;
  for (int k = 0; k < 150; ++k) {
    const double h = line.normal[0] * points.x[k] + line.normal[1] * points.y[k] + line.offset;
    if (h > 0) ++expected[k % 7 == 0 ? 2 : k % 2];
    if (k >= kNear) continue;
    EXPECT_NEAR(heights[k], h, 1e-15);
    closest = std::min(closest, std::fabs(h));
  }
  EXPECT_EQ(positive, expected);
  EXPECT_NEAR(least, closest, 1e-15);
}

}  // namespace
}  // namespace encase
