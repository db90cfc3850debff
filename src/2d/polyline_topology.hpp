// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/arrangement.hpp"
#include "encase/geometry.hpp"

/// Whether polylines divide the plane as the edges of an arrangement do, by exact predicates on
/// their doubles. docs/tracing.md has the argument.
namespace encase {

/// Left (Positive), right (Negative) or on the line: where `r` is, seen from p to q. Exact.
Sign orientation(const Point<2>& p, const Point<2>& q, const Point<2>& r);

/// A segment of an edge's polyline.
struct EdgePiece {
  int edge = -1;
  int piece = -1;
  auto operator<=>(const EdgePiece&) const = default;
};

/// Two segments that are as they may not be, the lesser one first; equal for a segment whose ends
/// are equal.
struct PieceConflict {
  EdgePiece first, second;
  auto operator<=>(const PieceConflict&) const = default;
};

/// One polyline for every edge of the arrangement, along its first half-edge; empty for an edge
/// that is left out.
using EdgePolylines = std::vector<std::vector<Point<2>>>;

/// Pairs of segments that meet elsewhere than in a common end that is the same vertex of an edge or
/// of the arrangement. Ascending. Pairs of segments that are both known to be apart are left out:
/// `is_new[edge][piece]` tells of which ones that is not known. Cost: about n log n for n segments.
std::vector<PieceConflict> meeting_pieces(const Arrangement& arrangement,
                                          const EdgePolylines& lines,
                                          const std::vector<std::vector<char>>& is_new);

/// Pairs of segments that leave a vertex in another order than their edges. Requires that no two
/// segments at a vertex have the same direction.
std::vector<PieceConflict> misplaced_around_vertices(const Arrangement& arrangement,
                                                     const EdgePolylines& lines);

/// Two boundary cycles of a face, by a half-edge each, one of which is on the wrong side of the
/// other; equal for one that runs the wrong way around.
struct CycleConflict {
  int first = -1;
  int second = -1;
};

/// Cycles that do not bound the face as they should: with the outer one counter-clockwise, those of
/// its holes clockwise and within it, and none of the holes in another. Requires that no segments
/// are in conflict, and all edges of the face.
std::vector<CycleConflict> misplaced_cycles(const Arrangement& arrangement,
                                            const EdgePolylines& lines, int face);

/// The boundary cycle of a half-edge as a closed polyline that ends where it begins.
std::vector<Point<2>> cycle_polyline(const Arrangement& arrangement, const EdgePolylines& lines,
                                     int half_edge);

}  // namespace encase
