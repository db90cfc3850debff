// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "encase/caps_output.hpp"
#include "json_writer.hpp"
#include "names.hpp"
#include "result_parts.hpp"

namespace encase {
namespace {

void put_curves(JsonWriter& w, const std::vector<NamedCurve>& curves) {
  w.lines(curves, [&](const NamedCurve& curve) {
    w.raw("{");
    w.field("name", curve.name);
    w.field("expression", curve.function.to_string());
    w.raw("}");
  });
}

void put_obstacles(JsonWriter& w, const CapsObstacles& obstacles) {
  w.raw("{");
  w.field("unexamined_leaves", obstacles.unexamined_leaves);
  w.field("indeterminate_leaves", obstacles.indeterminate_leaves);
  w.field("open_vertices", obstacles.open_vertices);
  w.field("open_edges", obstacles.open_edges);
  w.raw("}");
}

void put_leaf(JsonWriter& w, const CapsLeaf& leaf) {
  w.raw("[");
  w.put(name_of(kCapsLabels, leaf.label)), w.raw(",");
  w.put(leaf.depth), w.raw(",");
  w.put(leaf.curves), w.raw(",");
  w.put(leaf.region), w.raw(",");
  w.put_index(leaf.graph_axis);
  w.raw("]");
}

void put_region(JsonWriter& w, const CapsRegion& region, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("label", name_of(kCapsLabels, region.label));
  w.field("curves", region.curves);
  w.field("leaves", region.leaves);
  w.field("box", region.box);
  w.field("singular", region.singular);
  w.field("apart", region.apart);
  w.field("neighbours", region.neighbours);
  w.raw("}");
}

void put_vertex(JsonWriter& w, const CapsVertex& vertex, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("kind", name_of(kCapsVertexKinds, vertex.kind));
  w.field("curves", vertex.curves);
  w.field("box", vertex.box);
  w.key("region"), w.put_index(vertex.region);
  w.raw("}");
}

void put_edge(JsonWriter& w, const CapsEdge& edge, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("curve", edge.curve);
  w.field("vertices", edge.vertices);
  w.field("proved", edge.proved);
  w.key("polyline"), w.list(edge.polyline);
  w.raw("}");
}

}  // namespace

std::string to_json(const CapsResult& r) {
  JsonWriter w;
  put_head(w, "caps", name_of(kCapsClasses, r.answer));
  w.section("epsilon"), w.put(r.epsilon);
  w.section("delta"), w.put(r.delta);
  w.section("self_crossings"), w.put(r.self_crossings);
  w.section("obstacles"), put_obstacles(w, r.obstacles);
  w.section("curves"), put_curves(w, r.curves);
  w.section("box"), w.put(r.box);
  w.section("cut"), w.put(kCapsCut);
  w.section("tokens"), w.put(r.tokens);
  w.section("curve_sets"), w.list(r.curve_sets);
  w.section("leaves"), w.lines(r.leaves, [&](const CapsLeaf& leaf) { put_leaf(w, leaf); });
  int id = 0;
  w.section("regions");
  w.lines(r.regions, [&](const CapsRegion& region) { put_region(w, region, id++); });
  id = 0;
  w.section("vertices");
  w.lines(r.vertices, [&](const CapsVertex& vertex) { put_vertex(w, vertex, id++); });
  id = 0;
  w.section("edges"), w.lines(r.edges, [&](const CapsEdge& edge) { put_edge(w, edge, id++); });
  w.section("statistics"), w.raw("{");
  w.field("nodes", r.nodes);
  w.field("evaluations", r.evaluations);
  w.raw("}\n}\n");
  return w.take();
}

std::string summary_json(const CapsResult& r) {
  std::array<std::int64_t, 4> labels{};
  int depth = 0;
  for (const CapsLeaf& leaf : r.leaves) {
    ++labels[static_cast<std::size_t>(leaf.label)];
    depth = std::max(depth, leaf.depth);
  }
  const auto crossings = std::count_if(r.vertices.begin(), r.vertices.end(), [](const auto& v) {
    return v.kind == CapsVertex::Kind::Crossing;
  });
  const auto proved =
      std::count_if(r.edges.begin(), r.edges.end(), [](const auto& edge) { return edge.proved; });
  JsonWriter w;
  w.raw("{");
  w.field("status", name_of(kCapsClasses, r.answer));
  w.field("delta", r.delta);
  w.field("curves", static_cast<int>(r.curves.size()));
  w.field("nodes", r.nodes);
  w.field("depth", depth);
  w.key("leaves"), w.raw("{");
  for (const auto& name : kCapsLabels)
    w.field(name.text, labels[static_cast<std::size_t>(name.value)]);
  w.raw("}");
  w.field("regions", static_cast<int>(r.regions.size()));
  w.field("vertices", static_cast<int>(r.vertices.size()));
  w.field("crossings", static_cast<std::int64_t>(crossings));
  w.field("edges", static_cast<int>(r.edges.size()));
  w.field("proved_edges", static_cast<std::int64_t>(proved));
  w.field("seconds", r.seconds);
  w.field("tree_seconds", r.tree_seconds);
  w.raw("}");
  return w.take();
}

}  // namespace encase
