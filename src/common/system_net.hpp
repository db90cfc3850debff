// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/box_tests.hpp"
#include "common/interval.hpp"
#include "common/patch.hpp"
#include "encase/geometry.hpp"

/// Nets of two polynomials: what the search for their common zeros works with.
/// docs/error-bounds.md, section 11, derives their radii.
namespace encase {

/// Two polynomials on one box: patches of one size, their rows along one axis. (Nothing is said of
/// second derivatives.)
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

/// The nets on a part of their box, transposed. `to` may not be `from`.
void restrict_to(const SystemNet& from, const Part& part, SystemNet* to);

/// The nets on the quarters of their box, transposed: number k + 2 m lies in half k across the rows
/// and in half m across the lanes. Of those in a half across the rows that is `empty` nothing is
/// said; it is set for a half on which one polynomial is proved to have a sign. Returns for every
/// other quarter whether that is so; only of the others are there nets. `from` may not be among
/// them.
std::array<bool, 4> quarter(const SystemNet& from, std::array<bool, 2>* empty, SystemNet* quarters);

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
