// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "encase/surface_encasement.hpp"
#include "exit_code.hpp"

namespace encase {

/// What `encase surfaces` was asked for.
struct SurfacesRequest {
  std::string file;                      ///< "-" is standard input; empty: `expressions`
  std::vector<std::string> expressions;  ///< of -e
  std::string region;                    ///< of --region, overrides the file's
  std::string json;
  std::string mesh;
  std::string vtk_directory;
  bool history = false;
  double tolerance = 0;  ///< of curves and meshes; 0: 10^-3 of the region's size
  double angle = 0.2;    ///< of meshes: between triangles' and surfaces' normals
  bool summary = false;
  bool quiet = false;
  bool verbose = false;
  SurfaceOptions options;
};

/// Reads, encases, writes the files asked for and reports. Errors go to standard error.
ExitCode run_surfaces(SurfacesRequest request);

}  // namespace encase
