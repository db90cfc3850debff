// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"
#include "encase/geometry.hpp"
#include "encase/result.hpp"

/// Polylines along the edges of an arrangement, with a proved distance, that cross nowhere but
/// where the curves do. docs/tracing.md says how and why.
namespace encase {

using Polyline = std::vector<Point<2>>;

/// A piece of an edge between two vertices of its polyline, beside its chord.
struct TracedPiece {
  /// Proved: piece and chord both run strictly monotonically along this coordinate, so that a line
  /// across it meets either once.
  int axis = 0;
  /// Proved: no point of the piece is farther than this from the chord, and no point of the chord
  /// from the piece (in input units). Infinite: nothing is proved of this piece.
  double distance = 0;
};

/// An edge of the arrangement as a polyline along its first half-edge; a closed loop ends where it
/// begins.
struct TracedEdge {
  Polyline points;
  /// For every point a box that holds it and the point of the edge at which its pieces meet: for a
  /// crossing, the only common point of the curves in the box; else the curve's only point there on
  /// a splitting line, a side of the region, or a line x = const or y = const.
  std::vector<Box<2>> boxes;
  std::vector<TracedPiece> pieces;  ///< one fewer than points
};

struct Tracing {
  std::vector<TracedEdge> edges;  ///< of the arrangement, in its order
  /// The largest distance of a piece: the Hausdorff distance of every polyline from its edge is at
  /// most this.
  double distance = 0;
  bool within_tolerance = false;  ///< `distance` is at most the tolerance asked
  /// Proved, exactly, for the polylines as they are written: no two meet, and none meets itself,
  /// but in the vertices that their edges share; around every vertex they leave in the order of the
  /// edges; and what lies in a hole of a face lies there. So a homeomorphism of the plane takes the
  /// arrangement to the polylines, vertex by vertex, edge by edge and face by face.
  bool same_topology = false;
  /// Pairs of edges whose polylines meet, or lie around a vertex or a face, as they should not
  /// (equal numbers: one that meets itself); empty if none do.
  std::vector<std::array<int, 2>> conflicts;
};

struct TraceOptions {
  double tolerance = 1e-3;     ///< > 0, in input units; may be infinite
  int max_points = 1000000;    ///< more are not made: what is missing becomes pieces without proof
  int max_rounds = 40;         ///< of looking for conflicts and refining the pieces concerned
  bool check_topology = true;  ///< false: conflicts are not looked for
};

/// Traces all edges. Below 2^-46 of the largest coordinate of the region doubles do not allow more:
/// pieces then have about that distance. BadInput if the tolerance is not a positive number.
/// Deterministic. Cost: some microseconds a point; an arc needs about length / sqrt(8 tolerance
/// radius) of them.
Result<Tracing> trace(const Encasement& encasement, const Arrangement& arrangement,
                      const TraceOptions& options = {});

/// The boundary of a face as closed polylines with the face to the left, each ending where it
/// begins: the outer boundary first (counter-clockwise), then those of the holes (clockwise). The
/// outside has holes only.
std::vector<Polyline> face_boundary(const Arrangement& arrangement, const Tracing& tracing,
                                    int face);

/// The same of one face: only its edges are traced and compared with each other. Undecided if the
/// tolerance is not proved or the polylines' topology is not the face's.
Result<std::vector<Polyline>> face_boundary(const Encasement& encasement,
                                            const Arrangement& arrangement, int face,
                                            double tolerance);

}  // namespace encase
