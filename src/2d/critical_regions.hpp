// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/subdivision.hpp"
#include "common/tile.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// The critical regions of one curve, with the proof that they are complete.
struct CriticalRegions {
  std::vector<CriticalRegion> regions;
  /// The subdivided box and its tokens (encase/cover.hpp); k >= 0 names regions[k].
  Box<2> root_box;
  std::vector<int> tokens;
  /// Leaves in which neither the curve nor its critical points could be excluded.
  std::vector<Box<2>> unresolved;
  /// Leaves in which a critical point of another kind was not excluded: saddles are in these.
  std::vector<Box<2>> other_points;
  int boxes = 0;
};

/// Finds boxes that contain every local maximum of |f| in the part of a box on the negative side of
/// the half planes, f being of one sign on each, joined to connected regions (thesis 3.1, with
/// Bernstein enclosures in place of its quadratic Taylor bound). The curve has no singular point
/// outside the unresolved boxes. `curve` is written into the regions. The tiles cover `root`, the
/// box.
CriticalRegions critical_regions(TiledFunction& f, int curve, const Box<2>& root,
                                 const std::vector<Line>& half_planes,
                                 const SubdivisionLimits& limits, Kernel& kernel);
CriticalRegions critical_regions(const FilteredFunction<2>& f, int curve, const Box<2>& box,
                                 const std::vector<Line>& half_planes,
                                 const SubdivisionLimits& limits, Kernel& kernel);

/// Joins boxes that touch: the index of its component for every box, components numbered from 0 in
/// the order of their first boxes.
std::vector<int> connected_components(const std::vector<Box<2>>& boxes);

}  // namespace encase
