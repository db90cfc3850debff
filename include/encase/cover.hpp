// SPDX-License-Identifier: MIT
#pragma once

/// A subdivision of a box, as tokens in preorder. A split token is followed by the subtree of the
/// lower half, then that of the upper half; the cut is at `lo + (hi - lo) / 2`, exact in doubles.
namespace encase::cover {

inline constexpr int kSplitX = -1;
inline constexpr int kSplitY = -2;
inline constexpr int kSplitZ = -3;
inline constexpr int kExcluded = -4;    ///< nothing of what is sought lies in the box
inline constexpr int kOutside = -5;     ///< the box lies outside the region used
inline constexpr int kUnresolved = -6;  ///< lies in a box of `degenerate` or `undecided`
// A token k >= 0 names item k: what the box can contain belongs to that item.

}  // namespace encase::cover
