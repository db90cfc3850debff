// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "common/box_tests.hpp"
#include "common/tile.hpp"
#include "encase/geometry.hpp"

/// Small tensor Bernstein nets of one size for polynomials of any degree: what subdivisions of the
/// plane work with. docs/error-bounds.md derives their radii.
namespace encase {

/// A polynomial f on a box, in the box's coordinates [-1,1]^2: a tensor Bernstein net of `count`
/// coefficients in either variable (degree count - 1), and how far f may be from it. The rows of
/// the net run along `rows_axis` (0: x); lanes from `count` on repeat the last one.
struct Patch {
  static constexpr int kMaxCount = 8;

  alignas(64) std::array<std::array<double, 8>, 8> b;
  int count = 0;
  int rows_axis = 0;
  double lo = 0, hi = 0;  ///< the extreme coefficients
  /// Bounds on the distance between f and the net: of values, of partial derivatives (across rows,
  /// across lanes), and of second ones (twice across rows, twice across lanes, mixed).
  double radius = 0;
  std::array<double, 2> slope_radius{};
  std::array<double, 3> bend_radius{};

  /// The sign f is proved to have on the closed box.
  std::optional<Sign> sign() const {
    if (lo > radius) return Sign::Positive;
    if (hi < -radius) return Sign::Negative;
    return std::nullopt;
  }
  double magnitude() const { return hi > -lo ? hi : -lo; }
};

/// The number of coefficients in either variable that patches of polynomials up to a degree have.
int patch_count(int degree);

/// What replacing a monomial s^k, k >= 8, by its interpolant of degree 7 costs on [-1,1]: bounds on
/// the difference and its first two derivatives.
struct InterpolationLoss {
  double value, slope, bend;
};
const InterpolationLoss& interpolation_loss(int k);

/// The same for a tile's polynomial on parts of its rectangle with half widths up to the fraction
/// `part` of the tile's, in the coordinates of the part.
InterpolationLoss interpolation_loss(const Tile& tile, double part);

/// The patch with `count` coefficients in either variable (at least patch_count of the tile's
/// degree) on a box inside the tile's rectangle, rows along x.
void expand(const Tile& tile, const Box<2>& box, int count, Patch* patch);

/// The halves across an axis (their rows run along the other one). Without `whole`, of a half on
/// which f has a proved sign only that is valid: lo, hi and radius. `patch` may be one of the
/// halves.
void halve(const Patch& patch, int axis, bool whole, Patch* lower, Patch* upper);

/// What the patches of two polynomials on one box, of equal counts, prove about their common zeros.
struct SystemVerdict {
  SystemVerdict() {}  // nothing is set: most of it is seldom needed

  bool excluded;  ///< there is none in the closed box
  Box<2> zeros;   ///< all of them lie here, in the coordinates of the box
  bool contracts;
  Contraction<2> contraction;  ///< if it contracts: there is at most one, a simple one
};
void test_system(const Patch& f, const Patch& g, double quality, SystemVerdict* verdict);

/// Makes the rows run along the other axis.
void turn(Patch* patch);

/// How much f changes along x and along y: the largest difference of neighbouring coefficients.
std::array<double, 2> variation(const Patch& patch);

/// What a patch proves about critical points.
struct CriticalVerdict {
  bool excluded = false;  ///< as no_relevant_critical_point (box_tests.hpp), with little effort
  std::array<double, 2> variation{};  ///< as above; unless excluded
};
CriticalVerdict test_critical(const Patch& patch);

}  // namespace encase
