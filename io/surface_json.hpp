// SPDX-License-Identifier: MIT
#pragma once

#include "encase/surface_result_json.hpp"
#include "json_node.hpp"
#include "json_writer.hpp"

namespace encase {

/// The encasement of surfaces that a document holds, and its arrangement, if that is in it. Leaves
/// by Malformed.
StoredSurfaces read_surfaces(const JsonNode& root);

void put_arrangement(JsonWriter& w, const SpaceArrangement& arrangement);
SpaceArrangement read_arrangement(const JsonNode& node, const SurfaceEncasement& encasement);

void put_meshes(JsonWriter& w, const std::vector<SurfaceMesh>& meshes);
std::vector<SurfaceMesh> read_meshes(const JsonNode& node, const SurfaceEncasement& encasement);

}  // namespace encase
