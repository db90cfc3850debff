// SPDX-License-Identifier: MIT
#include "2d/clearing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace encase {
namespace {

double distance_to_segment(const Point<2>& p, const Point<2>& from, const Point<2>& to) {
  const Point<2> along = {to[0] - from[0], to[1] - from[1]};
  const double square = along[0] * along[0] + along[1] * along[1];
  double part = 0;
  if (square > 0)
    part =
        std::clamp(((p[0] - from[0]) * along[0] + (p[1] - from[1]) * along[1]) / square, 0.0, 1.0);
  return std::hypot(from[0] + part * along[0] - p[0], from[1] + part * along[1] - p[1]);
}

/// How far a point inside is from the boundaries; negative outside.
double clearance(const std::vector<std::vector<Point<2>>>& boundaries, const Point<2>& p) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (const std::vector<Point<2>>& polygon : boundaries)
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point<2>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      least = std::min(least, distance_to_segment(p, a, b));
      if ((a[1] > p[1]) != (b[1] > p[1]) &&
          p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]))
        inside = !inside;
    }
  return inside ? least : -least;
}

/// A square of places for the centre.
struct Square {
  Point<2> center{};
  double half = 0;
  double clearance = 0;
  /// No place in the square has more than this.
  double bound() const { return clearance + half * std::sqrt(2.0); }
  bool operator<(const Square& other) const { return bound() < other.bound(); }
};

}  // namespace

Clearing largest_clearing(const std::vector<std::vector<Point<2>>>& boundaries, double precision) {
  constexpr int kMostTried = 1000;
  Clearing best;
  best.radius = -std::numeric_limits<double>::infinity();
  if (boundaries.empty() || boundaries[0].empty()) return best;
  Box<2> box{boundaries[0][0], boundaries[0][0]};
  for (const Point<2>& p : boundaries[0]) box = hull(box, Box<2>{p, p});
  std::priority_queue<Square> squares;
  int tried = 0;
  const auto visit = [&](const Point<2>& center, double half) {
    const Square square{center, half, clearance(boundaries, center)};
    if (square.clearance > best.radius) best = {center, square.clearance};
    squares.push(square);
    ++tried;
  };
  const double half = 0.5 * std::max(std::min(box.width(0), box.width(1)),
                                     std::max(box.width(0), box.width(1)) / 32);
  for (double x = box.lo[0] + half; x < box.hi[0] + half; x += 2 * half)
    for (double y = box.lo[1] + half; y < box.hi[1] + half; y += 2 * half) visit({x, y}, half);
  while (!squares.empty() && tried < kMostTried) {
    const Square square = squares.top();
    squares.pop();
    if (square.bound() <= best.radius + precision) break;
    const double quarter = 0.5 * square.half;
    for (const double x : {-quarter, quarter})
      for (const double y : {-quarter, quarter})
        visit({square.center[0] + x, square.center[1] + y}, quarter);
  }
  return best;
}

}  // namespace encase
