// SPDX-License-Identifier: MIT
#include "json_tree.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace encase {

namespace {

using Json = nlohmann::json;

/// Receives the parser's events and builds the tree.
class Builder : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return add({}); }
  bool boolean(bool) override { return add({JsonTree::Kind::Boolean, {}, {}, {}}); }
  bool number_integer(number_integer_t value) override {
    return add({JsonTree::Kind::Number, std::to_string(value), {}, {}});
  }
  bool number_unsigned(number_unsigned_t value) override {
    return add({JsonTree::Kind::Number, std::to_string(value), {}, {}});
  }
  bool number_float(number_float_t, const string_t& written) override {
    return add({JsonTree::Kind::Number, written, {}, {}});
  }
  bool string(string_t& value) override { return add({JsonTree::Kind::String, value, {}, {}}); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonTree::Kind::Object); }
  bool start_array(std::size_t) override { return open(JsonTree::Kind::Array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& value) override {
    for (const auto& member : open_.back().members)
      if (member.first == value) return refuse("the key \"" + value + "\" appears twice");
    open_.back().members.emplace_back(value, JsonTree{});
    return true;
  }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    std::string message = error.what();
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."
    const std::size_t colon = message.find(": ");
    if (colon != std::string::npos) message = message.substr(colon + 2);
    error_ = {position > 0 ? position - 1 : 0, "not valid JSON: " + message};
    return false;
  }

  std::variant<JsonTree, SyntaxError> take(bool parsed) && {
    if (!parsed) return std::move(error_);
    return std::move(root_);
  }

 private:
  bool refuse(std::string message) {
    error_ = {0, std::move(message)};
    return false;
  }
  bool add(JsonTree value) {
    if (open_.empty())
      root_ = std::move(value);
    else if (open_.back().kind == JsonTree::Kind::Array)
      open_.back().items.push_back(std::move(value));
    else
      open_.back().members.back().second = std::move(value);
    return true;
  }
  bool open(JsonTree::Kind kind) {
    if (open_.size() == 100) return refuse("the JSON is nested too deeply");
    open_.push_back({kind, {}, {}, {}});
    return true;
  }
  bool close() {
    JsonTree done = std::move(open_.back());
    open_.pop_back();
    return add(std::move(done));
  }

  std::vector<JsonTree> open_;  // from the root to the innermost array or object
  JsonTree root_;
  SyntaxError error_;
};

}  // namespace

std::variant<JsonTree, SyntaxError> parse_json(std::string_view text) {
  Builder builder;
  const bool parsed = Json::sax_parse(text, &builder);
  return std::move(builder).take(parsed);
}

}  // namespace encase
