// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>

namespace encase {

/// What options accept, with a message in plain words.
inline const CLI::Validator kPositive(
    [](const std::string& text) -> std::string {
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      return *end == 0 && value > 0 ? "" : "'" + text + "' is no positive number";
    },
    "POSITIVE");

inline const CLI::Validator kNatural(
    [](const std::string& text) -> std::string {
      const bool digits = text.find_first_not_of("0123456789") == std::string::npos;
      return digits ? "" : "'" + text + "' is not 0, 1, 2, ...";
    },
    "");

}  // namespace encase
