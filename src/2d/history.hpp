// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/encasement.hpp"

namespace encase {

/// The polygon that each cut of an encasement's history divides: for each entry of `history` its
/// vertices, counter-clockwise, rounded. Which vertices there are is decided exactly. An entry that
/// nothing refers to, or whose polygon its ancestors' lines do not cut, has an empty polygon.
std::vector<std::vector<Point<2>>> history_polygons(const Encasement& encasement);

/// A part of the region at some stage of the history: a cut that is yet to come, or a cell.
struct HistoryPiece {
  int split = -1;  ///< entry of `history`, or -1
  int cell = -1;   ///< cell, or -1
  int depth = 0;   ///< number of cuts above it
};

/// The parts of the region after the first `cuts` entries of the history, in an order that depends
/// on nothing but the history.
std::vector<HistoryPiece> pieces_after(const Encasement& encasement, int cuts);

}  // namespace encase
