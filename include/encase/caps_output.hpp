// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/caps.hpp"

/// Files of a CAPS result. Deterministic: no times but in the summary.
namespace encase {

/// The result as JSON, format "encase-result" version 1 with the command "caps" (docs/json.md).
std::string to_json(const CapsResult& result);

/// Reads what `to_json` wrote. Every index refers to something that is there and the tokens are
/// those of a quadtree with these leaves; that the result is right is for `verify` to say. BadInput
/// otherwise, with the file's name and the place in it. Never crashes, whatever the text.
Result<CapsResult> caps_from_json(const std::string& text, const std::string& file_name);

/// One JSON object on one line: status, delta, curves, nodes, depth, leaves (by label), regions,
/// vertices, crossings, edges, proved_edges, seconds and tree_seconds (CPU).
std::string summary_json(const CapsResult& result);

struct CapsSvgOptions {
  int size = 720;  ///< length of the box' longer side in pixels
  bool legend = true;
  bool axes = true;
};

/// A picture: the leaves tinted by their labels, the curves (where they are not proved as sampled),
/// and the vertices by their kinds.
std::string to_svg(const CapsResult& result, const CapsSvgOptions& options = {});

}  // namespace encase
