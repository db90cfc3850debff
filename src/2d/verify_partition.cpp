// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "common/segments.hpp"
#include "verify_claims.hpp"

namespace encase::verification {

namespace {

using Corner = std::array<Interval, 2>;

/// The tightest doubles around the meeting point of two lines that are not parallel.
Corner enclosed_meet(const Line& first, const Line& second) {
  const RationalPoint<2> p = exact_meet(first, second);
  return {Interval::enclose(p[0]), Interval::enclose(p[1])};
}

class Replay {
 public:
  explicit Replay(Claims& claims) : claims_(claims), e_(claims.result) {
    partition_.cells.resize(e_.cells.size());
    depths_.resize(e_.cells.size(), -1);
    claimed_.resize(e_.line_crossings.size(), false);
    sort_crossings();
  }

  Partition run() {
    partition_.complete = replay();
    if (!partition_.complete) return std::move(partition_);
    check_segments();
    for (std::size_t i = 0; i < e_.cells.size() && !claims_.full(); ++i)
      claims_.require(e_.cells[i].depth == depths_[i], "Cell ", i, " has depth ", depths_[i],
                      " in the history, not ", e_.cells[i].depth, ".");
    for (std::size_t i = 0; i < claimed_.size() && !claims_.full(); ++i)
      claims_.require(claimed_[i], "Line crossing ", i, " lies on no edge.");
    return std::move(partition_);
  }

 private:
  const Line& line(int i) const { return e_.lines[static_cast<std::size_t>(i)]; }
  const LineCrossing& crossing(int i) const {
    return e_.line_crossings[static_cast<std::size_t>(i)];
  }

  /// Sorts each line's crossings; that their open intervals are disjoint proves their order,
  /// whatever their curves.
  void sort_crossings() {
    on_line_.resize(e_.lines.size());
    for (std::size_t i = 0; i < e_.line_crossings.size(); ++i)
      on_line_[static_cast<std::size_t>(e_.line_crossings[i].line)].push_back(static_cast<int>(i));
    for (std::size_t l = 0; l < on_line_.size() && !claims_.full(); ++l) {
      auto& ids = on_line_[l];
      std::sort(ids.begin(), ids.end(), [&](int a, int b) {
        return std::pair(crossing(a).lo, crossing(a).hi) <
               std::pair(crossing(b).lo, crossing(b).hi);
      });
      for (std::size_t k = 1; k < ids.size(); ++k)
        claims_.require(crossing(ids[k - 1]).hi <= crossing(ids[k]).lo, "Line crossings ",
                        ids[k - 1], " and ", ids[k], " overlap on line ", l, ".");
    }
  }

  /// Adds the segment of a line between two corners that are enclosed there. Its crossings are
  /// those whose intervals lie between the corners.
  int add_segment(int line_id, const Corner& from, const Corner& to) {
    const int axis = parameter_axis(line(line_id));
    // Both enclose one exact number as tightly as doubles can, so they are ordered by either bound.
    Interval start = from[static_cast<std::size_t>(axis)];
    Interval end = to[static_cast<std::size_t>(axis)];
    if (end.lo < start.lo || end.hi < start.hi) std::swap(start, end);

    Segment segment;
    segment.line = line_id;
    segment.lo = start.lo;
    segment.hi = end.hi;
    for (int id : on_line_[static_cast<std::size_t>(line_id)]) {
      const LineCrossing& c = crossing(id);
      if (c.hi <= start.lo || c.lo >= end.hi) continue;
      claims_.require(start.hi <= c.lo && c.hi <= end.lo, "The interval of line crossing ", id,
                      " holds an end of its segment on line ", line_id, ".");
      claimed_[static_cast<std::size_t>(id)] = true;
      segment.crossings.push_back(id);
    }
    partition_.segments.push_back(std::move(segment));
    return static_cast<int>(partition_.segments.size()) - 1;
  }

  /// Every line crossing is a simple root. On an edge of a certified cell there are no other zeros,
  /// from the far end of one corner's enclosure to that of the other's: the list is complete, and
  /// no curve passes through a corner. Cells that are not certified claim no more than what they
  /// list.
  void check_segments() {
    std::vector<std::vector<Interval>> complete(partition_.segments.size());
    for (std::size_t i = 0; i < e_.cells.size(); ++i)
      if (certified(e_.cells[i])) add_edges(partition_.cells[i], &complete);
    for_each(claims_, partition_.segments.size(), [&](Claims& part, std::size_t s) {
      const std::vector<Interval> parts = united(std::move(complete[s]));
      for (int curve : curves_on_segment(part, partition_.segments[s], parts)) {
        if (part.full()) break;
        check_curve_on_segment(part, curve, partition_.segments[s], parts);
      }
    });
  }

  /// Adds where the edges of a polygon lie on their segments.
  void add_edges(const Polygon& polygon, std::vector<std::vector<Interval>>* on_segments) const {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Edge& edge = polygon[k];
      const auto axis = static_cast<std::size_t>(parameter_axis(line(edge.line)));
      const Interval a = edge.start[axis], b = polygon[(k + 1) % polygon.size()].start[axis];
      (*on_segments)[static_cast<std::size_t>(edge.segment)].push_back(
          {std::fmin(a.lo, b.lo), std::fmax(a.hi, b.hi)});
    }
  }

  /// The union of intervals as disjoint ones, in order.
  static std::vector<Interval> united(std::vector<Interval> intervals) {
    std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
      return std::pair(a.lo, a.hi) < std::pair(b.lo, b.hi);
    });
    std::vector<Interval> result;
    for (const Interval& next : intervals) {
      if (result.empty() || next.lo > result.back().hi)
        result.push_back(next);
      else
        result.back().hi = std::fmax(result.back().hi, next.hi);
    }
    return result;
  }

  /// The curves about which a segment claims something that the shared cover does not prove.
  std::vector<int> curves_on_segment(Claims& part, const Segment& segment,
                                     const std::vector<Interval>& complete) {
    std::vector<int> curves;
    if (!complete.empty()) {
      const auto point =
          point_on_line(line(segment.line), Interval(complete.front().lo, complete.back().hi));
      curves = curves_near(part, line(segment.line),
                           {{point[0].lo, point[1].lo}, {point[0].hi, point[1].hi}});
    }
    for (int id : segment.crossings) curves.push_back(crossing(id).curve);
    std::sort(curves.begin(), curves.end());
    curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
    return curves;
  }

  void check_curve_on_segment(Claims& part, int curve, const Segment& segment,
                              const std::vector<Interval>& complete) {
    const auto& f = part.curves[static_cast<std::size_t>(curve)];
    std::vector<const LineCrossing*> its;
    for (int id : segment.crossings) {
      const LineCrossing& c = crossing(id);
      if (c.curve != curve) continue;
      const bool proved = part.require(
          one_root_on_line(f, line(segment.line), c.lo, c.hi, part.kernel), "Line crossing ", id,
          " is not proved to be one simple root of curve ", curve, " on line ", segment.line, ".");
      if (!proved) return;
      its.push_back(&c);
    }
    for (const Interval& reach : complete) {
      const LineCrossing* previous = nullptr;
      for (const LineCrossing* c : its) {
        if (c->hi <= reach.lo || c->lo >= reach.hi) continue;
        check_gap(part, curve, segment.line, reach, previous, c);
        previous = c;
      }
      check_gap(part, curve, segment.line, reach, previous, nullptr);
    }
  }

  /// Proves that a curve has no zero between two successive crossings with a line, or between one
  /// and an end of the part `reach` of the line.
  void check_gap(Claims& part, int curve, int line_id, const Interval& reach,
                 const LineCrossing* before, const LineCrossing* after) {
    const auto& f = part.curves[static_cast<std::size_t>(curve)];
    const Line& l = line(line_id);
    double lo = before ? before->hi : reach.lo, hi = after ? after->lo : reach.hi;
    // The corner's enclosure reaches into the interval, which has been objected to.
    if (lo > hi) return;
    bool proved = no_root_on_line(f, l, lo, hi, part.kernel);
    // A root may lie too close to an end of its interval for boxes of doubles to tell them apart.
    // But where an interval and a part of the gap together have one root, it is that of the
    // interval.
    for (int k = 1; !proved && before && k <= 40; k += 3) {
      const double t = lo + std::ldexp(hi - lo, -k);
      if (!(lo < t) || !one_root_on_line(f, l, before->lo, t, part.kernel)) continue;
      lo = t;
      break;
    }
    for (int k = 1; !proved && after && k <= 40; k += 3) {
      const double t = hi - std::ldexp(hi - lo, -k);
      if (!(t < hi) || !one_root_on_line(f, l, t, after->hi, part.kernel)) continue;
      hi = t;
      break;
    }
    part.require(proved || no_root_on_line(f, l, lo, hi, part.kernel), "Curve ", curve,
                 " is not proved absent from line ", line_id, " between its crossings there.");
  }

  /// How many of an edge's crossings, counted in its segment's order, lie before a corner on it.
  int position(const Edge& edge, const Corner& corner) {
    const Interval t = corner[static_cast<std::size_t>(parameter_axis(line(edge.line)))];
    const auto& ids = partition_.segments[static_cast<std::size_t>(edge.segment)].crossings;
    int k = edge.first;
    while (k < edge.last && crossing(ids[static_cast<std::size_t>(k)]).hi <= t.lo) ++k;
    if (k < edge.last) {
      const int id = ids[static_cast<std::size_t>(k)];
      claims_.require(t.hi <= crossing(id).lo, "The interval of line crossing ", id,
                      " holds a corner.");
    }
    return k;
  }

  /// Cuts an edge at a corner inside it: the part before and the part after, counter-clockwise.
  std::pair<Edge, Edge> cut(const Edge& edge, const Corner& corner) {
    Edge before = edge, after = edge;
    after.start = corner;
    const int k = position(edge, corner);
    if (parameter_increases(line(edge.line), edge.interior)) {
      before.last = k;
      after.first = k;
    } else {
      before.first = k;
      after.last = k;
    }
    return {before, after};
  }

  Polygon region_polygon() {
    const int n = e_.region_used.side_count();
    std::vector<Corner> corners;
    for (int k = 0; k < n; ++k) corners.push_back(enclosed_meet(line((k + n - 1) % n), line(k)));
    Polygon polygon;
    for (int k = 0; k < n; ++k) {
      Edge edge;
      edge.line = k;
      edge.interior = Sign::Negative;
      edge.start = corners[static_cast<std::size_t>(k)];
      edge.segment = add_segment(k, edge.start, corners[static_cast<std::size_t>((k + 1) % n)]);
      edge.last = crossing_count(edge.segment);
      polygon.push_back(edge);
    }
    return polygon;
  }

  int crossing_count(int segment) const {
    return static_cast<int>(
        partition_.segments[static_cast<std::size_t>(segment)].crossings.size());
  }

  /// Splits a convex polygon by a line with vertices on both sides and none on it: false if it is
  /// not such a line. The parts are convex, and their corners are proper.
  bool split(const Polygon& polygon, int line_id, Polygon* negative, Polygon* positive) {
    const std::size_t n = polygon.size();
    std::vector<Sign> signs(n);
    for (std::size_t k = 0; k < n; ++k) {
      signs[k] = side(line(line_id), line(polygon[(k + n - 1) % n].line), line(polygon[k].line),
                      claims_.kernel);
      if (signs[k] == Sign::Zero) return false;
    }
    // The edges on which the line leaves the negative and the positive side, counter-clockwise.
    std::size_t up = n, down = n, changes = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (signs[k] == signs[(k + 1) % n]) continue;
      ++changes;
      (signs[k] == Sign::Negative ? up : down) = k;
    }
    if (changes != 2) return false;

    const Corner at_up = enclosed_meet(line(line_id), line(polygon[up].line));
    const Corner at_down = enclosed_meet(line(line_id), line(polygon[down].line));
    const auto [up_negative, up_positive] = cut(polygon[up], at_up);
    const auto [down_positive, down_negative] = cut(polygon[down], at_down);
    Edge seam;
    seam.line = line_id;
    seam.segment = add_segment(line_id, at_up, at_down);
    seam.last = crossing_count(seam.segment);

    negative->push_back(down_negative);
    for (std::size_t k = (down + 1) % n; k != up; k = (k + 1) % n) negative->push_back(polygon[k]);
    negative->push_back(up_negative);
    seam.interior = Sign::Negative;
    seam.start = at_up;
    negative->push_back(seam);

    positive->push_back(up_positive);
    for (std::size_t k = (up + 1) % n; k != down; k = (k + 1) % n) positive->push_back(polygon[k]);
    positive->push_back(down_positive);
    seam.interior = Sign::Positive;
    seam.start = at_down;
    positive->push_back(seam);
    return true;
  }

  bool replay() {
    if (!claims_.require(!e_.cells.empty(), "There are no cells.")) return false;
    // Children come after their parents, so that one pass in order visits every node once its
    // polygon is known, and there can be no cycle.
    const std::size_t n = e_.history.size();
    std::vector<Polygon> nodes(n);
    std::vector<int> depths(n, -1);
    const auto place = [&](std::size_t parent, int child, Polygon&& polygon, int depth) {
      if (child < 0) {
        const auto c = static_cast<std::size_t>(~child);
        if (!claims_.require(depths_[c] < 0, "Cell ", c, " has two places in the history."))
          return false;
        depths_[c] = depth;
        partition_.cells[c] = std::move(polygon);
        return true;
      }
      const auto c = static_cast<std::size_t>(child);
      if (!claims_.require(c > parent && depths[c] < 0, "Split ", c,
                           " has two parents or comes before its parent ", parent, "."))
        return false;
      depths[c] = depth;
      nodes[c] = std::move(polygon);
      return true;
    };

    Polygon whole = region_polygon();
    if (n == 0) {
      depths_[0] = 0;
      partition_.cells[0] = std::move(whole);
    } else {
      depths[0] = 0;
      nodes[0] = std::move(whole);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (claims_.full()) return false;
      if (!claims_.require(depths[i] >= 0, "Split ", i, " cuts nothing.")) return false;
      Polygon negative, positive;
      const Split& s = e_.history[i];
      if (!claims_.require(split(nodes[i], s.line, &negative, &positive), "Line ", s.line,
                           " of split ", i, " does not cut its polygon between the corners."))
        return false;
      if (!place(i, s.negative, std::move(negative), depths[i] + 1)) return false;
      if (!place(i, s.positive, std::move(positive), depths[i] + 1)) return false;
      nodes[i] = {};
    }
    for (std::size_t c = 0; c < depths_.size(); ++c)
      if (!claims_.require(depths_[c] >= 0, "Cell ", c, " is not in the history.")) return false;
    return true;
  }

  Claims& claims_;
  const Encasement& e_;
  Partition partition_;
  std::vector<int> depths_;
  std::vector<bool> claimed_;
  std::vector<std::vector<int>> on_line_;
};

/// Walks a cell's vertices along the replayed polygon.
class BoundaryWalk {
 public:
  BoundaryWalk(Claims& claims, const Partition& partition, std::size_t cell, double slack)
      : claims_(claims),
        e_(claims.result),
        partition_(partition),
        cell_(cell),
        slack_(slack),
        polygon_(partition.cells[cell]) {}

  void run() {
    const Cell& cell = e_.cells[cell_];
    const std::size_t n = cell.vertices.size();
    std::size_t corners = 0;
    for (const Vertex& v : cell.vertices) corners += v.line_in != v.line_out;
    if (!claims_.require(corners == polygon_.size(), "Cell ", cell_, " has ", corners,
                         " corners, its polygon ", polygon_.size(), "."))
      return;
    if (!find_start(cell.vertices[0])) {
      claims_.require(false, "Vertex 0 of cell ", cell_, " is not on its polygon.");
      return;
    }
    check_point(0);
    std::vector<int> word;
    const bool strict = cell.state == CellState::Certified || cell.state == CellState::Relaxed;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t next = (k + 1) % n;
      const std::size_t before = word.size();
      if (!advance(cell.vertices[next], &word)) {
        claims_.require(false, "Vertex ", next, " of cell ", cell_,
                        " does not follow its predecessor on the polygon.");
        return;
      }
      if (next != 0) check_point(next);
      const std::size_t count = word.size() - before;
      const bool at_cut = is_cut(cell.vertices[k]) || is_cut(cell.vertices[next]);
      if (strict)
        claims_.require(count <= 1, "Edge ", k, " of cell ", cell_, " has several crossings.");
      claims_.require(count >= 1 || !at_cut, "A cut at edge ", k, " of cell ", cell_,
                      " is not between two crossings.");
    }
    claims_.require(word == cell.word, "The word of cell ", cell_, " is not that of its boundary.");
  }

 private:
  static bool is_cut(const Vertex& v) { return v.line_in == v.line_out; }
  const Line& line(int i) const { return e_.lines[static_cast<std::size_t>(i)]; }
  const Edge& edge() const { return polygon_[edge_]; }
  bool increases() const { return parameter_increases(line(edge().line), edge().interior); }
  int edge_size() const { return edge().last - edge().first; }

  /// The k-th crossing of the present edge, counter-clockwise.
  int crossing_id(int k) const {
    const auto& ids = partition_.segments[static_cast<std::size_t>(edge().segment)].crossings;
    return ids[static_cast<std::size_t>(increases() ? edge().first + k : edge().last - 1 - k)];
  }
  /// A parameter is before the k-th crossing of the present edge, or after it, counter-clockwise.
  /// It lies outside the open interval; outside all of them no curve is zero, by the proofs of the
  /// segment.
  bool before(double t, int k) const {
    const LineCrossing& c = e_.line_crossings[static_cast<std::size_t>(crossing_id(k))];
    return increases() ? t <= c.lo : t >= c.hi;
  }
  bool after(double t, int k) const {
    const LineCrossing& c = e_.line_crossings[static_cast<std::size_t>(crossing_id(k))];
    return increases() ? t >= c.hi : t <= c.lo;
  }

  bool find_start(const Vertex& v) {
    for (edge_ = 0; edge_ < polygon_.size(); ++edge_)
      if (edge().line == v.line_out) break;
    if (edge_ == polygon_.size()) return false;
    done_ = 0;
    if (!is_cut(v)) return polygon_[previous()].line == v.line_in;
    while (done_ < edge_size() && after(v.parameter, done_)) ++done_;
    return done_ > 0 && done_ < edge_size() && before(v.parameter, done_);
  }
  std::size_t previous() const { return (edge_ + polygon_.size() - 1) % polygon_.size(); }

  /// Moves on to the next vertex and collects the crossings on the way.
  bool advance(const Vertex& v, std::vector<int>* word) {
    if (v.line_in != edge().line) return false;
    if (is_cut(v)) {
      // Between two crossings of the edge, hence inside it.
      while (done_ < edge_size() && after(v.parameter, done_))
        word->push_back(crossing_id(done_++));
      return done_ > 0 && done_ < edge_size() && before(v.parameter, done_);
    }
    while (done_ < edge_size()) word->push_back(crossing_id(done_++));
    edge_ = (edge_ + 1) % polygon_.size();
    done_ = 0;
    return v.line_out == edge().line;
  }

  /// The vertex's rounded point is within a few units in the last place of the region's size.
  void check_point(std::size_t k) {
    const Vertex& v = e_.cells[cell_].vertices[k];
    std::array<Interval, 2> exact = edge().start;
    if (is_cut(v)) {
      const RationalPoint<2> p = point_on_line(line(edge().line), Rational(v.parameter));
      exact = {Interval::enclose(p[0]), Interval::enclose(p[1])};
    }
    for (std::size_t i = 0; i < 2; ++i) {
      claims_.require(exact[i].lo - slack_ <= v.point[i] && v.point[i] <= exact[i].hi + slack_,
                      "The point of vertex ", k, " of cell ", cell_,
                      " is not where its lines meet.");
    }
  }

  Claims& claims_;
  const Encasement& e_;
  const Partition& partition_;
  std::size_t cell_;
  double slack_;
  const Polygon& polygon_;
  std::size_t edge_ = 0;
  int done_ = 0;  // crossings of the present edge that are behind
};

}  // namespace

bool parameter_increases(const Line& line, Sign interior) {
  // With the interior on the negative side (a, b) points outward, and counter-clockwise is (-b, a).
  const bool increases = parameter_axis(line) == 0 ? line.normal[1] < 0 : line.normal[0] > 0;
  return increases == (interior == Sign::Negative);
}

Partition replay_history(Claims& claims) { return Replay(claims).run(); }

void check_cell_boundaries(Claims& claims, const Partition& partition) {
  double scale = 0;
  for (const auto& corner : claims.result.region_used.corners)
    for (const Rational& c : corner) scale = std::fmax(scale, std::fabs(nearest_double(c)));
  for (std::size_t i = 0; i < partition.cells.size() && !claims.full(); ++i)
    BoundaryWalk(claims, partition, i, 0x1p-50 * scale).run();
}

std::vector<int> cells_near(Claims& claims, const Partition& partition, const Box<2>& box) {
  const Encasement& e = claims.result;
  for (int k = 0; k < e.region_used.side_count(); ++k)
    if (side(e.lines[static_cast<std::size_t>(k)], box, claims.kernel) == Sign::Positive) return {};
  std::vector<int> cells;
  std::vector<int> stack{e.history.empty() ? ~0 : 0};
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    if (node >= 0) {
      const Split& split = e.history[static_cast<std::size_t>(node)];
      const auto s = side(e.lines[static_cast<std::size_t>(split.line)], box, claims.kernel);
      if (s != Sign::Positive) stack.push_back(split.negative);
      if (s != Sign::Negative) stack.push_back(split.positive);
      continue;
    }
    // The lines do not separate the box from the cell; the box's own sides may.
    std::array<Interval, 2> extent;
    bool first = true;
    for (const Edge& edge : partition.cells[static_cast<std::size_t>(~node)]) {
      for (std::size_t i = 0; i < 2; ++i) {
        extent[i].lo = first ? edge.start[i].lo : std::fmin(extent[i].lo, edge.start[i].lo);
        extent[i].hi = first ? edge.start[i].hi : std::fmax(extent[i].hi, edge.start[i].hi);
      }
      first = false;
    }
    if (extent[0].lo <= box.hi[0] && box.lo[0] <= extent[0].hi && extent[1].lo <= box.hi[1] &&
        box.lo[1] <= extent[1].hi)
      cells.push_back(~node);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

int cell_around(Claims& claims, const std::vector<Box<2>>& boxes) {
  const Encasement& e = claims.result;
  const auto common_side = [&](int line) -> std::optional<Sign> {
    std::optional<Sign> common;
    for (const Box<2>& box : boxes) {
      const auto s = side(e.lines[static_cast<std::size_t>(line)], box, claims.kernel);
      if (!s || (common && *common != *s)) return std::nullopt;
      common = s;
    }
    return common;
  };
  for (int k = 0; k < e.region_used.side_count(); ++k)
    if (common_side(k) != Sign::Negative) return -1;
  int node = e.history.empty() ? ~0 : 0;
  while (node >= 0) {
    const Split& split = e.history[static_cast<std::size_t>(node)];
    const auto s = common_side(split.line);
    if (!s) return -1;
    node = *s == Sign::Negative ? split.negative : split.positive;
  }
  return ~node;
}

bool strictly_inside(Claims& claims, const Polygon& polygon, const Box<2>& box) {
  for (const Edge& edge : polygon)
    if (side(claims.result.lines[static_cast<std::size_t>(edge.line)], box, claims.kernel) !=
        edge.interior)
      return false;
  return true;
}

}  // namespace encase::verification
