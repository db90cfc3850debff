// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "3d/leaf_contacts.hpp"
#include "encase/slice.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// Where a facet is: a convex polygon in a plane, between two cells or a cell and the outside.
struct FacetPlace {
  int plane = -1;
  std::array<int, 2> cells{-1, -1};
  Box<3> extent;  ///< with the plane it tells the polygon
  Region polygon;
  std::vector<int> side_planes;
};

/// A region as cells see it.
struct SolidRegion {
  Polyhedron polyhedron;
  bool is_box = false;  ///< the partition's root is the polyhedron
};

/// The charts of planes, each made once.
class PlaneCharts {
 public:
  explicit PlaneCharts(const std::vector<Plane>& planes) : planes_(planes) {}
  const PlaneChart& of(int plane);

 private:
  const std::vector<Plane>& planes_;
  std::vector<std::optional<PlaneChart>> charts_;
};

/// A surface on a facet's plane: of an expression its numerator, which is what cells are told of.
/// In certified cells both have the same zeros; the sign of a denominator may depend on the plane.
Function<2> on_facet(const PlaneChart& chart, const Function<3>& surface);

/// All facets of the cells, which are the parts of the leaves' boxes in the region. In an order
/// that depends on the partition only.
std::vector<FacetPlace> facet_places(const BoxPartition& partition, const SolidRegion& region,
                                     PlaneCharts& charts);

}  // namespace encase
