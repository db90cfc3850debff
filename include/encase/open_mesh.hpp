// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/encasement.hpp"

/// Needs OpenMesh: component `open_mesh`.
namespace encase {

/// Writes the cells as a polygon mesh in the plane z = 0, counter-clockwise, vertices within an
/// edge of another cell inserted there, so that it is a 2-manifold with the region's boundary. The
/// extension chooses the format:
///   - .om: points in double precision and the face properties `cell` and `state` (int, in the
///   order
///     of CellState);
///   - .off, .obj, .ply: points as decimals or floats, as OpenMesh writes them.
/// BadInput for another extension, Io if the file cannot be written, Internal if the cells are no
/// complex. The file is complete or absent.
Status write_open_mesh(const Encasement& encasement, const std::string& path);

}  // namespace encase
