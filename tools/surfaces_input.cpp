// SPDX-License-Identifier: MIT
#include "surfaces_input.hpp"

#include <optional>
#include <utility>

#include "encase/surfaces_file.hpp"

namespace encase {

Result<SurfacesInput> read_surfaces_input(const std::string& file,
                                          const std::vector<std::string>& expressions,
                                          const std::string& region) {
  std::string lines;
  for (const std::string& expression : expressions) lines += expression + "\n";
  auto read = expressions.empty() ? load_surfaces(file) : read_surfaces(lines, "-e");
  if (!read) return read.error();
  std::optional<Polyhedron> solid = std::move(read.value().region);
  if (!region.empty()) {
    auto parsed = parse_solid_region(region, "--region");
    if (!parsed) return parsed.error();
    solid = std::move(parsed).value();
  }
  if (!solid)
    return Error{Error::Code::BadInput,
                 "no region is given: add a line 'region: box x0 x1 y0 y1 z0 z1' to the file, or "
                 "--region \"box x0 x1 y0 y1 z0 z1\""};
  return SurfacesInput{std::move(read.value().surfaces), *std::move(solid)};
}

}  // namespace encase
