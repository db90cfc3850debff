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

/// Parts of [-1,1] that halvings lead to have numbers: 1 the whole, and n has the halves 2n and
/// 2n + 1; 0 where they are too small to be told apart.
inline std::int64_t number_of_half(std::int64_t number, bool upper) {
  return number == 0 || number >> 50 != 0 ? 0 : 2 * number + upper;
}

/// The sources on a part of their box, and the cubic nets there, as above. `to` may not be `from`.
void restrict_to(const std::array<CubicSource, 2>& from, const Part& part,
                 std::array<CubicSource, 2>* to, CubicSystem* system);

/// The same on the part with these numbers along x and y, which are not 0.
void restrict_to(const std::array<CubicSource, 2>& from, const std::array<std::int64_t, 2>& number,
                 std::array<CubicSource, 2>* to, CubicSystem* system);

}  // namespace encase
