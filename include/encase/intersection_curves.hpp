// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "encase/result.hpp"
#include "encase/surface_encasement.hpp"

/// The curves in which surfaces meet, and polylines along them with a proved distance.
/// docs/meshes.md says how and why.
namespace encase {

/// An arc of a cell as a part of an intersection curve.
struct ArcUse {
  int cell = -1;
  int arc = -1;  ///< in the cell's `arcs`
  bool forward = true;
  bool operator==(const ArcUse&) const = default;
};

/// A connected component of the common points of two surfaces in the region used.
struct IntersectionCurve {
  std::array<int, 2> surfaces{};  ///< ascending
  bool closed = false;
  std::vector<ArcUse> arcs;  ///< one after the other
  /// The facet points between the arcs, one more than arcs: the first and the last of a closed one
  /// are the same. Those of an open one lie on the region's boundary, or where a cell begins that
  /// is not certified.
  std::vector<int> facet_points;
  std::array<bool, 2> cut_off{};  ///< whether the latter, at its begin and end
};

/// All intersection curves, as far as cells are certified; ordered by their surfaces. Open ones
/// come before closed ones. Cost: linear in the number of arcs.
std::vector<IntersectionCurve> intersection_curves(const SurfaceEncasement& encasement);

/// An intersection curve as a polyline along grad f x grad g, where f is the first of its surfaces
/// and g the second. A closed one ends where it begins.
struct TracedIntersection {
  IntersectionCurve curve;
  std::vector<Point<3>> points;
  /// For every point a box that holds it and the point of the curve for which it stands.
  std::vector<Box<3>> boxes;
  std::vector<Point<3>> tangents;                ///< unit vectors, up to rounding, at the points
  std::vector<std::array<Point<3>, 2>> normals;  ///< of both surfaces: unit gradients
  std::vector<int> cells;                        ///< of every segment: one fewer than points
  /// Proved: neither the segment nor the piece of the curve between the points for which its ends
  /// stand has a point farther than this from the other, in input units; so all of the segment is
  /// as close to both surfaces. Infinite: nothing is proved of it.
  std::vector<double> distances;
  std::vector<int> triple_points;  ///< of every point: which one it is, or -1
};

struct IntersectionTracing {
  std::vector<TracedIntersection> curves;  ///< in the order of `intersection_curves`
  double distance = 0;                     ///< the largest one of a segment
  bool within_tolerance = true;            ///< it is at most the tolerance asked
};

struct IntersectionTraceOptions {
  double tolerance = 1e-3;   ///< > 0, in input units; may be infinite
  int max_points = 1000000;  ///< more are not made: what is missing becomes segments without proof
  /// As EncaseOptions'; false ends the tracing, which is then Undecided.
  std::function<bool(const char* stage, double done)> progress;
};

/// Traces all intersection curves. BadInput if the tolerance is not a positive number.
/// Deterministic. Cost: some ten microseconds a point; an arc needs about length / sqrt(8 tolerance
/// radius) of them.
Result<IntersectionTracing> trace(const SurfaceEncasement& encasement,
                                  const IntersectionTraceOptions& options = {});

/// What two surfaces have in common.
struct SurfaceIntersection {
  SurfaceEncasement encasement;  ///< `outcome` tells whether the curves are all there are
  std::vector<TracedIntersection> curves;
  bool within_tolerance = true;
};

/// Encases two surfaces in the region and traces the curves in which they meet. Errors are those of
/// `encase` and `trace`. For more surfaces, or for what else is known, take these.
Result<SurfaceIntersection> intersect(const Function<3>& f, const Function<3>& g,
                                      const Polyhedron& region, double tolerance,
                                      const SurfaceOptions& options = {});

}  // namespace encase
