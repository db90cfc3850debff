// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/slice.hpp"

/// Needs VTK: component `vtk`.
namespace encase {

/// Writes an encasement for ParaView and other readers of VTK's XML files: `result.vtm` in the
/// directory, with the blocks `cells`, `curves`, `points`, `critical_regions`, `unresolved` and, of
/// the arrangement where the answer is certified, `faces`, `edges`, `vertices` and `labels` in
/// `result/*.vtp`; with `history` also `history.pvd`, the cells after each cut of the splitting
/// history (at most 200 time steps, evenly chosen) in `history/*.vtp`. docs/vtk.md lists the
/// arrays. Makes the directory if its parent exists. The .vtm and .pvd files appear when all they
/// refer to is complete; those of an earlier run are removed first. Io if a file cannot be written.
/// Deterministic.
Status write_vtk(const Encasement& encasement, const std::string& directory, bool history = false);

/// The same of what is on a plane, in the coordinates of space.
Status write_vtk(const Slice& slice, const std::string& directory, bool history = false);

/// Several of them, each in a directory `slice_000`, `slice_001`, ... of its own, as the time steps
/// of `slices.pvd`, which appears last.
Status write_vtk(const std::vector<Slice>& slices, const std::string& directory);

}  // namespace encase
