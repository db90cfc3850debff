// SPDX-License-Identifier: MIT
#include "2d/polyline_topology.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encase {
namespace {

Sign exact_orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const Rational x(r[0]), y(r[1]);
  const Rational left = (Rational(p[0]) - x) * (Rational(q[1]) - y),
                 right = (Rational(p[1]) - y) * (Rational(q[0]) - x);
  return sign_of(cmp(left, right));
}

/// A segment of a polyline with its ends as vertices: of the arrangement, or of an edge alone.
struct Segment {
  EdgePiece of;
  Point<2> p, q;
  int from, to;  ///< the vertices' numbers
  bool is_new;

  Box<2> box() const {
    return {{std::min(p[0], q[0]), std::min(p[1], q[1])},
            {std::max(p[0], q[0]), std::max(p[1], q[1])}};
  }
};

/// Whether two closed segments have a common point.
bool meet(const Segment& a, const Segment& b) {
  const auto opposite = [](Sign s, Sign t) {
    return static_cast<int>(s) * static_cast<int>(t) <= 0;
  };
  return a.box().meets(b.box()) &&
         opposite(orientation(a.p, a.q, b.p), orientation(a.p, a.q, b.q)) &&
         opposite(orientation(b.p, b.q, a.p), orientation(b.p, b.q, a.q));
}

/// Whether two other points are seen from p in the same direction.
bool same_direction(const Point<2>& p, const Point<2>& a, const Point<2>& b) {
  if (orientation(p, a, b) != Sign::Zero) return false;
  const int axis = a[0] != p[0] ? 0 : 1;
  return (a[axis] > p[axis]) == (b[axis] > p[axis]);
}

/// Whether two segments have a point in common that they should not.
bool in_conflict(const Segment& a, const Segment& b) {
  const bool from = a.from == b.from || a.from == b.to, to = a.to == b.from || a.to == b.to;
  if (from && to) return true;
  if (!from && !to) return meet(a, b);
  const Point<2>&common = from ? a.p : a.q, &of_a = from ? a.q : a.p;
  const bool begins = b.from == (from ? a.from : a.to);
  return same_direction(common, of_a, begins ? b.q : b.p);
}

/// All pairs that may be in conflict, by halving the plane.
class PairSearch {
 public:
  explicit PairSearch(const std::vector<Segment>& segments) : segments_(segments) {}

  std::vector<PieceConflict> run() {
    std::vector<int> all(segments_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    search(all, 0);
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  void search(const std::vector<int>& here, int depth) {
    constexpr std::size_t kFew = 16;
    constexpr int kDeepest = 60;
    if (here.size() <= kFew || depth == kDeepest) return compare_all(here);
    Box<2> box = segments_[here.front()].box();
    for (const int k : here) box = hull(box, segments_[k].box());
    const int axis = box.width(0) >= box.width(1) ? 0 : 1;
    std::vector<double> centers;
    for (const int k : here) centers.push_back(segments_[k].box().center()[axis]);
    const auto middle = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
    std::nth_element(centers.begin(), middle, centers.end());
    std::vector<int> low, high;
    for (const int k : here) {
      const Box<2> of = segments_[k].box();
      if (of.lo[axis] <= *middle) low.push_back(k);
      if (of.hi[axis] >= *middle) high.push_back(k);
    }
    // Where most of them cross the middle, nothing is gained.
    if (10 * (low.size() + high.size()) > 17 * here.size()) return compare_all(here);
    search(low, depth + 1);
    search(high, depth + 1);
  }

  void compare_all(const std::vector<int>& here) {
    for (std::size_t i = 0; i < here.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Segment &a = segments_[here[i]], &b = segments_[here[j]];
        if ((a.is_new || b.is_new) && a.box().meets(b.box()) && in_conflict(a, b))
          found_.push_back({std::min(a.of, b.of), std::max(a.of, b.of)});
      }
  }

  const std::vector<Segment>& segments_;
  std::vector<PieceConflict> found_;
};

/// Where a half-edge's polyline goes first, and the segment of that.
struct Departure {
  Point<2> to;
  EdgePiece piece;
};
Departure departure(const EdgePolylines& lines, int half_edge) {
  const int edge = Arrangement::edge_of(half_edge);
  const auto& line = lines[edge];
  const int last = static_cast<int>(line.size()) - 2;
  if (half_edge % 2 == 0) return {line[1], {edge, 0}};
  return {line[last], {edge, last}};
}

/// Whether a point that is not on a closed polyline is inside: a ray to the right leaves it an odd
/// number of times.
bool is_inside(const Point<2>& point, const std::vector<Point<2>>& cycle) {
  bool inside = false;
  for (std::size_t k = 1; k < cycle.size(); ++k) {
    const Point<2>&p = cycle[k - 1], &q = cycle[k];
    if ((p[1] > point[1]) == (q[1] > point[1])) continue;
    const bool left = orientation(p, q, point) == Sign::Positive;
    if (left == (q[1] > p[1])) inside = !inside;
  }
  return inside;
}

/// Whether the area to the left of a closed polyline is bounded: the sign of its area.
bool is_counter_clockwise(const std::vector<Point<2>>& cycle) {
  double area = 0, size = 0;
  const Point<2>& o = cycle.front();
  for (std::size_t k = 1; k < cycle.size(); ++k) {
    const double p = (cycle[k - 1][0] - o[0]) * (cycle[k][1] - o[1]),
                 q = (cycle[k - 1][1] - o[1]) * (cycle[k][0] - o[0]);
    area += p - q;
    size += std::fabs(p) + std::fabs(q);
  }
  // Four roundings of each product, one of each difference, and a sum of so many.
  const double error = size * 0x1p-52 * (static_cast<double>(cycle.size()) + 8) + 0x1p-900;
  if (std::fabs(area) > error) return area > 0;
  Rational exact = 0;
  for (std::size_t k = 1; k < cycle.size(); ++k)
    exact += Rational(cycle[k - 1][0]) * Rational(cycle[k][1]) -
             Rational(cycle[k - 1][1]) * Rational(cycle[k][0]);
  return sgn(exact) > 0;
}

}  // namespace

Sign orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const double left = (p[0] - r[0]) * (q[1] - r[1]), right = (p[1] - r[1]) * (q[0] - r[0]);
  const double value = left - right;
  // Three roundings of either product, one of the difference.
  const double error = 0x1p-51 * (std::fabs(left) + std::fabs(right)) + 0x1p-1000;
  if (value > error) return Sign::Positive;
  if (value < -error) return Sign::Negative;
  return exact_orientation(p, q, r);
}

std::vector<PieceConflict> meeting_pieces(const Arrangement& arrangement,
                                          const EdgePolylines& lines,
                                          const std::vector<std::vector<char>>& is_new) {
  std::vector<Segment> segments;
  std::vector<PieceConflict> conflicts;
  int vertices = static_cast<int>(arrangement.vertices.size());
  for (std::size_t e = 0; e < lines.size(); ++e) {
    const auto& line = lines[e];
    const int count = static_cast<int>(line.size()) - 1;
    if (count < 1) continue;
    // Inner vertices are numbered on from those of the arrangement; the end of a loop without
    // vertices is its beginning.
    const int origin = arrangement.half_edges[2 * e].origin,
              end = arrangement.half_edges[2 * e + 1].origin, first = vertices;
    vertices += count;
    for (int k = 0; k < count; ++k) {
      Segment s{{static_cast<int>(e), k}, line[k], line[k + 1], first + k, first + k + 1,
                is_new[e][k] != 0};
      if (k == 0 && origin >= 0) s.from = origin;
      if (k == count - 1) s.to = end >= 0 ? end : first;
      if (s.p == s.q)
        conflicts.push_back({s.of, s.of});
      else
        segments.push_back(s);
    }
  }
  const auto pairs = PairSearch(segments).run();
  conflicts.insert(conflicts.end(), pairs.begin(), pairs.end());
  return conflicts;
}

std::vector<PieceConflict> misplaced_around_vertices(const Arrangement& arrangement,
                                                     const EdgePolylines& lines) {
  std::vector<PieceConflict> conflicts;
  for (std::size_t v = 0; v < arrangement.vertices.size(); ++v) {
    std::vector<Departure> out;
    Point<2> at{};
    for (const int h : arrangement.around(static_cast<int>(v))) {
      const auto& line = lines[Arrangement::edge_of(h)];
      if (line.size() < 2) continue;
      at = h % 2 == 0 ? line.front() : line.back();
      out.push_back(departure(lines, h));
    }
    // Seen from the first one: less than half a turn, half a turn, more.
    const auto turn = [&](std::size_t k) {
      return -static_cast<int>(orientation(at, out[0].to, out[k].to));
    };
    for (std::size_t k = 2; k < out.size(); ++k) {
      const int before = turn(k - 1), here = turn(k);
      const bool follows =
          before < here ||
          (before == here && orientation(at, out[k - 1].to, out[k].to) == Sign::Positive);
      if (follows) continue;
      for (const std::size_t other : {std::size_t{0}, k - 1})
        conflicts.push_back(
            {std::min(out[other].piece, out[k].piece), std::max(out[other].piece, out[k].piece)});
    }
  }
  return conflicts;
}

std::vector<CycleConflict> misplaced_cycles(const Arrangement& arrangement,
                                            const EdgePolylines& lines, int face) {
  const std::vector<int> boundaries = arrangement.boundaries(face);
  std::vector<std::vector<Point<2>>> cycles;
  for (const int h : boundaries) cycles.push_back(cycle_polyline(arrangement, lines, h));
  const bool has_outer = arrangement.faces[face].outer >= 0;
  std::vector<CycleConflict> conflicts;
  for (std::size_t i = 0; i < cycles.size(); ++i) {
    const bool is_outer = i == 0 && has_outer;
    if (is_counter_clockwise(cycles[i]) != is_outer)
      conflicts.push_back({boundaries[i], boundaries[i]});
    for (std::size_t j = 0; j < cycles.size() && !is_outer; ++j)
      if (i != j && is_inside(cycles[i].front(), cycles[j]) != (j == 0 && has_outer))
        conflicts.push_back({boundaries[i], boundaries[j]});
  }
  return conflicts;
}

std::vector<Point<2>> cycle_polyline(const Arrangement& arrangement, const EdgePolylines& lines,
                                     int half_edge) {
  std::vector<Point<2>> cycle;
  for (const int h : arrangement.cycle(half_edge)) {
    const auto& line = lines[Arrangement::edge_of(h)];
    const std::ptrdiff_t skipped = cycle.empty() ? 0 : 1;
    if (h % 2 == 0)
      cycle.insert(cycle.end(), line.begin() + skipped, line.end());
    else
      cycle.insert(cycle.end(), line.rbegin() + skipped, line.rend());
  }
  return cycle;
}

}  // namespace encase
