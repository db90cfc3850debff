// SPDX-License-Identifier: MIT
#include "encase/surface_topology.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "common/union_find.hpp"

namespace encase {

namespace {

/// One surface's patches with the edges of facets in which they meet: a complex of discs and
/// spheres, segments and circles, and points.
class PatchComplex {
 public:
  PatchComplex(const SurfaceEncasement& e, int surface) : e_(e) {
    for (const SpaceCell& cell : e.cells) {
      const bool certified = cell.state == CellState::Certified;
      if (!certified && cell.signs[surface] == Sign::Zero) shape_.complete = false;
      for (const SurfacePatch& patch : cell.patches)
        if (patch.surface == surface) add(patch);
    }
    shape_.surface = surface;
  }

  SurfaceTopology shape() {
    SurfaceTopology shape = shape_;
    UnionFind joined(static_cast<std::size_t>(shape.patches));
    UnionFind loops(points_.size());
    std::set<int> on_boundary;
    for (const auto& [edge, use] : edges_) {
      for (const int patch : use.patches) joined.join(use.patches[0], patch);
      if (!on_region_boundary(edge.first)) continue;
      // A circle on the boundary is a loop of its own.
      if (use.points.empty()) ++shape.boundary_loops;
      for (const int p : use.points) {
        loops.join(point_number(use.points[0]), point_number(p));
        on_boundary.insert(point_number(p));
      }
    }
    for (int k = 0; k < shape.patches; ++k) shape.components += joined.find(k) == k;
    shape.boundary_loops += count_sets(on_boundary, loops);
    for (const auto& [edge, use] : edges_) shape.euler -= use.points.empty() ? 0 : 1;
    shape.euler += static_cast<int>(points_.size());
    return shape;
  }

 private:
  struct EdgeUse {
    std::vector<int> patches;
    std::vector<int> points;  ///< facet points at its ends; none on a circle without any
  };

  void add(const SurfacePatch& patch) {
    const int number = shape_.patches++;
    shape_.euler += patch.loop.empty() ? 2 : 1;
    for (const FacetEdge& edge : patch.loop) {
      EdgeUse& use = edges_[{edge.facet, Arrangement::edge_of(edge.half_edge)}];
      use.patches.push_back(number);
      if (use.patches.size() > 1) continue;
      const Facet& facet = e_.facets[edge.facet];
      for (const int h : {edge.half_edge, Arrangement::twin(edge.half_edge)}) {
        const int origin = facet.arrangement.half_edges[h].origin;
        if (origin < 0) continue;
        use.points.push_back(facet.points[origin]);
        points_.emplace(facet.points[origin], static_cast<int>(points_.size()));
      }
    }
  }

  int point_number(int facet_point) const { return points_.at(facet_point); }

  bool on_region_boundary(int facet) const {
    const auto& cells = e_.facets[facet].cells;
    return cells[0] < 0 || cells[1] < 0;
  }

  static int count_sets(const std::set<int>& members, UnionFind& sets) {
    std::set<int> roots;
    for (const int k : members) roots.insert(sets.find(k));
    return static_cast<int>(roots.size());
  }

  const SurfaceEncasement& e_;
  SurfaceTopology shape_;
  std::map<std::pair<int, int>, EdgeUse> edges_;  ///< by facet and its arrangement's edge
  std::map<int, int> points_;                     ///< facet points, numbered
};

}  // namespace

std::vector<SurfaceTopology> surface_topology(const SurfaceEncasement& encasement) {
  std::vector<SurfaceTopology> shapes;
  for (int k = 0; k < static_cast<int>(encasement.surfaces.size()); ++k)
    shapes.push_back(PatchComplex(encasement, k).shape());
  return shapes;
}

}  // namespace encase
