// SPDX-License-Identifier: MIT
#include "3d/field_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "3d/space_vectors.hpp"

namespace encase {

namespace {

Point<3> centre_of(const GraphCertificate& graph) {
  return graph.center - (1 / graph.spread) * graph.direction;
}

/// Twice the signed area of a polygon in the plane of the first two coordinates.
double doubled_area(const std::vector<Point<3>>& polygon) {
  double area = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point<3>&p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    area += p[0] * q[1] - p[1] * q[0];
  }
  return area;
}

/// Whether the sides of a polygon in the plane of the first two coordinates cross each other.
bool crosses_itself(const std::vector<Point<3>>& polygon) {
  const std::size_t n = polygon.size();
  const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
    return cross(polygon[b] - polygon[a], polygon[c] - polygon[a])[2];
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 2; j < n; ++j) {
      const std::size_t p = i + 1, q = (j + 1) % n;
      if (q == i) continue;
      if (turn(i, p, j) * turn(i, p, q) <= 0 && turn(j, q, i) * turn(j, q, p) <= 0) return true;
    }
  return false;
}

/// Of the angles that directions include with the normals.
template <class Direction>
double least_cosine(const std::vector<Point<3>>& normals, const Direction& direction) {
  double least = 1;
  for (std::size_t k = 0; k < normals.size(); ++k)
    least = std::min(least, dot(normals[k], direction(k)));
  return least;
}

/// The point for which the squares of its distances from the lines along normals have the least
/// sum: sum of (1 - n n^T) (x - p) = 0. Not a number if these are parallel.
Point<3> nearest_to_lines(const std::vector<Point<3>>& points,
                          const std::vector<Point<3>>& normals) {
  std::array<Point<3>, 3> rows{};
  Point<3> right{};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point<3>&p = points[k] - points[0], &n = normals[k];
    for (int i = 0; i < 3; ++i) {
      Point<3> row = -n[i] * n;
      row[i] += 1;
      rows[i] = rows[i] + row;
      right[i] += dot(row, p);
    }
  }
  const Point<3> columns =
      (1 / dot(rows[0], cross(rows[1], rows[2]))) *
      (right[0] * cross(rows[1], rows[2]) +
       (right[1] * cross(rows[2], rows[0]) + right[2] * cross(rows[0], rows[1])));
  return points[0] + columns;
}

/// Directions all around.
std::vector<Point<3>> directions() {
  std::vector<Point<3>> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          all.push_back(
              unit({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}));
  return all;
}

}  // namespace

FieldChart::FieldChart(const GraphCertificate& graph, const std::vector<Point<3>>& boundary,
                       const std::vector<Point<3>>& normals) {
  constexpr double kLeastCosine = 0.3;
  Point<3> mean_normal{};
  for (const Point<3>& normal : normals) mean_normal = mean_normal + normal;
  origin_ = boundary.front();
  look_from(unit(mean_normal));
  if (least_cosine(normals, [&](std::size_t) { return w_; }) > kLeastCosine && is_simple(boundary))
    return;
  const auto cosine_from = [&](const Point<3>& centre, double outward) {
    return least_cosine(normals,
                        [&](std::size_t k) { return outward * unit(boundary[k] - centre); });
  };
  const bool parallel = graph.spread == 0;
  const Point<3> direction = unit(graph.direction);
  const Point<3> centre = parallel ? Point<3>{} : centre_of(graph);
  const double outward = graph.spread > 0 ? 1 : -1;
  const double least = parallel ? least_cosine(normals, [&](std::size_t) { return direction; })
                                : cosine_from(centre, outward);
  if (least < kLeastCosine) {
    const Point<3> focus = nearest_to_lines(boundary, normals);
    for (const double away : {1.0, -1.0}) {
      if (!(cosine_from(focus, away) > least)) continue;
      look_around(focus, away, boundary);
      if (is_simple(boundary)) return;
    }
  }
  if (parallel) {
    kind_ = Kind::Parallel;
    outward_ = 1;
    origin_ = boundary.front();
    look_from(direction);
  } else {
    look_around(centre, outward, boundary);
  }
}

/// Whether the boundary runs counter-clockwise around the patch and does not cross itself.
bool FieldChart::is_simple(const std::vector<Point<3>>& boundary) const {
  const std::vector<Point<3>> seen = images(boundary);
  return doubled_area(seen) > 0 && !crosses_itself(seen);
}

/// Along rays, stereographically. The one opposite to the middle must not be in the patch: then
/// the boundary's image would run clockwise. The best is as far as can be from the boundary.
void FieldChart::look_around(const Point<3>& centre, double outward,
                             const std::vector<Point<3>>& boundary) {
  kind_ = Kind::Stereographic;
  outward_ = outward;
  origin_ = centre;
  Point<3> mean{};
  std::vector<Point<3>> rays;
  for (const Point<3>& p : boundary) {
    rays.push_back(unit(p - origin_));
    mean = mean + rays.back();
  }
  std::vector<Point<3>> middles = directions();
  middles.push_back(unit(mean));
  double best = -1;
  Point<3> middle = unit(mean);
  for (const Point<3>& candidate : middles) {
    double nearest = 2;
    for (const Point<3>& ray : rays) nearest = std::min(nearest, 1 + dot(ray, candidate));
    if (!(nearest > best)) continue;
    look_from(candidate);
    if (!(doubled_area(images(boundary)) > 0)) continue;
    best = nearest;
    middle = candidate;
  }
  look_from(middle);
}

FieldChart::FieldChart(const GraphCertificate& graph)
    : kind_(Kind::Directions), origin_(centre_of(graph)), outward_(graph.spread > 0 ? 1 : -1) {}

void FieldChart::look_from(const Point<3>& middle) {
  w_ = middle;
  const auto basis = across(w_);
  u_ = outward_ > 0 ? basis[0] : basis[1];
  v_ = outward_ > 0 ? basis[1] : basis[0];
}

std::vector<Point<3>> FieldChart::images(const std::vector<Point<3>>& points) const {
  std::vector<Point<3>> all;
  for (const Point<3>& p : points) all.push_back(coordinates(p));
  return all;
}

Point<3> FieldChart::coordinates(const Point<3>& point) const {
  const Point<3> from = point - origin_;
  if (kind_ == Kind::Parallel) return {dot(from, u_), dot(from, v_), 0};
  const Point<3> ray = unit(from);
  if (kind_ == Kind::Directions) return ray;
  const double scale = 1 / (1 + dot(ray, w_));
  return {scale * dot(ray, u_), scale * dot(ray, v_), 0};
}

bool FieldChart::positive(const Point<3>& a, const Point<3>& b, const Point<3>& c) const {
  // Differences of coordinates have one rounding, products and sums two more each.
  constexpr double kError = 0x1p-49;
  if (kind_ != Kind::Directions) {
    const Point<3> p = b - a, q = c - a;
    const double first = p[0] * q[1], second = p[1] * q[0];
    return first - second > kError * (std::fabs(first) + std::fabs(second));
  }
  const Point<3> normal = cross(b, c);
  const double terms = std::fabs(a[0]) * (std::fabs(b[1] * c[2]) + std::fabs(b[2] * c[1])) +
                       std::fabs(a[1]) * (std::fabs(b[2] * c[0]) + std::fabs(b[0] * c[2])) +
                       std::fabs(a[2]) * (std::fabs(b[0] * c[1]) + std::fabs(b[1] * c[0]));
  return outward_ * dot(a, normal) > kError * terms;
}

FieldChart::Line FieldChart::line(const Point<3>& c) const {
  if (kind_ == Kind::Parallel) return {origin_ + (c[0] * u_ + c[1] * v_), w_};
  if (kind_ == Kind::Directions) return {origin_, outward_ * unit(c)};
  const double r = c[0] * c[0] + c[1] * c[1];
  const Point<3> ray = (2 * c[0]) * u_ + ((2 * c[1]) * v_ + (1 - r) * w_);
  return {origin_, outward_ * unit(ray)};
}

}  // namespace encase
