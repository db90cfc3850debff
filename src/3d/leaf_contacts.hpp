// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/surface_encasement.hpp"

namespace encase {

/// A binary partition of a box by axis-parallel planes, all different, as SpacePartition's.
struct BoxPartition {
  const std::vector<Plane>& planes;
  const std::vector<Split>& history;
  Box<3> root;
  /// The planes of the root's sides: lower x, upper x, lower y, ...; -1 where that is no plane.
  std::array<int, 6> root_planes{-1, -1, -1, -1, -1, -1};
};

/// Where the boxes of two leaves touch, or a leaf's box the outside of the root: a rectangle.
struct LeafContact {
  int plane = -1;
  std::array<int, 2> leaves{-1, -1};  ///< on the plane's negative and positive side; -1: outside
  Box<3> rectangle;                   ///< without extent across the plane
  std::array<int, 6> bounds{};        ///< planes of its sides, as BoxPartition's root_planes
};

/// The leaves' boxes, and the planes of their sides as BoxPartition's root_planes.
struct BoundedLeaf {
  Box<3> box;
  std::array<int, 6> bounds{};
};
std::vector<BoundedLeaf> bounded_leaves(const BoxPartition& partition);

/// Every pair of leaves whose boxes have a rectangle in common, and every rectangle of a leaf's box
/// in a side of the root that is a plane. In an order that depends on the partition only. Cost:
/// proportional to what is found, times the depth.
std::vector<LeafContact> leaf_contacts(const BoxPartition& partition);

}  // namespace encase
