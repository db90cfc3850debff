// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/result.hpp"
#include "encase/surface_mesh.hpp"

/// Needs OpenMesh: component `open_mesh`.
namespace encase {

/// Writes surfaces as one triangle mesh with vertex normals, in which different surfaces share no
/// point. The extension chooses the format:
///   - .om: in double precision and with the face properties `surface`, `cell` (int), `distance`
///     and `angle` (double) of SurfaceMesh;
///   - .off, .obj, .ply: as OpenMesh writes them.
/// BadInput for another extension, Io if the file cannot be written, Internal if a mesh is not
/// manifold. The file is complete or absent. Deterministic.
Status write_open_mesh(const std::vector<SurfaceMesh>& meshes, const std::string& path);

}  // namespace encase
