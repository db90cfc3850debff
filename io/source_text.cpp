// SPDX-License-Identifier: MIT
#include "source_text.hpp"

#include <algorithm>
#include <cstdio>

namespace encase {

namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

/// The number of characters, and the text as a terminal can show it: tabs and other control
/// characters each as one blank.
std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return !continues_character(c); }));
}
std::string shown(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (is_control(c)) c = ' ';
  return result;
}

}  // namespace

std::string located(const std::string& source, std::string_view text, const SyntaxError& error) {
  constexpr std::size_t kMargin = 50;  // characters shown on either side of the place
  const std::size_t offset = std::min(error.offset, text.size());
  const std::size_t line =
      static_cast<std::size_t>(std::count(text.begin(), text.begin() + offset, '\n')) + 1;
  const std::size_t newline = text.substr(0, offset).rfind('\n');
  const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
  const std::size_t end = std::min(text.find('\n', offset), text.size());
  const std::size_t column = characters(text.substr(begin, offset - begin)) + 1;

  std::size_t from = offset - begin > kMargin ? offset - kMargin : begin;
  std::size_t to = end - offset > kMargin ? offset + kMargin : end;
  while (from < offset && continues_character(text[from])) ++from;
  while (to < end && continues_character(text[to])) ++to;
  const std::string before = (from > begin ? "..." : "") + shown(text.substr(from, offset - from));
  std::string after = shown(text.substr(offset, to - offset)) + (to < end ? "..." : "");
  while (!after.empty() && after.back() == ' ') after.pop_back();

  return source + ':' + std::to_string(line) + ':' + std::to_string(column) + ": " + error.message +
         "\n  " + before + after + "\n  " + std::string(characters(before), ' ') + '^';
}

std::string quoted_character(std::string_view text, std::size_t offset) {
  if (is_control(text[offset])) {
    char code[8];
    std::snprintf(code, sizeof code, "\\x%02X", static_cast<unsigned char>(text[offset]));
    return std::string("'") + code + "'";
  }
  std::size_t end = offset + 1;
  while (end < text.size() && end < offset + 4 && continues_character(text[end])) ++end;
  return "'" + std::string(text.substr(offset, end - offset)) + "'";
}

}  // namespace encase
