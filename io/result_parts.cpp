// SPDX-License-Identifier: MIT
#include "io/result_parts.hpp"

#include <utility>

namespace encase {

void put_head(JsonWriter& w, const char* command, const char* status) {
  w.raw("{\n");
  w.field("format", "encase-result");
  w.section("version"), w.put(kResultVersion);
  w.section("command"), w.put(command);
  w.section("status"), w.put(status);
}

void put_polygon(JsonWriter& w, const Region& polygon) { w.list(polygon.corners); }

Region read_polygon(const JsonNode& corners) {
  auto region = make_region(corners.map([](const JsonNode& corner) {
    corner.of_size(2);
    return RationalPoint<2>{corner.item(0).rational(), corner.item(1).rational()};
  }));
  if (!region) corners.fail(region.error().message);
  return std::move(region).value();
}

void put_solid_region(JsonWriter& w, const Polyhedron& region) {
  w.raw("{\"halfspaces\":"), w.list(region.sides), w.raw("}");
}

HalfSpace read_half_space(const JsonNode& node) {
  node.of_size(4);
  HalfSpace read;
  for (int k = 0; k < 4; ++k) read[k] = node.item(k).rational();
  return read;
}

Polyhedron read_solid_region(const JsonNode& node) {
  const JsonNode sides = node.member("halfspaces");
  auto region = make_polyhedron(sides.map(read_half_space));
  if (!region) sides.fail(region.error().message);
  return std::move(region).value();
}

void put_history(JsonWriter& w, const std::vector<Split>& history) {
  w.lines(history, [&](const Split& split) {
    w.put(std::array<int, 3>{split.line, split.negative, split.positive});
  });
}

std::vector<Split> read_history(const JsonNode& node, std::size_t cuts, std::size_t cells) {
  const int count = node.size();
  std::vector<bool> node_seen(count), cell_seen(cells);
  std::vector<Split> history(count);
  for (int k = 0; k < count; ++k) {
    const JsonNode split = node.item(k);
    split.of_size(3);
    history[k].line = split.item(0).index(cuts);
    const auto read_child = [&](const JsonNode& child) {
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

void put_decisions(JsonWriter& w, const DecisionCounts& decisions) {
  w.key("decisions"), w.raw("{");
  w.field("by_double", decisions.by_double);
  w.field("by_mpfr", decisions.by_mpfr);
  w.field("by_exact", decisions.by_exact);
  w.field("undecided", decisions.undecided);
  w.raw("}");
}

DecisionCounts read_decisions(const JsonNode& node) {
  DecisionCounts decisions;
  decisions.by_double = node.member("by_double").count();
  decisions.by_mpfr = node.member("by_mpfr").count();
  decisions.by_exact = node.member("by_exact").count();
  decisions.undecided = node.member("undecided").count();
  return decisions;
}

}  // namespace encase
