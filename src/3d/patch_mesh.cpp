// SPDX-License-Identifier: MIT
#include "3d/patch_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "2d/ear_cutting.hpp"
#include "3d/space_vectors.hpp"

namespace encase {

namespace {

/// The cotangent of the angle at c between a and b.
double cotangent(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  const Point<3> p = a - c, q = b - c;
  return dot(p, q) / length(cross(p, q));
}

/// Whether one corner lies nearly on the edge between the others.
bool is_flat(const Point<3>& a, const Point<3>& b, const Point<3>& c) {
  constexpr double kFlat = 0.001;
  const double p = length(b - a), q = length(c - a), r = length(c - b);
  return length(cross(b - a, c - a)) < kFlat * std::min({p * q, q * r, r * p});
}

}  // namespace

int PatchMesh::add(int id) {
  ids_.push_back(id);
  coordinates_.push_back(chart_.coordinates(points_[id]));
  corners_.push_back(corner_maker_.corner(points_[id], lines_.sides(id)));
  return static_cast<int>(ids_.size()) - 1;
}

Box<3> PatchMesh::box() const {
  Box<3> box{corners_.front().at, corners_.front().at};
  for (const Corner& corner : corners_) box = hull(box, {corner.at, corner.at});
  return box;
}

void PatchMesh::join_neighbours() {
  std::map<std::pair<int, int>, int> side;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (int i = 0; i < 3; ++i)
      side[{triangles_[t].corners[i], triangles_[t].corners[(i + 1) % 3]}] = static_cast<int>(t);
  for (Triangle& t : triangles_)
    for (int i = 0; i < 3; ++i) {
      const auto other = side.find({t.corners[(i + 1) % 3], t.corners[i]});
      t.neighbours[i] = other == side.end() ? -1 : other->second;
    }
}

bool PatchMesh::fill(const std::vector<int>& boundary) {
  std::vector<Point<2>> plane;
  std::vector<int> polygon;
  for (const int id : boundary) {
    polygon.push_back(add(id));
    plane.push_back({coordinates_.back()[0], coordinates_.back()[1]});
  }
  if (polygon.size() < 3) return false;
  for (std::size_t k = 0; k < boundary.size(); ++k)
    boundary_.emplace_back(boundary[k], boundary[(k + 1) % boundary.size()]);
  for (const auto& corners : cut_ears(plane, polygon))
    triangles_.push_back({corners, {-1, -1, -1}, {}});
  join_neighbours();
  std::vector<int> all, changed;
  for (std::size_t t = 0; t < triangles_.size(); ++t) all.push_back(static_cast<int>(t));
  make_delaunay(all, &changed);
  return true;
}

bool PatchMesh::surround(const Box<3>& cell) {
  const double reach = length(cell.hi - cell.lo);
  std::array<int, 6> corner;
  for (int k = 0; k < 6; ++k) {
    Point<3> ray{};
    ray[k / 2] = k % 2 ? -1 : 1;
    const FieldChart::Line line = chart_.line(ray);
    // Halves the part of the ray on which f changes its sign.
    const double outward = dot(line.along, ray) > 0 ? 1 : -1;
    double inside = 0, outside = reach;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (inside + outside);
      const double f = surface_.function().approximate(line.at + middle * ray);
      (outward * f < 0 ? inside : outside) = middle;
    }
    Point<3> point;
    if (!lift(line, outward * 0.5 * (inside + outside), &point)) return false;
    points_.push_back(point);
    corner[k] = add(static_cast<int>(points_.size()) - 1);
  }
  for (int octant = 0; octant < 8; ++octant) {
    std::array<int, 3> corners = {corner[octant & 1], corner[2 + (octant >> 1 & 1)],
                                  corner[4 + (octant >> 2 & 1)]};
    if (!positive(corners[0], corners[1], corners[2])) std::swap(corners[0], corners[1]);
    triangles_.push_back({corners, {-1, -1, -1}, {}});
  }
  join_neighbours();
  return true;
}

/// The point of the surface on a line, near the guess. It is in the certificate's box, so it is the
/// surface's only point on its line of the certificate's field there.
bool PatchMesh::lift(const FieldChart::Line& line, double guess, Point<3>* point) const {
  double t = guess;
  for (int step = 0; step < 12; ++step) {
    const auto f = surface_.function().value_and_gradient(line.at + t * line.along);
    const double slope = dot(f.gradient, line.along);
    if (!(slope > 0)) return false;
    const double move = f.value / slope;
    t -= move;
    if (!std::isfinite(t)) return false;
    // The next move is about the square of this one.
    if (std::fabs(move) < 0x1p-8 * goal_.least_length) break;
  }
  *point = line.at + t * line.along;
  if (!graph_.box.contains(*point)) return false;
  // f is negative before and positive behind a root, proved; nearer ones than this are not told
  // apart from where rounding takes the point.
  for (double by = 0x1p-10 * goal_.least_length; by <= 0x1p10 * goal_.least_length; by *= 32) {
    const Interval before = surface_.value(*point - by * line.along, Kernel::kDoubleBits);
    const Interval behind = surface_.value(*point + by * line.along, Kernel::kDoubleBits);
    if (before.hi < 0 && behind.lo > 0) return true;
  }
  return false;
}

/// Whether a new point would make flat triangles with an edge of the boundary, which is too long
/// then (Ruppert's criterion).
bool PatchMesh::crowds_boundary(const Point<3>& point) {
  bool crowds = false;
  for (const auto& edge : boundary_) {
    if (!(dot(points_[edge.first] - point, points_[edge.second] - point) < 0)) continue;
    too_long_.push_back(edge);
    crowds = true;
  }
  return crowds;
}

int PatchMesh::edge_towards(int triangle, int neighbour) const {
  const auto& n = triangles_[triangle].neighbours;
  return static_cast<int>(std::find(n.begin(), n.end(), neighbour) - n.begin());
}

void PatchMesh::replace_neighbour(int triangle, int before, int after) {
  if (triangle < 0) return;
  for (int& n : triangles_[triangle].neighbours)
    if (n == before) {
      n = after;
      return;
    }
}

/// The triangles a b c and b a d on both sides of an edge become a m c, m b c, b m d and m a d.
bool PatchMesh::split(int t, int edge, std::vector<int>* changed) {
  const int u = triangles_[t].neighbours[edge];
  // (Two triangles that share two edges would be two sides of one.)
  if (std::count(triangles_[t].neighbours.begin(), triangles_[t].neighbours.end(), u) != 1)
    return false;
  const int other = edge_towards(u, t);
  const int a = triangles_[t].corners[edge], b = triangles_[t].corners[(edge + 1) % 3],
            c = triangles_[t].corners[(edge + 2) % 3], d = triangles_[u].corners[(other + 2) % 3];
  const FieldChart::Line line = chart_.line(0.5 * (coordinates_[a] + coordinates_[b]));
  const Point<3> middle = 0.5 * (at(a) + at(b));
  Point<3> point;
  if (!lift(line, dot(middle - line.at, line.along), &point)) {
    blame_boundary(t);  // between its points the surface may leave the cell
    return false;
  }
  if (crowds_boundary(point)) return false;
  points_.push_back(point);
  const int m = add(static_cast<int>(points_.size()) - 1);
  if (!(positive(a, m, c) && positive(m, b, c) && positive(b, m, d) && positive(m, a, d))) {
    points_.pop_back();
    ids_.pop_back();
    coordinates_.pop_back();
    corners_.pop_back();
    return false;
  }
  const int beyond_bc = triangles_[t].neighbours[(edge + 1) % 3];
  const int beyond_ca = triangles_[t].neighbours[(edge + 2) % 3];
  const int beyond_ad = triangles_[u].neighbours[(other + 1) % 3];
  const int beyond_db = triangles_[u].neighbours[(other + 2) % 3];
  const int t2 = static_cast<int>(triangles_.size()), u2 = t2 + 1;
  triangles_[t] = {{a, m, c}, {u2, t2, beyond_ca}, {}};
  triangles_[u] = {{b, m, d}, {t2, u2, beyond_db}, {}};
  triangles_.push_back({{m, b, c}, {u, beyond_bc, t}, {}});
  triangles_.push_back({{m, a, d}, {t, beyond_ad, u}, {}});
  replace_neighbour(beyond_bc, t, t2);
  replace_neighbour(beyond_ad, u, u2);
  changed->insert(changed->end(), {t, u, t2, u2});
  make_delaunay({t, u, t2, u2}, changed);
  return true;
}

bool PatchMesh::wants_flip(int t, int edge) const {
  const int u = triangles_[t].neighbours[edge];
  if (u < 0 || std::count(triangles_[t].neighbours.begin(), triangles_[t].neighbours.end(), u) != 1)
    return false;
  const int a = triangles_[t].corners[edge], b = triangles_[t].corners[(edge + 1) % 3],
            c = triangles_[t].corners[(edge + 2) % 3];
  const int d = triangles_[u].corners[(edge_towards(u, t) + 2) % 3];
  if (!positive(a, d, c) || !positive(d, b, c)) return false;
  if (!positive(a, b, c) || !positive(b, a, d)) return true;
  return cotangent(coordinates_[a], coordinates_[b], coordinates_[c]) +
             cotangent(coordinates_[a], coordinates_[b], coordinates_[d]) <
         -0x1p-20;
}

/// The triangles a b c and b a d become a d c and d b c.
void PatchMesh::flip(int t, int edge) {
  const int u = triangles_[t].neighbours[edge], other = edge_towards(u, t);
  const int a = triangles_[t].corners[edge], b = triangles_[t].corners[(edge + 1) % 3],
            c = triangles_[t].corners[(edge + 2) % 3], d = triangles_[u].corners[(other + 2) % 3];
  const int beyond_bc = triangles_[t].neighbours[(edge + 1) % 3];
  const int beyond_ca = triangles_[t].neighbours[(edge + 2) % 3];
  const int beyond_ad = triangles_[u].neighbours[(other + 1) % 3];
  const int beyond_db = triangles_[u].neighbours[(other + 2) % 3];
  triangles_[t] = {{a, d, c}, {beyond_ad, u, beyond_ca}, {}};
  triangles_[u] = {{d, b, c}, {beyond_db, beyond_bc, t}, {}};
  replace_neighbour(beyond_ad, u, t);
  replace_neighbour(beyond_bc, t, u);
}

/// Flips edges whose opposite angles in space add up to more than pi: then those of the other
/// diagonal do not, as no four angles of a quadrangle in space add up to more than 2 pi. For
/// certain only a bounded number of times.
void PatchMesh::make_delaunay(std::vector<int> work, std::vector<int>* changed) {
  std::size_t left = 4096 + 64 * work.size();
  while (!work.empty() && left > 0) {
    const int t = work.back();
    work.pop_back();
    for (int edge = 0; edge < 3; ++edge) {
      if (!wants_flip(t, edge)) continue;
      const int u = triangles_[t].neighbours[edge];
      flip(t, edge);
      changed->insert(changed->end(), {t, u});
      work.insert(work.end(), {t, u});
      --left;
      break;
    }
  }
}

/// An edge within that lies in a side of the region; -1: none.
int PatchMesh::chord_of(const Triangle& t) const {
  for (int i = 0; i < 3; ++i)
    if (t.neighbours[i] >= 0 &&
        common_side(corners_[t.corners[i]].sides, corners_[t.corners[(i + 1) % 3]].sides) >= 0)
      return i;
  return -1;
}

/// At the middle of the longest edge, unless that is one of the boundary; of a chord, if it has
/// one.
void PatchMesh::divide(int t, std::vector<int>* changed) {
  const std::array<int, 3>& corners = triangles_[t].corners;
  int longest = 0;
  double most = 0;
  for (int i = 0; i < 3; ++i) {
    const double l = length(at(corners[(i + 1) % 3]) - at(corners[i]));
    if (l > most) {
      most = l;
      longest = i;
    }
  }
  triangles_[t].given_up = true;
  if (most < goal_.least_length) return;
  if (const int chord = chord_of(triangles_[t]); chord >= 0) {
    split(t, chord, changed);
    return;
  }
  // Flat triangles beget flat ones: what is around them must be divided, or the boundary.
  const auto [a, b, c] = corners;
  const bool flat = is_flat(at(a), at(b), at(c));
  const bool flat_in_chart = is_flat(coordinates_[a], coordinates_[b], coordinates_[c]);
  if (triangles_[t].neighbours[longest] < 0 || flat_in_chart)
    blame_boundary(t);
  else if (!flat)
    split(t, longest, changed);
}

/// A triangle's edges on the boundary are too long.
void PatchMesh::blame_boundary(int t) {
  const Triangle& triangle = triangles_[t];
  for (int i = 0; i < 3; ++i)
    if (triangle.neighbours[i] < 0)
      too_long_.emplace_back(ids_[triangle.corners[i]], ids_[triangle.corners[(i + 1) % 3]]);
}

/// The triangle a b c on an edge a b of the boundary becomes a m c and m b c.
bool PatchMesh::divide_boundary(const std::map<std::pair<int, int>, int>& middles) {
  std::vector<int> changed;
  for (int t = 0; t < static_cast<int>(triangles_.size()); ++t)
    for (int edge = 0; edge < 3;) {
      const int a = triangles_[t].corners[edge], b = triangles_[t].corners[(edge + 1) % 3],
                c = triangles_[t].corners[(edge + 2) % 3];
      const auto middle = triangles_[t].neighbours[edge] < 0
                              ? middles.find(std::minmax(ids_[a], ids_[b]))
                              : middles.end();
      if (middle == middles.end()) {
        ++edge;
        continue;
      }
      const int m = add(middle->second);
      if (!positive(a, m, c) || !positive(m, b, c)) return false;
      const int beyond_bc = triangles_[t].neighbours[(edge + 1) % 3];
      const int beyond_ca = triangles_[t].neighbours[(edge + 2) % 3];
      const int t2 = static_cast<int>(triangles_.size());
      triangles_[t] = {{a, m, c}, {-1, t2, beyond_ca}, {}};
      triangles_.push_back({{m, b, c}, {-1, beyond_bc, t}, {}});
      replace_neighbour(beyond_bc, t, t2);
      changed.insert(changed.end(), {t, t2});
      edge = 0;
    }
  std::vector<std::pair<int, int>> boundary;
  for (const auto& [a, b] : boundary_) {
    const auto middle = middles.find(std::minmax(a, b));
    if (middle == middles.end()) {
      boundary.emplace_back(a, b);
    } else {
      boundary.emplace_back(a, middle->second);
      boundary.emplace_back(middle->second, b);
    }
  }
  boundary_.swap(boundary);
  std::vector<int> flipped;
  make_delaunay(std::move(changed), &flipped);
  return true;
}

void PatchMesh::refine(int most) {
  too_long_.clear();
  std::vector<int> work;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    triangles_[t].given_up = false;
    work.push_back(static_cast<int>(t));
  }
  const auto good = [&](const Triangle& t) {
    return t.bounds.distance <= goal_.tolerance && t.bounds.angle <= goal_.angle &&
           t.bounds.way <= goal_.tolerance && chord_of(t) < 0 && !t.too_large;
  };
  for (std::size_t next = 0; next < work.size(); ++next) {
    Triangle& t = triangles_[work[next]];
    if (t.given_up || good(t)) continue;
    const auto& [a, b, c] = t.corners;
    t.bounds = bound_triangle(models_, {corners_[a], corners_[b], corners_[c]}, goal_.tolerance,
                              corner_maker_.moved());
    if (good(t)) continue;
    if (static_cast<int>(triangles_.size()) >= most) break;
    std::vector<int> changed;
    divide(work[next], &changed);
    work.insert(work.end(), changed.begin(), changed.end());
  }
  std::sort(too_long_.begin(), too_long_.end());
  too_long_.erase(std::unique(too_long_.begin(), too_long_.end()), too_long_.end());
}

}  // namespace encase
