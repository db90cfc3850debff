// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/encasement.hpp"

namespace encase {

/// The exact point of a cell's vertex: where its two lines meet, or a point of its one line. The
/// lines must not be parallel.
RationalPoint<2> exact_point(const std::vector<Line>& lines, const Vertex& vertex);

/// The cells of an encasement as a cell complex: two closed cells share a vertex, an edge or
/// nothing. A vertex that lies within an edge of another cell (a T-junction) is inserted there.
/// Points are told apart exactly.
struct CellComplex {
  std::vector<RationalPoint<2>> exact;  ///< the vertices, no two equal
  std::vector<Point<2>> points;         ///< each rounded to nearest
  std::vector<std::vector<int>> cells;  ///< one for each cell: its vertices, counter-clockwise
  std::vector<std::vector<int>> lines;  ///< the line on which each vertex' edge to the next runs
};

/// Internal if a cell has less than three vertices or parallel lines that follow each other. Cost:
/// a few rational comparisons for each vertex and edge, and sorting.
Result<CellComplex> make_cell_complex(const Encasement& encasement);

}  // namespace encase
