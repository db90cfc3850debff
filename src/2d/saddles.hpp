// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "2d/partition.hpp"

namespace encase {

/// Approximate saddles of a curve's polynomial, one in or near each box in which Newton's iteration
/// for a critical point stays. Nothing is proved, some may be missing.
void append_saddles(TiledFunction& f, int curve, const std::vector<Box<2>>& boxes,
                    std::vector<Saddle>* saddles);

}  // namespace encase
