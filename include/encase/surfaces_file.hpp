// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "encase/polyhedron.hpp"
#include "encase/result.hpp"
#include "encase/slice.hpp"

/// Surfaces, regions of space and planes from text. The formats are described in docs/command.md.
/// Errors are BadInput and name the source, line and column, and show the line with a caret below
/// the place.
namespace encase {

/// What a file of surfaces says.
struct SurfacesFile {
  std::vector<NamedSurface> surfaces;  ///< at least one, none constant, names all different
  std::optional<Polyhedron> region;    ///< nothing if the file names none
};

/// Reads the text format, or JSON where the first character that is not blank is `{`. `source` is
/// what errors call the text, usually the file's name.
Result<SurfacesFile> read_surfaces(const std::string& text, const std::string& source);

/// Reads a file; "-" is standard input. Io if it cannot be read or is a directory.
Result<SurfacesFile> load_surfaces(const std::string& path);

/// Reads `box x0 x1 y0 y1 z0 z1` or `halfspaces (a,b,c,d) ...`.
Result<Polyhedron> parse_solid_region(const std::string& text,
                                      const std::string& source = "region");

/// Reads `a b c d`, the plane a x + b y + c z + d = 0.
Result<std::array<Rational, 4>> parse_plane(const std::string& text,
                                            const std::string& source = "plane");

}  // namespace encase
