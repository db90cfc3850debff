// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "common/filtered_inclusion.hpp"
#include "common/substitute.hpp"
#include "encase/slice.hpp"

namespace encase {

namespace {

/// The part of a convex polygon where a u + b v + c <= 0. Its corners, some perhaps twice.
std::vector<RationalPoint<2>> clip(const std::vector<RationalPoint<2>>& polygon,
                                   const std::array<Rational, 3>& line) {
  const auto value = [&](const RationalPoint<2>& p) {
    return Rational(line[0] * p[0] + line[1] * p[1] + line[2]);
  };
  std::vector<RationalPoint<2>> clipped;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const RationalPoint<2>&p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Rational at_p = value(p), at_q = value(q);
    if (at_p <= 0) clipped.push_back(p);
    if (sgn(at_p) * sgn(at_q) >= 0) continue;
    const Rational t = at_p / (at_p - at_q);
    clipped.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
  }
  return clipped;
}

/// The expression with others in place of its variables.
Expression substitute(const Expression& f, const std::array<Expression, 3>& replacements) {
  std::vector<Expression> values;
  for (const Expression::Step& step : f.steps()) {
    const auto operand = [&](int index) { return values[static_cast<std::size_t>(index)]; };
    switch (step.operation) {
      case Operation::Constant:
        values.emplace_back(step.constant);
        break;
      case Operation::Pi:
        values.push_back(Expression::pi());
        break;
      case Operation::Euler:
        values.push_back(Expression::euler());
        break;
      case Operation::Variable:
        values.push_back(replacements[static_cast<std::size_t>(step.number)]);
        break;
      case Operation::Power:
        values.push_back(operand(step.first).power(step.number));
        break;
      default:
        values.push_back(step.second < 0 ? Expression::apply(step.operation, operand(step.first))
                                         : Expression::apply(step.operation, operand(step.first),
                                                             operand(step.second)));
    }
  }
  return values.back();
}

}  // namespace

PlaneChart::PlaneChart(const std::array<Rational, 4>& plane) : plane_(plane) {
  solved_ = 2;
  for (int i : {1, 0})
    if (abs(plane[i]) > abs(plane[solved_])) solved_ = i;
  axes_ = {(solved_ + 1) % 3, (solved_ + 2) % 3};
  if (plane[solved_] < 0) std::swap(axes_[0], axes_[1]);
  for (int i = 0; i < 2; ++i) height_[i] = -plane[axes_[i]] / plane[solved_];
  height_[2] = -plane[3] / plane[solved_];
  for (int i = 0; i < 3; ++i) rounded_height_[i] = nearest_double(height_[i]);
}

RationalPoint<3> PlaneChart::lift(const RationalPoint<2>& point) const {
  RationalPoint<3> lifted;
  for (int i = 0; i < 2; ++i) lifted[axes_[i]] = point[i];
  lifted[solved_] = height_[0] * point[0] + height_[1] * point[1] + height_[2];
  return lifted;
}

Point<3> PlaneChart::lift(const Point<2>& point) const {
  Point<3> lifted;
  for (int i = 0; i < 2; ++i) lifted[axes_[i]] = point[i];
  lifted[solved_] =
      rounded_height_[0] * point[0] + rounded_height_[1] * point[1] + rounded_height_[2];
  return lifted;
}

Function<2> PlaneChart::restrict(const Function<3>& function) const {
  if (function.is_polynomial()) {
    std::array<Polynomial<2>, 3> at;
    at[solved_] = Polynomial<2>::constant(height_[2]);
    for (int i = 0; i < 2; ++i) {
      at[axes_[i]] = Polynomial<2>::variable(i);
      at[solved_] = at[solved_] + Polynomial<2>::constant(height_[i]) * at[axes_[i]];
    }
    return encase::substitute<2, 3>(function.polynomial(), at);
  }
  if (function.is_inclusion()) {
    PlaneMap map;
    for (std::size_t i = 0; i < 2; ++i) map[static_cast<std::size_t>(axes_[i])][i] = 1;
    for (std::size_t i = 0; i < 3; ++i) map[static_cast<std::size_t>(solved_)][i] = height_[i];
    return restricted(function.inclusion(), map);
  }
  std::array<Expression, 3> at;
  Expression height(height_[2]);
  for (int i = 0; i < 2; ++i) {
    at[axes_[i]] = Expression::variable(i);
    if (height_[i] == 1)
      height = at[axes_[i]] + height;
    else if (height_[i] != 0)
      height = Expression(height_[i]) * at[axes_[i]] + height;
  }
  at[solved_] = height;
  return substitute(function.expression(), at);
}

Result<Region> PlaneChart::restrict(const Polyhedron& polyhedron) const {
  // The part lies in the rectangle around the corners' coordinates.
  RationalPoint<2> lo, hi;
  for (int i = 0; i < 2; ++i) {
    const auto less = [&](const RationalPoint<3>& p, const RationalPoint<3>& q) {
      return p[axes_[i]] < q[axes_[i]];
    };
    const auto [first, last] =
        std::minmax_element(polyhedron.corners.begin(), polyhedron.corners.end(), less);
    lo[i] = (*first)[axes_[i]];
    hi[i] = (*last)[axes_[i]];
  }
  std::vector<RationalPoint<2>> polygon{
      {lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}};
  for (const HalfSpace& side : polyhedron.sides)
    polygon = clip(polygon, {side[axes_[0]] + side[solved_] * height_[0],
                             side[axes_[1]] + side[solved_] * height_[1],
                             side[3] + side[solved_] * height_[2]});
  if (polygon.empty()) return Error{Error::Code::BadInput, "the plane does not meet the region"};
  auto region = make_region(std::move(polygon));
  if (!region)
    return Error{Error::Code::BadInput, "the plane meets the region in a corner or an edge only"};
  return region;
}

}  // namespace encase
