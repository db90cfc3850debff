// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/encasement.hpp"

namespace encase {

struct Verification {
  std::vector<std::string> objections;  ///< empty: every claim of the result is re-proved
  std::int64_t claims = 0;              ///< how many claims were re-proved
  bool ok() const { return objections.empty(); }
};

struct VerifyOptions {
  int max_bits = 848;
  int max_objections = 20;
  int threads = 1;  ///< how many may work; the verification is the same for any number
};

/// Re-proves an encasement from its stored facts and the exact input, without the search that found
/// it: the partition, the crossings on every edge, the crossing boxes, the completeness of the
/// lists of crossings and critical regions, the loop certificates, and the definition cell by cell.
Verification verify(const Encasement& encasement, const VerifyOptions& options = {});

}  // namespace encase
