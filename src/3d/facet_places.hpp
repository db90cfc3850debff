// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "3d/leaf_contacts.hpp"
#include "encase/slice.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// Where a facet is: a convex polygon in a plane, between two cells or a cell and the outside.
struct FacetPlace {
  int plane = -1;  ///< the first of those that are the same
  std::array<int, 2> cells{-1, -1};
  Box<3> extent;  ///< with the plane it tells the polygon
  Region polygon;
  std::vector<int> side_planes;
};

/// A region as cells see it.
struct SolidRegion {
  Polyhedron polyhedron;
  Box<3> root;          ///< of the partition: around the polyhedron
  bool is_box = false;  ///< the polyhedron is the root; its sides are lower x, upper x, ...
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

/// All facets of the cells, which are the parts of the leaves' boxes in the region. In an order
/// that depends on the partition only.
std::vector<FacetPlace> facet_places(const BoxPartition& partition, const SolidRegion& region,
                                     const std::vector<Box<3>>& leaf_boxes, PlaneCharts& charts);

}  // namespace encase
