// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "encase/verify.hpp"

namespace encase {

/// What a verification objects to, a line each.
inline std::string text(const Verification& verification) {
  std::string all;
  for (const std::string& objection : verification.objections) all += objection + "\n";
  return all;
}

}  // namespace encase
