// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "2d/caps_tree.hpp"
#include "2d/curve_bounds.hpp"
#include "encase/caps.hpp"

namespace encase {

/// Groups the leaves of `tree` into regions, sets the leaves' `region`, and lists the regions'
/// neighbours. `singular_apart`: leaves of one curve that is no graph there make regions of their
/// own.
std::vector<CapsRegion> label_regions(CapsTree& tree, bool singular_apart);

struct CapsGraph {
  std::vector<CapsVertex> vertices;
  std::vector<CapsEdge> edges;
  bool cut_short = false;  ///< what was left is not proved
};

/// The graph of vertices and edges; marks the regions where two curves are proved to be apart.
/// `stop` is asked now and then; true ends the proofs.
CapsGraph make_graph(const CapsTree& tree, std::vector<CapsRegion>& regions,
                     std::vector<CurveBounds>& curves, bool polylines,
                     const std::function<bool()>& stop);

}  // namespace encase
