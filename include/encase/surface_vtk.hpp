// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/result.hpp"
#include "encase/surface_encasement.hpp"

/// Needs VTK: component `vtk`.
namespace encase {

struct SurfaceVtkOptions {
  double tolerance = 0;  ///< of curves and meshes, in input units; 0: 10^-3 of the region's size
  bool history = false;  ///< also `history.pvd`: the facets after each cut, in at most 200 steps
};

/// Writes an encasement of surfaces as `result.vtm` with the blocks `cells`, `facets`, `surfaces`,
/// `intersection_curves`, `points`, `critical_regions` and `unresolved`; docs/vtk.md lists the
/// arrays. Errors, and what is complete when, as write_vtk of vtk.hpp.
Status write_vtk(const SurfaceEncasement& encasement, const std::string& directory,
                 const SurfaceVtkOptions& options = {});

}  // namespace encase
