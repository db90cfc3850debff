// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "3d/mesh_corner.hpp"
#include "common/filtered_function.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// The edges of all facets' arrangements that lie on surfaces, as polylines in space. Patches on
/// both sides of a facet share them.
class FacetLines {
 public:
  /// All are to outlive this. Points go to the list `points`. Between two of them that follow each
  /// other the surface's normal turns by at most about `angle`. Every polyline has at least three
  /// points, a closed one three different ones: no two have the same points in a row.
  FacetLines(const SurfaceEncasement& encasement, const std::vector<FilteredFunction<3>>& functions,
             double tolerance, double angle, std::vector<Point<3>>* points);

  /// The points along a half-edge, but for the last one.
  std::vector<int> along(const FacetEdge& edge) const;
  /// The number of an edge.
  int line(const FacetEdge& edge) const;
  int count() const { return static_cast<int>(lines_.size()); }
  /// The sides of the region in which a point of a line lies.
  PointSides sides(int point) const;

  /// Puts a point between two that follow each other; gives the line's number, or -1, and the
  /// point.
  struct Division {
    int line = -1;
    int middle = -1;
  };
  Division divide(const std::pair<int, int>& segment);

 private:
  struct Line {
    int facet = -1;
    int surface = -1;
    std::vector<int> points;  ///< a closed one ends where it begins
  };
  void add_line(int facet, int edge, const std::vector<Point<2>>& polyline);
  int place_between(const Line& line, int from, int to);
  void refine(Line* line, double tolerance, double angle);
  void remember(int line);
  void add_to_side(int plane, int point);

  const SurfaceEncasement& encasement_;
  const std::vector<FilteredFunction<3>>& functions_;
  std::vector<Point<3>>& points_;
  std::vector<int> facet_points_;    ///< their places in `points`
  std::map<int, PointSides> sides_;  ///< of points in some
  std::vector<Line> lines_;
  std::map<std::pair<int, int>, int> number_;      ///< by facet and edge
  std::map<std::pair<int, int>, int> of_segment_;  ///< the line, by two points, ascending
};

}  // namespace encase
