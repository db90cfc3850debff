// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/encasement.hpp"

namespace encase {

/// What a person reads of a result: its status, the table of crossings, what resists.
std::string report(const Encasement& encasement);

/// What each step of the algorithm did, numbered as in docs/encasement.md.
std::string statistics_report(const Encasement& encasement);

}  // namespace encase
