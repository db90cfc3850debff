// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrangement_json.hpp"
#include "caps_json.hpp"
#include "encase/caps_output.hpp"
#include "encase/result_json.hpp"
#include "json_node.hpp"
#include "names.hpp"
#include "result_parts.hpp"
#include "surface_json.hpp"

namespace encase {
namespace {

using Json = nlohmann::json;

SliceSource read_source(const JsonNode& node, std::size_t curves) {
  const HalfSpace plane = read_half_space(node.member("plane"));
  if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0)
    node.member("plane").fail("a plane needs a normal");
  SliceSource source{read_functions<3>(node.member("surfaces")),
                     read_solid_region(node.member("region")),
                     PlaneChart(plane),
                     {},
                     {}};
  source.surface_of = node.member("surface_of").indices(source.surfaces.size());
  node.member("surface_of").of_size(static_cast<int>(curves));
  source.containing = node.member("containing").indices(source.surfaces.size());
  return source;
}

Region read_region(const JsonNode& node) {
  if (node.is_text()) {
    if (node.text() != "plane") node.fail("a region is a polygon or \"plane\"");
    return whole_plane();
  }
  return read_polygon(node.member("polygon"));
}

Line read_line(const JsonNode& node) {
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

SharedCover read_shared_cover(const JsonNode& node, std::size_t curves) {
  SharedCover cover;
  cover.root = node.member("root").box();
  cover.alive =
      node.member("alive").map([&](const JsonNode& list) { return list.indices(curves); });
  cover.tokens = read_tokens<2>(node.member("tokens"), cover.alive.size());
  return cover;
}

LineCrossing read_line_crossing(const JsonNode& node, std::size_t lines, std::size_t curves) {
  LineCrossing crossing;
  crossing.line = node.member("line").index(lines);
  crossing.curve = node.member("curve").index(curves);
  const JsonNode interval = node.member("interval");
  interval.of_size(2);
  crossing.lo = interval.item(0).number();
  crossing.hi = interval.item(1).number();
  if (!(crossing.lo < crossing.hi)) interval.fail("the ends are in the wrong order");
  return crossing;
}

Crossing read_crossing(const JsonNode& node, std::size_t curves, std::size_t cells) {
  Crossing crossing;
  crossing.curves = read_ascending<2>(node.member("curves"), curves);
  crossing.point = {node.member("x").number(), node.member("y").number()};
  crossing.rounded = node.member("rounded").boolean();
  crossing.box = node.member("box").box();
  crossing.cell = node.member("cell").index_or_null(cells);
  crossing.location = node.member("location").one_of(kLocations);
  return crossing;
}

/// Lines of edges, rounded vertices and cuts, put together to vertices.
std::vector<Vertex> read_vertices(const JsonNode& node, std::size_t lines) {
  const std::vector<int> edge_lines = node.member("lines").indices(lines);
  const JsonNode points = node.member("vertices");
  const int count = static_cast<int>(edge_lines.size());
  if (count < 3) node.member("lines").fail("a cell has at least three edges");
  points.of_size(count);
  std::vector<Vertex> vertices(count);
  for (int k = 0; k < count; ++k) {
    vertices[k].line_in = edge_lines[k == 0 ? count - 1 : k - 1];
    vertices[k].line_out = edge_lines[k];
    vertices[k].point = points.item(k).point();
  }
  const JsonNode cuts = node.member("cuts");
  const int cut_count = cuts.size();
  for (int k = 0; k < cut_count; ++k) {
    const JsonNode cut = cuts.item(k);
    cut.of_size(2);
    vertices[cut.item(0).index(vertices.size())].parameter = cut.item(1).number();
  }
  return vertices;
}

Cell read_cell(const JsonNode& node, const Encasement& e, std::size_t crossings) {
  Cell cell;
  cell.state = node.member("state").one_of(kCellStates);
  if (node.member("relaxed").boolean() != (cell.state == CellState::Relaxed))
    node.member("relaxed").fail("contradicts 'state'");
  cell.depth = static_cast<int>(node.member("depth").integer(0, std::numeric_limits<int>::max()));
  cell.vertices = read_vertices(node, e.lines.size());
  cell.word = node.member("word").indices(e.line_crossings.size());
  cell.branches = node.member("branches").map([&](const JsonNode& branch) {
    branch.of_size(3);
    return Branch{branch.item(0).index(e.curves.size()),
                  branch.item(1).index(e.line_crossings.size()),
                  branch.item(2).index(e.line_crossings.size())};
  });
  cell.crossing = node.member("crossing").index_or_null(crossings);
  cell.loop_certificates = node.member("loop_certificates").map([&](const JsonNode& certificate) {
    return LoopCertificate{certificate.member("critical").index(e.critical_regions.size()),
                           certificate.member("from").point(), certificate.member("to").point()};
  });
  return cell;
}

Statistics read_statistics(const JsonNode& node) {
  Statistics s;
  s.decisions = read_decisions(node.member("decisions"));
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

void check_format(const JsonNode& root) {
  if (root.member("format").text() != "encase-result")
    root.member("format").fail("this is not a result of encase");
  const JsonNode version = root.member("version");
  if (version.integer(0, std::numeric_limits<int>::max()) != kResultVersion)
    version.fail("this version of encase reads version " + std::to_string(kResultVersion) +
                 " only");
}

Encasement read_encasement(const JsonNode& root) {
  if (root.member("command").text() != "curves" && root.member("command").text() != "slice")
    root.member("command").fail("expected a result of 'curves' or 'slice'");

  Encasement e;
  e.outcome = root.member("status").one_of(kOutcomes);
  const JsonNode input = root.member("input");
  e.input = read_functions<2>(input.member("curves"));
  e.perturbation = input.member("delta").number();
  e.seed = input.member("seed").unsigned_integer();
  e.curves = root.member("curves").map([&](const JsonNode& curve) {
    return Curve{curve.member("name").text(), read_function<2>(curve),
                 curve.member("sources").indices(e.input.size())};
  });
  e.region = read_region(root.member("region"));
  e.region_used = read_region(root.member("region_used"));

  // Whatever is referred to is read, or at least counted, before what refers to it.
  e.lines = root.member("lines").map(read_line);
  if (e.lines.size() < e.region_used.corners.size())
    root.member("lines").fail("the sides of the region used are missing");
  const std::size_t cells = root.member("cells").size();
  e.line_crossings = root.member("crossings_on_lines").map([&](const JsonNode& crossing) {
    return read_line_crossing(crossing, e.lines.size(), e.curves.size());
  });
  e.crossings = root.member("crossings").map([&](const JsonNode& crossing) {
    return read_crossing(crossing, e.curves.size(), cells);
  });
  e.critical_regions = root.member("critical").map([&](const JsonNode& region) {
    return CriticalRegion{
        region.member("curve").index(e.curves.size()),
        static_cast<Sign>(region.member("sign").integer(-1, 1)),
        region.member("boxes").map([](const JsonNode& box) { return box.box(); })};
  });
  e.cells = root.member("cells").map(
      [&](const JsonNode& cell) { return read_cell(cell, e, e.crossings.size()); });
  e.history = read_history(root.member("history"), e.lines.size(), cells);
  const JsonNode covers = root.member("covers");
  if (covers.has("shared"))
    e.shared_cover = read_shared_cover(covers.member("shared"), e.curves.size());
  e.crossing_covers = covers.member("crossings").map([&](const JsonNode& item) {
    return CrossingCover{read_ascending<2>(item.member("curves"), e.curves.size()),
                         item.member("root").box(),
                         read_tokens<2>(item.member("tokens"), e.crossings.size())};
  });
  e.critical_covers = covers.member("critical").map([&](const JsonNode& item) {
    return CriticalCover{item.member("curve").index(e.curves.size()), item.member("root").box(),
                         read_tokens<2>(item.member("tokens"), e.critical_regions.size())};
  });
  e.infinity = root.member("infinity").map([&](const JsonNode& item) {
    InfinityPiece piece;
    piece.chart = static_cast<int>(item.member("chart").integer(0, 1));
    piece.lo = item.member("lo").number();
    piece.hi = item.member("hi").number();
    piece.curve = item.member("curve").index_or_null(e.curves.size());
    return piece;
  });
  const auto unresolved = [&](const char* key) {
    return read_unresolved(root.member(key), "curves", &Unresolved::curves, e.input.size(),
                           e.curves.size());
  };
  e.degenerate = unresolved("degenerate");
  e.undecided = unresolved("undecided");
  e.statistics = read_statistics(root.member("statistics"));
  return e;
}

// The parser's message without its "[json.exception.parse_error.101] ".
std::string plain(const Json::exception& exception) {
  const std::string text = exception.what();
  const std::size_t end = text.rfind("[json.exception", 0) == 0 ? text.find("] ") : text.npos;
  return end == text.npos ? text : text.substr(end + 2);
}

StoredResult read_stored(const JsonNode& root) {
  StoredResult result{read_encasement(root), std::nullopt, std::nullopt};
  if (root.member("command").text() == "slice")
    result.source = read_source(root.member("slice"), result.encasement.input.size());
  if (root.has("arrangement"))
    result.arrangement = read_arrangement(root.member("arrangement"), result.encasement);
  return result;
}

/// What `read` makes of the document, which must be a result of encase.
template <class Read>
auto read_document(const std::string& text, const std::string& file_name, const Read& read)
    -> Result<decltype(read(std::declval<const JsonNode&>()))> {
  try {
    const Json json = Json::parse(text);
    const JsonNode root(json);
    check_format(root);
    return read(root);
  } catch (const Malformed& malformed) {
    return Error{Error::Code::BadInput, file_name + ": " + malformed.what};
  } catch (const Json::exception& exception) {
    return Error{Error::Code::BadInput, file_name + ": " + plain(exception)};
  }
}

}  // namespace

Result<StoredResult> result_from_json(const std::string& text, const std::string& file_name) {
  return read_document(text, file_name, read_stored);
}

Result<CapsResult> caps_from_json(const std::string& text, const std::string& file_name) {
  return read_document(text, file_name, read_caps);
}

Result<StoredSurfaces> surfaces_from_json(const std::string& text, const std::string& file_name) {
  return read_document(text, file_name, read_surfaces);
}

Result<AnyResult> any_result_from_json(const std::string& text, const std::string& file_name) {
  return read_document(text, file_name, [](const JsonNode& root) -> AnyResult {
    if (root.member("command").text() == "caps") return read_caps(root);
    if (root.member("command").text() == "surfaces") return read_surfaces(root);
    return read_stored(root);
  });
}

Result<Encasement> encasement_from_json(const std::string& text, const std::string& file_name) {
  Result<StoredResult> result = result_from_json(text, file_name);
  if (!result) return result.error();
  return std::move(result.value().encasement);
}

}  // namespace encase
