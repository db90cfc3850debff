// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "encase/result.hpp"
#include "encase/space_arrangement.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"

namespace encase {

/// The result as JSON, format "encase-result" version 1 (docs/json.md). Everything but `seconds` is
/// in it, exactly; facets hold results of their own. With `arrangement`, which must be that of the
/// encasement, it is a part of the result, and so are meshes of its surfaces. Equal results give
/// equal bytes.
std::string to_json(const SurfaceEncasement& encasement,
                    const SpaceArrangement* arrangement = nullptr,
                    const std::vector<SurfaceMesh>& meshes = {});

/// What a file holds.
struct StoredSurfaces {
  SurfaceEncasement encasement;
  std::optional<SpaceArrangement> arrangement;  ///< if it is in the file
  std::vector<SurfaceMesh> meshes;              ///< those in the file
};

/// Reads what `to_json` wrote. Every index refers to something that is there and every number is
/// within what Encase accepts; that the result is right is for `verify` to say, and for `check`
/// that the meshes are. BadInput otherwise, with the file's name and the place in it. Never
/// crashes, whatever the text.
Result<StoredSurfaces> surfaces_from_json(const std::string& text, const std::string& file_name);

/// One JSON object on one line: status, surfaces (encased), points (common to three of them),
/// intersection_curves, closed_curves (those among them without ends), cells, euler and components
/// (lists with one entry a surface; null where a cell that may meet it is not certified), seconds
/// (CPU); with `arrangement` also its regions.
std::string summary_json(const SurfaceEncasement& encasement,
                         const SpaceArrangement* arrangement = nullptr);

}  // namespace encase
