// SPDX-License-Identifier: MIT
#include "2d/curve_follower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace encase {
namespace {

double distance(const Point<2>& p, const Point<2>& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1]);
}

}  // namespace

bool CurvePath::is_proved() const {
  return std::all_of(pieces.begin(), pieces.end(),
                     [](const CurvePiece& piece) { return std::isfinite(piece.distance); });
}

void CurvePath::reverse() {
  std::reverse(points.begin(), points.end());
  std::reverse(pieces.begin(), pieces.end());
  for (CurvePiece& piece : pieces) piece.direction = -piece.direction;
}

void CurvePath::append(const CurvePath& path) {
  points.insert(points.end(), path.points.begin() + (points.empty() ? 0 : 1), path.points.end());
  pieces.insert(pieces.end(), path.pieces.begin(), path.pieces.end());
}

/// The coordinate along which the curve runs from one point to the other.
int CurveFollower::axis_between(const Point<2>& from, const Point<2>& to) {
  const Point<2> p = prover_.look_at(from).gradient, q = prover_.look_at(to).gradient;
  return std::fabs(p[0] + q[0]) > std::fabs(p[1] + q[1]) ? 1 : 0;
}

/// A point of the curve about so far along the tangent, by Newton's iteration in one coordinate.
CurveFollower::Step CurveFollower::step_from(const Point<2>& at, int direction, double length) {
  Step step;
  const Point<2> g = prover_.look_at(at).gradient;
  const double advance = direction * length / std::hypot(g[0], g[1]);
  const Point<2> start = {at[0] + advance * g[1], at[1] - advance * g[0]};
  if (!std::isfinite(start[0]) || !std::isfinite(start[1])) return step;
  step.axis = axis_between(at, start);
  const int across = 1 - step.axis;
  constexpr int kMostIterations = 4;
  Point<2> p = start;
  const auto approach = [&](bool precise) {
    p = start;
    for (int k = 0; k < kMostIterations; ++k) {
      const ValueAndGradient here = prover_.look_at(p);
      const double change = (precise ? f_.value(p) : here.value) / here.gradient[across];
      if (!(std::fabs(change) <= 2 * length)) return false;
      p[across] -= change;
      // The rest is for the proof to find.
      if (std::fabs(change) <= 0x1p-5 * length) return true;
    }
    return true;
  };
  if (!approach(false) && !approach(true)) return step;
  step.found = true;
  step.to = {p, {p, p}};
  return step;
}

CurvePath CurveFollower::follow(const CurvePoint& from, const CurvePoint& to, int direction,
                                double goal, int most) {
  goal = std::max(goal, least_goal());
  CurvePath path;
  path.points = {from};
  double length = distance(from.point, to.point);
  const double least = 0x1p-48 * size_;
  while (static_cast<int>(path.pieces.size()) + 1 < most && length >= least) {
    const CurvePoint at = path.points.back();
    if (!f_.box().contains(at.point)) break;  // the end is in the region
    const auto accept = [&](const Attempt& attempt) {
      if (!attempt.proved || attempt.piece.distance > goal) return false;
      path.points.push_back(attempt.to);
      path.pieces.push_back(attempt.piece);
      return true;
    };
    const double rest = distance(at.point, to.point);
    if (rest <= 1.3 * length &&
        accept(prover_.prove(at, to, false, axis_between(at.point, to.point), direction, goal)))
      return path;
    const double way = rest < 2 * length ? std::min(length, 0.55 * rest) : length;
    const Step step = step_from(at.point, direction, way);
    if (!step.found) {
      length = 0.5 * way;
      continue;
    }
    const Attempt attempt = prover_.prove(at, step.to, true, step.axis, direction, goal);
    // A piece that may hold the end goes too far.
    if (attempt.proved && attempt.tube.may_meet(to.box)) {
      length = 0.5 * way;
      continue;
    }
    const double factor = std::isfinite(attempt.factor) ? attempt.factor : 0.5;
    length = way * (accept(attempt) ? std::max(factor, 0.5) : std::min(factor, 0.7));
  }
  path.points.push_back(to);
  path.pieces.push_back({0, direction, std::numeric_limits<double>::infinity()});
  return path;
}

}  // namespace encase
