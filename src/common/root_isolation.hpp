// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/cover.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// All common zeros of a system in a convex region of a box, with the proof that the list is
/// complete.
template <int D>
struct RootIsolation {
  /// Pairwise disjoint boxes; each holds exactly one common zero, simple, in its interior. Some may
  /// lie outside the half spaces.
  std::vector<Box<D>> roots;
  /// For every root whether it is proved that the box's centre is the zero, correctly rounded.
  /// Empty if that is not asked.
  std::vector<bool> rounded;
  /// The subdivided box and its tokens (encase/cover.hpp): a leaf is excluded, outside, unresolved,
  /// or names root k: a box that contains the leaf and roots[k] holds at most one common zero.
  Box<D> root_box;
  std::vector<int> tokens;
  /// The leaves that stayed unresolved.
  std::vector<Box<D>> unresolved;
  int boxes = 0;
};

}  // namespace encase
