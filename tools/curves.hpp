// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "exit_code.hpp"

namespace encase {

/// What `encase curves` was asked for.
struct CurvesRequest {
  std::string file;                      ///< "-" is standard input; empty: `expressions`
  std::vector<std::string> expressions;  ///< of -e
  std::string region;                    ///< of --region, overrides the file's
  std::string onto;                      ///< a result to whose curves these are added, or empty
  std::string json;
  std::string svg;
  bool faces = false;   ///< in the SVG and the mesh
  bool labels = false;  ///< in the SVG
  std::string mesh;
  std::string vtk_directory;
  bool history = false;
  bool summary = false;
  bool quiet = false;
  bool verbose = false;
  EncaseOptions options;
};

/// Reads, encases, writes the files asked for and reports. Errors go to standard error.
ExitCode run_curves(CurvesRequest request);

}  // namespace encase
