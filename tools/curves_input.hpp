// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/curves_file.hpp"
#include "encase/result.hpp"

namespace encase {

/// The curves of a file ("-": standard input) or, if there are any, of expressions, and the region:
/// what `region` says, else the file. BadInput if both say nothing and `region_needed` holds.
Result<CurvesFile> read_curves_input(const std::string& file,
                                     const std::vector<std::string>& expressions,
                                     const std::string& region, bool region_needed);

}  // namespace encase
