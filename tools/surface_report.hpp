// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"

namespace encase {

/// What a person reads of an encasement of surfaces: its status, the common points of three
/// surfaces, the curves in which two meet, the surfaces' shapes, what resists.
std::string report(const SurfaceEncasement& encasement);

/// A line for every mesh: its size, and how close it is proved to be.
std::string mesh_report(const SurfaceEncasement& encasement,
                        const std::vector<SurfaceMesh>& meshes);

/// What the steps of the algorithm did.
std::string statistics_report(const SurfaceEncasement& encasement);

}  // namespace encase
