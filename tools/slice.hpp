// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/slice.hpp"
#include "exit_code.hpp"
#include "request.hpp"

namespace encase {

/// What `encase slice` was asked for.
struct SliceRequest : Request {
  std::string plane;
  int count = 0;  ///< so many parallel planes; 0: the plane itself
  EncaseOptions options;
};

/// Reads, slices, writes the files asked for and reports. Errors go to standard error.
ExitCode run_slice(SliceRequest request);

}  // namespace encase
