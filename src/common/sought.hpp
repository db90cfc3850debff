// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "common/tile.hpp"
#include "encase/cover.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// What is to be subdivided: leaves of a subdivision of `root` that is begun.
template <int N>
struct Sought {
  /// The token of the leaves that are subdivided; the others stay as they are.
  static constexpr int kLeaf = cover::kUnresolved - 1;
  /// Such a leaf, and the polynomials with tiles that cover it.
  struct Leaf {
    Box<2> box;
    std::array<TiledFunction*, N> polynomials;
  };
  Box<2> root;
  std::vector<int> tokens;
  std::vector<Leaf> leaves;  ///< in the order of the tokens
};

/// A whole box.
template <int N>
Sought<N> sought_in(const Box<2>& box, const std::array<TiledFunction*, N>& polynomials) {
  Sought<N> sought;
  sought.root = box;
  sought.tokens = {Sought<N>::kLeaf};
  sought.leaves.push_back({box, polynomials});
  return sought;
}

}  // namespace encase
