// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/encasement.hpp"

namespace encase {

/// What no partition by lines goes below, or hardly: a cell for each crossing, one for each branch
/// without a crossing and two for each oval without one. Told from cells that are all certified;
/// the first `sides` lines are the region's.
int least_cells(const std::vector<Cell>& cells, const std::vector<LineCrossing>& line_crossings,
                int sides);

inline int least_cells(const Encasement& encasement) {
  return least_cells(encasement.cells, encasement.line_crossings,
                     encasement.region_used.side_count());
}

}  // namespace encase
