// SPDX-License-Identifier: MIT
#include "3d/facet_lines.hpp"

#include <algorithm>

#include "3d/space_vectors.hpp"
#include "encase/slice.hpp"
#include "encase/tracing.hpp"

namespace encase {

namespace {

std::pair<int, int> ascending(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

FacetLines::FacetLines(const SurfaceEncasement& encasement,
                       const std::vector<FilteredFunction<3>>& functions, double tolerance,
                       double angle, std::vector<Point<3>>* points)
    : encasement_(encasement), functions_(functions), points_(*points) {
  for (const FacetPoint& p : encasement.facet_points) {
    facet_points_.push_back(static_cast<int>(points_.size()));
    points_.push_back(p.point);
    for (const int plane : p.planes) add_to_side(plane, facet_points_.back());
  }
  TraceOptions options;
  options.tolerance = tolerance;
  for (std::size_t f = 0; f < encasement.facets.size(); ++f) {
    const Facet& facet = encasement.facets[f];
    if (facet.surfaces.empty()) continue;
    const auto tracing = trace(facet.encasement, facet.arrangement, options);
    if (!tracing) continue;
    for (std::size_t k = 0; k < facet.arrangement.edges.size(); ++k)
      if (facet.arrangement.edges[k].curve >= 0)
        add_line(static_cast<int>(f), static_cast<int>(k), tracing.value().edges[k].points);
  }
  for (Line& line : lines_) refine(&line, tolerance, angle);
  for (int k = 0; k < count(); ++k) remember(k);
}

/// Where the surface's normal turns by an angle over a length l, it leaves a triangle of that size
/// by about angle l / 6.
void FacetLines::refine(Line* line, double tolerance, double angle) {
  constexpr int kMostPieces = 1000;
  const auto normal = [&](int p) { return unit(functions_[line->surface].gradient(points_[p])); };
  for (std::size_t k = 0; k + 1 < line->points.size() && line->points.size() < kMostPieces;) {
    const int p = line->points[k], q = line->points[k + 1];
    const double turn = length(normal(q) - normal(p));
    const double away = turn * length(points_[q] - points_[p]) / 6;
    if (turn > angle || away > 0.5 * tolerance)
      line->points.insert(line->points.begin() + static_cast<std::ptrdiff_t>(k) + 1,
                          place_between(*line, p, q));
    else
      ++k;
  }
}

void FacetLines::add_line(int facet, int edge, const std::vector<Point<2>>& polyline) {
  const Facet& of = encasement_.facets[facet];
  const PlaneChart chart(encasement_.planes[of.plane].exact());
  Line line;
  line.facet = facet;
  line.surface = of.surfaces[of.arrangement.edges[edge].curve];
  const auto add = [&](const Point<2>& p) {
    points_.push_back(chart.lift(p));
    const int place = static_cast<int>(points_.size()) - 1;
    add_to_side(of.plane, place);
    return place;
  };
  const int first = of.arrangement.half_edges[2 * edge].origin;
  const int last = of.arrangement.half_edges[2 * edge + 1].origin;
  line.points.push_back(first >= 0 ? facet_points_[of.points[first]] : add(polyline.front()));
  for (std::size_t k = 1; k + 1 < polyline.size(); ++k) line.points.push_back(add(polyline[k]));
  line.points.push_back(last >= 0 ? facet_points_[of.points[last]] : line.points.front());
  const std::size_t least = first >= 0 ? 3 : 4;
  while (line.points.size() < least)
    line.points.insert(line.points.begin() + 1,
                       place_between(line, line.points[0], line.points[1]));
  number_[{facet, edge}] = static_cast<int>(lines_.size());
  lines_.push_back(std::move(line));
}

void FacetLines::remember(int line) {
  const std::vector<int>& points = lines_[line].points;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
    of_segment_[ascending(points[k], points[k + 1])] = line;
}

/// A new point of the surface in the facet's plane, near the middle of two.
int FacetLines::place_between(const Line& line, int from, int to) {
  const Plane& plane = encasement_.planes[encasement_.facets[line.facet].plane];
  const Point<3> normal = unit(plane.normal);
  const Point<3> middle = 0.5 * (points_[from] + points_[to]);
  Point<3> point = middle;
  for (int step = 0; step < 8; ++step) {
    const auto f = functions_[line.surface].value_and_gradient(point);
    const Point<3> slope = f.gradient - dot(f.gradient, normal) * normal;
    const double square = dot(slope, slope);
    if (!(square > 0)) break;
    point = point - (f.value / square) * slope;
  }
  // A point of another branch would be no help.
  if (!(length(point - middle) < 0.5 * length(points_[to] - points_[from]))) point = middle;
  points_.push_back(point);
  const int place = static_cast<int>(points_.size()) - 1;
  add_to_side(encasement_.facets[line.facet].plane, place);
  return place;
}

void FacetLines::add_to_side(int plane, int point) {
  if (plane < 0 || plane >= static_cast<int>(encasement_.region_used.sides.size())) return;
  PointSides& sides = sides_.emplace(point, kWithin).first->second;
  sides[sides[0] < 0 ? 0 : 1] = plane;
}

PointSides FacetLines::sides(int point) const {
  const auto found = sides_.find(point);
  return found == sides_.end() ? kWithin : found->second;
}

int FacetLines::line(const FacetEdge& edge) const {
  const auto found = number_.find({edge.facet, Arrangement::edge_of(edge.half_edge)});
  return found == number_.end() ? -1 : found->second;
}

std::vector<int> FacetLines::along(const FacetEdge& edge) const {
  const int number = line(edge);
  if (number < 0) return {};
  std::vector<int> points = lines_[number].points;
  if (edge.half_edge % 2 == 1) std::reverse(points.begin(), points.end());
  points.pop_back();
  return points;
}

FacetLines::Division FacetLines::divide(const std::pair<int, int>& segment) {
  const auto found = of_segment_.find(ascending(segment.first, segment.second));
  if (found == of_segment_.end()) return {};
  const int number = found->second;
  Line& line = lines_[number];
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k)
    if (ascending(line.points[k], line.points[k + 1]) == found->first) {
      const int middle = place_between(line, line.points[k], line.points[k + 1]);
      line.points.insert(line.points.begin() + static_cast<std::ptrdiff_t>(k) + 1, middle);
      of_segment_.erase(found);
      for (const std::size_t i : {k, k + 1})
        of_segment_[ascending(line.points[i], line.points[i + 1])] = number;
      return {number, middle};
    }
  return {};
}

}  // namespace encase
