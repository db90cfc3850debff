// SPDX-License-Identifier: MIT
#pragma once

#include "encase/arrangement.hpp"
#include "json_node.hpp"
#include "json_writer.hpp"

/// The key `arrangement` of a result (docs/json.md).
namespace encase {

void put_arrangement(JsonWriter& w, const Arrangement& arrangement);

/// Every index refers to something that is there, the boundaries of the faces link the half-edges,
/// and what is said twice agrees; that it is the arrangement of the encasement is for `verify` to
/// say. Throws Malformed otherwise.
Arrangement read_arrangement(const JsonNode& node, const Encasement& encasement);

}  // namespace encase
