// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "2d/curve_bounds.hpp"
#include "encase/caps.hpp"
#include "verify_claims.hpp"

/// The claims of a CAPS result. Nothing here trusts the search: what is asked are statements about
/// boxes and segments (`curve_bounds.hpp`, `side_roots.hpp`).
namespace encase::verification {

struct CapsClaims : Reporter {
  CapsClaims(const CapsResult& r, const VerifyOptions& options) : Reporter(options), result(r) {}

  const CapsLeaf& leaf(int k) const { return result.leaves[static_cast<std::size_t>(k)]; }
  const std::vector<int>& curves_of(const CapsLeaf& l) const {
    return result.curve_sets[static_cast<std::size_t>(l.curves)];
  }
  const std::vector<int>& curves_of(const CapsRegion& r) const {
    return result.curve_sets[static_cast<std::size_t>(r.curves)];
  }
  CurveBounds& curve(int c) { return curves[static_cast<std::size_t>(c)]; }

  const CapsResult& result;
  std::vector<CurveBounds> curves{};
};

/// Two leaves that share a piece of a side, which lies across the axis.
struct SharedSide {
  int lower = -1;
  int upper = -1;
  int axis = 0;
};

/// All of them, of leaves that tile a box.
std::vector<SharedSide> shared_sides(const CapsResult& result);

/// Each vertex is what it is called, and the edges are those that follow from the leaves, the
/// curves' zeros on their sides and what is proved of the vertices. Of an undecided result: those
/// that are called proved do follow.
void check_caps_graph(CapsClaims& claims, const std::vector<SharedSide>& sides);

}  // namespace encase::verification
