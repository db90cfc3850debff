// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/verify.hpp"
#include "exit_code.hpp"

namespace encase {

/// What `encase check` was asked for.
struct CheckRequest {
  std::string file;  ///< "-" is standard input
  bool quiet = false;
  VerifyOptions options;
};

/// Reads a result and re-proves it. The objections, if any, go to standard output, one a line.
ExitCode run_check(const CheckRequest& request);

}  // namespace encase
