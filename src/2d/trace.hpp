// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"

/// Polylines along curves, for pictures. A certified cell holds a curve in one branch, an arc that
/// cuts the convex cell in two. A line that the arc crosses just once cuts it into two such arcs in
/// two convex parts of the cell: so the order of points along the branch is known whatever its
/// shape, and bisection goes on until each part of the arc is caught between two lines parallel to
/// its chord.
///
/// Parts of cells and their corners are doubles here: nothing of this is a certificate.
namespace encase {

using Polyline = std::vector<Point<2>>;

/// A polyline along a branch of a certified cell from the branch's first line crossing to its
/// second, within about `tolerance` (> 0, in input units) of it. Where no line can be found that
/// the branch crosses just once, or doubles give out, the polyline has a longer chord.
Polyline trace_branch(const Encasement& encasement, int cell, const Branch& branch,
                      double tolerance);

/// The branches of a curve, traced and joined across cells: open polylines, and closed ones whose
/// last point is their first. What runs through cells without certified branches is missing.
std::vector<Polyline> trace_curve(const Encasement& encasement, int curve, double tolerance);

/// The edges of an arrangement along their first half-edges; loops end where they begin. Edges that
/// meet in a vertex have the same point there.
std::vector<Polyline> trace_edges(const Encasement& encasement, const Arrangement& arrangement,
                                  double tolerance);

/// Short segments near a curve in a cell of any state, from the signs of the curve's polynomial on
/// a grid of about the given spacing (at most 200 by 200 points): a sketch that may miss what is
/// finer.
std::vector<Polyline> sketch_curve(const Encasement& encasement, int cell, int curve,
                                   double spacing);

}  // namespace encase
