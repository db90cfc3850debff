// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "common/bernstein_tables.hpp"
#include "common/tile.hpp"
#include "encase/geometry.hpp"

/// Polynomials of degree up to 15 in one variable in Bernstein form, on SIMD units: what the search
/// for roots on lines consists of. All instruction sets give the same bits.
namespace encase {

/// Which of the values in a row are proved to be positive, which negative: bit j for value j.
struct SignBits {
  std::uint32_t positive = 0;
  std::uint32_t negative = 0;
};

/// The Bernstein coefficients of a polynomial on [0, 1], zeros beyond its degree, and the signs of
/// those that exceed a threshold.
struct alignas(64) LineNet {
  std::array<double, BernsteinTables::kSize + 2> b{};
  SignBits signs;
};

/// The polynomial of a tile on the segment origin + direction s, |s| <= 1, in the tile's
/// coordinates, from its values at the nodes of the tables. Its coefficients each err by at most
/// interpolation_roundings(degree) u values_norm sum |a_ij| S^i T^j, if |s| <= S and |t| <= T on
/// the segment, up to the tile's reach. Here and below `degree` is that of the tables, at least the
/// tile's.
void interpolate(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                 const BernsteinTables& tables, double threshold, LineNet* net);

/// The same by Taylor's coefficients in s, slower, with errors of at most
/// substitution_roundings(degree) u sum |a_ij| kReach^(i+j). Without signs.
void substitute(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                const BernsteinTables& tables, LineNet* net);

/// Restricts to the halves, or to the parts below and above a fraction of the way; `upper` may be
/// `net`. Adds an error of at most cutting_roundings(degree) u max |b|. Requires that fraction is a
/// multiple of 2^-10.
void halve(const LineNet& net, const BernsteinTables& tables, double threshold, LineNet* lower,
           LineNet* upper);
void cut(const LineNet& net, const BernsteinTables& tables, double fraction, double threshold,
         LineNet* lower, LineNet* upper);

/// The signs of the coefficients that exceed a threshold, and of the differences of neighbours.
SignBits signs(const LineNet& net, int degree, double threshold);
SignBits rises(const LineNet& net, int degree, double threshold);

/// The largest absolute value of a coefficient.
double largest_coefficient(const LineNet& net);

/// How far a net's function is from the net: the value, the first and the second derivative.
struct NetErrors {
  double value, slope, bend;
};
/// Where a net's function is proved to change sign, just once and with a slope that is not zero.
struct SignChange {
  enum class Verdict { Found, TooMuchBend, TooMuchError } verdict;
  double lo, hi;
  double at;  ///< about where
};
/// Finds the sign change of a function that has opposite signs at 0 and 1 (`rises`: the positive
/// one at 1) and is monotone, or such that the net changes sign just once, also after a shift by no
/// more than the errors. These are to include those of the coefficients; `largest` is at least the
/// largest coefficient. Requires degree >= 2.
SignChange find_sign_change(const LineNet& net, const BernsteinTables& tables, bool rises,
                            double largest, const NetErrors& errors);

/// The value of a tile's polynomial at s, to within value_roundings(degree) u sum |a_ij|
/// kReach^(i+j).
double value_at(const Tile& tile, const Point<2>& s);

/// At least sum |a_ij| reach_0^i reach_1^j, and hardly more. The reach is not negative, at most
/// Tile::kReach.
double largest_value(const Tile& tile, const Point<2>& reach);

constexpr int interpolation_roundings(int degree) { return 3 * degree + 8; }
constexpr int substitution_roundings(int degree) { return 4 * degree + 12; }
constexpr int cutting_roundings(int degree) { return 2 * degree + 3; }
constexpr int value_roundings(int degree) { return 2 * degree + 20; }

}  // namespace encase
