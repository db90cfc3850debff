// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "2d/trace.hpp"
#include "encase/arrangement.hpp"

namespace encase {

/// The pieces of an arrangement as polygons that share their corners: two of them meet in corners
/// and edges of both, or not at all. Which corners a polygon has, and in which order, is exact, as
/// in CellComplex; where the corners on curves lie is as near as the polylines are. So the
/// polygons' signed areas add up to that of the region; but where curves are closer to each other
/// than their polylines are to them, polygons may overlap by as much.
struct PieceComplex {
  std::vector<Point<2>> points;
  std::vector<std::vector<int>> pieces;  ///< one for each piece: its points, counter-clockwise
};

/// `edges` are polylines along the edges, as of `trace_edges`. Internal if the cells are no
/// complex.
Result<PieceComplex> make_piece_complex(const Encasement& encasement,
                                        const Arrangement& arrangement,
                                        const std::vector<Polyline>& edges);

/// The closed polylines around a face (not the outside), the outer one first; `edges` as above.
std::vector<Polyline> boundaries(const Arrangement& arrangement, const std::vector<Polyline>& edges,
                                 const Arrangement::Face& face);

}  // namespace encase
