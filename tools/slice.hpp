// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/slice.hpp"
#include "exit_code.hpp"

namespace encase {

/// What `encase slice` was asked for.
struct SliceRequest {
  std::string file;                      ///< "-" is standard input; empty: `expressions`
  std::vector<std::string> expressions;  ///< of -e
  std::string region;                    ///< of --region, overrides the file's
  std::string plane;
  int count = 0;  ///< so many parallel planes; 0: the plane itself
  std::string json;
  std::string svg;
  std::string vtk_directory;
  bool summary = false;
  bool quiet = false;
  bool verbose = false;
  EncaseOptions options;
};

/// Reads, slices, writes the files asked for and reports. Errors go to standard error.
ExitCode run_slice(SliceRequest request);

}  // namespace encase
