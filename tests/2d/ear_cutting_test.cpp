// SPDX-License-Identifier: MIT
#include "2d/ear_cutting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace encase {
namespace {

double area(const std::vector<Point<2>>& points, const std::vector<int>& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point<2>&p = points[polygon[k]], &q = points[polygon[(k + 1) % polygon.size()]];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

/// The triangles of the polygon through all points in their order.
std::vector<std::array<int, 3>> triangles_of(const std::vector<Point<2>>& points) {
  std::vector<int> polygon(points.size());
  std::iota(polygon.begin(), polygon.end(), 0);
  return cut_ears(points, polygon);
}

double total(const std::vector<Point<2>>& points, bool absolute) {
  double sum = 0;
  for (const auto& t : triangles_of(points)) {
    const double part = area(points, {t[0], t[1], t[2]});
    sum += absolute ? std::fabs(part) : part;
  }
  return sum;
}

double whole(const std::vector<Point<2>>& points) {
  std::vector<int> polygon(points.size());
  std::iota(polygon.begin(), polygon.end(), 0);
  return area(points, polygon);
}

/// Positive triangles whose areas add up do not overlap.
void expect_cut(const std::vector<Point<2>>& points) {
  EXPECT_EQ(triangles_of(points).size(), points.size() - 2);
  EXPECT_NEAR(total(points, true), whole(points), 1e-12 * whole(points));
}

TEST(EarCutting, FillsPolygonsWithDents) {
  expect_cut({{0, 0}, {1, 0}, {0, 1}});
  expect_cut({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});
  // A comb.
  std::vector<Point<2>> comb = {{0, 0}, {20, 0}};
  for (int k = 19; k >= 0; --k) comb.push_back({1.0 * k, k % 2 == 0 ? 5.0 : 1.0});
  expect_cut(comb);
  // A spiral.
  std::vector<Point<2>> spiral;
  for (int k = 0; k < 60; ++k)
    spiral.push_back({(2 + 0.2 * k) * std::cos(0.3 * k), (2 + 0.2 * k) * std::sin(0.3 * k)});
  for (int k = 59; k >= 0; --k)
    spiral.push_back({(1.5 + 0.2 * k) * std::cos(0.3 * k), (1.5 + 0.2 * k) * std::sin(0.3 * k)});
  expect_cut(spiral);
}

TEST(EarCutting, FillsCellsCutByACurve) {
  // Below and above a parabola in a square, whose sides have points in between.
  for (const double side : {1.0, -1.0}) {
    std::vector<Point<2>> polygon;
    for (int k = -50; k <= 50; ++k) polygon.push_back({side * k / 50, 0.9 * k * k / 2500 - 0.5});
    polygon.push_back({side, side});
    polygon.push_back({0, side});
    polygon.push_back({-side, side});
    expect_cut(polygon);
  }
}

TEST(EarCutting, FillsStarsOfRandomPoints) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.1, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Point<2>> star;
    const int n = 5 + round;
    for (int k = 0; k < n; ++k) {
      const double r = radius(random), angle = 2 * std::acos(-1.0) * k / n;
      star.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    expect_cut(star);
  }
}

TEST(EarCutting, KeepsTheAreaOfWhatIsNoSimplePolygon) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<Point<2>> points;
    for (int k = 0; k < 20; ++k) points.push_back({place(random), place(random)});
    EXPECT_EQ(triangles_of(points).size(), 18u);
    EXPECT_NEAR(total(points, false), whole(points), 1e-13);
  }
  // All on a line, and all in a point.
  EXPECT_EQ(triangles_of({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).size(), 2u);
  EXPECT_EQ(triangles_of({{1, 1}, {1, 1}, {1, 1}, {1, 1}}).size(), 2u);
}

}  // namespace
}  // namespace encase
