// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/encasement.hpp"
#include "exit_code.hpp"
#include "request.hpp"

namespace encase {

/// What `encase curves` was asked for.
struct CurvesRequest : Request {
  std::string onto;     ///< a result to whose curves these are added, or empty
  bool faces = false;   ///< in the SVG and the mesh
  bool labels = false;  ///< in the SVG
  EncaseOptions options;
};

/// Reads, encases, writes the files asked for and reports. Errors go to standard error.
ExitCode run_curves(CurvesRequest request);

}  // namespace encase
