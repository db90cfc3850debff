// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/polyhedron.hpp"

namespace encase {

/// Which sides of a region cut boxes, and whether boxes have a part of the region; exact.
class RegionSides {
 public:
  /// Keeps a reference.
  explicit RegionSides(const Polyhedron& region);

  std::vector<int> all() const;
  /// Of some sides those that cut the box; the box lies within the others. Nothing of those left
  /// out may cut it. `empty`: the box has no interior point in the region.
  std::vector<int> across(const Box<3>& box, const std::vector<int>& sides, bool* empty) const;

 private:
  bool has_interior(const Box<3>& box, const std::vector<int>& sides) const;

  const Polyhedron& region_;
  std::vector<Plane> planes_;
};

}  // namespace encase
