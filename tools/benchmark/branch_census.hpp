// SPDX-License-Identifier: MIT
#pragma once

#include "encase/encasement.hpp"

namespace encase::benchmark {

/// How the curves of a certified encasement run, each curve for itself.
struct BranchCensus {
  int branches = 0;       ///< between two points of the region's boundary
  int bare_branches = 0;  ///< those among them without a crossing
  int ovals = 0;
  int bare_ovals = 0;
};

BranchCensus branch_census(const Encasement& encasement);

/// What no partition by lines goes below, or hardly: a cell for each crossing and each branch
/// without one, two for each oval without one.
int least_cells(const Encasement& encasement);

}  // namespace encase::benchmark
