// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "encase/arrangement.hpp"
#include "encase/caps.hpp"
#include "encase/encasement.hpp"
#include "encase/slice.hpp"
#include "encase/surface_result_json.hpp"

namespace encase {

/// The result as JSON, format "encase-result" version 1 (docs/json.md). Everything but `seconds` is
/// in it, exactly: doubles as the shortest decimals that read back, rationals as strings. With
/// `arrangement`, which must be that of the encasement, it is a part of the result. Equal results
/// give equal bytes.
std::string to_json(const Encasement& encasement, const Arrangement* arrangement = nullptr);

/// The same of a slice, with its surfaces, their region and the plane.
std::string to_json(const Slice& slice, const Arrangement* arrangement = nullptr);

/// What a file holds.
struct StoredResult {
  Encasement encasement;
  std::optional<Arrangement> arrangement;  ///< if it is in the file
  std::optional<SliceSource> source;       ///< if the result is a slice
};

/// Reads what `to_json` wrote. Every index in the result refers to something that is there, every
/// degree and every number is within what Encase accepts, the history is a forest, and the
/// boundaries of the arrangement's faces are closed; that the result is right is for `verify` to
/// say. BadInput otherwise, with the file's name and the place in it. Never crashes, whatever the
/// text.
Result<StoredResult> result_from_json(const std::string& text, const std::string& file_name);

/// The same, whichever command wrote it.
using AnyResult = std::variant<StoredResult, CapsResult, StoredSurfaces>;
Result<AnyResult> any_result_from_json(const std::string& text, const std::string& file_name);

/// The same, of the encasement alone.
Result<Encasement> encasement_from_json(const std::string& text, const std::string& file_name);

/// One JSON object on one line: status, curves (encased), crossings (not counting those outside the
/// region asked for), cells, relaxed_cells, pairs_met, pairs_isolated, filter_failures, seconds
/// (CPU); with `arrangement` also its vertices, edges, faces (without the outside) and components.
std::string summary_json(const Encasement& encasement, const Arrangement* arrangement = nullptr);

}  // namespace encase
