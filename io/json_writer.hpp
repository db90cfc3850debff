// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "encase/geometry.hpp"

namespace encase {

/// Builds a JSON text piece by piece.
class JsonWriter {
 public:
  std::string take() { return fmt::to_string(out_); }

  void raw(std::string_view text) { out_.append(text.data(), text.data() + text.size()); }
  void put(int value) { fmt::format_to(std::back_inserter(out_), "{}", value); }
  void put(std::int64_t value) { fmt::format_to(std::back_inserter(out_), "{}", value); }
  void put(std::uint64_t value) { fmt::format_to(std::back_inserter(out_), "{}", value); }
  void put(bool value) { raw(value ? "true" : "false"); }
  void put(double value) {
    // JSON has no infinities; readers take "-0" for the integer 0.
    if (!std::isfinite(value))
      raw("null");
    else if (value == 0)
      raw(std::signbit(value) ? "-0.0" : "0");
    else
      fmt::format_to(std::back_inserter(out_), "{}", value);
  }
  void put(const std::string& text) {
    raw(nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  void put(const char* text) { put(std::string(text)); }
  void put(Sign sign) { put(static_cast<int>(sign)); }
  void put(const Rational& value) {
    raw("\"");
    raw(value.get_str());
    raw("\"");
  }
  template <int D>
  void put(const Box<D>& box) {
    raw("[");
    for (int i = 0; i < D; ++i) {
      raw(i == 0 ? "[" : ",[");
      put(box.lo[i]), raw(","), put(box.hi[i]), raw("]");
    }
    raw("]");
  }
  template <class T, std::size_t N>
  void put(const std::array<T, N>& values) {
    list(values);
  }
  void put(const std::vector<int>& values) { list(values); }
  void put_index(int index) {
    if (index < 0)
      raw("null");
    else
      put(index);
  }

  /// "[a,b,c]", each item put by `put_item`.
  template <class Items, class PutItem>
  void list(const Items& items, PutItem put_item) {
    raw("[");
    bool first = true;
    for (const auto& item : items) {
      if (!first) raw(",");
      first = false;
      put_item(item);
    }
    raw("]");
  }
  template <class Items>
  void list(const Items& items) {
    list(items, [this](const auto& item) { put(item); });
  }
  /// A list with a line for each item.
  template <class Items, class PutItem>
  void lines(const Items& items, PutItem put_item) {
    if (std::empty(items)) return raw("[]");
    raw("[");
    bool first = true;
    for (const auto& item : items) {
      raw(first ? "\n" : ",\n");
      first = false;
      put_item(item);
    }
    raw("\n]");
  }
  /// `"key":value`, with a separator in front unless it is an object's first.
  template <class T>
  void field(const char* key, const T& value) {
    this->key(key);
    put(value);
  }
  /// The key of what begins a new line of the document, after another one.
  void section(const char* key) {
    raw(",\n");
    this->key(key);
  }
  void key(const char* key) {
    const char last = out_.size() ? out_[out_.size() - 1] : '{';
    if (last != '{' && last != '\n') raw(",");
    raw("\"");
    raw(key);
    raw("\":");
  }

 private:
  fmt::memory_buffer out_;
};

}  // namespace encase
