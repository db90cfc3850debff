// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "3d/surface_bounds.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// The sides of the region in which a point lies, ascending; -1: none.
using PointSides = std::array<int, 2>;
inline constexpr PointSides kWithin{-1, -1};

/// A side in which both points lie; -1: none.
inline int common_side(const PointSides& a, const PointSides& b) {
  for (const int side : a)
    if (side >= 0 && (side == b[0] || side == b[1])) return side;
  return -1;
}

/// What proofs about a mesh use of a point of it.
struct Corner {
  Point<3> at{};
  PointSides sides = kWithin;
  double size = 0;  ///< at least |f|
  /// The unit gradient there, up to rounding, within the sides that the point lies in; zero where
  /// these are nearly parallel.
  Point<3> direction{};
  /// As far as this along the direction and its opposite it is not farther into any other side of
  /// the region than that lies away.
  double room = 0;
};

/// Makes corners of meshes of one surface.
class MeshCorners {
 public:
  /// Both are to outlive this.
  MeshCorners(const SurfaceEncasement& encasement, const SurfaceBounds& surface);

  Corner corner(const Point<3>& at, const PointSides& sides) const;

  int side_count() const { return static_cast<int>(sides_.size()); }
  /// How far a point lies beyond a side; negative within the region.
  double beyond(int side, const Point<3>& p) const;
  /// Points nearer than this to a side count as lying in it.
  double near() const { return 0x1p-44 * size_; }
  /// From such points to where they would lie exactly, at most.
  double moved() const { return 0x1p-40 * size_; }
  /// Triangles farther apart than this are so wherever their corners are moved.
  double margin() const { return 4 * moved(); }

 private:
  /// A unit normal that points outward.
  struct Side {
    Point<3> normal;
    double offset;
  };

  const SurfaceBounds& surface_;
  double size_;  ///< of the region
  std::vector<Side> sides_;
};

}  // namespace encase
