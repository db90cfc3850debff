// SPDX-License-Identifier: MIT
#include "encase/result_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

namespace encase {
namespace {

using Json = nlohmann::json;

constexpr int kVersion = 1;

template <class E>
struct Name {
  E value;
  const char* text;
};

constexpr Name<Outcome> kOutcomes[] = {{Outcome::Certified, "certified"},
                                       {Outcome::Degenerate, "degenerate"},
                                       {Outcome::Undecided, "undecided"}};
constexpr Name<Location> kLocations[] = {{Location::Inside, "inside"},
                                         {Location::OnBoundary, "on_boundary"},
                                         {Location::Outside, "outside"}};
constexpr Name<CellState> kStates[] = {{CellState::Certified, "certified"},
                                       {CellState::Relaxed, "relaxed"},
                                       {CellState::Degenerate, "degenerate"},
                                       {CellState::Undecided, "undecided"}};
constexpr Name<Unresolved::Kind> kKinds[] = {
    {Unresolved::Kind::Contact, "contact"},
    {Unresolved::Kind::SingularPoint, "singular_point"},
    {Unresolved::Kind::Concurrency, "concurrency"},
    {Unresolved::Kind::SharedComponent, "shared_component"},
    {Unresolved::Kind::RepeatedComponent, "repeated_component"},
    {Unresolved::Kind::Infinity, "infinity"},
    {Unresolved::Kind::Budget, "budget"}};

template <class E, std::size_t N>
const char* name_of(const Name<E> (&names)[N], E value) {
  for (const Name<E>& name : names)
    if (name.value == value) return name.text;
  return "";
}

/// The curves of these are indices of input curves, of the others indices of encased curves.
bool names_input_curves(Unresolved::Kind kind) {
  return kind == Unresolved::Kind::SharedComponent || kind == Unresolved::Kind::RepeatedComponent;
}

// --- Writing -----------------------------------------------------------------------------------

class Writer {
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
    raw(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
  }
  void put(const char* text) { put(std::string(text)); }
  void put(Sign sign) { put(static_cast<int>(sign)); }
  void put(const Rational& value) {
    raw("\"");
    raw(value.get_str());
    raw("\"");
  }
  void put(const Box<2>& box) {
    raw("[[");
    put(box.lo[0]), raw(","), put(box.hi[0]), raw("],[");
    put(box.lo[1]), raw(","), put(box.hi[1]), raw("]]");
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

void put_terms(Writer& w, const Polynomial<2>& polynomial) {
  w.list(polynomial.terms(), [&](const Polynomial<2>::Term& term) {
    w.raw("[");
    w.put(term.exponent[0]), w.raw(","), w.put(term.exponent[1]), w.raw(",");
    w.put(term.coefficient);
    w.raw("]");
  });
}

void put_region(Writer& w, const Region& region) {
  if (region.plane) return w.put("plane");
  w.raw("{\"polygon\":");
  w.list(region.corners);
  w.raw("}");
}

void put_line(Writer& w, const Line& line) {
  if (line.rational)
    w.put(*line.rational);
  else
    w.put(std::array<double, 3>{line.normal[0], line.normal[1], line.offset});
}

void put_crossing(Writer& w, const Crossing& crossing, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("curves", crossing.curves);
  w.field("x", crossing.point[0]);
  w.field("y", crossing.point[1]);
  w.field("rounded", crossing.rounded);
  w.field("box", crossing.box);
  w.key("cell"), w.put_index(crossing.cell);
  w.field("location", name_of(kLocations, crossing.location));
  w.raw("}");
}

void put_cell(Writer& w, const Cell& cell, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("state", name_of(kStates, cell.state));
  w.field("relaxed", cell.state == CellState::Relaxed);
  w.field("depth", cell.depth);
  w.key("lines");
  w.list(cell.vertices, [&](const Vertex& vertex) { w.put(vertex.line_out); });
  w.key("vertices");
  w.list(cell.vertices, [&](const Vertex& vertex) { w.put(vertex.point); });
  w.raw(",\"cuts\":[");
  bool first = true;
  for (std::size_t k = 0; k < cell.vertices.size(); ++k) {
    const Vertex& vertex = cell.vertices[k];
    if (vertex.line_in != vertex.line_out && vertex.parameter == 0) continue;
    w.raw(first ? "[" : ",[");
    first = false;
    w.put(static_cast<int>(k)), w.raw(","), w.put(vertex.parameter), w.raw("]");
  }
  w.raw("]");
  w.field("word", cell.word);
  w.key("branches");
  w.list(cell.branches, [&](const Branch& branch) {
    w.put(std::array<int, 3>{branch.curve, branch.from, branch.to});
  });
  w.key("crossing"), w.put_index(cell.crossing);
  w.key("loop_certificates");
  w.list(cell.loop_certificates, [&](const LoopCertificate& certificate) {
    w.raw("{");
    w.field("critical", certificate.critical_region);
    w.field("from", certificate.from);
    w.field("to", certificate.to);
    w.raw("}");
  });
  w.raw("}");
}

void put_unresolved(Writer& w, const std::vector<Unresolved>& places) {
  w.lines(places, [&](const Unresolved& place) {
    w.raw("{");
    w.field("kind", name_of(kKinds, place.kind));
    w.key("box");
    if (place.has_box)
      w.put(place.box);
    else
      w.raw("null");
    w.field("curves", place.curves);
    w.field("proved", place.proved);
    w.field("reason", place.reason);
    w.raw("}");
  });
}

void put_covers(Writer& w, const Encasement& e) {
  w.raw("{");
  if (!e.shared_cover.tokens.empty()) {
    w.raw("\"shared\":{");
    w.field("root", e.shared_cover.root);
    w.field("tokens", e.shared_cover.tokens);
    w.key("alive"), w.list(e.shared_cover.alive);
    w.raw("},\n");
  }
  w.raw("\"crossings\":");
  w.lines(e.crossing_covers, [&](const CrossingCover& cover) {
    w.raw("{");
    w.field("curves", cover.curves);
    w.field("root", cover.root);
    w.field("tokens", cover.tokens);
    w.raw("}");
  });
  w.raw(",\n\"critical\":");
  w.lines(e.critical_covers, [&](const CriticalCover& cover) {
    w.raw("{");
    w.field("curve", cover.curve);
    w.field("root", cover.root);
    w.field("tokens", cover.tokens);
    w.raw("}");
  });
  w.raw("}");
}

/// The counts of pairs as well unless there is one pair at most: then they follow from its cover.
void put_statistics(Writer& w, const Statistics& s, bool with_pairs) {
  w.raw("{\"decisions\":{");
  w.field("by_double", s.decisions.by_double);
  w.field("by_mpfr", s.decisions.by_mpfr);
  w.field("by_exact", s.decisions.by_exact);
  w.field("undecided", s.decisions.undecided);
  w.raw("}");
  if (with_pairs) {
    w.field("pairs_met", s.pairs_met);
    w.field("pairs_isolated", s.pairs_isolated);
    w.field("filter_failures", s.filter_failures);
  }
  w.field("root_boxes", s.root_boxes);
  w.field("critical_boxes", s.critical_boxes);
  w.field("restrictions", s.restrictions);
  w.field("expansions", s.expansions);
  w.field("mpfr_expansions", s.mpfr_expansions);
  w.field("candidate_lines", s.candidate_lines);
  w.field("splits", s.splits);
  w.field("loop_splits", s.loop_splits);
  w.raw("}");
}

// --- Reading -----------------------------------------------------------------------------------

// Leaves the reader at the first thing wrong; caught in encasement_from_json.
struct Malformed {
  std::string what;
};

/// A value of the document with the way to it, for messages.
class Node {
 public:
  explicit Node(const Json& json) : json_(&json) {}

  [[noreturn]] void fail(const std::string& what) const {
    const std::string place = path();
    throw Malformed{place.empty() ? what : place + ": " + what};
  }

  bool is_null() const { return json_->is_null(); }
  bool is_text() const { return json_->is_string(); }

  Node member(const char* key) const {
    if (!json_->is_object()) fail("expected an object");
    const auto found = json_->find(key);
    if (found == json_->end()) fail("'" + std::string(key) + "' is missing");
    return Node(*found, this, key, 0);
  }
  bool has(const char* key) const { return json_->is_object() && json_->contains(key); }
  int size() const {
    if (!json_->is_array()) fail("expected a list");
    if (json_->size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      fail("the list is too long");
    return static_cast<int>(json_->size());
  }
  Node item(int index) const { return Node((*json_)[index], this, nullptr, index); }

  /// A list of exactly `count` items.
  const Node& of_size(int count) const {
    if (size() != count) fail("expected a list of " + std::to_string(count));
    return *this;
  }
  template <class F>
  auto map(F read) const {
    std::vector<decltype(read(std::declval<const Node&>()))> values;
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
  Point<2> point() const {
    of_size(2);
    return {item(0).number(), item(1).number()};
  }
  Box<2> box() const {
    of_size(2);
    Box<2> box;
    for (int axis = 0; axis < 2; ++axis) {
      const Node interval = item(axis);
      interval.of_size(2);
      box.lo[axis] = interval.item(0).number();
      box.hi[axis] = interval.item(1).number();
      if (box.lo[axis] > box.hi[axis]) interval.fail("the ends are in the wrong order");
    }
    return box;
  }
  std::vector<int> indices(std::size_t size) const {
    return map([&](const Node& node) { return node.index(size); });
  }

 private:
  Node(const Json& json, const Node* parent, const char* key, int index)
      : json_(&json), parent_(parent), key_(key), index_(index) {}

  std::string path() const {
    if (!parent_) return {};
    const std::string before = parent_->path();
    if (!key_) return before + "[" + std::to_string(index_) + "]";
    return before.empty() ? key_ : before + "." + key_;
  }

  const Json* json_;
  const Node* parent_ = nullptr;
  const char* key_ = nullptr;
  int index_ = 0;
};

Polynomial<2> read_terms(const Node& node) {
  auto terms = node.map([](const Node& term) {
    term.of_size(3);
    Polynomial<2>::Term read;
    read.exponent[0] = static_cast<int>(term.item(0).integer(0, kMaxDegree));
    read.exponent[1] = static_cast<int>(term.item(1).integer(0, kMaxDegree - read.exponent[0]));
    read.coefficient = term.item(2).rational();
    return read;
  });
  Polynomial<2> polynomial = Polynomial<2>::from_terms(std::move(terms));
  if (polynomial.is_constant()) node.fail("the polynomial is constant");
  return polynomial;
}

Region read_region(const Node& node) {
  if (node.is_text()) {
    if (node.text() != "plane") node.fail("a region is a polygon or \"plane\"");
    return whole_plane();
  }
  const Node polygon = node.member("polygon");
  auto corners = polygon.map([](const Node& corner) {
    corner.of_size(2);
    return RationalPoint<2>{corner.item(0).rational(), corner.item(1).rational()};
  });
  Result<Region> region = make_region(std::move(corners));
  if (!region) polygon.fail(region.error().message);
  return std::move(region).value();
}

Line read_line(const Node& node) {
  node.of_size(3);
  Line line;
  if (node.item(0).is_text()) {
    std::array<Rational, 3> c;
    for (int k = 0; k < 3; ++k) c[k] = node.item(k).rational();
    if (c[0] == 0 && c[1] == 0) node.fail("a line needs a normal");
    line = Line::from_rationals(c);
    if (!std::isfinite(line.normal[0]) || !std::isfinite(line.normal[1]) ||
        !std::isfinite(line.offset) || (line.normal[0] == 0 && line.normal[1] == 0))
      node.fail("the numbers are out of range");
    return line;
  }
  line.normal = {node.item(0).number(), node.item(1).number()};
  line.offset = node.item(2).number();
  if (line.normal[0] == 0 && line.normal[1] == 0) node.fail("a line needs a normal");
  return line;
}

std::array<int, 2> read_pair(const Node& node, std::size_t curves) {
  node.of_size(2);
  const std::array<int, 2> pair = {node.item(0).index(curves), node.item(1).index(curves)};
  if (pair[0] >= pair[1]) node.fail("expected two different curves in ascending order");
  return pair;
}

std::vector<int> read_tokens(const Node& node, std::size_t items) {
  return node.map([&](const Node& token) {
    const auto value = token.integer(cover::kUnresolved, static_cast<std::int64_t>(items) - 1);
    if (value == cover::kSplitZ) token.fail("a plane cover is not cut in z");
    return static_cast<int>(value);
  });
}

SharedCover read_shared_cover(const Node& node, std::size_t curves) {
  SharedCover cover;
  cover.root = node.member("root").box();
  cover.alive = node.member("alive").map([&](const Node& list) { return list.indices(curves); });
  cover.tokens = read_tokens(node.member("tokens"), cover.alive.size());
  return cover;
}

LineCrossing read_line_crossing(const Node& node, std::size_t lines, std::size_t curves) {
  LineCrossing crossing;
  crossing.line = node.member("line").index(lines);
  crossing.curve = node.member("curve").index(curves);
  const Node interval = node.member("interval");
  interval.of_size(2);
  crossing.lo = interval.item(0).number();
  crossing.hi = interval.item(1).number();
  if (!(crossing.lo < crossing.hi)) interval.fail("the ends are in the wrong order");
  return crossing;
}

Crossing read_crossing(const Node& node, std::size_t curves, std::size_t cells) {
  Crossing crossing;
  crossing.curves = read_pair(node.member("curves"), curves);
  crossing.point = {node.member("x").number(), node.member("y").number()};
  crossing.rounded = node.member("rounded").boolean();
  crossing.box = node.member("box").box();
  crossing.cell = node.member("cell").index_or_null(cells);
  crossing.location = node.member("location").one_of(kLocations);
  return crossing;
}

/// Lines of edges, rounded vertices and cuts, put together to vertices.
std::vector<Vertex> read_vertices(const Node& node, std::size_t lines) {
  const std::vector<int> edge_lines = node.member("lines").indices(lines);
  const Node points = node.member("vertices");
  const int count = static_cast<int>(edge_lines.size());
  if (count < 3) node.member("lines").fail("a cell has at least three edges");
  points.of_size(count);
  std::vector<Vertex> vertices(count);
  for (int k = 0; k < count; ++k) {
    vertices[k].line_in = edge_lines[k == 0 ? count - 1 : k - 1];
    vertices[k].line_out = edge_lines[k];
    vertices[k].point = points.item(k).point();
  }
  const Node cuts = node.member("cuts");
  const int cut_count = cuts.size();
  for (int k = 0; k < cut_count; ++k) {
    const Node cut = cuts.item(k);
    cut.of_size(2);
    vertices[cut.item(0).index(vertices.size())].parameter = cut.item(1).number();
  }
  return vertices;
}

Cell read_cell(const Node& node, const Encasement& e, std::size_t crossings) {
  Cell cell;
  cell.state = node.member("state").one_of(kStates);
  if (node.member("relaxed").boolean() != (cell.state == CellState::Relaxed))
    node.member("relaxed").fail("contradicts 'state'");
  cell.depth = static_cast<int>(node.member("depth").integer(0, std::numeric_limits<int>::max()));
  cell.vertices = read_vertices(node, e.lines.size());
  cell.word = node.member("word").indices(e.line_crossings.size());
  cell.branches = node.member("branches").map([&](const Node& branch) {
    branch.of_size(3);
    return Branch{branch.item(0).index(e.curves.size()),
                  branch.item(1).index(e.line_crossings.size()),
                  branch.item(2).index(e.line_crossings.size())};
  });
  cell.crossing = node.member("crossing").index_or_null(crossings);
  cell.loop_certificates = node.member("loop_certificates").map([&](const Node& certificate) {
    return LoopCertificate{certificate.member("critical").index(e.critical_regions.size()),
                           certificate.member("from").point(), certificate.member("to").point()};
  });
  return cell;
}

/// Children come after their parents and each has one parent, so that walks down the history end.
std::vector<Split> read_history(const Node& node, std::size_t lines, std::size_t cells) {
  const int count = node.size();
  std::vector<bool> node_seen(count), cell_seen(cells);
  std::vector<Split> history(count);
  for (int k = 0; k < count; ++k) {
    const Node split = node.item(k);
    split.of_size(3);
    history[k].line = split.item(0).index(lines);
    const auto read_child = [&](const Node& child) {
      const int index =
          static_cast<int>(child.integer(-static_cast<std::int64_t>(cells), count - 1));
      if (index >= 0 && index <= k) child.fail("a cut refers to one that is not after it");
      std::vector<bool>& seen = index >= 0 ? node_seen : cell_seen;
      const std::size_t slot = index >= 0 ? index : ~index;
      if (seen[slot]) child.fail("a piece has two parents");
      seen[slot] = true;
      return index;
    };
    history[k].negative = read_child(split.item(1));
    history[k].positive = read_child(split.item(2));
  }
  return history;
}

std::vector<Unresolved> read_unresolved(const Node& node, const Encasement& e) {
  return node.map([&](const Node& item) {
    Unresolved place;
    place.kind = item.member("kind").one_of(kKinds);
    const Node box = item.member("box");
    place.has_box = !box.is_null();
    if (place.has_box) place.box = box.box();
    place.curves = item.member("curves").indices(names_input_curves(place.kind) ? e.input.size()
                                                                                : e.curves.size());
    place.proved = item.member("proved").boolean();
    place.reason = item.member("reason").text();
    return place;
  });
}

Statistics read_statistics(const Node& node) {
  Statistics s;
  const Node decisions = node.member("decisions");
  s.decisions.by_double = decisions.member("by_double").count();
  s.decisions.by_mpfr = decisions.member("by_mpfr").count();
  s.decisions.by_exact = decisions.member("by_exact").count();
  s.decisions.undecided = decisions.member("undecided").count();
  if (node.has("pairs_met")) {
    s.pairs_met = node.member("pairs_met").count();
    s.pairs_isolated = node.member("pairs_isolated").count();
    s.filter_failures = node.member("filter_failures").count();
  }
  s.root_boxes = node.member("root_boxes").count();
  s.critical_boxes = node.member("critical_boxes").count();
  s.restrictions = node.member("restrictions").count();
  s.expansions = node.member("expansions").count();
  s.mpfr_expansions = node.member("mpfr_expansions").count();
  s.candidate_lines = node.member("candidate_lines").count();
  s.splits = node.member("splits").count();
  s.loop_splits = node.member("loop_splits").count();
  return s;
}

Encasement read_encasement(const Node& root) {
  if (root.member("format").text() != "encase-result")
    root.member("format").fail("this is not a result of encase");
  const Node version = root.member("version");
  if (version.integer(0, std::numeric_limits<int>::max()) != kVersion)
    version.fail("this version of encase reads version " + std::to_string(kVersion) + " only");
  if (root.member("command").text() != "curves")
    root.member("command").fail("this version of encase reads results of 'curves' only");

  Encasement e;
  e.outcome = root.member("status").one_of(kOutcomes);
  const Node input = root.member("input");
  e.input = input.member("curves").map([](const Node& curve) {
    return NamedCurve{curve.member("name").text(), read_terms(curve.member("terms"))};
  });
  e.perturbation = input.member("delta").number();
  e.seed = input.member("seed").unsigned_integer();
  e.curves = root.member("curves").map([&](const Node& curve) {
    return Curve{curve.member("name").text(), read_terms(curve.member("terms")),
                 curve.member("sources").indices(e.input.size())};
  });
  e.region = read_region(root.member("region"));
  e.region_used = read_region(root.member("region_used"));

  // Whatever is referred to is read, or at least counted, before what refers to it.
  e.lines = root.member("lines").map(read_line);
  if (e.lines.size() < e.region_used.corners.size())
    root.member("lines").fail("the sides of the region used are missing");
  const std::size_t cells = root.member("cells").size();
  e.line_crossings = root.member("crossings_on_lines").map([&](const Node& crossing) {
    return read_line_crossing(crossing, e.lines.size(), e.curves.size());
  });
  e.crossings = root.member("crossings").map([&](const Node& crossing) {
    return read_crossing(crossing, e.curves.size(), cells);
  });
  e.critical_regions = root.member("critical").map([&](const Node& region) {
    return CriticalRegion{region.member("curve").index(e.curves.size()),
                          static_cast<Sign>(region.member("sign").integer(-1, 1)),
                          region.member("boxes").map([](const Node& box) { return box.box(); })};
  });
  e.cells = root.member("cells").map(
      [&](const Node& cell) { return read_cell(cell, e, e.crossings.size()); });
  e.history = read_history(root.member("history"), e.lines.size(), cells);
  const Node covers = root.member("covers");
  if (covers.has("shared"))
    e.shared_cover = read_shared_cover(covers.member("shared"), e.curves.size());
  e.crossing_covers = covers.member("crossings").map([&](const Node& item) {
    return CrossingCover{read_pair(item.member("curves"), e.curves.size()),
                         item.member("root").box(),
                         read_tokens(item.member("tokens"), e.crossings.size())};
  });
  e.critical_covers = covers.member("critical").map([&](const Node& item) {
    return CriticalCover{item.member("curve").index(e.curves.size()), item.member("root").box(),
                         read_tokens(item.member("tokens"), e.critical_regions.size())};
  });
  e.infinity = root.member("infinity").map([&](const Node& item) {
    InfinityPiece piece;
    piece.chart = static_cast<int>(item.member("chart").integer(0, 1));
    piece.lo = item.member("lo").number();
    piece.hi = item.member("hi").number();
    piece.curve = item.member("curve").index_or_null(e.curves.size());
    return piece;
  });
  e.degenerate = read_unresolved(root.member("degenerate"), e);
  e.undecided = read_unresolved(root.member("undecided"), e);
  e.statistics = read_statistics(root.member("statistics"));
  return e;
}

// The parser's message without its "[json.exception.parse_error.101] ".
std::string plain(const Json::exception& exception) {
  const std::string text = exception.what();
  const std::size_t end = text.rfind("[json.exception", 0) == 0 ? text.find("] ") : text.npos;
  return end == text.npos ? text : text.substr(end + 2);
}

}  // namespace

std::string to_json(const Encasement& e) {
  Writer w;
  w.raw("{\n");
  w.field("format", "encase-result");
  const auto top = [&w](const char* key) {
    w.raw(",\n");
    w.key(key);
  };
  top("version"), w.put(kVersion);
  top("command"), w.put("curves");
  top("status"), w.put(name_of(kOutcomes, e.outcome));
  top("input"), w.raw("{\"curves\":");
  w.lines(e.input, [&](const NamedCurve& curve) {
    w.raw("{");
    w.field("name", curve.name);
    w.key("terms"), put_terms(w, curve.polynomial);
    w.raw("}");
  });
  w.field("delta", e.perturbation);
  w.field("seed", e.seed);
  w.raw("}");
  top("curves");
  w.lines(e.curves, [&](const Curve& curve) {
    w.raw("{");
    w.field("name", curve.name);
    w.key("terms"), put_terms(w, curve.polynomial);
    w.field("sources", curve.sources);
    w.raw("}");
  });
  top("region"), put_region(w, e.region);
  top("region_used"), put_region(w, e.region_used);
  top("lines"), w.lines(e.lines, [&](const Line& line) { put_line(w, line); });
  int id = 0;
  top("crossings");
  w.lines(e.crossings, [&](const Crossing& crossing) { put_crossing(w, crossing, id++); });
  id = 0;
  top("cells"), w.lines(e.cells, [&](const Cell& cell) { put_cell(w, cell, id++); });
  top("crossings_on_lines");
  w.lines(e.line_crossings, [&](const LineCrossing& crossing) {
    w.raw("{");
    w.field("line", crossing.line);
    w.field("curve", crossing.curve);
    w.field("interval", std::array<double, 2>{crossing.lo, crossing.hi});
    w.raw("}");
  });
  top("critical");
  w.lines(e.critical_regions, [&](const CriticalRegion& region) {
    w.raw("{");
    w.field("curve", region.curve);
    w.field("sign", region.sign);
    w.key("boxes"), w.list(region.boxes);
    w.raw("}");
  });
  top("covers"), put_covers(w, e);
  top("history");
  w.lines(e.history, [&](const Split& split) {
    w.put(std::array<int, 3>{split.line, split.negative, split.positive});
  });
  top("infinity");
  w.lines(e.infinity, [&](const InfinityPiece& piece) {
    w.raw("{");
    w.field("chart", piece.chart);
    w.field("lo", piece.lo);
    w.field("hi", piece.hi);
    w.key("curve"), w.put_index(piece.curve);
    w.raw("}");
  });
  top("degenerate"), put_unresolved(w, e.degenerate);
  top("undecided"), put_unresolved(w, e.undecided);
  top("statistics"), put_statistics(w, e.statistics, !e.shared_cover.tokens.empty());
  w.raw("\n}\n");
  return w.take();
}

Result<Encasement> encasement_from_json(const std::string& text, const std::string& file_name) {
  try {
    const Json json = Json::parse(text);
    return read_encasement(Node(json));
  } catch (const Malformed& malformed) {
    return Error{Error::Code::BadInput, file_name + ": " + malformed.what};
  } catch (const Json::exception& exception) {
    return Error{Error::Code::BadInput, file_name + ": " + plain(exception)};
  }
}

std::string summary_json(const Encasement& e) {
  const auto counted = std::count_if(e.crossings.begin(), e.crossings.end(), [](const Crossing& c) {
    return c.location != Location::Outside;
  });
  const auto relaxed = std::count_if(e.cells.begin(), e.cells.end(), [](const Cell& cell) {
    return cell.state == CellState::Relaxed;
  });
  Writer w;
  w.raw("{");
  w.field("status", name_of(kOutcomes, e.outcome));
  w.field("curves", static_cast<int>(e.curves.size()));
  w.field("crossings", static_cast<std::int64_t>(counted));
  w.field("cells", static_cast<int>(e.cells.size()));
  w.field("relaxed_cells", static_cast<std::int64_t>(relaxed));
  w.field("pairs_met", e.statistics.pairs_met);
  w.field("pairs_isolated", e.statistics.pairs_isolated);
  w.field("filter_failures", e.statistics.filter_failures);
  w.field("seconds", e.seconds);
  w.raw("}");
  return w.take();
}

}  // namespace encase
