// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/filtered_expression.hpp"
#include "encase/geometry.hpp"

/// Where an expression is not proved to be analytic: around poles, where it has no value and where
/// it is not differentiable.
namespace encase {

/// Boxes within `root`; on a neighbourhood of every point of the root outside of them the
/// expression is analytic. Isolated points get tiny boxes, lines of them a chain of boxes of about
/// a hundredth of the root's width. Cost: one small Taylor model where the expression is analytic
/// everywhere.
std::vector<Box<2>> find_gaps(const FilteredExpression<2>& f, const Box<2>& root, Kernel& kernel);

/// Somewhat larger: what searches on lines leave out, and what contains that.
Box<2> left_out_at(const Box<2>& gap);
Box<2> zone_of(const Box<2>& gap);

/// How a box lies to boxes: it has no inner point in common with any, it lies within one (or is so
/// much smaller than one it meets that it does not matter), or neither.
enum class Relation { Apart, Within, Partly };
Relation relation(const Box<2>& box, const std::vector<Box<2>>& gaps);

/// A few boxes that contain all of the given ones and not much more than these need.
std::vector<Box<2>> gathered(std::vector<Box<2>> boxes, const Box<2>& root);

}  // namespace encase
