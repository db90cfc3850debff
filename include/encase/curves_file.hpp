// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/function.hpp"
#include "encase/region.hpp"
#include "encase/result.hpp"

/// Curves and regions from text. The formats are described in docs/command.md. Errors are BadInput
/// and name the source, line and column, and show the line with a caret below the place.
namespace encase {

/// What a file of curves says.
struct CurvesFile {
  std::vector<NamedCurve> curves;  ///< at least one, none zero or constant, names all different
  std::optional<Region> region;    ///< nothing if the file names none
};

/// Reads the text format, or JSON where the first character that is not blank is `{`. `source` is
/// what errors call the text, usually the file's name.
Result<CurvesFile> read_curves(const std::string& text, const std::string& source);
Result<CurvesFile> read_curves(std::istream& stream, const std::string& source);

/// Reads a file; "-" is standard input. Io if it cannot be read or is a directory.
Result<CurvesFile> load_curves(const std::string& path);

/// Reads one curve, `expr` or `lhs = rhs`, as in a file: a polynomial where it is one. Functions
/// that are zero everywhere, constant or without a value are read too.
Result<Function<2>> parse_function(const std::string& text,
                                   const std::string& source = "expression");
/// The same of polynomials only.
Result<Polynomial<2>> parse_polynomial(const std::string& text,
                                       const std::string& source = "expression");

/// Reads `xmin xmax ymin ymax`, `polygon (x,y) (x,y) ...` or `plane`.
Result<Region> parse_region(const std::string& text, const std::string& source = "region");

}  // namespace encase
