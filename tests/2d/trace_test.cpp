// SPDX-License-Identifier: MIT
#include "2d/trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/filtered_function.hpp"
#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

double distance(const Point<2>& p, const Point<2>& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1]);
}

double distance(const Point<2>& p, const Polyline& line) {
  double least = distance(p, line.front());
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Point<2>&a = line[k - 1], &b = line[k];
    const double l = distance(a, b);
    if (l == 0) continue;
    const double t = ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / (l * l);
    const double s = std::clamp(t, 0.0, 1.0);
    least = std::min(least, distance(p, {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])}));
  }
  return least;
}

/// The largest |f| / |grad f| over the points: how far they are from the curve.
double residual(const Polynomial<2>& polynomial, const Polyline& line) {
  const FilteredFunction<2> f(polynomial);
  double largest = 0;
  for (const Point<2>& p : line) {
    const Point<2> g = f.gradient(p);
    largest = std::max(largest, std::fabs(f.approximate(p)) / std::hypot(g[0], g[1]));
  }
  return largest;
}

TEST(TraceBranch, RunsFromTheFirstCrossingToTheSecondWithinTheTolerance) {
  const Encasement e = sample::circle_and_line();
  const double tolerance = 1e-4;
  const Branch& branch = e.cells[0].branches[0];
  const Polyline line = trace_branch(e, 0, branch, tolerance);
  EXPECT_NEAR(line.front()[0], 0.0625, 1e-15);
  EXPECT_NEAR(line.front()[1], -std::sqrt(0.5 - 0.0625 * 0.0625), tolerance);
  EXPECT_NEAR(line.back()[1], std::sqrt(0.5 - 0.0625 * 0.0625), tolerance);
  EXPECT_LE(residual(e.curves[0].function.polynomial(), line), tolerance / 50);
  for (const Point<2>& p : line) EXPECT_LE(p[0], 0.0625 + 1e-12);
  // The left part of the circle, all of it: its points lie close to the polyline.
  for (double angle = 1.7; angle < 4.58; angle += 0.001)
    ASSERT_LE(distance({std::sqrt(0.5) * std::cos(angle), std::sqrt(0.5) * std::sin(angle)}, line),
              1.5 * tolerance);
  // An arc of radius r and sagitta s has a chord of sqrt(8 r s): not many more points than needed.
  const double chord = std::sqrt(8 * std::sqrt(0.5) * tolerance);
  EXPECT_LE(line.size(), 4 * 3.0 * std::sqrt(0.5) / chord);
}

TEST(TraceBranch, FollowsABranchThatItsBisectorCrossesThreeTimes) {
  // x = 4 y^3 - 2 y: an S that folds back twice.
  const Encasement e =
      sample::one_branch(sample::polynomial({{{1, 0}, 1}, {{0, 3}, -4}, {{0, 1}, 2}}),
                         {3, 0, -1, -0.8}, {1, 0, 0.8, 1});
  const double tolerance = 1e-3;
  const Polyline line = trace_branch(e, 0, e.cells[0].branches[0], tolerance);
  EXPECT_LE(residual(e.curves[0].function.polynomial(), line), tolerance / 50);
  for (std::size_t k = 1; k < line.size(); ++k) ASSERT_LT(line[k - 1][1], line[k][1]);
  for (double y = line.front()[1]; y < line.back()[1]; y += 1e-3)
    ASSERT_LE(distance({4 * y * y * y - 2 * y, y}, line), 1.5 * tolerance) << y;
}

TEST(TraceBranch, FollowsAHairpinWithCloseEnds) {
  // x = 10000 y^2 - 0.9: enters and leaves through x = 1, 0.028 apart.
  const Encasement e = sample::one_branch(
      sample::polynomial({{{1, 0}, -1}, {{0, 2}, 10000}, {{0, 0}, Rational(-9, 10)}}),
      {1, 0, -0.02, -0.01}, {1, 0, 0.01, 0.02});
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const Polyline line = trace_branch(e, 0, e.cells[0].branches[0], tolerance);
    for (double y = line.front()[1]; y < line.back()[1]; y += 1e-4)
      ASSERT_LE(distance({10000 * y * y - 0.9, y}, line), 1.5 * tolerance) << y;
    for (std::size_t k = 1; k < line.size(); ++k) ASSERT_LT(line[k - 1][1], line[k][1]);
  }
}

TEST(TraceBranch, SeesABumpBetweenEndsWhoseTangentsAreTheChord) {
  // y = (x^2 - 1)^2 / 2 from x = -1 to x = 1.
  const Encasement e =
      sample::one_branch(sample::polynomial({{{0, 1}, -2}, {{4, 0}, 1}, {{2, 0}, -2}, {{0, 0}, 1}}),
                         {3, 0, -0.1, 0.1}, {1, 0, -0.1, 0.1});
  const double tolerance = 1e-3;
  const Polyline line = trace_branch(e, 0, e.cells[0].branches[0], tolerance);
  for (double x = -1; x < 1; x += 1e-3)
    ASSERT_LE(distance({x, (x * x - 1) * (x * x - 1) / 2}, line), 1.5 * tolerance) << x;
}

TEST(TraceBranch, TakesTheChordOfALine) {
  const Encasement e = sample::circle_and_line();
  EXPECT_EQ(trace_branch(e, 1, e.cells[1].branches[1], 1e-6).size(), 2u);
}

TEST(TraceBranch, EndsForAnyTolerance) {
  const Encasement e = sample::circle_and_line();
  EXPECT_LE(trace_branch(e, 0, e.cells[0].branches[0], 0).size(), 100000u);
  EXPECT_LE(trace_branch(e, 0, e.cells[0].branches[0], 1e9).size(), 8u);
}

TEST(TraceCurve, ClosesALoopAcrossCells) {
  const Encasement e = sample::circle_and_line();
  const auto chains = trace_curve(e, 0, 1e-3);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].front(), chains[0].back());
  double length = 0;
  for (std::size_t k = 1; k < chains[0].size(); ++k) {
    EXPECT_GT(distance(chains[0][k - 1], chains[0][k]), 0);
    length += distance(chains[0][k - 1], chains[0][k]);
  }
  EXPECT_NEAR(length, 2 * 3.14159265 * std::sqrt(0.5), 0.01);
}

TEST(TraceCurve, JoinsAnOpenCurveFromBoundaryToBoundary) {
  Encasement e = sample::circle_and_line();
  // Against the direction of its neighbour.
  std::swap(e.cells[0].branches[1].from, e.cells[0].branches[1].to);
  const auto chains = trace_curve(e, 1, 1e-3);
  ASSERT_EQ(chains.size(), 1u);
  ASSERT_EQ(chains[0].size(), 2u);
  EXPECT_DOUBLE_EQ(std::fabs(chains[0].front()[0]), 1);
  EXPECT_DOUBLE_EQ(chains[0].front()[0], -chains[0].back()[0]);
}

TEST(TraceCurve, LeavesOutCellsWithoutBranches) {
  Encasement e = sample::circle_and_line();
  e.cells[0].branches.clear();
  const auto chains = trace_curve(e, 0, 1e-3);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_NE(chains[0].front(), chains[0].back());
}

TEST(TraceEdges, JoinsVertices) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  const auto lines = trace_edges(e, a, 1e-3);
  ASSERT_EQ(lines.size(), a.edges.size());
  std::map<int, Point<2>> at;
  double circle = 0, line = 0, boundary = 0;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    ASSERT_GE(lines[k].size(), 2u);
    for (const bool end : {false, true}) {
      const int v = a.half_edges[2 * k + end].origin;
      const Point<2> point = end ? lines[k].back() : lines[k].front();
      EXPECT_EQ(at.try_emplace(v, point).first->second, point);
      if (a.vertices[v].kind == Arrangement::Vertex::Kind::Crossing) {
        EXPECT_EQ(point, e.crossings[a.vertices[v].index].point);
      }
    }
    double& sum = a.edges[k].curve < 0 ? boundary : a.edges[k].curve == 0 ? circle : line;
    for (std::size_t i = 1; i < lines[k].size(); ++i) sum += distance(lines[k][i - 1], lines[k][i]);
  }
  EXPECT_NEAR(circle, 2 * 3.14159265 * std::sqrt(0.5), 0.01);
  EXPECT_NEAR(line, 2 * std::hypot(1, 0.2), 0.01);
  EXPECT_NEAR(boundary, 8, 1e-9);
}

TEST(TraceEdges, ClosesLoopsWithoutVertices) {
  const auto x = Polynomial<2>::variable(0), y = Polynomial<2>::variable(1);
  const Polynomial<2> circle = x * x + y * y - Polynomial<2>::constant(Rational(1, 2));
  const Encasement e = encase({{"circle", circle}}, sample::square()).value();
  const Arrangement a = arrange(e).value();
  const auto lines = trace_edges(e, a, 1e-3);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_GT(lines[0].size(), 20u);
}

TEST(SketchCurve, StaysInTheCellAndNearTheCurve) {
  const Encasement e = sample::circle_and_line();
  const auto segments = sketch_curve(e, 0, 0, 0.02);
  EXPECT_GT(segments.size(), 100u);
  double length = 0;
  for (const Polyline& segment : segments) {
    length += distance(segment[0], segment[1]);
    for (const Point<2>& p : segment) {
      EXPECT_LE(p[0], 0.0625 + 1e-12);
      EXPECT_NEAR(std::hypot(p[0], p[1]), std::sqrt(0.5), 1e-3);
    }
  }
  const double angle = 3.14159265 + 2 * std::asin(0.0625 / std::sqrt(0.5));
  EXPECT_NEAR(length, angle * std::sqrt(0.5), 0.06);
  EXPECT_TRUE(sketch_curve(e, 2, 0, 0.02).empty());
}

}  // namespace
}  // namespace encase
