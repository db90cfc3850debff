// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "common/cubic_system.hpp"
#include "common/tile.hpp"

/// What the cubic nets of two polynomials are made from. docs/error-bounds.md derives the radii.
namespace encase {

/// A polynomial on a box, in the box's coordinates [-1,1]^2, from which cubic nets on the box and
/// its parts are made: a tensor Chebyshev net of degree 7.
struct CubicSource {
  alignas(64) std::array<std::array<double, 8>, 8> c;
  int rows_axis;          ///< whose Chebyshev polynomials the rows belong to (0: x)
  int count;              ///< of rows and lanes; all others are zero
  double size;            ///< at least the sum of the coefficients' absolute values
  double left_out;        ///< the part of the radius that is due to terms of higher degree
  double radius;          ///< bounds the distance of values
  Point<2> slope_radius;  ///< bounds on the distance of partial derivatives, in x and y

  /// The polynomial is proved to have a sign on the closed box.
  bool has_sign() const;
};
/// On a box inside the tile's rectangle.
void expand(const Tile& tile, const Box<2>& box, CubicSource* source);

/// The cubic nets of the sources, which lie alike, on their box: terms of higher degree are left
/// out.
void cut_off(const std::array<CubicSource, 2>& sources, CubicSystem* system);

/// The sources on a part of their box, and the cubic nets there, as above. `to` may not be `from`.
void restrict_to(const std::array<CubicSource, 2>& from, const Part& part,
                 std::array<CubicSource, 2>* to, CubicSystem* system);

/// The sources on a box and the cubic nets there.
struct SystemPatch {
  std::array<CubicSource, 2> source;
  CubicSystem net;
};

/// The same on the four quarters of their box; bit 0 of a quarter's number: it is the upper one in
/// x, bit 1: in y. `from` may not be among them.
void quarter(const std::array<CubicSource, 2>& from, SystemPatch* quarters);

}  // namespace encase
