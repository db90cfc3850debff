// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "encase/verify.hpp"

namespace encase::verification {

inline void append(std::string& text, const char* part) { text += part; }
inline void append(std::string& text, const std::string& part) { text += part; }
inline void append(std::string& text, int part) { text += std::to_string(part); }
inline void append(std::string& text, std::size_t part) { text += std::to_string(part); }

/// Counts claims and keeps objections.
struct Reporter {
  explicit Reporter(const VerifyOptions& options)
      : max_objections(options.max_objections > 1 ? options.max_objections : 1) {}

  /// Counts a claim that is proved, and objects to one that is not in a sentence made of `parts`.
  template <class... Parts>
  bool require(bool proved, const Parts&... parts) {
    if (proved) {
      ++report.claims;
      return true;
    }
    if (!full()) {
      std::string sentence;
      (append(sentence, parts), ...);
      report.objections.push_back(std::move(sentence));
    }
    return false;
  }
  /// Takes over what another verification found, of an item that is named.
  void include(const std::string& of, const Verification& other) {
    report.claims += other.claims;
    for (const std::string& objection : other.objections)
      if (!full()) report.objections.push_back(of + ": " + objection);
  }
  /// Enough objections: checking more would only take time.
  bool full() const { return static_cast<int>(report.objections.size()) >= max_objections; }

  int max_objections;
  Verification report;
};

}  // namespace encase::verification
