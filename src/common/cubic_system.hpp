// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/box_tests.hpp"
#include "common/interval.hpp"
#include "common/patch.hpp"
#include "encase/geometry.hpp"

/// Cubic nets of two polynomials side by side: what the search for their common zeros works with.
/// docs/error-bounds.md derives their radii.
namespace encase {

/// Two polynomials on a box, in the box's coordinates [-1,1]^2: tensor Bernstein nets of degree 3,
/// and how far the polynomials may be from them. Row i has the coefficients of the first polynomial
/// in the lanes 0 to 3, those of the second one in the lanes 4 to 7.
struct CubicSystem {
  alignas(64) std::array<std::array<double, 8>, 4> b;
  int rows_axis = 0;                 ///< along which the rows run (0: x)
  std::array<double, 2> lo{}, hi{};  ///< the extreme coefficients
  std::array<double, 2> radius{};    ///< bounds on the distance of values
  /// Bounds on the distance of partial derivatives: of either polynomial, across rows and lanes.
  std::array<std::array<double, 2>, 2> slope_radius{};

  double magnitude(int i) const { return hi[i] > -lo[i] ? hi[i] : -lo[i]; }
  /// One of the polynomials is proved to have a sign on the closed box.
  bool excluded() const {
    return lo[0] > radius[0] || hi[0] < -radius[0] || lo[1] > radius[1] || hi[1] < -radius[1];
  }
};

/// A part of a box, in the coordinates of the box: origin +- half.
struct Part {
  Point<2> origin, half;
};
using Chart = std::array<Centered, 2>;
inline Chart chart_of(const Box<2>& box) {
  return {centered(box.lo[0], box.hi[0]), centered(box.lo[1], box.hi[1])};
}
Part part_of(const Chart& chart, const Box<2>& box);

/// Cubic nets on a part of the box of others.
void restrict_to(const CubicSystem& from, const Part& part, CubicSystem* system);

/// The halves across an axis (their rows run along the other one), and for each whether it is
/// excluded; then nothing else is said of it. `system` may be one of the halves.
std::array<bool, 2> halve(const CubicSystem& system, int axis, CubicSystem* lower,
                          CubicSystem* upper);

/// What the nets prove about the common zeros.
struct SystemVerdict {
  SystemVerdict() {}  // nothing is set: most of it is seldom needed

  bool excluded;  ///< there is none in the closed box
  Box<2> zeros;   ///< all of them lie here, in the coordinates of the box
  bool contracts;
  Contraction<2> contraction;  ///< if it contracts: there is at most one, a simple one
};
void test_system(const CubicSystem& system, double quality, SystemVerdict* verdict);

/// How much the polynomials change along x and along y, each beside its size: the largest
/// differences of neighbouring coefficients.
std::array<double, 2> relative_variation(const CubicSystem& system);

}  // namespace encase
