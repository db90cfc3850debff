// SPDX-License-Identifier: MIT
#include "2d/trace.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "common/filtered_polynomial.hpp"
#include "common/kernel.hpp"
#include "common/segments.hpp"

namespace encase {
namespace {

constexpr int kMaxDepth = 30;
constexpr int kMaxNodes = 200;  ///< subdivisions of a segment for the roots on it
constexpr int kMaxPoints = 20000;

double distance(const Point<2>& p, const Point<2>& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1]);
}

double value(const Line& line, const Point<2>& p) {
  return line.normal[0] * p[0] + line.normal[1] * p[1] + line.offset;
}

Line line_through(const Point<2>& point, const Point<2>& normal) {
  Line line;
  line.normal = normal;
  line.offset = -(normal[0] * point[0] + normal[1] * point[1]);
  return line;
}

/// A convex polygon and its parts on both sides of a line, in doubles.
struct Cut {
  Polyline negative;
  Polyline positive;
  Polyline on_line;  ///< where the boundary meets the line
};

Cut cut(const Polyline& polygon, const Line& line) {
  Cut parts;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point<2>& p = polygon[k];
    const Point<2>& q = polygon[(k + 1) % polygon.size()];
    const double vp = value(line, p), vq = value(line, q);
    if (vp <= 0) parts.negative.push_back(p);
    if (vp >= 0) parts.positive.push_back(p);
    if (vp == 0) parts.on_line.push_back(p);
    if ((vp < 0 && vq > 0) || (vp > 0 && vq < 0)) {
      const double t = vp / (vp - vq);
      const Point<2> r = {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};
      parts.negative.push_back(r);
      parts.positive.push_back(r);
      parts.on_line.push_back(r);
    }
  }
  return parts;
}

/// The range of the line's parameter over points on it.
std::optional<RootInterval> parameter_range(const Line& line, const Polyline& points) {
  const int axis = parameter_axis(line);
  RootInterval range{std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity()};
  for (const Point<2>& p : points) {
    range.lo = std::min(range.lo, p[axis]);
    range.hi = std::max(range.hi, p[axis]);
  }
  if (!(range.lo < range.hi)) return std::nullopt;
  return range;
}

/// Traces branches of one curve.
class Tracer {
 public:
  Tracer(const Encasement& encasement, int curve, double tolerance)
      : encasement_(encasement),
        f_(encasement.curves[curve].polynomial),
        tolerance_(std::max(tolerance, least_tolerance(encasement))) {
    // Enough to see through the noise of doubles; more would be spent on nothing visible.
    kernel_.max_bits = 212;
  }

  Polyline branch(const Cell& cell, const Branch& branch) {
    Polyline polygon;
    for (const Vertex& vertex : cell.vertices) polygon.push_back(vertex.point);
    const Point<2> from = end(branch.from);
    points_ = {from};
    follow(polygon, from, end(branch.to), 0);
    return std::move(points_);
  }

  /// The same point for both cells that share a line crossing.
  Point<2> end(int crossing) {
    const auto [found, is_new] = ends_.try_emplace(crossing);
    if (is_new) {
      const LineCrossing& c = encasement_.line_crossings[crossing];
      found->second = root_point(encasement_.lines[c.line], {c.lo, c.hi});
    }
    return found->second;
  }

 private:
  static double least_tolerance(const Encasement& encasement) {
    const Box<2> box = encasement.region_used.bounding_box();
    double size = 0;
    for (int axis = 0; axis < 2; ++axis)
      size = std::max({size, std::fabs(box.lo[axis]), std::fabs(box.hi[axis])});
    return 0x1p-40 * size;
  }

  Point<2> root_point(const Line& line, RootInterval root) {
    for (int k = 0; k < 100 && root.hi - root.lo > 0x1p-7 * tolerance_; ++k)
      if (!refine_on_line(f_, line, &root, kernel_)) break;
    const double t = root.lo + 0.5 * (root.hi - root.lo);
    const auto point = point_on_line(line, Interval(t));
    return {point[0].mid(), point[1].mid()};
  }

  /// Appends points behind `from` up to `to`, the ends of the one arc in the polygon.
  void follow(const Polyline& polygon, const Point<2>& from, const Point<2>& to, int depth) {
    if (depth < kMaxDepth && points_.size() < kMaxPoints && !near_chord(polygon, from, to))
      for (const Line& line : candidates(from, to))
        if (follow_both_sides(polygon, from, to, line, depth)) return;
    points_.push_back(to);
  }

  /// Lines to cut the arc by, the best first: its chord's bisector, then lines that cross the chord
  /// elsewhere and at other angles.
  static std::vector<Line> candidates(const Point<2>& from, const Point<2>& to) {
    const Point<2> chord = {to[0] - from[0], to[1] - from[1]};
    std::vector<Line> lines;
    for (const double slant : {0.0, 0.6, -0.6, 2.0, -2.0})
      for (const double part : {0.5, 0.35, 0.65, 0.2, 0.8, 0.08, 0.92})
        lines.push_back(line_through({from[0] + part * chord[0], from[1] + part * chord[1]},
                                     {chord[0] - slant * chord[1], chord[1] + slant * chord[0]}));
    return lines;
  }

  bool follow_both_sides(const Polyline& polygon, const Point<2>& from, const Point<2>& to,
                         const Line& line, int depth) {
    const double at_from = value(line, from), at_to = value(line, to);
    if (!((at_from < 0 && at_to > 0) || (at_from > 0 && at_to < 0))) return false;
    const Cut parts = cut(polygon, line);
    const auto range = parameter_range(line, parts.on_line);
    if (!range) return false;
    const auto roots = isolate_on_line(f_, line, range->lo, range->hi, kMaxNodes, kernel_);
    if (!roots || roots->size() != 1) return false;
    const Point<2> middle = root_point(line, roots->front());
    follow(at_from < 0 ? parts.negative : parts.positive, from, middle, depth + 1);
    follow(at_from < 0 ? parts.positive : parts.negative, middle, to, depth + 1);
    return true;
  }

  /// Whether the arc stays within the tolerance of its chord.
  bool near_chord(const Polyline& polygon, const Point<2>& from, const Point<2>& to) {
    const double length = distance(from, to);
    const Point<2> normal = {from[1] - to[1], to[0] - from[0]};
    if (!(length > 0)) return diameter(polygon) <= tolerance_;
    // A quick look first: the sagitta of an arc with these tangents at its ends.
    const double bend = slope(from, normal) + slope(to, normal);
    if (!(0.125 * length * bend <= tolerance_)) return false;
    for (const double offset : {tolerance_, -tolerance_}) {
      Line line = line_through(from, normal);
      line.offset += offset * length;
      const auto range = parameter_range(line, cut(polygon, line).on_line);
      if (range && !no_root_on_line(f_, line, range->lo, range->hi, kernel_)) return false;
    }
    return true;
  }

  /// |tan| of the angle between the curve at a point and the chord with this normal.
  double slope(const Point<2>& point, const Point<2>& normal) const {
    const Point<2> g = f_.gradient(point);
    const double across = g[0] * normal[0] + g[1] * normal[1];
    const double along = g[0] * normal[1] - g[1] * normal[0];
    return std::fabs(along / across);
  }

  static double diameter(const Polyline& polygon) {
    double d = 0;
    for (const Point<2>& p : polygon) d = std::max(d, distance(polygon.front(), p));
    return d;
  }

  const Encasement& encasement_;
  FilteredPolynomial<2> f_;
  double tolerance_;
  Kernel kernel_;
  std::map<int, Point<2>> ends_;
  Polyline points_;
};

/// The square of the distance of a point from a segment.
double square_distance(const Point<2>& p, const Point<2>& from, const Point<2>& to) {
  const Point<2> along = {to[0] - from[0], to[1] - from[1]};
  const double length = along[0] * along[0] + along[1] * along[1];
  const double t = ((p[0] - from[0]) * along[0] + (p[1] - from[1]) * along[1]) / length;
  const double part = length > 0 ? std::clamp(t, 0.0, 1.0) : 0;
  const double dx = from[0] + part * along[0] - p[0], dy = from[1] + part * along[1] - p[1];
  return dx * dx + dy * dy;
}

/// The part of a polyline behind the place nearest to a point, with that point first.
Polyline part_behind(const Polyline& line, const Point<2>& point) {
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const double d = square_distance(point, line[k], line[k + 1]);
    if (d < least) {
      least = d;
      nearest = k;
    }
  }
  Polyline part = {point};
  part.insert(part.end(), line.begin() + static_cast<std::ptrdiff_t>(nearest) + 1, line.end());
  return part;
}

/// Joins polylines whose ends are line crossings.
class Chains {
 public:
  void add(int from, int to, Polyline points) {
    const int id = static_cast<int>(pieces_.size());
    pieces_.push_back({{from, to}, std::move(points), false});
    at_[from].push_back(id);
    at_[to].push_back(id);
  }

  std::vector<Polyline> join() {
    std::vector<Polyline> chains;
    for (int id = 0; id < static_cast<int>(pieces_.size()); ++id) {
      if (pieces_[id].used) continue;
      // Back to the beginning of the chain, or around a loop to where we are; then forwards.
      int first = id, end = 0;
      while (true) {
        const auto before = neighbour(first, end);
        if (!before || before->first == id) break;
        first = before->first;
        end = 1 - before->second;
      }
      chains.push_back(walk(first, end));
    }
    return chains;
  }

 private:
  struct Piece {
    std::array<int, 2> ends;
    Polyline points;
    bool used = false;
  };

  /// The piece that goes on at an end of a piece, with its own end there.
  std::optional<std::pair<int, int>> neighbour(int id, int end) const {
    const int crossing = pieces_[id].ends[end];
    const std::vector<int>& here = at_.at(crossing);
    if (here.size() != 2 || here[0] == here[1]) return std::nullopt;
    const int other = here[0] == id ? here[1] : here[0];
    return std::pair(other, pieces_[other].ends[0] == crossing ? 0 : 1);
  }

  Polyline walk(int id, int start) {
    Polyline chain;
    while (true) {
      Piece& piece = pieces_[id];
      piece.used = true;
      if (start == 1) std::reverse(piece.points.begin(), piece.points.end());
      chain.insert(chain.end(), piece.points.begin() + (chain.empty() ? 0 : 1), piece.points.end());
      const auto next = neighbour(id, 1 - start);
      if (!next || pieces_[next->first].used) return chain;
      id = next->first;
      start = next->second;
    }
  }

  std::vector<Piece> pieces_;
  std::map<int, std::vector<int>> at_;  ///< pieces that end at a line crossing
};

}  // namespace

Polyline trace_branch(const Encasement& encasement, int cell, const Branch& branch,
                      double tolerance) {
  return Tracer(encasement, branch.curve, tolerance).branch(encasement.cells[cell], branch);
}

std::vector<Polyline> trace_curve(const Encasement& encasement, int curve, double tolerance) {
  Tracer tracer(encasement, curve, tolerance);
  Chains chains;
  for (const Cell& cell : encasement.cells)
    for (const Branch& branch : cell.branches)
      if (branch.curve == curve) chains.add(branch.from, branch.to, tracer.branch(cell, branch));
  return chains.join();
}

std::vector<Polyline> trace_edges(const Encasement& encasement, const Arrangement& arrangement,
                                  double tolerance) {
  std::vector<Tracer> tracers;
  for (std::size_t k = 0; k < encasement.curves.size(); ++k)
    tracers.emplace_back(encasement, static_cast<int>(k), tolerance);
  const auto trace_strand = [&](const Arrangement::Strand& strand) {
    const Cell& cell = encasement.cells[strand.cell];
    const Branch& branch = cell.branches[strand.branch];
    Polyline line = tracers[branch.curve].branch(cell, branch);
    // From the crossing or the beginning to the strand's other end, then in its direction.
    const int last = strand.from < 0 ? strand.to : strand.from;
    if (strand.from < 0 || strand.to < 0) {
      if (branch.to != last) std::reverse(line.begin(), line.end());
      line = part_behind(line, encasement.crossings[cell.crossing].point);
      if (strand.to < 0) std::reverse(line.begin(), line.end());
    } else if (branch.to != strand.to) {
      std::reverse(line.begin(), line.end());
    }
    return line;
  };
  const auto point_of = [&](const Arrangement::Vertex& vertex) {
    if (vertex.kind == Arrangement::Vertex::Kind::Crossing)
      return encasement.crossings[vertex.index].point;
    if (vertex.kind == Arrangement::Vertex::Kind::OnBoundary)
      return tracers[encasement.line_crossings[vertex.index].curve].end(vertex.index);
    const RationalPoint<2>& corner = encasement.region_used.corners[vertex.index];
    return Point<2>{corner[0].get_d(), corner[1].get_d()};
  };
  std::vector<Polyline> lines;
  for (std::size_t k = 0; k < arrangement.edges.size(); ++k) {
    Polyline line;
    for (const Arrangement::Strand& strand : arrangement.edges[k].strands) {
      const Polyline part = trace_strand(strand);
      line.insert(line.end(), part.begin() + (line.empty() ? 0 : 1), part.end());
    }
    if (arrangement.edges[k].curve < 0)
      for (const std::size_t h : {2 * k, 2 * k + 1})
        line.push_back(point_of(arrangement.vertices[arrangement.half_edges[h].origin]));
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<Polyline> sketch_curve(const Encasement& encasement, int cell, int curve,
                                   double spacing) {
  constexpr int kMostSteps = 200;
  Polyline polygon;
  for (const Vertex& vertex : encasement.cells[cell].vertices) polygon.push_back(vertex.point);
  if (polygon.empty()) return {};
  Box<2> box{polygon.front(), polygon.front()};
  for (const Point<2>& p : polygon) box = hull(box, {p, p});
  std::array<int, 2> steps;
  for (int axis = 0; axis < 2; ++axis)
    steps[axis] = static_cast<int>(std::clamp(box.width(axis) / spacing, 4.0, 1.0 * kMostSteps));
  const auto at = [&](double i, double j) {
    return Point<2>{box.lo[0] + i / steps[0] * box.width(0),
                    box.lo[1] + j / steps[1] * box.width(1)};
  };
  const auto inside = [&](const Point<2>& p) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point<2>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      if ((b[0] - a[0]) * (p[1] - a[1]) < (b[1] - a[1]) * (p[0] - a[0])) return false;
    }
    return true;
  };
  const FilteredPolynomial<2> f(encasement.curves[curve].polynomial);
  std::vector<double> values;
  for (int j = 0; j <= steps[1]; ++j)
    for (int i = 0; i <= steps[0]; ++i) values.push_back(f.approximate(at(i, j)));
  const auto value = [&](int i, int j) { return values[j * (steps[0] + 1) + i]; };

  // In each triangle of the grid the linear interpolant's zero set is one segment or none.
  std::vector<Polyline> segments;
  const auto add = [&](const std::array<std::array<int, 2>, 3>& corners) {
    Polyline ends;
    for (int k = 0; k < 3; ++k) {
      const auto &p = corners[k], &q = corners[(k + 1) % 3];
      const double vp = value(p[0], p[1]), vq = value(q[0], q[1]);
      if ((vp < 0) == (vq < 0)) continue;
      const double t = vp / (vp - vq);
      ends.push_back(at(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])));
    }
    if (ends.size() == 2 && inside(ends[0]) && inside(ends[1])) segments.push_back(ends);
  };
  for (int j = 0; j < steps[1]; ++j)
    for (int i = 0; i < steps[0]; ++i) {
      add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
      add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  return segments;
}

}  // namespace encase
