// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/surface_encasement.hpp"

namespace encase {

/// What a person reads of an encasement of surfaces: its status, the common points of three
/// surfaces, the curves in which two meet, the surfaces' shapes, what resists.
std::string report(const SurfaceEncasement& encasement);

/// What the steps of the algorithm did.
std::string statistics_report(const SurfaceEncasement& encasement);

}  // namespace encase
