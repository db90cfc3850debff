// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/filtered_function.hpp"
#include "encase/geometry.hpp"

/// Where an expression is not proved to be analytic (but for poles that hold no zeros): where it
/// has no value and where it is not differentiable. Likewise where an inclusion function tells
/// nothing.
namespace encase {

/// Boxes within `root`; on a neighbourhood of every point of the root outside of them the
/// function has a model. Isolated points get tiny boxes, lines along an axis strips of about a
/// thousandth of the root's width, other lines a chain of boxes of about a hundredth. Cost: one
/// small Taylor model where there is one everywhere.
std::vector<Box<2>> find_gaps(const FilteredFunction<2>& f, const Box<2>& root, Kernel& kernel);

/// Somewhat larger: what searches on lines leave out, and what contains that.
Box<2> left_out_at(const Box<2>& gap);
Box<2> zone_of(const Box<2>& gap);

/// How a box lies to gaps: it has no inner point in common with any, it has with one and lies
/// within what is left out there, or neither.
enum class Relation { Apart, Within, Partly };
Relation relation(const Box<2>& box, const std::vector<Box<2>>& gaps);

/// A few boxes that contain all of the given ones and not much more than these need.
std::vector<Box<2>> gathered(std::vector<Box<2>> boxes, const Box<2>& root);

}  // namespace encase
