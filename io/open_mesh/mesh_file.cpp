// SPDX-License-Identifier: MIT
#include "io/open_mesh/mesh_file.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace encase {

Result<std::string> mesh_format(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 4> kFormats = {".om", ".off", ".obj", ".ply"};
  if (std::find(kFormats.begin(), kFormats.end(), extension) != kFormats.end()) return extension;
  const std::string why = extension == ".stl" ? "STL holds triangles only, cells are polygons"
                                              : "its extension names no mesh format";
  return Error{Error::Code::BadInput,
               "cannot write '" + path + "': " + why + "; use .om, .off, .obj or .ply"};
}

}  // namespace encase
