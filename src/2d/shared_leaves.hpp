// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "2d/nested_tiles.hpp"
#include "common/kernel.hpp"
#include "common/sought.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// Two curves that are alive in a common leaf.
struct Meeting {
  int first, second;  ///< the curves, ascending
  int leaf;
  bool apart;  ///< proved to have no common zero in the leaf
};

/// One subdivision of a box for many curves.
struct SharedLeaves {
  /// The way from the root to a leaf: bit k belongs to the halving number k.
  struct Path {
    std::uint64_t across_y = 0;  ///< the box is halved across y
    std::uint64_t upper = 0;     ///< the leaf is in the upper half
    int length = 0;
  };
  SharedCover cover;
  std::vector<Box<2>> boxes;       ///< of the leaves, as in cover.alive
  std::vector<Path> paths;         ///< likewise
  std::vector<Meeting> meetings;   ///< of all leaves, sorted by curves
  std::vector<Box<2>> unresolved;  ///< the leaves that were open when it was stopped
  int visited = 0;                 ///< boxes, leaves included
};

/// Subdivides the box that the curves' tiles cover, common to all, until few curves are left in a
/// leaf or halving takes none away. A curve is dropped where it is proved to have no zero; boxes
/// outside one of the half planes (positive side) are left out. `stop`, asked now and then, ends
/// it: what is open then stays unresolved. Cost: linear in the curves alive in the boxes visited.
SharedLeaves share_leaves(NestedTiles& curves, const std::vector<Line>& half_planes,
                          const std::function<bool()>& stop, Kernel& kernel);

/// Two curves that meet in some leaf.
struct MeetingPair {
  std::array<int, 2> curves{};  ///< ascending
  std::span<const Meeting> meetings;

  /// In how many leaves they may have common zeros.
  std::size_t open() const {
    return static_cast<std::size_t>(
        std::count_if(meetings.begin(), meetings.end(), [](const Meeting& m) { return !m.apart; }));
  }
};

/// All of them, in lexicographic order. `leaves` must outlive them.
std::vector<MeetingPair> meeting_pairs(const SharedLeaves& leaves);

/// The smallest box that has all leaves in which a pair meets.
Box<2> hull(const SharedLeaves& leaves, const MeetingPair& pair);

/// The leaves in which a pair meets, in the smallest part of the subdivision that has them; all
/// else there is excluded.
Sought<2> sought_in(const SharedLeaves& leaves, const MeetingPair& pair, NestedTiles& curves);

/// For each of `count` curves the hull of the leaves in which it is alive; one of negative widths
/// for a curve that is alive in none.
std::vector<Box<2>> hulls_of_curves(const SharedLeaves& leaves, int count);

/// The root of a subdivision for what lies in `part`: a box around it inside `whole`, a subdivision
/// root, or `whole` itself where the part is hardly smaller.
Box<2> root_around(const Box<2>& part, const Box<2>& whole);

}  // namespace encase
