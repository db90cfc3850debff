// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "3d/facet_places.hpp"
#include "common/filtered_function.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// Facets of a certified partition with their points, as cells are read from them.
struct FacetComplex {
  const std::vector<FilteredFunction<3>>& surfaces;
  const std::vector<Plane>& planes;
  const std::vector<const Facet*>& facets;
  PlaneCharts& charts;
  Kernel& kernel;
};

/// A loop of a surface on a cell's boundary, as SurfacePatch's.
struct BoundaryLoop {
  std::vector<FacetEdge> edges;
  std::vector<int> points;  ///< where each edge begins, in `facet_points`; -1 without vertices
};

/// The boundary of a cell: a sphere made of its facets.
class CellBoundary {
 public:
  /// The facets of the cell by index, all certified.
  CellBoundary(const FacetComplex& complex, int cell, const std::vector<int>& facets)
      : complex_(complex), cell_(cell), facets_(facets) {}

  const std::vector<int>& facets() const { return facets_; }
  const Facet& facet(int index) const { return *complex_.facets[static_cast<std::size_t>(index)]; }
  /// Whether the cell lies on the negative side of the facet's plane, so that the plane's normal
  /// points out of the cell.
  bool is_below(int index) const { return facet(index).cells[0] == cell_; }
  /// The curve of a surface on a facet, or -1.
  int curve_of(int index, int surface) const;

  /// The loops of a surface, each once. Nothing if its arcs on the facets do not form loops.
  std::optional<std::vector<BoundaryLoop>> loops(int surface) const;

  /// The number of connected components of the part of some of the facets, the union of which is a
  /// disc or the whole boundary, where a surface's function has a sign.
  int components(int surface, Sign sign, const std::function<bool(int facet)>& is_included) const;

  /// The sign of a function at a corner of the boundary, which is no zero of a surface that the
  /// facet has.
  Sign sign_at_corner(int surface, int facet) const;

 private:
  const FacetComplex& complex_;
  int cell_;
  const std::vector<int>& facets_;
};

}  // namespace encase
