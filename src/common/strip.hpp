// SPDX-License-Identifier: MIT
#pragma once

#include "common/patch.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// Where the zeros of a polynomial on a box lie, in the box's coordinates: between two parallel
/// lines, lo <= slope * s <= hi. docs/error-bounds.md says why.
struct Strip {
  Point<2> slope{};
  double lo = 0, hi = 0;
};
Strip strip_of(const Patch& patch);

/// Whether it is proved that no point of the closed box lies in both strips.
bool apart(const Strip& a, const Strip& b);

/// Whether it is proved that two polynomials, of which patches on one box are given and their
/// strips, have no common zero there: their strips are apart or, if the nets have one size and
/// lie alike, one of the two combinations that the strips' slopes suggest keeps a sign.
bool apart(const Patch& f, const Strip& a, const Patch& g, const Strip& b);

}  // namespace encase
