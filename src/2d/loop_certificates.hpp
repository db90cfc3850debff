// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "2d/cell_at_hand.hpp"

namespace encase {

/// Proves that no loop in the cell surrounds a critical region inside it: a segment from the region
/// to the cell's boundary on which the curve has no point. A loop around the region would have to
/// cross it. Nothing if none of the segments tried is free of the curve.
std::optional<LoopCertificate> certify_no_loop(CellAtHand& at_hand, int critical_region);

}  // namespace encase
