// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "encase/geometry.hpp"

/// Plane curves on lines and segments, and where lines meet.
namespace encase {

/// An open interval of a line's parameter with one simple root inside and none at its ends.
struct RootInterval {
  double lo = 0;
  double hi = 0;
};

/// All roots of f on the line's parameter interval [lo, hi], in increasing order, in disjoint
/// intervals within [lo, hi]; all proved simple. Nothing if that cannot be proved (a multiple root,
/// a root at lo or hi, f zero on the line, or more than max_nodes subdivisions).
std::optional<std::vector<RootInterval>> isolate_on_line(const FilteredFunction<2>& f,
                                                         const Line& line, double lo, double hi,
                                                         int max_nodes, Kernel& kernel);

/// f has exactly one root, simple, in the parameter interval (lo, hi) of the line and is not zero
/// at its ends.
bool one_root_on_line(const FilteredFunction<2>& f, const Line& line, double lo, double hi,
                      Kernel& kernel);

/// f has no zero on the closed parameter interval [lo, hi] of the line.
bool no_root_on_line(const FilteredFunction<2>& f, const Line& line, double lo, double hi,
                     Kernel& kernel);

/// f has no zero on the closed segment between two points.
bool no_root_on_segment(const FilteredFunction<2>& f, const Point<2>& from, const Point<2>& to,
                        Kernel& kernel);

/// Halves a root's interval at least once (more where that is cheap); false if doubles leave no
/// room or the sign at the new end cannot be proved.
bool refine_on_line(const FilteredFunction<2>& f, const Line& line, RootInterval* root,
                    Kernel& kernel);

/// Cuts a root's interval at a parameter, so that the root is proved to lie before or beyond it;
/// false if f is zero there.
bool narrow_on_line(const FilteredFunction<2>& f, const Line& line, double at, RootInterval* root,
                    Kernel& kernel);

/// The exact sign of f at the point of the line with the given parameter.
Sign sign_on_line(const FilteredFunction<2>& f, const Line& line, double parameter, Kernel& kernel);

/// The point of a line at a parameter: enclosed in doubles, and exactly.
std::array<Interval, 2> point_on_line(const Line& line, const Interval& parameter);
RationalPoint<2> point_on_line(const Line& line, const Rational& parameter);

/// Whether a line's parameter grows along an edge on it that runs counter-clockwise around a cell
/// on the line's negative or positive side. Exact: the signs of the doubles are those of the
/// coefficients.
bool parameter_grows(const Line& line, bool positive);

/// The common point of two lines that are not parallel: enclosed, and exactly. Parallel lines give
/// infinite intervals; the exact form requires lines that are not parallel.
std::array<Interval, 2> meet(const Line& first, const Line& second);
RationalPoint<2> exact_meet(const Line& first, const Line& second);

/// The exact side of a line on which lie: a point, a rational point, the meeting point of two lines
/// that are not parallel.
Sign side(const Line& line, const Point<2>& point, Kernel& kernel);
Sign side(const Line& line, const RationalPoint<2>& point, Kernel& kernel);
Sign side(const Line& line, const Line& first, const Line& second, Kernel& kernel);

/// The side of a line on which the whole closed box lies, if it does not meet the line. Exact.
std::optional<Sign> side(const Line& line, const Box<2>& box, Kernel& kernel);

}  // namespace encase
