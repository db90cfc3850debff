// SPDX-License-Identifier: MIT
#include "function_file.hpp"

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
#include "common/wording.hpp"
#include "expression_parser.hpp"
#include "json_tree.hpp"
#include "region_text.hpp"

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

/// What a file has, and how it is called.
template <int D>
const std::string kNoun = kZeroSet<D>;

/// Why the zeros of an expression are no curve or surface, or nothing.
template <int D>
std::string complaint(const std::string& name, const Expression& f) {
  bool constant = true;
  for (int axis = 0; axis < D; ++axis) constant = constant && !f.uses(axis);
  if (constant) return name + " has no variable: it is a constant";
  typename ExpressionProgram<D>::template Workspace<Interval> workspace;
  std::array<Interval, D> everywhere;
  everywhere.fill(elementary::whole_line());
  if (ExpressionProgram<D>(f).template value<Interval>(everywhere, workspace).nowhere())
    return name + " has no value at any point";
  return {};
}

/// Why a function has no curve or surface, or nothing.
template <int D>
std::string complaint(const NamedFunction<D>& named) {
  const std::string name = kNoun<D> + " " + in_quotes(named.name);
  if (named.function.is_expression()) return complaint<D>(name, named.function.expression());
  const Polynomial<D>& f = named.function.polynomial();
  if (f.is_zero()) return name + " is the zero polynomial, which vanishes everywhere";
  if (f.is_constant()) return name + " is a constant and not zero, so no point lies on it";
  return {};
}

template <int D>
std::string complaint_about_name(std::string_view name) {
  const bool fits = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
           c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
  });
  return fits ? "" : "a " + kNoun<D> + "'s name consists of letters, digits, '_', '-' and '.'";
}

std::variant<Region, SyntaxError> parse_region_in(std::string_view text, Region*) {
  return parse_plane_region(text);
}
std::variant<Polyhedron, SyntaxError> parse_region_in(std::string_view text, Polyhedron*) {
  return parse_solid_region(text);
}

/// The text format. Errors are SyntaxErrors with offsets into the whole text.
template <int D>
class TextReader {
 public:
  explicit TextReader(std::string_view text) : text_(text) {}

  std::variant<FunctionFile<D>, SyntaxError> read() {
    std::size_t begin = text_.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0;  // byte order mark
    for (;;) {
      const std::size_t newline = std::min(text_.find('\n', begin), text_.size());
      const Piece line = Piece{text_, 0}.part(begin, newline - begin);
      const Piece content = line.part(0, line.text.find('#')).trimmed();
      if (!content.text.empty() && !read_line(content)) return *error_;
      if (newline == text_.size()) break;
      begin = newline + 1;
    }
    if (file_.functions.empty()) return SyntaxError{text_.size(), "there is no " + kNoun<D>};
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
      return read_function(kNoun<D>.substr(0, 1) + std::to_string(file_.functions.size()), line,
                           line);
    const Piece name = line.part(0, colon).trimmed(), rest = line.part(colon + 1).trimmed();
    if (name.text == "region") return read_region(name, rest);
    const std::string complaint = complaint_about_name<D>(name.text);
    if (!complaint.empty()) return fail(name.offset, complaint);
    return read_function(std::string(name.text), name, rest);
  }

  bool read_region(const Piece& key, const Piece& value) {
    if (file_.region) return fail(key.offset, "the region is given twice");
    auto region = parse_region_in(value.text, static_cast<RegionIn<D>*>(nullptr));
    if (const auto* e = std::get_if<SyntaxError>(&region))
      return fail(value.offset + e->offset, e->message);
    file_.region = std::move(std::get<RegionIn<D>>(region));
    return true;
  }

  bool read_function(const std::string& name, const Piece& where, const Piece& expression) {
    const auto [previous, is_new] = offset_of_.emplace(name, where.offset);
    if (!is_new)
      return fail(where.offset, "there is already a " + kNoun<D> + " " + in_quotes(name) +
                                    ", in line " + std::to_string(line_number(previous->second)));
    auto f = parse_function<D>(expression.text);
    if (const auto* e = std::get_if<SyntaxError>(&f))
      return fail(expression.offset + e->offset, e->message);
    NamedFunction<D> named{name, std::move(std::get<Function<D>>(f))};
    const std::string reason = complaint(named);
    if (!reason.empty()) return fail(expression.offset, reason);
    file_.functions.push_back(std::move(named));
    return true;
  }

  std::size_t line_number(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(
                   std::count(text_.begin(), text_.begin() + static_cast<long>(offset), '\n'));
  }

  std::string_view text_;
  FunctionFile<D> file_;
  std::map<std::string, std::size_t> offset_of_;  // of the names
  std::optional<SyntaxError> error_;
};

/// The JSON format. Errors name the place by its path, like curves[2].terms[0].
template <int D>
class JsonReader {
 public:
  Result<FunctionFile<D>> read(const JsonTree& root, const std::string& source) {
    source_ = source;
    if (!read_root(root)) return *error_;
    return std::move(file_);
  }

 private:
  using Kind = JsonTree::Kind;
  const std::string kList = kNoun<D> + "s";

  bool fail(const std::string& path, const std::string& message) {
    error_ = bad(source_ + ": " + (path.empty() ? "" : path + ": ") + message);
    return false;
  }

  bool read_root(const JsonTree& root) {
    if (root.kind != Kind::Object) return fail("", "expected an object with \"" + kList + "\"");
    const JsonTree* list = nullptr;
    for (const auto& [key, value] : root.members) {
      if (key == "region") {
        if (!read_region(value)) return false;
      } else if (key == kList) {
        list = &value;
      } else if (key != "comment") {
        return fail("", "unknown key \"" + key + "\"; known are \"" + kList +
                            "\", \"region\", \"comment\"");
      }
    }
    if (!list || (list->kind == Kind::Array && list->items.empty()))
      return fail("", "there is no " + kNoun<D>);
    if (list->kind != Kind::Array) return fail(kList, "expected an array");
    for (std::size_t k = 0; k < list->items.size(); ++k)
      if (!read_function(list->items[k], k)) return false;
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
    if constexpr (D == 2)
      return read_plane_region(value);
    else
      return read_solid_region(value);
  }

  bool read_plane_region(const JsonTree& value) {
    constexpr char kForms[] =
        "expected [xmin, xmax, ymin, ymax], {\"polygon\": [[x, y], ...]} or \"plane\"";
    std::array<Rational, 4> b;
    std::vector<RationalPoint<2>> corners;
    if (value.kind == Kind::Array)
      return read_numbers(value, "region", kForms, &b) &&
             take_region(make_region(b[0], b[1], b[2], b[3]));
    if (value.kind == Kind::String && value.text == "plane") return take_region(whole_plane());
    return read_tuples(value, "polygon", kForms, "expected [x, y]", &corners) &&
           take_region(make_region(std::move(corners)));
  }

  bool read_solid_region(const JsonTree& value) {
    constexpr char kForms[] =
        "expected [x0, x1, y0, y1, z0, z1] or {\"halfspaces\": [[a, b, c, d], ...]}";
    std::array<Rational, 6> b;
    std::vector<HalfSpace> sides;
    if (value.kind == Kind::Array)
      return read_numbers(value, "region", kForms, &b) &&
             take_region(make_box({b[0], b[2], b[4]}, {b[1], b[3], b[5]}));
    return read_tuples(value, "halfspaces", kForms, "expected [a, b, c, d]", &sides) &&
           take_region(make_polyhedron(std::move(sides)));
  }

  /// An array of N numbers; `form` says so.
  template <std::size_t N>
  bool read_numbers(const JsonTree& value, const std::string& path, const char* form,
                    std::array<Rational, N>* numbers) {
    if (value.kind != Kind::Array || value.items.size() != N) return fail(path, form);
    for (std::size_t i = 0; i < N; ++i)
      if (!read_number(value.items[i], path + "[" + std::to_string(i) + "]", &(*numbers)[i]))
        return false;
    return true;
  }

  /// The region's only member `key`, an array of arrays of N numbers.
  template <std::size_t N>
  bool read_tuples(const JsonTree& value, const std::string& key, const char* forms,
                   const char* form, std::vector<std::array<Rational, N>>* tuples) {
    if (value.kind != Kind::Object || value.members.size() != 1 || value.members[0].first != key ||
        value.members[0].second.kind != Kind::Array)
      return fail("region", forms);
    const auto& list = value.members[0].second.items;
    tuples->resize(list.size());
    for (std::size_t k = 0; k < list.size(); ++k)
      if (!read_numbers(list[k], "region." + key + "[" + std::to_string(k) + "]", form,
                        &(*tuples)[k]))
        return false;
    return true;
  }
  bool take_region(Result<RegionIn<D>> region) {
    if (!region.ok()) return fail("region", region.error().message);
    file_.region = std::move(region).value();
    return true;
  }

  bool read_function(const JsonTree& value, std::size_t index) {
    const std::string path = kList + "[" + std::to_string(index) + "]";
    if (value.kind != Kind::Object) return fail(path, "expected an object");
    std::string name = kNoun<D>.substr(0, 1) + std::to_string(index);
    std::optional<Function<D>> f;
    for (const auto& [key, item] : value.members) {
      const std::string item_path = path + "." + key;
      if (key == "name") {
        if (item.kind != Kind::String) return fail(item_path, "expected a string");
        name = item.text;
        const std::string complaint = complaint_about_name<D>(name);
        if (!complaint.empty()) return fail(item_path, complaint);
      } else if (key == "expr" || key == "terms") {
        if (f) return fail(path, "a " + kNoun<D> + " has either \"expr\" or \"terms\"");
        f.emplace();
        if (!(key == "expr" ? read_expression(item, item_path, &*f)
                            : read_terms(item, item_path, &*f)))
          return false;
      } else if (key != "comment") {
        return fail(path, "unknown key \"" + key + "\"; known are \"name\", \"expr\", \"terms\"");
      }
    }
    if (!f) return fail(path, "a " + kNoun<D> + " needs \"expr\" or \"terms\"");
    for (const NamedFunction<D>& other : file_.functions)
      if (other.name == name)
        return fail(path, "there is already a " + kNoun<D> + " " + in_quotes(name));
    NamedFunction<D> named{std::move(name), std::move(*f)};
    const std::string reason = complaint(named);
    if (!reason.empty()) return fail(path, reason);
    file_.functions.push_back(std::move(named));
    return true;
  }

  bool read_expression(const JsonTree& item, const std::string& path, Function<D>* f) {
    if (item.kind != Kind::String) return fail(path, "expected a string");
    auto parsed = parse_function<D>(item.text);
    if (const auto* e = std::get_if<SyntaxError>(&parsed)) {
      error_ = bad(located(source_ + ": " + path, item.text, *e));
      return false;
    }
    *f = std::move(std::get<Function<D>>(parsed));
    return true;
  }

  bool read_terms(const JsonTree& list, const std::string& path, Function<D>* f) {
    const std::string form = D == 2 ? "[i, j, \"coefficient\"]" : "[i, j, k, \"coefficient\"]";
    if (list.kind != Kind::Array) return fail(path, "expected [" + form + ", ...]");
    std::vector<typename Polynomial<D>::Term> terms;
    for (std::size_t k = 0; k < list.items.size(); ++k) {
      const std::string item_path = path + "[" + std::to_string(k) + "]";
      const auto& items = list.items[k].items;
      if (list.items[k].kind != Kind::Array || items.size() != D + 1)
        return fail(item_path, "expected " + form);
      typename Polynomial<D>::Term term;
      int degree = 0;
      for (std::size_t i = 0; i < D; ++i) {
        Rational exponent;
        if (items[i].kind != Kind::Number || !parse_rational(items[i].text.c_str(), &exponent) ||
            exponent < 0 || exponent.get_den() != 1)
          return fail(item_path, "exponents are integers that are not negative");
        if (exponent > kMaxDegree) return fail(item_path, too_high(exponent.get_str()));
        term.exponent[i] = static_cast<int>(exponent.get_num().get_si());
        degree += term.exponent[i];
      }
      if (degree > kMaxDegree) return fail(item_path, too_high(std::to_string(degree)));
      if (!read_number(items[D], item_path + "[" + std::to_string(D) + "]", &term.coefficient))
        return false;
      terms.push_back(std::move(term));
    }
    *f = Polynomial<D>::from_terms(std::move(terms));
    return true;
  }
  static std::string too_high(const std::string& degree) {
    return "the degree is " + degree + "; polynomials are limited to degree " +
           std::to_string(kMaxDegree);
  }

  std::string source_;
  FunctionFile<D> file_;
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

template <int D>
Result<FunctionFile<D>> read_functions(const std::string& text, const std::string& source) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && text[first] == '{') {
    const auto tree = parse_json(text);
    if (const auto* e = std::get_if<SyntaxError>(&tree)) return bad(located(source, text, *e));
    return JsonReader<D>().read(std::get<JsonTree>(tree), source);
  }
  auto file = TextReader<D>(text).read();
  if (const auto* e = std::get_if<SyntaxError>(&file)) return bad(located(source, text, *e));
  return std::move(std::get<FunctionFile<D>>(file));
}

template <int D>
Result<FunctionFile<D>> load_functions(const std::string& path) {
  const auto text = file_contents(path);
  if (!text.ok()) return text.error();
  return read_functions<D>(text.value(), path == "-" ? "standard input" : path);
}

template Result<FunctionFile<2>> read_functions<2>(const std::string&, const std::string&);
template Result<FunctionFile<3>> read_functions<3>(const std::string&, const std::string&);
template Result<FunctionFile<2>> load_functions<2>(const std::string&);
template Result<FunctionFile<3>> load_functions<3>(const std::string&);

}  // namespace encase
