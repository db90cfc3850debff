// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <tuple>
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

/// A facet's side: a part of the common line of two planes.
struct SidePart {
  int facet = -1;
  int side = 0;
  std::array<int, 2> line{};  ///< its planes, ascending
  int plane = -1;             ///< the facet's
  bool forward = false;       ///< the line's coordinate grows along the side
  Rational lo, hi;            ///< of the coordinate: the first that changes along the line

  /// Parts of equal chains follow each other along the line, and do not overlap.
  auto chain() const { return std::tuple(line, plane, forward); }
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

  /// The sides of all facets, chain by chain in the order of the coordinate. Made when first asked.
  const std::vector<SidePart>& side_parts() const;

  /// The sign of a function at a corner of the boundary, which is no zero of a surface that the
  /// facet has.
  Sign sign_at_corner(int surface, int facet) const;

 private:
  const FacetComplex& complex_;
  int cell_;
  const std::vector<int>& facets_;
  mutable std::vector<SidePart> side_parts_;
};

}  // namespace encase
