// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/encasement.hpp"

/// Needs OpenMesh: component `open_mesh`.
namespace encase {

struct OpenMeshOptions {
  /// In place of the cells the parts into which the curves divide them, each with one face of the
  /// arrangement, along polylines within 10^-4 of the region's size of the curves. Only where the
  /// answer is certified.
  bool faces = false;
};

/// Writes the cells as a polygon mesh in the plane z = 0, counter-clockwise, vertices within an
/// edge of another cell inserted there, so that it is a 2-manifold with the region's boundary. The
/// extension chooses the format:
///   - .om: points in double precision and the face properties `cell`, `state` (int, in the order
///     of CellState), `face` (int, of the arrangement; -1 where there are several or none is known)
///     and `signs` (std::vector<int>, of every curve's polynomial; 0 where the curve runs through
///     or the cell is not certified);
///   - .off, .obj, .ply: points as decimals or floats, as OpenMesh writes them.
/// BadInput for another extension, Io if the file cannot be written, Internal if the cells are no
/// complex. The file is complete or absent. Deterministic.
Status write_open_mesh(const Encasement& encasement, const std::string& path,
                       const OpenMeshOptions& options = {});

}  // namespace encase
