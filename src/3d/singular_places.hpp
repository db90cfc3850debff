// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/filtered_function.hpp"
#include "encase/geometry.hpp"

/// Guesses where the search need not look closer. Nothing rests on them but when to stop.
namespace encase {

/// Whether surfaces seem to have a point in the box, or next to it, where they are not in general
/// position: one is singular there, two have dependent gradients at a common point, or three.
/// Newton's method, in doubles.
bool seem_singular(const std::vector<const FilteredFunction<3>*>& surfaces, const Box<3>& box);

/// For every box whether it is one of a row of boxes that touch: whether their hull is several
/// times as wide as the widest of them, or they touch one of the rows that are known.
std::vector<bool> in_rows(const std::vector<Box<3>>& boxes, const std::vector<Box<3>>& known);

}  // namespace encase
