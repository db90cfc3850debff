// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "common/bernstein.hpp"
#include "common/box_tests.hpp"
#include "encase/geometry.hpp"

/// Small tensor Bernstein nets of polynomials in three variables, what subdivisions of space work
/// with. docs/error-bounds.md derives their radii.
namespace encase {

/// A polynomial on a box, in the box's coordinates [-1,1]^3: a Bernstein net of `count`
/// coefficients in each variable (degree count - 1), as count planes of count lines of 8 or 16
/// lanes; lanes from `count` on repeat the last one. Which variables belong to planes, lines and
/// lanes is said by its SpaceSystem.
struct SpaceNet {
  static constexpr int kMaxCount = 16;

  double* rows = nullptr;  ///< aligned to 64 bytes
  int count = 0;
  double lo = 0, hi = 0;  ///< the extreme coefficients
  double radius = 0;      ///< of the coefficients' distances from the exact ones

  /// The sign the polynomial is proved to have on the closed box.
  std::optional<Sign> sign() const {
    if (lo > radius) return Sign::Positive;
    if (hi < -radius) return Sign::Negative;
    return std::nullopt;
  }
  double magnitude() const { return hi > -lo ? hi : -lo; }
  static int lanes(int count) { return count <= 8 ? 8 : 16; }
  /// How many doubles its rows are.
  static int size(int count) { return count * count * lanes(count); }
};

/// Three nets on one box.
struct SpaceSystem {
  std::array<SpaceNet, 3> nets;
  std::array<int, 3> order{0, 1, 2};  ///< the variables of planes, lines and lanes
};

/// Takes over a net of equal degrees in all variables, at most kMaxCount - 1.
void copy(const Bernstein<3>& from, const std::array<int, 3>& order, SpaceNet* to);

/// The halves of net k across the variable order[position]. Their rows belong to a system whose
/// order is as `order_of_halves` says.
void halve(const SpaceNet& net, int position, SpaceNet* lower, SpaceNet* upper);
std::array<int, 3> order_of_halves(const std::array<int, 3>& order, int position);

/// What the nets of a box prove about common zeros.
struct SpaceVerdict {
  bool excluded = false;  ///< there is none; what follows is for the other case
  Box<3> zeros;           ///< all lie in this part of [-1,1]^3
  /// As box_tests' contraction, if it was found with the quality asked for.
  bool contracts = false;
  Contraction<3> contraction;
  /// How much the Jacobian varies along each axis, as far as a halving helps; zero: not known.
  Point<3> bend{};
};
void test_system(const SpaceSystem& system, double quality, SpaceVerdict* verdict);

}  // namespace encase
