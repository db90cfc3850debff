// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/kernel.hpp"
#include "common/tile.hpp"
#include "encase/geometry.hpp"

/// Roots of plane curves on lines, found from tiles: what the search for splitting lines asks. All
/// answers are proved (docs/error-bounds.md); `segments.hpp` has the same from the coefficients.
namespace encase {

/// An open interval of a line's parameter with one simple root inside and none at its ends.
struct LineRoot {
  double lo = 0;
  double hi = 0;
  double at = 0;  ///< about where the root is
};

/// Appends all roots of f on the line's parameter interval [lo, hi], in increasing order, in
/// disjoint intervals within [lo, hi]; all proved simple. False, and nothing appended, if that
/// cannot be proved (a multiple root, a root at lo or hi, f zero on the line, or more than
/// max_nodes subdivisions). Where the line meets the gaps of f, or nearly (`left_out_at`), nothing
/// is said.
bool isolate_on_line(TiledFunction& f, const Line& line, double lo, double hi, int max_nodes,
                     Kernel& kernel, std::vector<LineRoot>* roots);

/// f has no zero on the closed parameter interval [lo, hi] of the line.
bool no_root_on_line(TiledFunction& f, const Line& line, double lo, double hi, Kernel& kernel);

/// f has no zero on the closed segment between two points.
bool no_root_on_segment(TiledFunction& f, const Point<2>& from, const Point<2>& to, Kernel& kernel);

/// Halves a root's interval at least once (more where that is cheap); false if doubles leave no
/// room or f is zero where it has to be cut.
bool refine_on_line(TiledFunction& f, const Line& line, LineRoot* root, Kernel& kernel);

/// Cuts a root's interval at a parameter, so that the root is proved to lie before or beyond it;
/// false if f is zero there.
bool narrow_on_line(TiledFunction& f, const Line& line, double at, LineRoot* root, Kernel& kernel);

/// The exact sign of f at the point of the line with the given parameter.
Sign sign_on_line(TiledFunction& f, const Line& line, double parameter, Kernel& kernel);

}  // namespace encase
