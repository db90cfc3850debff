// SPDX-License-Identifier: MIT
#pragma once

#include "3d/surface_models.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"

namespace encase {

/// A proved bound of the distances of all points of the mesh's surface in the region used from the
/// mesh; infinite if nothing is proved. docs/meshes.md has the argument. The models are the
/// surface's.
double cover_distance(const SurfaceMesh& mesh, const SurfaceEncasement& encasement,
                      SurfaceModels& models);

}  // namespace encase
