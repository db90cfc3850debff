// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/box_tests.hpp"
#include "common/interval.hpp"
#include "common/segments.hpp"
#include "encase/encasement.hpp"

/// Encasements from splits and crossings given by hand, filled in the slow and obvious way: what
/// the search must find by itself is given, and no code of the search is used.
namespace encase::hand_made {

inline Polynomial<2> polynomial(std::vector<Polynomial<2>::Term> terms) {
  return Polynomial<2>::from_terms(std::move(terms));
}

struct Recipe {
  std::vector<Function<2>> curves;
  std::vector<Point<2>> corners;  ///< of the region, counter-clockwise
  std::vector<std::array<double, 3>> splitting_lines;
  std::vector<Split> history;  ///< lines counted after the region's sides
  /// Pairs of curves and where they cross, up to a part of `crossing_radius`.
  std::vector<std::pair<std::array<int, 2>, Point<2>>> crossings;
  double crossing_radius = 0x1p-20;
  double critical_width = 0x1p-3;       ///< of the widest box of a critical region
  std::vector<Point<2>> asked_corners;  ///< if the region asked for is smaller
  std::vector<Unresolved> degenerate;   ///< cells whose bounding box meets one are degenerate
};

namespace detail {

struct Edge {
  RationalPoint<2> start;
  int line;
};
using Polygon = std::vector<Edge>;

inline Rational value(const Line& line, const RationalPoint<2>& p) {
  const auto c = line.exact();
  return c[0] * p[0] + c[1] * p[1] + c[2];
}

inline Line side(const RationalPoint<2>& p, const RationalPoint<2>& q) {
  const Rational a = q[1] - p[1], b = p[0] - q[0];
  return Line::from_rationals({a, b, Rational(-(a * p[0] + b * p[1]))});
}

/// The part of a convex polygon on one side of a line.
inline Polygon part(const Polygon& polygon, const std::vector<Line>& lines, int line, int sign) {
  Polygon result;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Edge& edge = polygon[k];
    const int here = sign * sgn(value(lines[line], edge.start));
    const int next = sign * sgn(value(lines[line], polygon[(k + 1) % polygon.size()].start));
    const auto meeting = [&] { return exact_meet(lines[line], lines[edge.line]); };
    if (here > 0) result.push_back(edge);
    if (here > 0 && next < 0) result.push_back({meeting(), line});
    if (here < 0 && next > 0) result.push_back({meeting(), edge.line});
  }
  return result;
}

class Builder {
 public:
  explicit Builder(const Recipe& recipe) : recipe_(recipe) {}

  Encasement build() {
    Polygon whole;
    for (const auto& corner : recipe_.corners)
      e_.region.corners.push_back({Rational(corner[0]), Rational(corner[1])});
    const auto corners = e_.region.corners;
    const std::size_t n = corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      e_.lines.push_back(side(corners[k], corners[(k + 1) % n]));
      whole.push_back({corners[k], static_cast<int>(k)});
    }
    e_.region_used = e_.region;
    if (!recipe_.asked_corners.empty()) e_.region.corners.clear();
    for (const auto& corner : recipe_.asked_corners)
      e_.region.corners.push_back({Rational(corner[0]), Rational(corner[1])});
    e_.degenerate = recipe_.degenerate;
    for (const auto& c : recipe_.splitting_lines) {
      Line line;
      line.normal = {c[0], c[1]};
      line.offset = c[2];
      e_.lines.push_back(line);
    }
    for (std::size_t i = 0; i < recipe_.curves.size(); ++i) {
      e_.input.push_back({"c" + std::to_string(i), recipe_.curves[i]});
      e_.curves.push_back({e_.input[i].name, recipe_.curves[i], {static_cast<int>(i)}});
      curves_.emplace_back(recipe_.curves[i]);
    }
    for (std::size_t k = 0; k < n; ++k)
      add_line_crossings(static_cast<int>(k), whole[k].start, whole[(k + 1) % n].start);
    e_.history = recipe_.history;
    for (Split& split : e_.history) split.line += static_cast<int>(n);
    e_.cells.resize(e_.history.size() + 1);
    polygons_.resize(e_.cells.size());
    cut(whole, e_.history.empty() ? ~0 : 0, 0);
    for (std::size_t i = 0; i < e_.cells.size(); ++i) add_boundary(static_cast<int>(i));
    for (const auto& [curves, point] : recipe_.crossings) add_crossing(curves, point);
    root_ = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (const auto& corner : recipe_.corners) root_ = hull(root_, {corner, corner});
    for (int i = 0; i < static_cast<int>(curves_.size()); ++i) {
      for (int j = i + 1; j < static_cast<int>(curves_.size()); ++j) {
        CrossingCover pair{{i, j}, root_, {}};
        cover_crossings(&pair);
        e_.crossing_covers.push_back(pair);
      }
      add_critical_cover(i);
    }
    add_loop_certificates();
    e_.outcome = e_.degenerate.empty() ? Outcome::Certified : Outcome::Degenerate;
    return e_;
  }

 private:
  void add_line_crossings(int line, const RationalPoint<2>& from, const RationalPoint<2>& to) {
    const auto axis = static_cast<std::size_t>(parameter_axis(e_.lines[line]));
    Interval start = Interval::enclose(from[axis]), end = Interval::enclose(to[axis]);
    if (end.lo < start.lo) std::swap(start, end);
    for (std::size_t i = 0; i < curves_.size(); ++i) {
      auto roots = isolate_on_line(curves_[i], e_.lines[line], start.hi, end.lo, 10000, kernel_);
      if (!roots && !recipe_.degenerate.empty()) continue;
      if (!roots) throw std::runtime_error("a line crossing cannot be isolated");
      for (RootInterval& root : *roots) {
        while (root.hi - root.lo > 1e-9 &&
               refine_on_line(curves_[i], e_.lines[line], &root, kernel_)) {
        }
        e_.line_crossings.push_back({line, static_cast<int>(i), root.lo, root.hi});
      }
    }
  }

  void cut(const Polygon& polygon, int node, int depth) {
    if (node < 0) {
      polygons_[~node] = polygon;
      e_.cells[~node].depth = depth;
      return;
    }
    const Split split = e_.history[node];
    const Polygon negative = part(polygon, e_.lines, split.line, -1);
    const Polygon positive = part(polygon, e_.lines, split.line, 1);
    for (std::size_t k = 0; k < negative.size(); ++k)
      if (negative[k].line == split.line)
        add_line_crossings(split.line, negative[k].start,
                           negative[(k + 1) % negative.size()].start);
    cut(negative, split.negative, depth + 1);
    cut(positive, split.positive, depth + 1);
  }

  void add_boundary(int id) {
    Cell& cell = e_.cells[id];
    const Polygon& polygon = polygons_[id];
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Edge& edge = polygon[k];
      const auto axis = static_cast<std::size_t>(parameter_axis(e_.lines[edge.line]));
      const Rational from = edge.start[axis], to = polygon[(k + 1) % polygon.size()].start[axis];
      std::vector<int> on_edge;
      for (std::size_t c = 0; c < e_.line_crossings.size(); ++c) {
        const LineCrossing& crossing = e_.line_crossings[c];
        if (crossing.line == edge.line && std::min(from, to) <= Rational(crossing.lo) &&
            Rational(crossing.hi) <= std::max(from, to))
          on_edge.push_back(static_cast<int>(c));
      }
      std::sort(on_edge.begin(), on_edge.end(), [&](int a, int b) {
        const double at_a = e_.line_crossings[a].lo, at_b = e_.line_crossings[b].lo;
        return from < to ? at_a < at_b : at_a > at_b;
      });
      const Edge& previous = polygon[(k + polygon.size() - 1) % polygon.size()];
      cell.vertices.push_back({previous.line,
                               edge.line,
                               0,
                               {nearest_double(edge.start[0]), nearest_double(edge.start[1])}});
      for (std::size_t c = 0; c < on_edge.size(); ++c) {
        if (c > 0) {
          const LineCrossing& a = e_.line_crossings[on_edge[c - 1]];
          const LineCrossing& b = e_.line_crossings[on_edge[c]];
          const double t = 0.5 * (std::max(a.lo, b.lo) + std::min(a.hi, b.hi));
          const auto p = point_on_line(e_.lines[edge.line], Rational(t));
          cell.vertices.push_back(
              {edge.line, edge.line, t, {nearest_double(p[0]), nearest_double(p[1])}});
        }
        cell.word.push_back(on_edge[c]);
      }
    }
    Box<2> extent{cell.vertices[0].point, cell.vertices[0].point};
    for (const Vertex& v : cell.vertices) extent = hull(extent, {v.point, v.point});
    cell.state = CellState::Certified;
    for (const Unresolved& u : e_.degenerate)
      if (u.has_box && u.box.meets(extent)) cell.state = CellState::Degenerate;
    if (cell.state == CellState::Degenerate) return;
    for (int curve = 0; curve < static_cast<int>(curves_.size()); ++curve) {
      std::vector<int> ends;
      for (int c : cell.word)
        if (e_.line_crossings[c].curve == curve) ends.push_back(c);
      if (ends.size() == 2) cell.branches.push_back({curve, ends[0], ends[1]});
    }
  }

  bool inside(int id, const RationalPoint<2>& p) const {
    const Polygon& polygon = polygons_[id];
    for (std::size_t k = 0; k < polygon.size(); ++k)
      if (value(side(polygon[k].start, polygon[(k + 1) % polygon.size()].start), p) >= 0)
        return false;
    return true;
  }

  void add_crossing(const std::array<int, 2>& curves, const Point<2>& point) {
    Crossing crossing;
    crossing.curves = curves;
    crossing.point = point;
    const double r = recipe_.crossing_radius;
    crossing.box = {{point[0] - r, point[1] - r}, {point[0] + r, point[1] + r}};
    for (int id = 0; id < static_cast<int>(e_.cells.size()); ++id)
      if (inside(id, {Rational(point[0]), Rational(point[1])})) {
        crossing.cell = id;
        e_.cells[id].crossing = static_cast<int>(e_.crossings.size());
      }
    e_.crossings.push_back(crossing);
  }

  bool outside(const Box<2>& box) {
    for (std::size_t k = 0; k < e_.region_used.corners.size(); ++k)
      if (encase::side(e_.lines[k], box, kernel_) == Sign::Positive) return true;
    return false;
  }

  /// Halves across alternating axes until `settle` names a token.
  template <class Settle>
  void subdivide(std::vector<int>* tokens, const Box<2>& box, int depth, const Settle& settle) {
    if (outside(box)) {
      tokens->push_back(cover::kOutside);
      return;
    }
    if (const auto token = settle(box)) {
      tokens->push_back(*token);
      return;
    }
    if (depth > 40) throw std::runtime_error("a cover does not end");
    const int axis = depth % 2;
    tokens->push_back(axis == 0 ? cover::kSplitX : cover::kSplitY);
    Box<2> lower = box, upper = box;
    lower.hi[axis] = upper.lo[axis] = box.lo[axis] + (box.hi[axis] - box.lo[axis]) / 2;
    subdivide(tokens, lower, depth + 1, settle);
    subdivide(tokens, upper, depth + 1, settle);
  }

  bool unresolved(const Box<2>& leaf, const std::vector<int>& curves) const {
    for (const Unresolved& u : e_.degenerate)
      if (u.has_box && u.box.contains(leaf) &&
          (u.curves == curves || u.kind == Unresolved::Kind::NotAnalytic))
        return true;
    return false;
  }

  void cover_crossings(CrossingCover* pair) {
    const System<2> system{&curves_[pair->curves[0]], &curves_[pair->curves[1]]};
    subdivide(&pair->tokens, root_, 0, [&](const Box<2>& leaf) -> std::optional<int> {
      if (no_common_zero<2>(system, leaf, kernel_)) return cover::kExcluded;
      for (std::size_t k = 0; k < e_.crossings.size(); ++k)
        if (e_.crossings[k].curves == pair->curves && leaf.meets(e_.crossings[k].box) &&
            at_most_one_zero<2>(system, hull(leaf, e_.crossings[k].box), kernel_))
          return static_cast<int>(k);
      if (unresolved(leaf, {pair->curves[0], pair->curves[1]})) return cover::kUnresolved;
      return std::nullopt;
    });
  }

  void add_critical_cover(int curve) {
    const auto& f = curves_[curve];
    CriticalCover complete{curve, root_, {}};
    const std::size_t first = e_.critical_regions.size();
    subdivide(&complete.tokens, root_, 0, [&](const Box<2>& leaf) -> std::optional<int> {
      if (no_relevant_critical_point(f, leaf, kernel_)) return cover::kExcluded;
      const auto sign = sign_on_box(f, leaf, kernel_);
      if (!sign && unresolved(leaf, {curve})) return cover::kUnresolved;
      if (!sign || leaf.largest_width() > recipe_.critical_width) return std::nullopt;
      e_.critical_regions.push_back({curve, *sign, {leaf}});
      return static_cast<int>(e_.critical_regions.size()) - 1;
    });
    join(first, &complete.tokens);
    e_.critical_covers.push_back(complete);
  }

  /// Joins regions from `first` on whose boxes touch, and renumbers the tokens.
  void join(std::size_t first, std::vector<int>* tokens) {
    auto& regions = e_.critical_regions;
    const auto touch = [&](const CriticalRegion& a, const CriticalRegion& b) {
      for (const auto& x : a.boxes)
        for (const auto& y : b.boxes)
          if (x.meets(y)) return true;
      return false;
    };
    for (bool joined = true; joined;) {
      joined = false;
      for (std::size_t a = first; a < regions.size() && !joined; ++a)
        for (std::size_t b = a + 1; b < regions.size() && !joined; ++b) {
          if (!touch(regions[a], regions[b])) continue;
          regions[a].boxes.insert(regions[a].boxes.end(), regions[b].boxes.begin(),
                                  regions[b].boxes.end());
          regions.erase(regions.begin() + static_cast<std::ptrdiff_t>(b));
          for (int& token : *tokens) {
            if (token == static_cast<int>(b))
              token = static_cast<int>(a);
            else if (token > static_cast<int>(b))
              --token;
          }
          joined = true;
        }
    }
  }

  /// Tries segments in all directions until one leaves the cell without meeting the curve.
  void add_loop_certificates() {
    for (std::size_t k = 0; k < e_.critical_regions.size(); ++k) {
      const CriticalRegion& region = e_.critical_regions[k];
      const Point<2> from = region.boxes[0].center();
      for (std::size_t i = 0; i < e_.cells.size(); ++i) {
        if (!inside(static_cast<int>(i), {Rational(from[0]), Rational(from[1])})) continue;
        for (int trial = 0; trial < 512; ++trial) {
          const double angle = 0.1 * (trial / 8), length = std::ldexp(4.0, -(trial % 8));
          const Point<2> to{from[0] + length * std::cos(angle), from[1] + length * std::sin(angle)};
          if (inside(static_cast<int>(i), {Rational(to[0]), Rational(to[1])}) ||
              !no_root_on_segment(curves_[region.curve], from, to, kernel_))
            continue;
          e_.cells[i].loop_certificates.push_back({static_cast<int>(k), from, to});
          break;
        }
      }
    }
  }

  const Recipe& recipe_;
  Encasement e_;
  Kernel kernel_;
  std::vector<FilteredFunction<2>> curves_;
  std::vector<Polygon> polygons_;
  Box<2> root_;
};

}  // namespace detail

inline Encasement build(const Recipe& recipe) { return detail::Builder(recipe).build(); }

}  // namespace encase::hand_made
