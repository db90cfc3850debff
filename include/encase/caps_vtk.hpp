// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/caps.hpp"

/// Needs VTK: component `vtk`.
namespace encase {

/// Writes a CAPS result for ParaView and other readers of VTK's XML files: `result.vtm` in the
/// directory, with the blocks `leaves`, `curves` (the polylines of proved edges) and `vertices` in
/// `result/*.vtp`. docs/vtk.md lists the arrays. Makes the directory if its parent exists; the .vtm
/// appears when all is complete. Io if a file cannot be written. Deterministic.
Status write_vtk(const CapsResult& result, const std::string& directory);

}  // namespace encase
