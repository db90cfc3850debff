// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "source_text.hpp"

namespace encase {

/// A JSON value that keeps numbers as they were written, so that decimals can be taken exactly.
struct JsonTree {
  enum class Kind { Null, Boolean, Number, String, Array, Object };
  Kind kind = Kind::Null;
  std::string text;  ///< of a number or string
  std::vector<JsonTree> items;
  std::vector<std::pair<std::string, JsonTree>> members;  ///< in the order of the text
};

/// Parses a text; nesting is limited to 100 levels, and no object may have a key twice.
std::variant<JsonTree, SyntaxError> parse_json(std::string_view text);

}  // namespace encase
