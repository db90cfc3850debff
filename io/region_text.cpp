// SPDX-License-Identifier: MIT
#include "region_text.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace encase {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

class RegionParser {
 public:
  explicit RegionParser(std::string_view text) : text_(text) {}

  std::variant<Region, SyntaxError> plane_region() {
    constexpr char kForms[] = "'xmin xmax ymin ymax', 'polygon (x,y) (x,y) ...' or 'plane'";
    skip_blanks();
    const std::string_view first = word();
    if (first.empty()) return error(std::string("a region is ") + kForms);
    if (first == "plane") {
      position_ += first.size();
      skip_blanks();
      if (position_ < text_.size()) return error("nothing may follow 'plane'");
      return whole_plane();
    }
    if (first == "polygon") {
      position_ += first.size();
      return polygon();
    }
    std::array<Rational, 4> bound;
    for (Rational& b : bound) {
      skip_separators();
      if (word().empty()) return error("a box has four numbers: xmin xmax ymin ymax");
      if (!number(&b)) return error(in_quotes(word()) + " is not a number; a region is " + kForms);
    }
    skip_blanks();
    if (position_ < text_.size())
      return error("a box has four numbers, xmin xmax ymin ymax, and nothing after them");
    return checked(make_region(bound[0], bound[1], bound[2], bound[3]));
  }

  std::variant<Polyhedron, SyntaxError> solid_region() {
    constexpr char kForms[] = "'box x0 x1 y0 y1 z0 z1' or 'halfspaces (a,b,c,d) (a,b,c,d) ...'";
    skip_blanks();
    const std::string_view first = word();
    position_ += first.size();
    if (first == "halfspaces") return half_spaces();
    if (first != "box") {
      position_ -= first.size();
      return error(std::string("a region of space is ") + kForms);
    }
    std::array<Rational, 6> bound;
    for (Rational& b : bound) {
      skip_separators();
      if (word().empty()) return error("a box has six numbers: x0 x1 y0 y1 z0 z1");
      if (!number(&b)) return error(in_quotes(word()) + " is not a number");
    }
    skip_blanks();
    if (position_ < text_.size())
      return error("a box has six numbers, x0 x1 y0 y1 z0 z1, and nothing after them");
    return checked(make_box({bound[0], bound[2], bound[4]}, {bound[1], bound[3], bound[5]}));
  }

  /// Four numbers, and nothing after them.
  std::variant<HalfSpace, SyntaxError> plane() {
    HalfSpace plane;
    for (Rational& c : plane) {
      skip_separators();
      if (word().empty())
        return error("a plane has four numbers, a b c d, of a x + b y + c z + d = 0");
      if (!number(&c)) return error(in_quotes(word()) + " is not a number");
    }
    skip_blanks();
    if (position_ < text_.size())
      return error("a plane has four numbers, a b c d, and nothing after them");
    return plane;
  }

 private:
  std::variant<Region, SyntaxError> polygon() {
    std::vector<RationalPoint<2>> corners;
    if (const auto e = tuples("a corner '(x,y)'", "a corner's two coordinates", &corners))
      return *e;
    return checked(make_region(std::move(corners)));
  }

  std::variant<Polyhedron, SyntaxError> half_spaces() {
    std::vector<HalfSpace> sides;
    if (const auto e = tuples("a half space '(a,b,c,d)'", "a half space's four numbers", &sides))
      return *e;
    return checked(make_polyhedron(std::move(sides)));
  }

  /// As many tuples of numbers in parentheses as there are; errors call one of them, and its end.
  template <std::size_t N>
  std::optional<SyntaxError> tuples(const std::string& one, const std::string& end,
                                    std::vector<std::array<Rational, N>>* result) {
    for (;;) {
      skip_separators();
      if (position_ == text_.size()) return std::nullopt;
      std::array<Rational, N> tuple;
      if (!symbol('(')) return error("expected " + one);
      for (std::size_t i = 0; i < N; ++i) {
        skip_blanks();
        if (i > 0 && symbol(',')) skip_blanks();
        if (!number(&tuple[i]))
          return error(word().empty() ? "expected a number"
                                      : in_quotes(word()) + " is not a number");
      }
      skip_blanks();
      if (!symbol(')')) return error("expected ')' after " + end);
      result->push_back(std::move(tuple));
    }
  }

  template <class Checked>
  static std::variant<Checked, SyntaxError> checked(Result<Checked> region) {
    if (!region.ok()) return SyntaxError{0, region.error().message};
    return std::move(region).value();
  }
  SyntaxError error(std::string message) const { return {position_, std::move(message)}; }

  void skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  }
  /// Blanks with at most one comma.
  void skip_separators() {
    skip_blanks();
    if (position_ > 0 && symbol(',')) skip_blanks();
  }
  bool symbol(char c) {
    if (position_ == text_.size() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  std::string_view word() const {
    std::size_t end = position_;
    while (end < text_.size() && !is_blank(text_[end]) &&
           std::string_view("(),").find(text_[end]) == std::string_view::npos)
      ++end;
    return text_.substr(position_, end - position_);
  }
  bool number(Rational* value) {
    const std::string_view text = word();
    if (!parse_rational(std::string(text).c_str(), value)) return false;
    position_ += text.size();
    return true;
  }

  std::string_view text_;
  std::size_t position_ = 0;
};

}  // namespace

std::variant<Region, SyntaxError> parse_plane_region(std::string_view text) {
  return RegionParser(text).plane_region();
}

std::variant<Polyhedron, SyntaxError> parse_solid_region(std::string_view text) {
  return RegionParser(text).solid_region();
}

std::variant<HalfSpace, SyntaxError> parse_plane(std::string_view text) {
  return RegionParser(text).plane();
}

}  // namespace encase
