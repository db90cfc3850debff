// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "encase/surface_encasement.hpp"

namespace encase {

/// Tells of all faces of facets that border on each other along the common line of two planes:
/// they have a piece of it in common on which there is no point of a surface. A sentence in
/// `fault` if the facets do not fit together.
void for_neighbours_along_lines(
    const SurfaceEncasement& encasement,
    const std::function<void(int facet, int face, int other_facet, int other_face)>& tell,
    std::string* fault);

}  // namespace encase
