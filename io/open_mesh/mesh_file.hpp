// SPDX-License-Identifier: MIT
#pragma once

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <array>
#include <sstream>
#include <string>

#include "encase/atomic_file.hpp"
#include "encase/result.hpp"

/// What writing meshes of any kind with OpenMesh has in common.
namespace encase {

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

/// The format that a path's extension names, with its dot in lower case: .om, .off, .obj or .ply;
/// BadInput for another one.
Result<std::string> mesh_format(const std::string& path);

/// Writes a mesh; the file is complete or absent.
template <class Mesh>
Status write_mesh_file(const Mesh& mesh, OpenMesh::IO::Options options, const std::string& format,
                       const std::string& path) {
  // Into memory first, so that a failure leaves no half a file.
  std::ostringstream stream(std::ios::binary);
  if (format == ".om") options += OpenMesh::IO::Options::Binary;
  constexpr int kDigits = 17;
  if (!OpenMesh::IO::write_mesh(mesh, stream, format, options, kDigits) || !stream)
    return Error{Error::Code::Io, "cannot write '" + path + "': OpenMesh failed to write the mesh"};
  return write_file(path, stream.str());
}

}  // namespace encase
