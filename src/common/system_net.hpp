// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/box_tests.hpp"
#include "common/interval.hpp"
#include "common/patch.hpp"
#include "encase/geometry.hpp"

/// Patches of two polynomials: what the search for their common zeros works with.
/// docs/error-bounds.md derives their radii.
namespace encase {

/// Two polynomials on one box, in the box's coordinates [-1,1]^2. The patches have as many
/// coefficients, and rows along the same axis.
struct SystemNet {
  std::array<Patch, 2> of;

  /// One of the polynomials is proved to have a sign on the closed box.
  bool excluded() const { return of[0].sign() || of[1].sign(); }
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

/// The nets on a part of their box. `to` may not be `from`.
void restrict_to(const SystemNet& from, const Part& part, SystemNet* to);

/// The nets on the four quarters of their box. Of those in a half across the rows that is `empty`
/// nothing is said, and it is set where a half is excluded; `excluded`: quarters. Quarter k + 2 m:
/// half k across the rows, half m across the lanes.
void quarter(const SystemNet& from, std::array<bool, 2>* empty, SystemNet* const* quarters,
             bool* excluded);

/// What the nets prove about the common zeros.
struct SystemVerdict {
  SystemVerdict() {}  // nothing is set: most of it is seldom needed

  bool excluded;  ///< there is none in the closed box
  Box<2> zeros;   ///< all of them lie here, in the coordinates of the box
  bool contracts;
  Contraction<2> contraction;  ///< if it contracts: there is at most one, a simple one
};
void test_system(const SystemNet& net, double quality, SystemVerdict* verdict);

/// How much the polynomials change along x and along y, each beside its size: the largest
/// differences of neighbouring coefficients.
std::array<double, 2> relative_variation(const SystemNet& net);

}  // namespace encase
