// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "encase/surface_encasement.hpp"
#include "written.hpp"

namespace encase::topology {

inline NamedSurface surface(const std::string& name, const std::string& text) {
  return {name, written::polynomial<3>(text)};
}

inline Polyhedron cube(const Rational& half) {
  return make_box({-half, -half, -half}, {half, half, half}).value();
}

/// V - E + F of a surface, made of its patches, each a disc (or a sphere), along the loops of which
/// edges and vertices are counted once. A loop without a vertex counts as an edge with one.
inline long euler_characteristic(const SurfaceEncasement& e, int surface) {
  std::set<std::pair<int, int>> edges;
  std::set<int> vertices;
  long loops = 0, faces = 0;
  for (const SpaceCell& cell : e.cells)
    for (const SurfacePatch& patch : cell.patches) {
      if (patch.surface != surface) continue;
      faces += patch.loop.empty() ? 2 : 1;
      for (const FacetEdge& at : patch.loop) {
        const Facet& facet = e.facets[static_cast<std::size_t>(at.facet)];
        const bool is_new = edges.emplace(at.facet, at.half_edge / 2).second;
        const int from =
            facet.arrangement.half_edges[static_cast<std::size_t>(at.half_edge)].origin;
        if (from >= 0)
          vertices.insert(facet.points[static_cast<std::size_t>(from)]);
        else if (is_new)
          ++loops;
        const int to =
            facet.arrangement.half_edges[static_cast<std::size_t>(at.half_edge ^ 1)].origin;
        if (to >= 0) vertices.insert(facet.points[static_cast<std::size_t>(to)]);
      }
    }
  return static_cast<long>(vertices.size()) + loops - static_cast<long>(edges.size()) + faces;
}

/// Of a pair's intersection curve the components that end at the region's boundary, and those that
/// are closed.
struct CurveComponents {
  int open = 0, closed = 0;
  bool operator==(const CurveComponents&) const = default;
};
inline CurveComponents curve_components(const SurfaceEncasement& e, int f, int g) {
  std::map<int, std::vector<int>> neighbours;
  for (const SpaceCell& cell : e.cells)
    for (const SurfaceArc& arc : cell.arcs) {
      if (arc.surfaces != std::array{f, g}) continue;
      neighbours[arc.ends[0]].push_back(arc.ends[1]);
      neighbours[arc.ends[1]].push_back(arc.ends[0]);
    }
  CurveComponents result;
  std::set<int> seen;
  for (const auto& [start, unused] : neighbours) {
    if (!seen.insert(start).second) continue;
    std::vector<int> stack{start};
    bool open = false;
    while (!stack.empty()) {
      const int at = stack.back();
      stack.pop_back();
      open = open || neighbours[at].size() == 1;
      for (const int next : neighbours[at])
        if (seen.insert(next).second) stack.push_back(next);
    }
    ++(open ? result.open : result.closed);
  }
  return result;
}

/// Triple points in certified cells.
inline int triple_points(const SurfaceEncasement& e) {
  int count = 0;
  for (const TriplePoint& point : e.triple_points) count += point.cell >= 0 ? 1 : 0;
  return count;
}

}  // namespace encase::topology
