// SPDX-License-Identifier: MIT
#include "vtk_parts.hpp"

#include <set>

namespace encase {

std::vector<std::string> SignColumns::column_names(const std::vector<std::string>& functions) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < functions.size(); ++k) {
    std::string name = "sign_";
    for (const char c : functions[k]) {
      const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      name += plain ? c : '_';
    }
    if (!seen.insert(name).second) {
      name += "_" + std::to_string(k);
      seen.insert(name);
    }
    names.push_back(name);
  }
  return names;
}

}  // namespace encase
