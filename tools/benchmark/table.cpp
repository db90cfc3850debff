// SPDX-License-Identifier: MIT
#include "table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace encase::benchmark {
namespace {

/// Three significant digits, without an exponent where that is legible; whole numbers as such.
std::string rounded(double x) {
  const double size = std::fabs(x);
  if (size < 1e7 && x == std::floor(x)) return fmt::format("{:.0f}", x);
  if (size >= 1e7 || size < 1e-4) return fmt::format("{:.2e}", x);
  const int digits = 2 - static_cast<int>(std::floor(std::log10(size)));
  return fmt::format("{:.{}f}", x, std::max(0, digits));
}

struct Shown {
  std::string operator()(std::monostate) const { return "-"; }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(std::int64_t count) const { return std::to_string(count); }
  std::string operator()(double number) const { return rounded(number); }
};

struct Exactly {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
  }
  std::string operator()(std::int64_t count) const { return std::to_string(count); }
  std::string operator()(double number) const { return fmt::format("{}", number); }
};

struct AsJson {
  nlohmann::ordered_json operator()(std::monostate) const { return nullptr; }
  template <class T>
  nlohmann::ordered_json operator()(const T& value) const {
    return value;
  }
};

bool is_text(const Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [column](const auto& row) {
    return std::holds_alternative<std::string>(row[column]);
  });
}

}  // namespace

void Table::add(std::vector<Value> row) {
  if (row.size() != columns.size()) throw std::logic_error("table " + name + ": a row's length");
  rows.push_back(std::move(row));
}

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    widths.push_back(table.columns[k].size());
    for (const auto& row : table.rows)
      widths[k] = std::max(widths[k], std::visit(Shown(), row[k]).size());
  }
  std::string text = table.title + "\n";
  const auto add = [&](std::size_t k, const std::string& entry) {
    const bool left = k == 0 && is_text(table, k);
    text +=
        left ? fmt::format("{:<{}}", entry, widths[k]) : fmt::format("{:>{}}", entry, widths[k]);
    text += k + 1 < widths.size() ? "  " : "\n";
  };
  for (std::size_t k = 0; k < table.columns.size(); ++k) add(k, table.columns[k]);
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size(); ++k) add(k, std::visit(Shown(), row[k]));
  return text;
}

std::string to_markdown(const Table& table) {
  std::string text = fmt::format("**{}**\n\n|", table.title);
  for (const std::string& column : table.columns) text += fmt::format(" {} |", column);
  text += "\n|";
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    text += is_text(table, k) ? "---|" : "--:|";
  for (const auto& row : table.rows) {
    text += "\n|";
    for (const Value& value : row) text += fmt::format(" {} |", std::visit(Shown(), value));
  }
  return text + "\n";
}

std::string to_csv(const std::vector<Table>& tables) {
  std::string text;
  for (const Table& table : tables) {
    text += fmt::format("# {}\n", table.title);
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      text += (k > 0 ? "," : "") + Exactly()(table.columns[k]);
    text += '\n';
    for (const auto& row : table.rows) {
      for (std::size_t k = 0; k < row.size(); ++k)
        text += (k > 0 ? "," : "") + std::visit(Exactly(), row[k]);
      text += '\n';
    }
    text += '\n';
  }
  return text;
}

std::string to_json(const std::string& machine, const std::vector<Table>& tables) {
  nlohmann::ordered_json root;
  root["machine"] = machine;
  root["tables"] = nlohmann::ordered_json::object();
  for (const Table& table : tables) {
    auto& list = root["tables"][table.name] = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
      nlohmann::ordered_json entry;
      for (std::size_t k = 0; k < row.size(); ++k)
        entry[table.columns[k]] = std::visit(AsJson(), row[k]);
      list.push_back(std::move(entry));
    }
  }
  return root.dump(1) + "\n";
}

Value span_of(const std::vector<int>& counts) {
  if (counts.empty()) return {};
  const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
  if (*least == *most) return std::int64_t{*least};
  return fmt::format("{}-{}", *least, *most);
}

}  // namespace encase::benchmark
