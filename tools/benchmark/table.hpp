// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace encase::benchmark {

/// Nothing (a figure that was not measured), a text, a count or a measured number.
using Value = std::variant<std::monostate, std::string, std::int64_t, double>;

struct Table {
  std::string name;   ///< a word, the key of the table in JSON
  std::string title;  ///< a sentence
  std::vector<std::string> columns;
  std::vector<std::vector<Value>> rows;  ///< each as long as `columns`
  bool printed = true;                   ///< false: only in the CSV and JSON files

  /// Throws std::logic_error if the row is not as long as `columns`.
  void add(std::vector<Value> row);
};

/// With columns as wide as needed, numbers to three digits.
std::string to_text(const Table& table);

/// A table in Markdown below its title in bold, numbers to three digits.
std::string to_markdown(const Table& table);

/// One block a table: a line `# title`, the names of the columns, the rows, an empty line.
/// Numbers have all their digits.
std::string to_csv(const std::vector<Table>& tables);

/// {"machine": ..., "tables": {name: [{column: value, ...}, ...], ...}}
std::string to_json(const std::string& machine, const std::vector<Table>& tables);

/// "7", or "3-12" where the counts differ.
Value span_of(const std::vector<int>& counts);

}  // namespace encase::benchmark
