// SPDX-License-Identifier: MIT
#include "encase/surfaces_file.hpp"

#include <utility>
#include <variant>

#include "function_file.hpp"
#include "region_text.hpp"

namespace encase {

namespace {

Result<SurfacesFile> surfaces_of(Result<FunctionFile<3>> file) {
  if (!file) return file.error();
  return SurfacesFile{std::move(file.value().functions), std::move(file.value().region)};
}

}  // namespace

Result<SurfacesFile> read_surfaces(const std::string& text, const std::string& source) {
  return surfaces_of(read_functions<3>(text, source));
}

Result<SurfacesFile> load_surfaces(const std::string& path) {
  return surfaces_of(load_functions<3>(path));
}

Result<Polyhedron> parse_solid_region(const std::string& text, const std::string& source) {
  return placed(parse_solid_region(std::string_view(text)), text, source);
}

Result<HalfSpace> parse_plane(const std::string& text, const std::string& source) {
  return placed(parse_plane(std::string_view(text)), text, source);
}

}  // namespace encase
