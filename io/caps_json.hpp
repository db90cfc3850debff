// SPDX-License-Identifier: MIT
#pragma once

#include "encase/caps.hpp"
#include "json_node.hpp"

namespace encase {

/// The CAPS result that a document holds. Leaves by Malformed.
CapsResult read_caps(const JsonNode& root);

}  // namespace encase
