// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/polyhedron.hpp"
#include "encase/result.hpp"
#include "encase/slice.hpp"

namespace encase {

struct SurfacesInput {
  std::vector<NamedSurface> surfaces;
  Polyhedron region;
};

/// The surfaces of a file ("-": standard input) or, if there are any, of expressions, and the
/// region: what `region` says, else the file. BadInput if both say nothing.
Result<SurfacesInput> read_surfaces_input(const std::string& file,
                                          const std::vector<std::string>& expressions,
                                          const std::string& region);

}  // namespace encase
