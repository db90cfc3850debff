// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "exit_code.hpp"

namespace encase {

/// Reads a result and re-proves it. The objections, if any, go to standard output, one a line.
ExitCode run_check(const std::string& file, bool quiet);

}  // namespace encase
