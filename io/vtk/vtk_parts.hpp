// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "encase/version.hpp"
#include "vtk_table.hpp"

/// What the blocks of all results have in common, those of curves, surfaces and CAPS; docs/vtk.md.
namespace encase {

/// What is said of a result as a whole: how it ended and what was given.
template <class Named>
FieldData field_data_of(const char* status, const std::vector<Named>& given) {
  std::vector<std::string> input;
  for (const Named& named : given) input.push_back(named.name + ": " + named.function.to_string());
  return {{"status", {status}}, {"input", input}, {"version", {std::string("encase ") + kVersion}}};
}

/// The names of some of the functions, with commas.
template <class Named, class Indices>
std::string names_of(const std::vector<Named>& functions, const Indices& indices) {
  std::string names;
  for (const int k : indices)
    names += (names.empty() ? "" : ", ") + functions[static_cast<std::size_t>(k)].name;
  return names;
}

/// Columns for the signs of all functions.
class SignColumns {
 public:
  template <class Named>
  SignColumns(const std::vector<Named>& functions, VtkTable* table) {
    std::vector<std::string> names;
    for (const Named& named : functions) names.push_back(named.name);
    for (const std::string& name : column_names(names))
      columns_.push_back(table->columns(integer(name)));
  }
  /// A row; signs that are not given are 0.
  template <class Signs>
  void operator()(const Signs& signs) const {
    for (std::size_t k = 0; k < columns_.size(); ++k)
      columns_[k](k < signs.size() ? static_cast<int>(signs[k]) : 0);
  }

 private:
  /// "sign_" and the name in plain ASCII, all different.
  static std::vector<std::string> column_names(const std::vector<std::string>& functions);
  std::vector<VtkRows<vtkIntArray>> columns_;
};

}  // namespace encase
