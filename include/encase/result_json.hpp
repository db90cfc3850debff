// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/encasement.hpp"

namespace encase {

/// The result as JSON, format "encase-result" version 1 (docs/json.md). Everything but `seconds` is
/// in it, exactly: doubles as the shortest decimals that read back, rationals as strings. Equal
/// encasements give equal bytes.
std::string to_json(const Encasement& encasement);

/// Reads what `to_json` wrote. Every index in the result refers to something that is there, every
/// degree and every number is within what Encase accepts, and the history is a forest; that the
/// result is right is for `verify` to say. BadInput otherwise, with the file's name and the place
/// in it. Never crashes, whatever the text.
Result<Encasement> encasement_from_json(const std::string& text, const std::string& file_name);

/// One JSON object on one line: status, curves (encased), crossings (not counting those outside the
/// region asked for), cells, relaxed_cells, pairs_met, pairs_isolated, filter_failures, seconds
/// (CPU).
std::string summary_json(const Encasement& encasement);

}  // namespace encase
