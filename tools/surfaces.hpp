// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/surface_encasement.hpp"
#include "exit_code.hpp"
#include "request.hpp"

namespace encase {

/// What `encase surfaces` was asked for.
struct SurfacesRequest : Request {
  double tolerance = 0;  ///< of curves and meshes; 0: 10^-3 of the region's size
  double angle = 0.2;    ///< of meshes: between triangles' and surfaces' normals
  SurfaceOptions options;
};

/// Reads, encases, writes the files asked for and reports. Errors go to standard error.
ExitCode run_surfaces(SurfacesRequest request);

}  // namespace encase
