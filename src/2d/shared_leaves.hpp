// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "2d/nested_tiles.hpp"
#include "common/kernel.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// One subdivision of a box for many curves.
struct SharedLeaves {
  SharedCover cover;
  std::vector<Box<2>> boxes;       ///< of the leaves, as in cover.alive
  std::vector<Box<2>> unresolved;  ///< the leaves that were open when it was stopped
  int visited = 0;                 ///< boxes, leaves included
};

/// Subdivides the box that the curves' tiles cover, common to all, until few curves are left in a
/// leaf or halving takes none away. A curve is dropped where it is proved to have no zero; boxes
/// outside one of the half planes (positive side) are left out. `stop`, asked now and then, ends
/// it: what is open then stays unresolved. Cost: linear in the curves alive in the boxes visited.
SharedLeaves share_leaves(NestedTiles& curves, const std::vector<Line>& half_planes,
                          const std::function<bool()>& stop, Kernel& kernel);

/// Two curves that are alive in a common leaf, and all such leaves.
struct MeetingPair {
  std::array<int, 2> curves{};  ///< ascending
  std::vector<Box<2>> leaves;
  Box<2> hull;  ///< of the leaves
};

/// All of them, in lexicographic order.
std::vector<MeetingPair> meeting_pairs(const SharedLeaves& leaves);

/// For each of `count` curves the hull of the leaves in which it is alive; one of negative widths
/// for a curve that is alive in none.
std::vector<Box<2>> hulls_of_curves(const SharedLeaves& leaves, int count);

/// The root of a subdivision for what lies in `part`: a box around it inside `whole`, a subdivision
/// root, or `whole` itself where the part is hardly smaller.
Box<2> root_around(const Box<2>& part, const Box<2>& whole);

}  // namespace encase
