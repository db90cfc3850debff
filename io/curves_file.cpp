// SPDX-License-Identifier: MIT
#include "encase/curves_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>
#include <variant>

#include "common/expression_program.hpp"
#include "expression_parser.hpp"
#include "json_tree.hpp"

namespace encase {

namespace {

Error bad(std::string message) { return {Error::Code::BadInput, std::move(message)}; }

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// A part of a text that knows where it begins.
struct Piece {
  std::string_view text;
  std::size_t offset = 0;

  Piece part(std::size_t begin, std::size_t length = std::string_view::npos) const {
    return {text.substr(begin, length), offset + begin};
  }
  Piece trimmed() const {
    std::size_t begin = 0, end = text.size();
    while (begin < end && is_blank(text[begin])) ++begin;
    while (end > begin && is_blank(text[end - 1])) --end;
    return part(begin, end - begin);
  }
};

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

/// Why the zeros of an expression are no curve, or nothing.
std::string complaint(const std::string& name, const Expression& f) {
  if (!f.uses(0) && !f.uses(1))
    return "curve " + in_quotes(name) + " has no variable: it is a constant";
  ExpressionProgram<2>::Workspace<Interval> workspace;
  const Interval line = elementary::whole_line();
  if (ExpressionProgram<2>(f).value<Interval>({line, line}, workspace).nowhere())
    return "curve " + in_quotes(name) + " has no value at any point";
  return {};
}

/// Why a function is no curve, or nothing.
std::string complaint(const std::string& name, const Function<2>& function) {
  if (!function.is_polynomial()) return complaint(name, function.expression());
  const Polynomial<2>& f = function.polynomial();
  if (f.is_zero())
    return "curve " + in_quotes(name) + " is the zero polynomial, which vanishes everywhere";
  if (f.is_constant())
    return "curve " + in_quotes(name) + " is a constant and not zero, so no point lies on it";
  return {};
}

std::string complaint_about_name(std::string_view name) {
  const bool fits = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
           c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
  });
  return fits ? "" : "a curve's name consists of letters, digits, '_', '-' and '.'";
}

class RegionParser {
 public:
  explicit RegionParser(std::string_view text) : text_(text) {}

  std::variant<Region, SyntaxError> parse() {
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

 private:
  std::variant<Region, SyntaxError> polygon() {
    std::vector<RationalPoint<2>> corners;
    for (;;) {
      skip_separators();
      if (position_ == text_.size()) break;
      RationalPoint<2> corner;
      if (!symbol('(')) return error("expected a corner '(x,y)'");
      for (int i = 0; i < 2; ++i) {
        skip_blanks();
        if (i == 1 && symbol(',')) skip_blanks();
        if (!number(&corner[i]))
          return error(word().empty() ? "expected a number"
                                      : in_quotes(word()) + " is not a number");
      }
      skip_blanks();
      if (!symbol(')')) return error("expected ')' after a corner's two coordinates");
      corners.push_back(std::move(corner));
    }
    return checked(make_region(std::move(corners)));
  }

  static std::variant<Region, SyntaxError> checked(Result<Region> region) {
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

/// The text format. Errors are SyntaxErrors with offsets into the whole text.
class TextReader {
 public:
  explicit TextReader(std::string_view text) : text_(text) {}

  std::variant<CurvesFile, SyntaxError> read() {
    std::size_t begin = text_.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;  // byte order mark
    for (;;) {
      const std::size_t newline = std::min(text_.find('\n', begin), text_.size());
      const Piece line = Piece{text_, 0}.part(begin, newline - begin);
      const Piece content = line.part(0, line.text.find('#')).trimmed();
      if (!content.text.empty() && !read_line(content)) return *error_;
      if (newline == text_.size()) break;
      begin = newline + 1;
    }
    if (file_.curves.empty()) return SyntaxError{text_.size(), "there is no curve"};
    return std::move(file_);
  }

 private:
  bool fail(std::size_t offset, std::string message) {
    error_ = SyntaxError{offset, std::move(message)};
    return false;
  }

  bool read_line(const Piece& line) {
    const std::size_t colon = line.text.find(':');
    if (colon == std::string_view::npos)
      return read_curve("c" + std::to_string(file_.curves.size()), line, line);
    const Piece name = line.part(0, colon).trimmed(), rest = line.part(colon + 1).trimmed();
    if (name.text == "region") return read_region(name, rest);
    const std::string complaint = complaint_about_name(name.text);
    if (!complaint.empty()) return fail(name.offset, complaint);
    return read_curve(std::string(name.text), name, rest);
  }

  bool read_region(const Piece& key, const Piece& value) {
    if (file_.region) return fail(key.offset, "the region is given twice");
    auto region = RegionParser(value.text).parse();
    if (const auto* e = std::get_if<SyntaxError>(&region))
      return fail(value.offset + e->offset, e->message);
    file_.region = std::move(std::get<Region>(region));
    return true;
  }

  bool read_curve(const std::string& name, const Piece& where, const Piece& expression) {
    const auto [previous, is_new] = offset_of_.emplace(name, where.offset);
    if (!is_new)
      return fail(where.offset, "there is already a curve " + in_quotes(name) + ", in line " +
                                    std::to_string(line_number(previous->second)));
    auto f = parse_function<2>(expression.text);
    if (const auto* e = std::get_if<SyntaxError>(&f))
      return fail(expression.offset + e->offset, e->message);
    auto& function = std::get<Function<2>>(f);
    const std::string reason = complaint(name, function);
    if (!reason.empty()) return fail(expression.offset, reason);
    file_.curves.push_back({name, std::move(function)});
    return true;
  }

  std::size_t line_number(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(
                   std::count(text_.begin(), text_.begin() + static_cast<long>(offset), '\n'));
  }

  std::string_view text_;
  CurvesFile file_;
  std::map<std::string, std::size_t> offset_of_;  // of the curves' names
  std::optional<SyntaxError> error_;
};

/// The JSON format. Errors name the place by its path, like curves[2].terms[0].
class JsonReader {
 public:
  Result<CurvesFile> read(const JsonTree& root, const std::string& source) {
    source_ = source;
    if (!read_root(root)) return *error_;
    return std::move(file_);
  }

 private:
  using Kind = JsonTree::Kind;

  bool fail(const std::string& path, const std::string& message) {
    error_ = bad(source_ + ": " + (path.empty() ? "" : path + ": ") + message);
    return false;
  }

  bool read_root(const JsonTree& root) {
    if (root.kind != Kind::Object) return fail("", "expected an object with \"curves\"");
    const JsonTree* curves = nullptr;
    for (const auto& [key, value] : root.members) {
      if (key == "region") {
        if (!read_region(value)) return false;
      } else if (key == "curves") {
        curves = &value;
      } else if (key != "comment") {
        return fail("",
                    "unknown key \"" + key + "\"; known are \"curves\", \"region\", \"comment\"");
      }
    }
    if (!curves || (curves->kind == Kind::Array && curves->items.empty()))
      return fail("", "there is no curve");
    if (curves->kind != Kind::Array) return fail("curves", "expected an array");
    for (std::size_t k = 0; k < curves->items.size(); ++k)
      if (!read_curve(curves->items[k], k)) return false;
    return true;
  }

  bool read_number(const JsonTree& value, const std::string& path, Rational* number) {
    if (value.kind != Kind::Number && value.kind != Kind::String)
      return fail(path, "expected a number, or one in a string");
    if (!parse_rational(value.text.c_str(), number) || value.text.find('\0') != std::string::npos)
      return fail(path, "\"" + value.text + "\" is not a number");
    return true;
  }

  bool read_region(const JsonTree& value) {
    constexpr char kForms[] =
        "expected [xmin, xmax, ymin, ymax], {\"polygon\": [[x, y], ...]} or \"plane\"";
    if (value.kind == Kind::Array) {
      if (value.items.size() != 4) return fail("region", kForms);
      std::array<Rational, 4> b;
      for (std::size_t i = 0; i < 4; ++i)
        if (!read_number(value.items[i], "region[" + std::to_string(i) + "]", &b[i])) return false;
      return take_region(make_region(b[0], b[1], b[2], b[3]));
    }
    if (value.kind == Kind::String && value.text == "plane") return take_region(whole_plane());
    if (value.kind != Kind::Object || value.members.size() != 1 ||
        value.members[0].first != "polygon" || value.members[0].second.kind != Kind::Array)
      return fail("region", kForms);
    const auto& list = value.members[0].second.items;
    std::vector<RationalPoint<2>> corners(list.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::string path = "region.polygon[" + std::to_string(k) + "]";
      if (list[k].kind != Kind::Array || list[k].items.size() != 2)
        return fail(path, "expected [x, y]");
      for (std::size_t i = 0; i < 2; ++i)
        if (!read_number(list[k].items[i], path + "[" + std::to_string(i) + "]", &corners[k][i]))
          return false;
    }
    return take_region(make_region(std::move(corners)));
  }
  bool take_region(Result<Region> region) {
    if (!region.ok()) return fail("region", region.error().message);
    file_.region = std::move(region).value();
    return true;
  }

  bool read_curve(const JsonTree& value, std::size_t index) {
    const std::string path = "curves[" + std::to_string(index) + "]";
    if (value.kind != Kind::Object) return fail(path, "expected an object");
    std::string name = "c" + std::to_string(index);
    std::optional<Function<2>> f;
    for (const auto& [key, item] : value.members) {
      const std::string item_path = path + "." + key;
      if (key == "name") {
        if (item.kind != Kind::String) return fail(item_path, "expected a string");
        name = item.text;
        const std::string complaint = complaint_about_name(name);
        if (!complaint.empty()) return fail(item_path, complaint);
      } else if (key == "expr" || key == "terms") {
        if (f) return fail(path, "a curve has either \"expr\" or \"terms\"");
        f.emplace();
        if (!(key == "expr" ? read_expression(item, item_path, &*f)
                            : read_terms(item, item_path, &*f)))
          return false;
      } else if (key != "comment") {
        return fail(path, "unknown key \"" + key + "\"; known are \"name\", \"expr\", \"terms\"");
      }
    }
    if (!f) return fail(path, "a curve needs \"expr\" or \"terms\"");
    for (const NamedCurve& curve : file_.curves)
      if (curve.name == name) return fail(path, "there is already a curve " + in_quotes(name));
    const std::string reason = complaint(name, *f);
    if (!reason.empty()) return fail(path, reason);
    file_.curves.push_back({std::move(name), std::move(*f)});
    return true;
  }

  bool read_expression(const JsonTree& item, const std::string& path, Function<2>* f) {
    if (item.kind != Kind::String) return fail(path, "expected a string");
    auto parsed = parse_function<2>(item.text);
    if (const auto* e = std::get_if<SyntaxError>(&parsed)) {
      error_ = bad(located(source_ + ": " + path, item.text, *e));
      return false;
    }
    *f = std::move(std::get<Function<2>>(parsed));
    return true;
  }

  bool read_terms(const JsonTree& list, const std::string& path, Function<2>* f) {
    if (list.kind != Kind::Array) return fail(path, "expected [[i, j, \"coefficient\"], ...]");
    std::vector<Polynomial<2>::Term> terms;
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      const std::string item_path = path + "[" + std::to_string(k) + "]";
      const auto& items = list.items[k].items;
      if (list.items[k].kind != Kind::Array || items.size() != 3)
        return fail(item_path, "expected [i, j, \"coefficient\"]");
      Polynomial<2>::Term term;
      for (std::size_t i = 0; i < 2; ++i) {
        Rational exponent;
        if (items[i].kind != Kind::Number || !parse_rational(items[i].text.c_str(), &exponent) ||
            exponent < 0 || exponent.get_den() != 1)
          return fail(item_path, "exponents are integers that are not negative");
        if (exponent > kMaxDegree) return fail(item_path, too_high(exponent.get_str()));
        term.exponent[i] = static_cast<int>(exponent.get_num().get_si());
      }
      if (term.exponent[0] + term.exponent[1] > kMaxDegree)
        return fail(item_path, too_high(std::to_string(term.exponent[0] + term.exponent[1])));
      if (!read_number(items[2], item_path + "[2]", &term.coefficient)) return false;
      terms.push_back(std::move(term));
    }
    *f = Polynomial<2>::from_terms(std::move(terms));
    return true;
  }
  static std::string too_high(const std::string& degree) {
    return "the degree is " + degree + "; polynomials are limited to degree " +
           std::to_string(kMaxDegree);
  }

  std::string source_;
  CurvesFile file_;
  std::optional<Error> error_;
};

/// The bytes of a file; "-" is standard input.
Result<std::string> file_contents(const std::string& path) {
  const auto io_error = [&](const std::string& reason) {
    return Error{Error::Code::Io, "cannot read " + path + ": " + reason};
  };
  if (path == "-") {
    std::string text{std::istreambuf_iterator<char>(std::cin), {}};
    if (std::cin.bad()) return io_error("standard input failed");
    return text;
  }
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return io_error("it is a directory");
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return io_error(errno ? std::strerror(errno) : "it cannot be opened");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) return io_error(errno ? std::strerror(errno) : "reading failed");
  return text;
}

}  // namespace

Result<CurvesFile> read_curves(const std::string& text, const std::string& source) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    const auto tree = parse_json(text);
    if (const auto* e = std::get_if<SyntaxError>(&tree)) return bad(located(source, text, *e));
    return JsonReader().read(std::get<JsonTree>(tree), source);
  }
  auto file = TextReader(text).read();
  if (const auto* e = std::get_if<SyntaxError>(&file)) return bad(located(source, text, *e));
  return std::move(std::get<CurvesFile>(file));
}

Result<CurvesFile> read_curves(std::istream& stream, const std::string& source) {
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) return Error{Error::Code::Io, "cannot read " + source};
  return read_curves(text, source);
}

Result<CurvesFile> load_curves(const std::string& path) {
  const auto text = file_contents(path);
  if (!text.ok()) return text.error();
  return read_curves(text.value(), path == "-" ? "standard input" : path);
}

Result<Polynomial<2>> parse_polynomial(const std::string& text, const std::string& source) {
  auto f = parse_polynomial<2>(text);
  if (const auto* e = std::get_if<SyntaxError>(&f)) return bad(located(source, text, *e));
  return std::move(std::get<Polynomial<2>>(f));
}

Result<Function<2>> parse_function(const std::string& text, const std::string& source) {
  auto f = parse_function<2>(text);
  if (const auto* e = std::get_if<SyntaxError>(&f)) return bad(located(source, text, *e));
  return std::move(std::get<Function<2>>(f));
}

Result<Region> parse_region(const std::string& text, const std::string& source) {
  auto region = RegionParser(text).parse();
  if (const auto* e = std::get_if<SyntaxError>(&region)) return bad(located(source, text, *e));
  return std::move(std::get<Region>(region));
}

}  // namespace encase
