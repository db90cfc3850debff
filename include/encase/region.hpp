// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/geometry.hpp"
#include "encase/result.hpp"

namespace encase {

/// A closed convex polygon with exact corners in counter-clockwise order, no three on a line; or
/// the whole plane.
struct Region {
  std::vector<RationalPoint<2>> corners;
  bool plane = false;  ///< without corners

  /// Side k from corner k to corner k + 1; the inside is its negative side.
  Line side(int k) const;
  int side_count() const { return static_cast<int>(corners.size()); }
  /// The smallest box with double bounds that contains the region.
  Box<2> bounding_box() const;
};

/// The whole plane.
inline Region whole_plane() { return {{}, true}; }

/// Takes corners in either orientation, drops those within a side, and rejects polygons that are
/// not convex or have no area (BadInput, naming the corner).
Result<Region> make_region(std::vector<RationalPoint<2>> corners);

/// The rectangle [xmin, xmax] x [ymin, ymax]; BadInput unless xmin < xmax and ymin < ymax.
Result<Region> make_region(const Rational& xmin, const Rational& xmax, const Rational& ymin,
                           const Rational& ymax);

}  // namespace encase
