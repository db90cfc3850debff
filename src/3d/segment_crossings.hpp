// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "encase/function.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// Where the functions of surfaces change their sign on the way from one point to another: their
/// indices, in that order. Exact: by roots of polynomials in one variable. Nothing if two of them
/// change it, or one does and another is zero, at the same place or too near to it, if a function
/// is zero at an end, or is no polynomial.
std::optional<std::vector<int>> sign_changes(const std::vector<const Function<3>*>& functions,
                                             const RationalPoint<3>& from,
                                             const RationalPoint<3>& to);

}  // namespace encase
