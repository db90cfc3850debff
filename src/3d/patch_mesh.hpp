// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "3d/facet_lines.hpp"
#include "3d/field_chart.hpp"
#include "3d/triangle_bounds.hpp"

namespace encase {

/// What a mesh is to meet.
struct MeshGoal {
  double tolerance = 0;
  double angle = 0;
  double least_length = 0;  ///< edges shorter than this are not divided
};

/// Triangles of one patch of a surface, between points of a list shared with other patches.
class PatchMesh {
 public:
  struct Triangle {
    std::array<int, 3> corners;     ///< places in this mesh
    std::array<int, 3> neighbours;  ///< across the edge from corner i to the next; -1: none
    TriangleBounds bounds;
    bool given_up = false;
    bool too_large = false;  ///< whatever is proved of it
  };

  /// `points` is added to; all but the chart are to outlive this. The lines of the chart meet the
  /// surface at most once in the box of the certificate.
  PatchMesh(const FieldChart& chart, const GraphCertificate& graph, SurfaceModels& models,
            const MeshCorners& corner_maker, const FacetLines& lines, const MeshGoal& goal,
            std::vector<Point<3>>* points)
      : chart_(chart),
        graph_(graph),
        models_(models),
        surface_(models.surface()),
        corner_maker_(corner_maker),
        lines_(lines),
        goal_(goal),
        points_(*points) {}

  /// Triangles between the points of a closed boundary, in its order.
  bool fill(const std::vector<int>& boundary);
  /// An octahedron around the centre of the field. False if its corners are not found.
  bool surround(const Box<3>& cell);
  /// Puts points on edges of the boundary, which are given by their ends, ascending. False if the
  /// triangles there would be turned over: then nothing else is to be asked of this.
  bool divide_boundary(const std::map<std::pair<int, int>, int>& middles);
  /// Divides triangles until they meet the goal, as far as that is possible without new points on
  /// the boundary and with no more than `most` of them.
  void refine(int most);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// To be divided when this is refined again.
  void find_too_large(int triangle) { triangles_[triangle].too_large = true; }
  /// The smallest one that contains it.
  Box<3> box() const;
  /// A corner's place in the list of points.
  int point(int corner) const { return ids_[corner]; }
  const Corner& corner(int corner) const { return corners_[corner]; }
  /// Edges of the boundary that stand in the way of the goal, by the places of their points.
  const std::vector<std::pair<int, int>>& too_long() const { return too_long_; }

 private:
  int add(int id);
  const Point<3>& at(int corner) const { return corners_[corner].at; }
  bool positive(int a, int b, int c) const {
    return chart_.positive(coordinates_[a], coordinates_[b], coordinates_[c]);
  }
  void join_neighbours();
  int chord_of(const Triangle& triangle) const;
  bool lift(const FieldChart::Line& line, double guess, Point<3>* point) const;
  bool crowds_boundary(const Point<3>& point);
  void blame_boundary(int triangle);
  void divide(int triangle, std::vector<int>* changed);
  bool split(int triangle, int edge, std::vector<int>* changed);
  bool wants_flip(int triangle, int edge) const;
  void flip(int triangle, int edge);
  void make_delaunay(std::vector<int> work, std::vector<int>* changed);
  int edge_towards(int triangle, int neighbour) const;
  void replace_neighbour(int triangle, int before, int after);

  FieldChart chart_;
  const GraphCertificate& graph_;
  SurfaceModels& models_;
  const SurfaceBounds& surface_;
  const MeshCorners& corner_maker_;
  const FacetLines& lines_;
  const MeshGoal& goal_;
  std::vector<Point<3>>& points_;
  std::vector<int> ids_;
  std::vector<Corner> corners_;
  std::vector<Point<3>> coordinates_;
  std::vector<Triangle> triangles_;
  std::vector<std::pair<int, int>> boundary_;  ///< its edges, by the places of their points
  std::vector<std::pair<int, int>> too_long_;
};

}  // namespace encase
