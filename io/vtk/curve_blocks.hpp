// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "2d/cell_signs.hpp"
#include "2d/piece_complex.hpp"
#include "2d/trace.hpp"
#include "encase/arrangement.hpp"
#include "vtk_multiblock.hpp"

/// The blocks of an encasement of curves, docs/vtk.md.
namespace encase {

/// What the blocks show.
struct CurveScene {
  const Encasement& encasement;
  std::optional<Arrangement> arrangement;  ///< where the encasement has one
  std::vector<Polyline> edges;             ///< of the arrangement
  PieceComplex pieces;                     ///< of the arrangement
  std::vector<std::pair<int, Polyline>> curves;
};

/// Traces the curves. Internal if the cells are no complex.
Result<CurveScene> make_curve_scene(const Encasement& encasement);

/// The scene must outlive them.
std::vector<VtkBlock> curve_blocks(const CurveScene& scene);

/// As the array `kind` of cells numbers them.
int cell_kind(const Cell& cell);

/// The corners of a cell, without the cuts that lie within an edge.
std::vector<Point<2>> cell_corners(const Cell& cell);

}  // namespace encase
