// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/caps.hpp"
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
/// lists of crossings and critical regions, the loop certificates, and the definition cell by cell;
/// where it is certified also that its arrangement exists and obeys the rules of `check`, Euler's
/// relation among them.
Verification verify(const Encasement& encasement, const VerifyOptions& options = {});

/// The same, and that a stored arrangement is that of the encasement, entry by entry, as `arrange`
/// derives it from the facts that were proved.
Verification verify(const Encasement& encasement, const Arrangement& arrangement,
                    const VerifyOptions& options = {});

/// Re-proves what is proved in a CAPS result (docs/caps.md): the quadtree and the labels of its
/// leaves, the regions, the vertices, the edges, and that the answer is what these make it. That a
/// delta-weak answer has the distance it names is claimed by the paper and not proved.
Verification verify(const CapsResult& result, const VerifyOptions& options = {});

}  // namespace encase
