// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/result.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// The result as JSON, format "encase-result" version 1 (docs/json.md). Everything but `seconds` is
/// in it, exactly; facets hold results of their own. Equal results give equal bytes.
std::string to_json(const SurfaceEncasement& encasement);

/// Reads what `to_json` wrote. Every index refers to something that is there and every number is
/// within what Encase accepts; that the result is right is for `verify` to say. BadInput otherwise,
/// with the file's name and the place in it. Never crashes, whatever the text.
Result<SurfaceEncasement> surfaces_from_json(const std::string& text, const std::string& file_name);

/// One JSON object on one line: status, surfaces (encased), points (common to three of them),
/// intersection_curves, closed_curves (those among them without ends), cells, euler and components
/// (lists with one entry a surface; null where a cell that may meet it is not certified), seconds
/// (CPU).
std::string summary_json(const SurfaceEncasement& encasement);

}  // namespace encase
