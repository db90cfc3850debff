// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "encase/function.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// (grad f x grad g) . w, exactly: where it is not zero, the curve f = g = 0 moves in the direction
/// w or against it. Nothing unless both are polynomials: expressions have no symbolic derivatives.
std::optional<Polynomial<3>> arc_direction(const Function<3>& f, const Function<3>& g,
                                           const Point<3>& w);

}  // namespace encase
