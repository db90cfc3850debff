// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "2d/cell_signs.hpp"
#include "2d/piece_complex.hpp"
#include "2d/trace.hpp"
#include "encase/arrangement.hpp"
#include "vtk_table.hpp"

/// The blocks of a result, docs/vtk.md.
namespace encase {

inline constexpr std::array<const char*, 9> kVtkBlocks = {
    "cells", "curves",   "points", "critical_regions", "unresolved", "faces",
    "edges", "vertices", "labels"};

/// What the blocks show.
struct VtkScene {
  const Encasement& encasement;
  std::optional<Arrangement> arrangement;  ///< where the encasement has one
  std::vector<Polyline> edges;             ///< of the arrangement
  PieceComplex pieces;                     ///< of the arrangement
  std::vector<std::pair<int, Polyline>> curves;
};

/// Traces the curves. Internal if the cells are no complex.
Result<VtkScene> make_vtk_scene(const Encasement& encasement);

/// Fills the table of an entry of kVtkBlocks.
vtkPolyData* fill_block(const VtkScene& scene, std::size_t block, VtkTable* table);

/// As the array `kind` of cells numbers them.
int cell_kind(const Cell& cell);

/// The corners of a cell, without the cuts that lie within an edge.
std::vector<Point<2>> cell_corners(const Cell& cell);

}  // namespace encase
