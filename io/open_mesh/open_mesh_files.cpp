// SPDX-License-Identifier: MIT
#include "encase/open_mesh.hpp"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <vector>

#include "2d/cell_complex.hpp"
#include "encase/atomic_file.hpp"

namespace encase {
namespace {

using Mesh = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

Error error(Error::Code code, const std::string& message) { return {code, message}; }

/// Keeps OpenMesh from writing to the terminal: what went wrong is in the returned error.
class Silence {
 public:
  Silence() {
    for (std::size_t k = 0; k < streams_.size(); ++k) {
      was_enabled_[k] = streams_[k]->is_enabled();
      streams_[k]->disable();
    }
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() {
    for (std::size_t k = 0; k < streams_.size(); ++k)
      if (was_enabled_[k]) streams_[k]->enable();
  }

 private:
  std::array<OpenMesh::mostream*, 3> streams_ = {&omlog(), &omout(), &omerr()};
  std::array<bool, 3> was_enabled_{};
};

/// The extension in lower case, with its dot.
std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

Status build(const Encasement& encasement, Mesh* mesh) {
  const Result<CellComplex> made = make_cell_complex(encasement);
  if (!made) return made.error();
  const CellComplex& complex = made.value();
  std::vector<Mesh::VertexHandle> vertices;
  vertices.reserve(complex.points.size());
  for (const Point<2>& p : complex.points) vertices.push_back(mesh->add_vertex({p[0], p[1], 0}));

  OpenMesh::FPropHandleT<int> cell_of, state_of;
  mesh->add_property(cell_of, "cell");
  mesh->add_property(state_of, "state");
  mesh->property(cell_of).set_persistent(true);
  mesh->property(state_of).set_persistent(true);
  std::vector<Mesh::VertexHandle> loop;
  for (std::size_t k = 0; k < complex.cells.size(); ++k) {
    loop.clear();
    for (const int vertex : complex.cells[k]) loop.push_back(vertices[vertex]);
    const Mesh::FaceHandle face = mesh->add_face(loop);
    if (!face.is_valid())
      return error(Error::Code::Internal,
                   "cell " + std::to_string(k) + " cannot be added to the mesh");
    mesh->property(cell_of, face) = static_cast<int>(k);
    mesh->property(state_of, face) = static_cast<int>(encasement.cells[k].state);
  }
  return std::nullopt;
}

}  // namespace

Status write_open_mesh(const Encasement& encasement, const std::string& path) {
  const std::string extension = extension_of(path);
  constexpr std::array<const char*, 4> kFormats = {".om", ".off", ".obj", ".ply"};
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end()) {
    std::string why = extension == ".stl" ? "STL holds triangles only, cells are polygons"
                                          : "its extension names no mesh format";
    return error(Error::Code::BadInput,
                 "cannot write '" + path + "': " + why + "; use .om, .off, .obj or .ply");
  }
  const Silence silence;
  Mesh mesh;
  if (Status bad = build(encasement, &mesh)) return bad;

  // Into memory first, so that a failure leaves no half a file.
  std::ostringstream stream(std::ios::binary);
  OpenMesh::IO::Options options;
  if (extension == ".om") options += OpenMesh::IO::Options::Binary;
  constexpr int kDigits = 17;
  if (!OpenMesh::IO::write_mesh(mesh, stream, extension, options, kDigits) || !stream)
    return error(Error::Code::Io, "cannot write '" + path + "': OpenMesh failed to write the mesh");
  return write_file(path, stream.str());
}

}  // namespace encase
