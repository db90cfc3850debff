// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "arrangement_json.hpp"
#include "encase/result_json.hpp"
#include "json_writer.hpp"
#include "names.hpp"
#include "result_parts.hpp"

namespace encase {
namespace {

void put_region(JsonWriter& w, const Region& region) {
  if (region.plane) return w.put("plane");
  w.raw("{\"polygon\":");
  put_polygon(w, region);
  w.raw("}");
}

void put_line(JsonWriter& w, const Line& line) {
  if (line.rational)
    w.put(*line.rational);
  else
    w.put(std::array<double, 3>{line.normal[0], line.normal[1], line.offset});
}

void put_crossing(JsonWriter& w, const Crossing& crossing, int id) {
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

void put_cell(JsonWriter& w, const Cell& cell, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("state", name_of(kCellStates, cell.state));
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

void put_unresolved(JsonWriter& w, const std::vector<Unresolved>& places) {
  put_unresolved(w, places, "curves", &Unresolved::curves, [](const Unresolved&) {});
}

void put_covers(JsonWriter& w, const Encasement& e) {
  w.raw("{");
  if (!e.shared_cover.tokens.empty()) {
    w.raw("\"shared\":{");
    put_cover(w, e.shared_cover.root, e.shared_cover.tokens);
    w.key("alive"), w.list(e.shared_cover.alive);
    w.raw("},\n");
  }
  w.raw("\"crossings\":");
  w.lines(e.crossing_covers, [&](const CrossingCover& cover) {
    w.raw("{");
    w.field("curves", cover.curves);
    put_cover(w, cover.root, cover.tokens);
    w.raw("}");
  });
  w.raw(",\n\"critical\":");
  w.lines(e.critical_covers, [&](const CriticalCover& cover) {
    w.raw("{");
    w.field("curve", cover.curve);
    put_cover(w, cover.root, cover.tokens);
    w.raw("}");
  });
  w.raw("}");
}

/// The counts of pairs as well unless there is one pair at most: then they follow from its cover.
void put_statistics(JsonWriter& w, const Statistics& s, bool with_pairs) {
  w.raw("{");
  put_decisions(w, s.decisions);
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

void put_source(JsonWriter& w, const SliceSource& source) {
  w.raw("{");
  w.field("plane", source.chart.plane());
  w.key("region"), put_solid_region(w, source.region);
  w.key("surfaces"), put_functions(w, source.surfaces);
  w.field("surface_of", source.surface_of);
  w.field("containing", source.containing);
  w.raw("}");
}

/// `source`: of a slice.
std::string write_result(const Encasement& e, const Arrangement* arrangement,
                         const SliceSource* source) {
  JsonWriter w;
  put_head(w, source ? "slice" : "curves", name_of(kOutcomes, e.outcome));
  w.section("input"), w.raw("{\"curves\":"), put_functions(w, e.input);
  w.field("delta", e.perturbation);
  w.field("seed", e.seed);
  w.raw("}");
  if (source) w.section("slice"), put_source(w, *source);
  w.section("curves"), put_encased(w, e.curves);
  w.section("region"), put_region(w, e.region);
  w.section("region_used"), put_region(w, e.region_used);
  w.section("lines"), w.lines(e.lines, [&](const Line& line) { put_line(w, line); });
  int id = 0;
  w.section("crossings");
  w.lines(e.crossings, [&](const Crossing& crossing) { put_crossing(w, crossing, id++); });
  id = 0;
  w.section("cells"), w.lines(e.cells, [&](const Cell& cell) { put_cell(w, cell, id++); });
  w.section("crossings_on_lines");
  w.lines(e.line_crossings, [&](const LineCrossing& crossing) {
    w.raw("{");
    w.field("line", crossing.line);
    w.field("curve", crossing.curve);
    w.field("interval", std::array<double, 2>{crossing.lo, crossing.hi});
    w.raw("}");
  });
  w.section("critical");
  w.lines(e.critical_regions, [&](const CriticalRegion& region) {
    w.raw("{");
    w.field("curve", region.curve);
    w.field("sign", region.sign);
    w.key("boxes"), w.list(region.boxes);
    w.raw("}");
  });
  w.section("covers"), put_covers(w, e);
  w.section("history"), put_history(w, e.history);
  w.section("infinity");
  w.lines(e.infinity, [&](const InfinityPiece& piece) {
    w.raw("{");
    w.field("chart", piece.chart);
    w.field("lo", piece.lo);
    w.field("hi", piece.hi);
    w.key("curve"), w.put_index(piece.curve);
    w.raw("}");
  });
  w.section("degenerate"), put_unresolved(w, e.degenerate);
  w.section("undecided"), put_unresolved(w, e.undecided);
  if (arrangement) w.section("arrangement"), put_arrangement(w, *arrangement);
  w.section("statistics"), put_statistics(w, e.statistics, !e.shared_cover.tokens.empty());
  w.raw("\n}\n");
  return w.take();
}

}  // namespace

std::string to_json(const Encasement& encasement, const Arrangement* arrangement) {
  return write_result(encasement, arrangement, nullptr);
}

std::string to_json(const Slice& slice, const Arrangement* arrangement) {
  return write_result(slice.encasement, arrangement, &slice.source);
}

std::string summary_json(const Encasement& e, const Arrangement* arrangement) {
  const auto counted = std::count_if(e.crossings.begin(), e.crossings.end(), [](const Crossing& c) {
    return c.location != Location::Outside;
  });
  const auto relaxed = std::count_if(e.cells.begin(), e.cells.end(), [](const Cell& cell) {
    return cell.state == CellState::Relaxed;
  });
  JsonWriter w;
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
  if (arrangement) {
    w.field("vertices", static_cast<int>(arrangement->vertices.size()));
    w.field("edges", static_cast<int>(arrangement->edges.size()));
    // The outside of the region is no face that anyone counts.
    w.field("faces", static_cast<int>(arrangement->faces.size()) - 1);
    w.field("components", static_cast<int>(arrangement->components.size()));
  }
  w.raw("}");
  return w.take();
}

}  // namespace encase
