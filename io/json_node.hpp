// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "encase/geometry.hpp"
#include "names.hpp"

namespace encase {

/// Leaves the reader at the first thing wrong; caught in encasement_from_json.
struct Malformed {
  std::string what;
};

/// A value of the document with the way to it, for messages.
class JsonNode {
 public:
  explicit JsonNode(const nlohmann::json& json) : json_(&json) {}

  [[noreturn]] void fail(const std::string& what) const {
    const std::string place = path();
    throw Malformed{place.empty() ? what : place + ": " + what};
  }

  bool is_null() const { return json_->is_null(); }
  bool is_text() const { return json_->is_string(); }

  JsonNode member(const char* key) const {
    if (!json_->is_object()) fail("expected an object");
    const auto found = json_->find(key);
    if (found == json_->end()) fail("'" + std::string(key) + "' is missing");
    return JsonNode(*found, this, key, 0);
  }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  int size() const {
    if (!json_->is_array()) fail("expected a list");
    if (json_->size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      fail("the list is too long");
    return static_cast<int>(json_->size());
  }
  JsonNode item(int index) const { return JsonNode((*json_)[index], this, nullptr, index); }

  /// A list of exactly `count` items.
  const JsonNode& of_size(int count) const {
    if (size() != count) fail("expected a list of " + std::to_string(count));
    return *this;
  }
  template <class F>
  auto map(F read) const {
    std::vector<decltype(read(std::declval<const JsonNode&>()))> values;
    const int count = size();
    values.reserve(count);
    for (int k = 0; k < count; ++k) values.push_back(read(item(k)));
    return values;
  }

  double number() const {
    if (!json_->is_number()) fail("expected a number");
    const double value = json_->get<double>();
    if (!std::isfinite(value)) fail("the number is out of range");
    return value;
  }
  std::int64_t integer(std::int64_t least, std::int64_t most) const {
    if (!json_->is_number_integer()) fail("expected an integer");
    // Only numbers above the range of int64_t are held as unsigned by their own choice.
    const bool too_large = json_->is_number_unsigned() &&
                           json_->get<std::uint64_t>() >
                               static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    const std::int64_t value = too_large ? most : json_->get<std::int64_t>();
    if (too_large || value < least || value > most)
      fail(most < least ? "refers to something that is not there"
                        : "expected an integer from " + std::to_string(least) + " to " +
                              std::to_string(most));
    return value;
  }
  std::uint64_t unsigned_integer() const {
    if (!json_->is_number_unsigned()) fail("expected an integer that is not negative");
    return json_->get<std::uint64_t>();
  }
  std::int64_t count() const { return integer(0, std::numeric_limits<std::int64_t>::max()); }
  /// An index into a list of `size` items.
  int index(std::size_t size) const {
    return static_cast<int>(integer(0, static_cast<std::int64_t>(size) - 1));
  }
  int index_or_null(std::size_t size) const { return is_null() ? -1 : index(size); }
  bool boolean() const {
    if (!json_->is_boolean()) fail("expected true or false");
    return json_->get<bool>();
  }
  const std::string& text() const {
    if (!is_text()) fail("expected a string");
    return json_->get_ref<const std::string&>();
  }
  template <class E, std::size_t N>
  E one_of(const Name<E> (&names)[N]) const {
    const std::string& value = text();
    for (const Name<E>& name : names)
      if (value == name.text) return name.value;
    fail("unknown word '" + value.substr(0, 40) + "'");
  }

  /// The value as a text.
  std::string dump() const { return json_->dump(); }

  /// A string: an integer or a fraction p/q. No exponents, so that a short text is a small number.
  Rational rational() const {
    const std::string& value = text();
    const std::size_t sign = !value.empty() && value[0] == '-';
    const std::size_t slash = std::min(value.find('/'), value.size());
    const auto digits = [&](std::size_t from, std::size_t to) {
      return from < to && std::all_of(value.begin() + from, value.begin() + to,
                                      [](char c) { return c >= '0' && c <= '9'; });
    };
    if (!digits(sign, slash) || (slash < value.size() && !digits(slash + 1, value.size())))
      fail("expected an integer or a fraction in a string");
    Rational rational(value, 10);
    if (rational.get_den() == 0) fail("the denominator is zero");
    rational.canonicalize();
    return rational;
  }
  template <int D = 2>
  Point<D> point() const {
    of_size(D);
    Point<D> point;
    for (int axis = 0; axis < D; ++axis) point[axis] = item(axis).number();
    return point;
  }
  template <int D = 2>
  Box<D> box() const {
    of_size(D);
    Box<D> box;
    for (int axis = 0; axis < D; ++axis) {
      const JsonNode interval = item(axis);
      interval.of_size(2);
      box.lo[axis] = interval.item(0).number();
      box.hi[axis] = interval.item(1).number();
      if (box.lo[axis] > box.hi[axis]) interval.fail("the ends are in the wrong order");
    }
    return box;
  }
  std::vector<int> indices(std::size_t size) const {
    return map([&](const JsonNode& node) { return node.index(size); });
  }

 private:
  JsonNode(const nlohmann::json& json, const JsonNode* parent, const char* key, int index)
      : json_(&json), parent_(parent), key_(key), index_(index) {}

  std::string path() const {
    if (!parent_) return {};
    const std::string before = parent_->path();
    if (!key_) return before + "[" + std::to_string(index_) + "]";
    return before.empty() ? key_ : before + "." + key_;
  }

  const nlohmann::json* json_;
  const JsonNode* parent_ = nullptr;
  const char* key_ = nullptr;
  int index_ = 0;
};

}  // namespace encase
