// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "2d/partition.hpp"

/// Which line to split a cell by. Everything here is a heuristic on doubles: a proposal counts only
/// once `Partition::try_line` has proved what it does.
namespace encase {

/// The line through a point with a normal; its doubles are its exact coefficients.
Line line_through(const Point<2>& point, const Point<2>& normal);

/// The best of the lines that may separate branches and crossings in the cell: gaps between
/// crossings and bisectors of the nearest ones; the mean normal between the closest boundary
/// crossings of different branches (thesis 3.2 as docs/encasement.md improves it) and of different
/// curves; if those are poor, the closest approach (thesis 6.1). After levels without progress, the
/// longest branch is bisected (thesis 3.5).
std::optional<Cut> best_cut(Partition& partition, const OpenCell& cell);

/// The best of the lines through a point in several directions.
std::optional<Cut> best_cut_through(Partition& partition, const OpenCell& cell,
                                    const Point<2>& point);

/// The best of the sides of a box that cut the cell.
std::optional<Cut> best_cut_along(Partition& partition, const OpenCell& cell, const Box<2>& box);

/// Any line at all that cuts the cell, tried in a fixed order of many.
std::optional<Cut> any_cut(Partition& partition, const OpenCell& cell);

}  // namespace encase
