// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"
#include "encase/tracing.hpp"

/// Polylines for pictures, also of encasements that are not certified: traced as in
/// encase/tracing.hpp, but no more is told than the points, and tolerances below 2^-30 of the
/// largest coordinate are not met.
namespace encase {

/// A polyline along a branch of a certified cell from the branch's first line crossing to its
/// second, within `tolerance` (in input units) of it.
Polyline trace_branch(const Encasement& encasement, int cell, const Branch& branch,
                      double tolerance);

/// The branches of a curve, traced and joined across cells: open polylines, and closed ones whose
/// last point is their first. What runs through cells without certified branches is missing.
std::vector<Polyline> trace_curve(const Encasement& encasement, int curve, double tolerance);

/// The edges of an arrangement along their first half-edges, strand by strand, with a point at
/// every line crossing on them; loops end where they begin. Edges that meet in a vertex have the
/// same point there.
std::vector<Polyline> trace_edges(const Encasement& encasement, const Arrangement& arrangement,
                                  double tolerance);

/// Short segments near a curve in a cell of any state, from the signs of the curve's polynomial on
/// a grid of about the given spacing (at most 200 by 200 points): a sketch that may miss what is
/// finer.
std::vector<Polyline> sketch_curve(const Encasement& encasement, int cell, int curve,
                                   double spacing);

}  // namespace encase
