// SPDX-License-Identifier: MIT
#include "2d/splitting_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace encase {
namespace {

double dot(const Point<2>& a, const Point<2>& b) { return a[0] * b[0] + a[1] * b[1]; }
Point<2> minus(const Point<2>& a, const Point<2>& b) { return {a[0] - b[0], a[1] - b[1]}; }
Point<2> halfway(const Point<2>& a, const Point<2>& b) {
  return {a[0] + 0.5 * (b[0] - a[0]), a[1] + 0.5 * (b[1] - a[1])};
}
double distance(const Point<2>& a, const Point<2>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}
Point<2> unit(const Point<2>& v) {
  const double length = std::hypot(v[0], v[1]);
  return length > 0 ? Point<2>{v[0] / length, v[1] / length} : Point<2>{0, 0};
}

/// A crossing of a curve with the cell's boundary.
struct BoundaryPoint {
  int curve;
  int index;  ///< among its curve's points, in cyclic order
  Point<2> at;
  Point<2> normal;  ///< unit gradient
};

std::vector<BoundaryPoint> boundary_points(Partition& partition, const OpenCell& cell) {
  std::vector<BoundaryPoint> points;
  std::vector<int> seen(partition.curves().size(), 0);
  for (const int id : partition.word(cell)) {
    const int c = partition.line_crossings[id].curve;
    const Partition::Spot& spot = partition.spot(id);
    points.push_back({c, seen[c]++, spot.at, spot.normal});
  }
  return points;
}

/// Keeps the best cut among the proposals.
class Selection {
 public:
  Selection(Partition& partition, const OpenCell& cell) : partition_(partition), cell_(cell) {}

  void propose(const Line& line) {
    ++proposals;
    const double enough = best ? best->score - 1e-9 : HUGE_VAL;
    if (auto cut = partition_.try_line(cell_, line, enough)) best = std::move(cut);
  }

  std::optional<Cut> best;
  int proposals = 0;

 private:
  Partition& partition_;
  const OpenCell& cell_;
};

/// The line between two points along the mean of the curves' normals there, each turned to point
/// from a to b. Where a chord joins two points of one branch its midpoint's tangent is the chord
/// itself; the mean normal has no such weakness (docs/encasement.md).
Line between(const BoundaryPoint& a, const BoundaryPoint& b) {
  const Point<2> direction = minus(b.at, a.at);
  Point<2> normal{0, 0};
  for (const BoundaryPoint* p : {&a, &b}) {
    const double s = dot(p->normal, direction) < 0 ? -1 : 1;
    normal[0] += s * p->normal[0];
    normal[1] += s * p->normal[1];
  }
  if (std::hypot(normal[0], normal[1]) < 1e-6) normal = direction;
  return line_through(halfway(a.at, b.at), normal);
}

struct Pair {
  int a, b;
  double gap;
};

void keep_closest(std::vector<Pair>& pairs, std::size_t count) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
    return p.gap != q.gap ? p.gap < q.gap : p.a != q.a ? p.a < q.a : p.b < q.b;
  });
  if (pairs.size() > count) pairs.resize(count);
}

void propose_between_crossings(const Partition& partition, const OpenCell& cell,
                               Selection& selection) {
  std::vector<Point<2>> points;
  for (const int id : cell.crossings) points.push_back(partition.crossings[id].point);
  const int n = static_cast<int>(points.size());
  if (n < 2) return;
  // The largest gap in the middle of the projections, in four directions.
  for (const Point<2>& d :
       {Point<2>{1, 0}, Point<2>{0, 1}, Point<2>{0.7071, 0.7072}, Point<2>{0.7072, -0.7071}}) {
    std::vector<double> values;
    for (const auto& p : points) values.push_back(dot(p, d));
    std::sort(values.begin(), values.end());
    const int from = static_cast<int>(0.35 * (n - 1));
    const int to = std::max(from + 1, static_cast<int>(std::ceil(0.65 * (n - 1))));
    int best = from;
    for (int i = from; i < to; ++i)
      if (values[i + 1] - values[i] > values[best + 1] - values[best]) best = i;
    const double at = 0.5 * (values[best] + values[best + 1]);
    selection.propose(line_through({at * d[0], at * d[1]}, d));
  }
  if (n > 12) return;
  std::vector<Pair> pairs;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) pairs.push_back({i, j, distance(points[i], points[j])});
  keep_closest(pairs, 3);
  for (const Pair& p : pairs)
    selection.propose(
        line_through(halfway(points[p.a], points[p.b]), minus(points[p.b], points[p.a])));
}

/// A line through a saddle of the curve's polynomial near a point: two branches that nearly meet
/// pass on both sides of one, and along the direction in which f moves away from zero there, no
/// branch is near.
void propose_through_saddle(const Partition& partition, const OpenCell& cell, int curve,
                            Point<2> at, Selection& selection) {
  Box<2> bounds{middle(cell.vertices[0]), middle(cell.vertices[0])};
  for (const auto& v : cell.vertices) bounds = hull(bounds, Box<2>{middle(v), middle(v)});
  const auto& [fx, fy] = partition.partials(curve);
  const double size = bounds.largest_width();
  // The scales of the two derivatives differ by a power of two each; Newton does not mind.
  for (int i = 0; i < 8; ++i) {
    const Point<2> gx = fx.gradient(at), gy = fy.gradient(at);
    const double vx = fx.approximate(at), vy = fy.approximate(at);
    const double det = gx[0] * gy[1] - gx[1] * gy[0];
    if (!(std::fabs(det) > 0)) return;
    const Point<2> step{(vx * gy[1] - vy * gx[1]) / det, (vy * gx[0] - vx * gy[0]) / det};
    at = minus(at, step);
    if (!bounds.contains(at)) return;
    if (std::hypot(step[0], step[1]) < 1e-9 * size) break;
  }
  const double scale_x = fx.scale(), scale_y = fy.scale();
  const double a = fx.gradient(at)[0] * scale_x, b = fx.gradient(at)[1] * scale_x,
               c = fy.gradient(at)[1] * scale_y;
  if (a * c - b * b >= 0) return;
  // The eigenvector whose eigenvalue has the sign of f is the line's direction; the other its
  // normal.
  const double sign = partition.curves()[curve].approximate(at) > 0 ? 1 : -1;
  const double mean = 0.5 * (a + c), spread = std::hypot(0.5 * (a - c), b);
  const double other = mean - sign * spread;
  const Point<2> first{b, other - a}, second{other - c, b};
  selection.propose(line_through(
      at, std::hypot(first[0], first[1]) > std::hypot(second[0], second[1]) ? first : second));
}

void propose_between_branches(const Partition& partition, const OpenCell& cell,
                              const std::vector<BoundaryPoint>& points, int curve_count,
                              Selection& selection) {
  for (int c = 0; c < curve_count; ++c) {
    std::vector<Pair> pairs;
    for (int i = 0; i < static_cast<int>(points.size()); ++i)
      for (int j = i + 1; j < static_cast<int>(points.size()); ++j) {
        // In the cyclic order of a curve's simple crossings, two of the same parity are never the
        // ends of one branch: between them would lie an odd number of others (thesis 3.2).
        if (points[i].curve != c || points[j].curve != c) continue;
        if ((points[j].index - points[i].index) % 2 != 0) continue;
        pairs.push_back({i, j, distance(points[i].at, points[j].at)});
      }
    keep_closest(pairs, 4);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const BoundaryPoint &a = points[pairs[k].a], &b = points[pairs[k].b];
      selection.propose(between(a, b));
      if (k < 2) propose_through_saddle(partition, cell, c, halfway(a.at, b.at), selection);
    }
    // Where a line has cut off the tip of a bend, the branches that leave the tip on both sides are
    // neighbours of different parity, and told apart by the bisector of their ends.
    std::vector<int> own;
    for (int i = 0; i < static_cast<int>(points.size()); ++i)
      if (points[i].curve == c) own.push_back(i);
    if (own.size() < 4) continue;
    pairs.clear();
    for (std::size_t i = 0; i < own.size(); ++i) {
      const int a = own[i], b = own[(i + 1) % own.size()];
      pairs.push_back({a, b, distance(points[a].at, points[b].at)});
    }
    keep_closest(pairs, 1);
    const BoundaryPoint &a = points[pairs[0].a], &b = points[pairs[0].b];
    selection.propose(line_through(halfway(a.at, b.at), minus(b.at, a.at)));
  }
}

void propose_between_curves(const std::vector<BoundaryPoint>& points, Selection& selection) {
  std::vector<Pair> pairs;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    if (points[i].curve != points[j].curve)
      pairs.push_back({i, j, distance(points[i].at, points[j].at)});
  }
  keep_closest(pairs, 4);
  for (const Pair& p : pairs) selection.propose(between(points[p.a], points[p.b]));
}

/// Moves two points along their curves towards each other (thesis 6.1): tangential steps that
/// minimise the distance to first order, then back onto the curve.
bool approach(const Partition& partition, const OpenCell& cell, BoundaryPoint* a,
              BoundaryPoint* b) {
  Box<2> bounds{middle(cell.vertices[0]), middle(cell.vertices[0])};
  for (const auto& v : cell.vertices) bounds = hull(bounds, Box<2>{middle(v), middle(v)});
  const double reach = 0.25 * (bounds.width(0) + bounds.width(1));
  const auto advance = [&](BoundaryPoint* p, double step) {
    step = std::clamp(step, -reach, reach);
    const auto& f = partition.curves()[p->curve];
    p->at[0] += -p->normal[1] * step;
    p->at[1] += p->normal[0] * step;
    for (int i = 0; i < 2; ++i) {
      const Point<2> g = f.gradient(p->at);
      const double square = dot(g, g);
      if (!(square > 0)) return false;
      const double v = f.approximate(p->at) / square;
      p->at[0] -= std::clamp(v * g[0], -reach, reach);
      p->at[1] -= std::clamp(v * g[1], -reach, reach);
    }
    for (int i = 0; i < 2; ++i) p->at[i] = std::clamp(p->at[i], bounds.lo[i], bounds.hi[i]);
    p->normal = unit(f.gradient(p->at));
    return std::isfinite(p->normal[0]) && std::isfinite(p->normal[1]);
  };
  for (int i = 0; i < 12; ++i) {
    const Point<2> d = minus(b->at, a->at);
    const Point<2> s{-a->normal[1], a->normal[0]}, t{-b->normal[1], b->normal[0]};
    // Minimise |d + v t - u s|^2.
    const double c = dot(s, t), p = dot(d, s), q = dot(d, t), det = 1 - c * c;
    double u, v;
    if (det > 1e-4) {
      u = (p - c * q) / det;
      v = (c * p - q) / det;
    } else {
      u = 0.5 * p;
      v = -0.5 * q;
    }
    if (!advance(a, u) || !advance(b, v)) return false;
    if (std::fabs(u) + std::fabs(v) < 1e-9 * reach) break;
  }
  return true;
}

void propose_closest_approach(const Partition& partition, const OpenCell& cell,
                              const std::vector<BoundaryPoint>& points, Selection& selection) {
  std::vector<Pair> pairs;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const bool apart =
          points[i].curve != points[j].curve ? true : (points[j].index - points[i].index) % 2 == 0;
      if (apart) pairs.push_back({i, j, distance(points[i].at, points[j].at)});
    }
  keep_closest(pairs, 3);
  for (const Pair& pair : pairs) {
    BoundaryPoint a = points[pair.a], b = points[pair.b];
    if (approach(partition, cell, &a, &b)) selection.propose(between(a, b));
  }
}

/// The longest chord between two crossings of one curve; a < 0 if there is none.
Pair longest_chord(const std::vector<BoundaryPoint>& points) {
  Pair longest{-1, -1, -1};
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(points.size()); ++j)
      if (points[i].curve == points[j].curve) {
        const double d = distance(points[i].at, points[j].at);
        if (d > longest.gap) longest = {i, j, d};
      }
  return longest;
}

/// The longest chord, bisected at right angles.
void propose_bisector(const std::vector<BoundaryPoint>& points, Selection& selection) {
  const Pair longest = longest_chord(points);
  if (longest.a < 0) return;
  const Point<2> a = points[longest.a].at, b = points[longest.b].at;
  for (const double w : {0.5, 0.43, 0.57}) {
    selection.propose(
        line_through({a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1])}, minus(b, a)));
    if (selection.best) return;
  }
}

/// Lines that hug a branch (thesis 3.5): past the point where the bisector of its longest chord
/// meets the curve, along the curve; and past the chord on the other side, along the chord.
void propose_refinement(const Partition& partition, const std::vector<BoundaryPoint>& points,
                        Selection& selection) {
  const Pair longest = longest_chord(points);
  if (longest.a < 0) return;
  const Point<2> a = points[longest.a].at, b = points[longest.b].at, middle_point = halfway(a, b);
  const Point<2> along = unit(minus(b, a)), across{-along[1], along[0]};
  const auto& f = partition.curves()[points[longest.a].curve];
  // Newton's iteration along the bisector.
  double t = 0;
  for (int i = 0; i < 8; ++i) {
    const Point<2> at{middle_point[0] + t * across[0], middle_point[1] + t * across[1]};
    const double slope = dot(f.gradient(at), across);
    if (!(std::fabs(slope) > 0)) return;
    t -= f.approximate(at) / slope;
    if (!(std::fabs(t) < longest.gap)) return;
  }
  const double side = t < 0 ? -1 : 1, margin = 0.1 * std::fabs(t) + 0.01 * longest.gap;
  const double beyond = t + side * margin, behind = -side * margin;
  const Point<2> p{middle_point[0] + beyond * across[0], middle_point[1] + beyond * across[1]};
  selection.propose(line_through(p, f.gradient(p)));
  selection.propose(line_through(
      {middle_point[0] + behind * across[0], middle_point[1] + behind * across[1]}, across));
}

}  // namespace

Line line_through(const Point<2>& point, const Point<2>& normal) {
  Line line;
  line.normal = unit(normal);
  line.offset = -dot(line.normal, point);
  return line;
}

std::optional<Cut> best_cut(Partition& partition, const OpenCell& cell) {
  const std::vector<BoundaryPoint> points = boundary_points(partition, cell);
  const std::vector<int> counts = partition.crossing_counts(cell);
  const double estimate = partition.estimate(counts, cell.crossings);
  // Levels without progress: halve the longest branch, then give separation another chance.
  const bool pair_only = cell.crossings.empty() && points.size() == 4 &&
                         std::count(counts.begin(), counts.end(), 2) == 2;
  const int patience = pair_only ? 2 : 4;
  if (cell.stall > 0 && cell.stall % (patience + 1) == patience) {
    Selection selection(partition, cell);
    // Subdivide; every third time, refine.
    if (cell.stall / (patience + 1) % 3 == 2) propose_refinement(partition, points, selection);
    if (!selection.best) propose_bisector(points, selection);
    if (selection.best) return selection.best;
  }
  Selection selection(partition, cell);
  propose_between_crossings(partition, cell, selection);
  propose_between_branches(partition, cell, points, static_cast<int>(counts.size()), selection);
  propose_between_curves(points, selection);
  if (!selection.best || selection.best->score > estimate + 0.1)
    propose_closest_approach(partition, cell, points, selection);
  if (!selection.best) propose_bisector(points, selection);
  return selection.best;
}

std::optional<Cut> best_cut_through(Partition& partition, const OpenCell& cell,
                                    const Point<2>& point) {
  Selection selection(partition, cell);
  for (int i = 0; i < 6; ++i) {
    const double angle = std::numbers::pi * (i / 6.0 + 0.013);
    selection.propose(line_through(point, {std::cos(angle), std::sin(angle)}));
  }
  return selection.best;
}

std::optional<Cut> best_cut_along(Partition& partition, const OpenCell& cell, const Box<2>& box) {
  Selection selection(partition, cell);
  for (int axis = 0; axis < 2; ++axis) {
    Point<2> normal{0, 0};
    normal[axis] = 1;
    const double shift = 0.011 * box.width(axis);
    for (const double at :
         {box.lo[axis], box.hi[axis], box.lo[axis] - shift, box.hi[axis] + shift}) {
      Point<2> point{0, 0};
      point[axis] = at;
      selection.propose(line_through(point, normal));
    }
  }
  return selection.best;
}

std::optional<Cut> any_cut(Partition& partition, const OpenCell& cell) {
  Point<2> center{0, 0};
  for (const auto& v : cell.vertices)
    for (int i = 0; i < 2; ++i)
      center[i] += middle(v)[i] / static_cast<double>(cell.vertices.size());
  for (int i = 0; i < 40; ++i) {
    // Directions by the golden angle, points on spokes from the centre to the vertices.
    const double angle = 2.399963 * (i + 1);
    const auto corner = middle(cell.vertices[i % cell.vertices.size()]);
    const double w = 0.08 * (i % 7);
    const Point<2> at{center[0] + w * (corner[0] - center[0]),
                      center[1] + w * (corner[1] - center[1])};
    if (auto cut = partition.try_line(cell, line_through(at, {std::cos(angle), std::sin(angle)}),
                                      HUGE_VAL))
      return cut;
  }
  return std::nullopt;
}

}  // namespace encase
