// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/result.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"

/// Needs VTK: component `vtk`.
namespace encase {

/// Writes an encasement of surfaces as `result.vtm` with the blocks `cells`, `facets`, `surfaces`,
/// `intersection_curves`, `points`, `critical_regions` and `unresolved`; with `history` also
/// `history.pvd`: the facets after each cut, in at most 200 steps. docs/vtk.md lists the arrays.
/// Curves and meshes are the encasement's. Errors, and what is complete when, as write_vtk of
/// vtk.hpp.
Status write_vtk(const SurfaceEncasement& encasement, const IntersectionTracing& curves,
                 const std::vector<SurfaceMesh>& meshes, const std::string& directory,
                 bool history = false);

}  // namespace encase
