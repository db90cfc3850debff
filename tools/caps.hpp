// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/caps.hpp"
#include "exit_code.hpp"

namespace encase {

/// What `encase caps` was asked for.
struct CapsRequest {
  std::string file;                      ///< "-" is standard input; empty: `expressions`
  std::vector<std::string> expressions;  ///< of -e
  std::string region;                    ///< of --region, overrides the file's
  std::string json;
  std::string svg;
  std::string vtk_directory;
  bool summary = false;
  bool quiet = false;
  bool verbose = false;
  CapsOptions options;
};

/// Reads, subdivides, writes the files asked for and reports. Errors go to standard error.
ExitCode run_caps(CapsRequest request);

}  // namespace encase
