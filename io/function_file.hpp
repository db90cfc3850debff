// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "encase/function.hpp"
#include "encase/polyhedron.hpp"
#include "encase/region.hpp"
#include "encase/result.hpp"

/// Files of curves (D = 2) and surfaces (D = 3), as text or JSON.
namespace encase {

template <int D>
using RegionIn = std::conditional_t<D == 2, Region, Polyhedron>;

/// What a file says.
template <int D>
struct FunctionFile {
  std::vector<NamedFunction<D>> functions;  ///< at least one, none constant, names all different
  std::optional<RegionIn<D>> region;        ///< nothing if the file names none
};

/// Reads the text format, or JSON where the first character that is not blank is `{`. `source` is
/// what errors call the text.
template <int D>
Result<FunctionFile<D>> read_functions(const std::string& text, const std::string& source);

/// Reads a file; "-" is standard input. Io if it cannot be read or is a directory.
template <int D>
Result<FunctionFile<D>> load_functions(const std::string& path);

}  // namespace encase
