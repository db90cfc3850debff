// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

/// What messages call things.
namespace encase {

/// The zero set of a function in D coordinates.
template <int D>
inline constexpr const char* kZeroSet = D == 2 ? "curve" : "surface";

/// A number for people, in at most six digits.
inline std::string decimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

}  // namespace encase
