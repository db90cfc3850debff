// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/surface_encasement.hpp"

namespace encase {

/// The shape of a surface in the region used, as its patches and the facets' edges tell.
struct SurfaceTopology {
  int surface = -1;
  int components = 0;
  /// Euler's characteristic: a sphere has 2, a disc 1, a torus 0.
  int euler = 0;
  int patches = 0;
  int boundary_loops = 0;  ///< closed curves on the region's boundary
  /// No cell that may meet the surface is left uncertified. If false, the counts are those of the
  /// certified part.
  bool complete = true;
};

/// Of every surface. Cost: linear in the size of the encasement.
std::vector<SurfaceTopology> surface_topology(const SurfaceEncasement& encasement);

}  // namespace encase
