// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "3d/cell_reading.hpp"

namespace encase {

/// A leaf whose patches are known.
struct PatchedCell {
  const ReadingScene& scene;
  const SpacePartition::Leaf& leaf;
  const CellBoundary& boundary;
  const std::vector<BoundaryLoop>& loops;  ///< of every patch; of a closed sphere an empty one
};

/// Adds the arcs in which pairs of surfaces meet in the leaf, with the triple points on them.
///
/// The ends of the arcs of a pair are the points where both meet a facet. The arcs' direction w
/// enters the cell at one end of each and leaves it at the other. An arc lies on one patch of
/// either surface, along it (grad f x grad g) . w keeps its sign, w grows from its beginning to its
/// end, and no two arcs on a patch, which is a disc, cross: their ends do not alternate on its
/// boundary. If only one way to pair the ends obeys that, it is the right one.
void match_arcs(const PatchedCell& cell, Reading* reading);

}  // namespace encase
