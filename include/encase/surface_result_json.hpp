// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/surface_encasement.hpp"

namespace encase {

/// One JSON object on one line: status, surfaces (encased), points (common to three of them),
/// intersection_curves, closed_curves (those among them without ends), cells, euler and components
/// (lists with one entry a surface; null where a cell that may meet it is not certified), seconds
/// (CPU).
std::string summary_json(const SurfaceEncasement& encasement);

}  // namespace encase
