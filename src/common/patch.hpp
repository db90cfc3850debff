// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

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
  double left_out = 0;  ///< what `expand` has left out of the value, by the low degree

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

/// The patch with `count` coefficients in either variable (at least patch_count of the tile's
/// degree) on a box inside the tile's rectangle, rows along x.
void expand(const Tile& tile, const Box<2>& box, int count, Patch* patch);

/// The halves across an axis (their rows run along the other one). Without `whole`, of a half on
/// which f has a proved sign only that is valid: lo, hi and radius. `patch` may be one of the
/// halves.
void halve(const Patch& patch, int axis, bool whole, Patch* lower, Patch* upper);

/// What a patch proves about critical points.
struct CriticalVerdict {
  bool excluded = false;  ///< as no_relevant_critical_point (box_tests.hpp), with little effort
  /// How much f changes along x and along y, unless excluded: the largest difference of
  /// neighbouring coefficients.
  std::array<double, 2> variation{};
};
CriticalVerdict test_critical(const Patch& patch);

}  // namespace encase
