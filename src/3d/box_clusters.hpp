// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// For every box the number of its connected component in their union, counted in the order of the
/// first boxes. Cost: that of comparing all that overlap in x.
std::vector<int> box_components(const std::vector<Box<3>>& boxes);

}  // namespace encase
