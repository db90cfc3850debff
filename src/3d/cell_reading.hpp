// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "3d/cell_boundary.hpp"
#include "3d/space_partition.hpp"

namespace encase {

/// What is needed to read cells.
struct ReadingScene {
  const FacetComplex& complex;
  const std::vector<FacetPoint>& points;
  const std::vector<TriplePoint>& triple_points;
  const std::vector<char>& inside;  ///< whether a triple point lies in the region used
  const std::vector<GraphCertificate>& graphs;
  const std::vector<PairCertificate>& pairs;
  /// (grad f x grad g) . w of each list of critical points.
  const std::vector<FilteredFunction<3>>& directions;
};

/// What a certified leaf consists of.
struct Reading {
  enum class Kind {
    Certified,
    Ambiguous,    ///< to be split, perhaps as `hint` says
    Inconsistent  ///< its parts do not fit together
  };
  Kind kind = Kind::Certified;
  std::string reason;  ///< unless certified
  std::optional<CutHint> hint;
  std::vector<SurfacePatch> patches;
  std::vector<SurfaceArc> arcs;
};

/// Reads the patches and arcs of a leaf from its facets, all of them certified. docs/surfaces.md
/// proves that the reading is right.
Reading read_cell(const ReadingScene& scene, int cell, const SpacePartition::Leaf& leaf,
                  const std::vector<int>& facets);

}  // namespace encase
