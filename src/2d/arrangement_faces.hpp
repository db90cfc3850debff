// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/arrangement.hpp"

namespace encase {

/// Adds to vertices, edges, half-edges and the pieces of faces what follows from them: the faces'
/// boundaries, holes and signs, the components, and the curves' components. What contradicts a
/// planar subdivision, in a clause, or nothing.
std::string complete(const Encasement& encasement, Arrangement* arrangement);

}  // namespace encase
