// SPDX-License-Identifier: MIT
#pragma once

#include "encase/caps.hpp"
#include "exit_code.hpp"
#include "request.hpp"

namespace encase {

/// What `encase caps` was asked for.
struct CapsRequest : Request {
  CapsOptions options;
};

/// Reads, subdivides, writes the files asked for and reports. Errors go to standard error.
ExitCode run_caps(CapsRequest request);

}  // namespace encase
