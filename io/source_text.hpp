// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace encase {

/// What is wrong with a text, and the offset of the byte where it is.
struct SyntaxError {
  std::size_t offset = 0;
  std::string message;
};

/// "source:line:column: message", then the line and a caret below the place. Lines and columns
/// count from 1, columns in characters (UTF-8); long lines are cut around the place.
std::string located(const std::string& source, std::string_view text, const SyntaxError& error);

/// The character (UTF-8) at an offset, quoted for a message; control characters as \xNN.
std::string quoted_character(std::string_view text, std::size_t offset);

}  // namespace encase
