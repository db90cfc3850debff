// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/tile.hpp"

/// What patches are made from. docs/error-bounds.md derives the radii.
namespace encase {

/// A polynomial on a box, in the box's coordinates [-1,1]^2: a tensor Chebyshev net of degree 7.
struct ChebyshevNet {
  alignas(64) std::array<std::array<double, 8>, 8> c;
  int rows_axis;          ///< whose Chebyshev polynomials the rows belong to (0: x)
  double size;            ///< at least the sum of the coefficients' absolute values
  double left_out;        ///< the part of the radius that is due to terms of higher degree
  double radius;          ///< bounds the distance of values
  Point<2> slope_radius;  ///< bounds on the distance of partial derivatives, in x and y
};
/// On a box inside the tile's rectangle.
void expand(const Tile& tile, const Box<2>& box, ChebyshevNet* net);

}  // namespace encase
