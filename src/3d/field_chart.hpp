// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/geometry.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// Lines that a patch of a surface meets once, as points of a plane or, of a closed surface around
/// a centre, as directions: those of a graph certificate's field V, or others that are less steep.
/// In doubles: what is made with it is proved elsewhere.
class FieldChart {
 public:
  /// For a patch that is a disc with this boundary, its left side inside seen from where V points,
  /// and the surface's normals there. If these are nearly parallel, and the boundary is simple
  /// seen from their mean, lines are parallel to that. Else they are rays from near all normals, if
  /// these are less steep than V, or lines of V. Parallel lines go to points of a plane across
  /// them, rays stereographically to a plane, from a direction outside of the patch.
  FieldChart(const GraphCertificate& graph, const std::vector<Point<3>>& boundary,
             const std::vector<Point<3>>& normals);
  /// For a closed surface around the centre of V.
  explicit FieldChart(const GraphCertificate& graph);

  /// Two of a plane and 0, or a direction. Means of them are coordinates too.
  Point<3> coordinates(const Point<3>& point) const;
  /// Whether three lines are in counter-clockwise order seen from where V points; proved of the
  /// coordinates as they are.
  bool positive(const Point<3>& a, const Point<3>& b, const Point<3>& c) const;

  struct Line {
    Point<3> at, along;  ///< along V, of length 1
  };
  Line line(const Point<3>& coordinates) const;

 private:
  enum class Kind { Parallel, Stereographic, Directions };
  void look_from(const Point<3>& middle);
  void look_around(const Point<3>& centre, double outward, const std::vector<Point<3>>& boundary);
  bool is_simple(const std::vector<Point<3>>& boundary) const;
  std::vector<Point<3>> images(const std::vector<Point<3>>& points) const;

  Kind kind_ = Kind::Parallel;
  Point<3> origin_{};  ///< of the coordinates, or the centre of V
  Point<3> u_{}, v_{}, w_{};
  double outward_ = 1;  ///< -1: V points towards the centre
};

}  // namespace encase
