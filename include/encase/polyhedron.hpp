// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/result.hpp"

namespace encase {

using Plane = Hyperplane<3>;

/// The half space a x + b y + c z + d <= 0.
using HalfSpace = std::array<Rational, 4>;

/// A closed convex polyhedron with exact sides: bounded, and with an interior.
struct Polyhedron {
  std::vector<HalfSpace> sides;           ///< as given; some may add nothing
  std::vector<RationalPoint<3>> corners;  ///< in lexicographic order

  /// The smallest box with double bounds that contains the polyhedron.
  Box<3> bounding_box() const;
};

/// The most half spaces a polyhedron may be given by.
inline constexpr int kMaxSides = 100;

/// The common part of half spaces. BadInput if it is empty, has no interior or is not bounded, if
/// one of the half spaces is everything or nothing, or there are more than kMaxSides.
Result<Polyhedron> make_polyhedron(std::vector<HalfSpace> half_spaces);

/// The box lo[0] <= x <= hi[0], ...; BadInput unless lo[i] < hi[i].
Result<Polyhedron> make_box(const RationalPoint<3>& lo, const RationalPoint<3>& hi);

}  // namespace encase
