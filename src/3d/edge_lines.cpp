// SPDX-License-Identifier: MIT
#include "3d/edge_lines.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "common/segments.hpp"

namespace encase {

namespace {

/// An end of an interval: a double, or a rational.
struct Bound {
  double value = 0;
  std::optional<Rational> exact;

  Rational rational() const { return exact ? *exact : Rational(value); }
  bool operator<(const Bound& other) const {
    return exact || other.exact ? rational() < other.rational() : value < other.value;
  }
};

/// A surface's crossing with the common line of two planes, as one facet sees it.
struct Sighting {
  std::array<int, 2> planes{};
  int surface = -1;
  /// Of the line's coordinate: the interval of the root, and whether the sign grows with it.
  Bound lo, hi;
  bool ascending = false;
  int facet = -1;
  int vertex = -1;

  std::tuple<const std::array<int, 2>&, int> line() const { return {planes, surface}; }
};

/// What the coordinate that stands for a common line of two planes is in terms of another one.
struct Coordinate {
  int axis = 0;
  /// coordinate = offset + slope * the other
  Rational offset = 0, slope = 1;

  Bound of(double other) const {
    if (slope == 1 && offset == 0) return {other, std::nullopt};
    return {0, Rational(offset + slope * Rational(other))};
  }
};

int unit_axis(const Plane& plane) {
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    if (plane.normal[i] == 0) continue;
    if (axis >= 0) return -1;
    axis = i;
  }
  return axis;
}

class PointNumbering {
 public:
  PointNumbering(const std::vector<FilteredFunction<3>>& surfaces, const std::vector<Plane>& planes,
                 PlaneCharts& charts, const std::vector<Facet*>& facets)
      : surfaces_(surfaces), planes_(planes), charts_(charts), facets_(facets) {}

  std::vector<FacetPoint> run() {
    for (std::size_t k = 0; k < facets_.size(); ++k) collect(static_cast<int>(k));
    std::stable_sort(
        sightings_.begin(), sightings_.end(), [](const Sighting& a, const Sighting& b) {
          return std::tie(a.planes, a.surface, a.lo) < std::tie(b.planes, b.surface, b.lo);
        });
    for (std::size_t k = 0; k < sightings_.size(); ++k) number(k);
    return std::move(points_);
  }

 private:
  void collect(int index) {
    Facet& facet = *facets_[static_cast<std::size_t>(index)];
    const Arrangement& a = facet.arrangement;
    facet.points.assign(a.vertices.size(), -1);
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
      const Arrangement::Vertex& vertex = a.vertices[v];
      if (vertex.kind == Arrangement::Vertex::Kind::OnBoundary)
        add_sighting(index, static_cast<int>(v));
      if (vertex.kind != Arrangement::Vertex::Kind::Crossing) continue;
      const auto [f, g] = facet.encasement.crossings[static_cast<std::size_t>(vertex.index)].curves;
      facet.points[v] = static_cast<int>(points_.size());
      points_.push_back({{facet.surfaces[static_cast<std::size_t>(f)],
                          facet.surfaces[static_cast<std::size_t>(g)]},
                         {facet.plane, -1},
                         charts_.of(facet.plane).lift(vertex.point)});
    }
  }

  void add_sighting(int index, int v) {
    const Facet& facet = *facets_[static_cast<std::size_t>(index)];
    const Arrangement& a = facet.arrangement;
    const Arrangement::Vertex& vertex = a.vertices[static_cast<std::size_t>(v)];
    const LineCrossing& crossing =
        facet.encasement.line_crossings[static_cast<std::size_t>(vertex.index)];
    const auto side = static_cast<std::size_t>(crossing.line);
    const Line& line = facet.encasement.lines[side];
    Sighting s;
    s.facet = index;
    s.vertex = v;
    s.surface = facet.surfaces[static_cast<std::size_t>(crossing.curve)];
    s.planes = {std::min(facet.plane, facet.side_planes[side]),
                std::max(facet.plane, facet.side_planes[side])};
    // The face behind the half-edge that goes on along the boundary, counter-clockwise.
    const int face = a.half_edges[static_cast<std::size_t>(vertex.half_edge)].face;
    const Sign ahead =
        a.faces[static_cast<std::size_t>(face)].signs[static_cast<std::size_t>(crossing.curve)];
    s.ascending = (ahead == Sign::Positive) == parameter_grows(line, false);
    const int seen = charts_.of(facet.plane).axes()[static_cast<std::size_t>(parameter_axis(line))];
    const Coordinate coordinate = coordinate_of(s.planes, seen);
    s.lo = coordinate.of(crossing.lo);
    s.hi = coordinate.of(crossing.hi);
    if (coordinate.slope < 0) {
      std::swap(s.lo, s.hi);
      s.ascending = !s.ascending;
    }
    sightings_.push_back(std::move(s));
  }

  /// The coordinate that stands for a line, in terms of coordinate `seen`: the one that grows
  /// fastest along it, the first of several.
  Coordinate coordinate_of(const std::array<int, 2>& planes, int seen) const {
    const Plane &p = planes_[static_cast<std::size_t>(planes[0])],
                &q = planes_[static_cast<std::size_t>(planes[1])];
    if (unit_axis(p) >= 0 && unit_axis(q) >= 0) return {seen, 0, 1};  // the only one that varies
    const std::array<Rational, 4> a = p.exact(), b = q.exact();
    std::array<Rational, 3> direction;
    for (std::size_t i = 0; i < 3; ++i)
      direction[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    std::size_t best = 0;
    for (std::size_t i = 1; i < 3; ++i)
      if (abs(direction[i]) > abs(direction[best])) best = i;
    const auto from = static_cast<std::size_t>(seen);
    if (best == from) return {seen, 0, 1};
    // With the third coordinate t eliminated: n best + m from + d = 0.
    const std::size_t t = 3 - best - from;
    const Rational n = a[best] * b[t] - b[best] * a[t], m = a[from] * b[t] - b[from] * a[t],
                   d = a[3] * b[t] - b[3] * a[t];
    return {static_cast<int>(best), -d / n, -m / n};
  }

  /// Gives a sighting the number of an earlier one of the same root, or a new one.
  void number(std::size_t k) {
    Sighting& s = sightings_[k];
    Facet& facet = *facets_[static_cast<std::size_t>(s.facet)];
    int& point = facet.points[static_cast<std::size_t>(s.vertex)];
    // The roots of those before lie in intervals that begin no later.
    for (std::size_t j = k; j-- > 0 && sightings_[j].line() == s.line();) {
      const Sighting& before = sightings_[j];
      if (before.facet == s.facet || !(s.lo < before.hi)) continue;
      if (before.hi < s.hi && s.ascending != before.ascending) continue;
      point = facets_[static_cast<std::size_t>(before.facet)]
                  ->points[static_cast<std::size_t>(before.vertex)];
      return;
    }
    point = static_cast<int>(points_.size());
    points_.push_back({{s.surface, -1}, s.planes, about(facet, s)});
  }

  /// About where a crossing is: by the rule of false position.
  Point<3> about(const Facet& facet, const Sighting& s) {
    const Arrangement::Vertex& vertex =
        facet.arrangement.vertices[static_cast<std::size_t>(s.vertex)];
    const LineCrossing& crossing =
        facet.encasement.line_crossings[static_cast<std::size_t>(vertex.index)];
    const Line& line = facet.encasement.lines[static_cast<std::size_t>(crossing.line)];
    const PlaneChart& chart = charts_.of(facet.plane);
    const auto p = static_cast<std::size_t>(parameter_axis(line)), q = 1 - p;
    const auto point = [&](double t) {
      Point<2> at;
      at[p] = t;
      at[q] = -(line.normal[p] * t + line.offset) / line.normal[q];
      return chart.lift(at);
    };
    const FilteredFunction<3>& f = surfaces_[static_cast<std::size_t>(s.surface)];
    double lo = crossing.lo, hi = crossing.hi, t = lo + 0.5 * (hi - lo);
    double at_lo = f.approximate(point(lo)), at_hi = f.approximate(point(hi));
    constexpr int kSteps = 40;
    for (int step = 0; step < kSteps && at_lo * at_hi < 0; ++step) {
      const double next = lo + (hi - lo) * (at_lo / (at_lo - at_hi));
      if (!(lo < next && next < hi) || std::fabs(next - t) < 0x1p-50 * std::fabs(t)) break;
      t = next;
      const double value = f.approximate(point(t));
      // An end that stays counts for less and less.
      if (value * at_lo > 0) {
        lo = t;
        at_lo = value;
        at_hi *= 0.5;
      } else {
        hi = t;
        at_hi = value;
        at_lo *= 0.5;
      }
    }
    return point(t);
  }

  const std::vector<FilteredFunction<3>>& surfaces_;
  const std::vector<Plane>& planes_;
  PlaneCharts& charts_;
  const std::vector<Facet*>& facets_;
  std::vector<Sighting> sightings_;
  std::vector<FacetPoint> points_;
};

}  // namespace

std::vector<FacetPoint> number_facet_points(const std::vector<FilteredFunction<3>>& surfaces,
                                            const std::vector<Plane>& planes, PlaneCharts& charts,
                                            const std::vector<Facet*>& facets) {
  return PointNumbering(surfaces, planes, charts, facets).run();
}

}  // namespace encase
