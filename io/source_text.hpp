// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "encase/result.hpp"

namespace encase {

/// What is wrong with a text, and the offset of the byte where it is.
struct SyntaxError {
  std::size_t offset = 0;
  std::string message;
};

/// "source:line:column: message", then the line and a caret below the place. Lines and columns
/// count from 1, columns in characters (UTF-8); long lines are cut around the place.
std::string located(const std::string& source, std::string_view text, const SyntaxError& error);

/// What was parsed, or the error at its place in the text.
template <class Parsed>
Result<Parsed> placed(std::variant<Parsed, SyntaxError> parsed, const std::string& text,
                      const std::string& source) {
  if (const auto* e = std::get_if<SyntaxError>(&parsed))
    return Error{Error::Code::BadInput, located(source, text, *e)};
  return std::move(std::get<Parsed>(parsed));
}

/// The character (UTF-8) at an offset, quoted for a message; control characters as \xNN.
std::string quoted_character(std::string_view text, std::size_t offset);

}  // namespace encase
