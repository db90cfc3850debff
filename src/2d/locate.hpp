// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "common/filtered_function.hpp"
#include "encase/encasement.hpp"

/// The region asked and the one used, where they differ.
namespace encase {

/// A polygon with double corners that contains the region and is larger by at most 2^-30 of its
/// diameter: corners moved outward by amounts that differ from corner to corner and attempt to
/// attempt.
std::optional<Region> enlarged(const Region& region, int attempt);

/// Decides for every crossing inside region_used, exactly, whether it lies in the interior of the
/// region asked, on its boundary or outside. One of curves that are no polynomials is never proved
/// to lie on the boundary: where precision does not tell, it is listed as undecided, and its cell
/// becomes so.
void locate_crossings(Encasement& encasement, Kernel& kernel);

}  // namespace encase
