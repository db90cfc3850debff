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

}  // namespace encase
