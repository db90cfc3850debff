// SPDX-License-Identifier: MIT
#include "arrangement_json.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace encase {
namespace {

using A = Arrangement;

void put_vertex(JsonWriter& w, const A& a, int id) {
  const A::Vertex& vertex = a.vertices[id];
  w.raw("{");
  w.field("id", id);
  w.field("kind", name_of(kVertexKinds, vertex.kind));
  w.field("index", vertex.index);
  w.field("x", vertex.point[0]);
  w.field("y", vertex.point[1]);
  w.field("half_edges", a.around(id));
  w.raw("}");
}

void put_edge(JsonWriter& w, const A& a, int id) {
  const A::Edge& edge = a.edges[id];
  w.raw("{");
  w.field("id", id);
  w.key("curve"), w.put_index(edge.curve);
  w.key("side"), w.put_index(edge.side);
  const std::array<int, 2> ends = {a.half_edges[2 * id].origin, a.half_edges[2 * id + 1].origin};
  w.key("vertices"), w.list(ends, [&](int vertex) { w.put_index(vertex); });
  w.field("faces", a.faces_at(id));
  w.field("component", edge.component);
  w.key("strands");
  w.list(edge.strands, [&](const A::Strand& strand) {
    w.raw("[");
    w.put(strand.cell), w.raw(","), w.put(strand.branch), w.raw(",");
    w.put_index(strand.from), w.raw(","), w.put_index(strand.to), w.raw("]");
  });
  w.raw("}");
}

void put_face(JsonWriter& w, const A& a, int id) {
  const A::Face& face = a.faces[id];
  w.raw("{");
  w.field("id", id);
  w.key("signs"), w.list(face.signs);
  w.key("parent"), w.put_index(face.parent);
  w.field("outer", face.outer < 0 ? std::vector<int>{} : a.cycle(face.outer));
  w.key("holes"), w.list(face.holes, [&](int hole) { w.put(a.cycle(hole)); });
  w.field("pieces", face.pieces);
  w.raw("}");
}

void put_component(JsonWriter& w, const A::Component& component, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("parent", component.parent);
  w.field("hole", component.hole);
  w.field("faces", component.faces);
  w.field("vertices", component.vertices);
  w.field("edges", component.edges);
  w.raw("}");
}

void put_curve_component(JsonWriter& w, const A::CurveComponent& component) {
  w.raw("{");
  w.field("curve", component.curve);
  w.field("closed", component.closed);
  w.field("half_edges", component.half_edges);
  w.field("crossings", component.crossings);
  w.raw("}");
}

/// The entries of a list, each of which knows its place.
template <class F>
auto read_list(const JsonNode& list, F read) {
  int place = 0;
  return list.map([&](const JsonNode& item) {
    const JsonNode id = item.member("id");
    if (id.integer(0, list.size()) != place) id.fail("an entry is not in its place");
    ++place;
    return read(item);
  });
}

/// What is there for indices to refer to.
struct Sizes {
  std::size_t vertices, edges, faces, pieces, components;
};

A::Vertex read_vertex(const JsonNode& node, const Encasement& e, const Sizes& sizes) {
  A::Vertex vertex;
  vertex.kind = node.member("kind").one_of(kVertexKinds);
  const std::size_t items = vertex.kind == A::Vertex::Kind::Crossing ? e.crossings.size()
                            : vertex.kind == A::Vertex::Kind::OnBoundary
                                ? e.line_crossings.size()
                                : e.region_used.corners.size();
  vertex.index = node.member("index").index(items);
  vertex.point = {node.member("x").number(), node.member("y").number()};
  const JsonNode around = node.member("half_edges");
  if (around.size() == 0) around.fail("a vertex has half-edges");
  vertex.half_edge = around.item(0).index(2 * sizes.edges);
  return vertex;
}

A::Strand read_strand(const JsonNode& node, const Encasement& e) {
  node.of_size(4);
  A::Strand strand;
  strand.cell = node.item(0).index(e.cells.size());
  strand.branch = node.item(1).index(e.cells[strand.cell].branches.size());
  strand.from = node.item(2).index_or_null(e.line_crossings.size());
  strand.to = node.item(3).index_or_null(e.line_crossings.size());
  return strand;
}

A::Edge read_edge(const JsonNode& node, const Encasement& e, const Sizes& sizes) {
  A::Edge edge;
  edge.curve = node.member("curve").index_or_null(e.curves.size());
  edge.side = node.member("side").index_or_null(e.region_used.corners.size());
  if ((edge.curve < 0) == (edge.side < 0)) node.fail("an edge is on a curve or on a side");
  edge.component = node.member("component").index(sizes.components);
  edge.strands =
      node.member("strands").map([&](const JsonNode& strand) { return read_strand(strand, e); });
  return edge;
}

/// The half-edges of an edge, which its faces' boundaries link later.
void read_half_edges(const JsonNode& node, const Sizes& sizes, A* a) {
  const JsonNode vertices = node.member("vertices"), faces = node.member("faces");
  vertices.of_size(2);
  faces.of_size(2);
  for (int k = 0; k < 2; ++k)
    a->half_edges.push_back(
        {vertices.item(k).index_or_null(sizes.vertices), -1, -1, faces.item(k).index(sizes.faces)});
}

/// Links the half-edges of a boundary, each of which is on one boundary of its face, and returns
/// the first.
int read_cycle(const JsonNode& node, int face, A* a) {
  const std::vector<int> cycle = node.indices(a->half_edges.size());
  if (cycle.empty()) node.fail("a boundary has half-edges");
  for (std::size_t k = 0; k < cycle.size(); ++k) {
    A::HalfEdge& here = a->half_edges[cycle[k]];
    if (here.face != face || here.next >= 0)
      node.item(static_cast<int>(k)).fail("the half-edge is not here or not only here");
    here.next = cycle[(k + 1) % cycle.size()];
    here.prev = cycle[(k + cycle.size() - 1) % cycle.size()];
  }
  return cycle.front();
}

A::Face read_face(const JsonNode& node, int id, const Encasement& e, const Sizes& sizes, A* a) {
  A::Face face;
  face.signs = node.member("signs").map(
      [](const JsonNode& sign) { return static_cast<Sign>(sign.integer(-1, 1)); });
  if (!face.signs.empty()) node.member("signs").of_size(static_cast<int>(e.curves.size()));
  face.parent = node.member("parent").index_or_null(sizes.faces);
  if (node.member("outer").size() > 0) face.outer = read_cycle(node.member("outer"), id, a);
  face.holes =
      node.member("holes").map([&](const JsonNode& hole) { return read_cycle(hole, id, a); });
  face.pieces = node.member("pieces").indices(sizes.pieces);
  for (std::size_t k = 0; k < face.pieces.size(); ++k) {
    int& of = a->pieces[face.pieces[k]].face;
    if (of >= 0) node.member("pieces").fail("a piece belongs to one face");
    of = id;
  }
  return face;
}

A::Component read_component(const JsonNode& node, const Sizes& sizes) {
  constexpr int kMost = std::numeric_limits<int>::max();
  A::Component component;
  component.parent = node.member("parent").index(sizes.faces);
  component.hole = node.member("hole").index(2 * sizes.edges);
  component.faces = node.member("faces").indices(sizes.faces);
  component.vertices = static_cast<int>(node.member("vertices").integer(0, kMost));
  component.edges = static_cast<int>(node.member("edges").integer(0, kMost));
  return component;
}

}  // namespace

void put_arrangement(JsonWriter& w, const Arrangement& a) {
  w.raw("{\"vertices\":");
  int id = 0;
  w.lines(a.vertices, [&](const A::Vertex&) { put_vertex(w, a, id++); });
  id = 0;
  w.raw(",\n\"edges\":"), w.lines(a.edges, [&](const A::Edge&) { put_edge(w, a, id++); });
  id = 0;
  w.raw(",\n\"faces\":"), w.lines(a.faces, [&](const A::Face&) { put_face(w, a, id++); });
  w.raw(",\n\"outside\":"), w.put(a.outside);
  w.raw(",\n\"pieces\":"), w.list(a.pieces, [&](const A::Piece& piece) {
    w.put(std::array<int, 2>{piece.cell, piece.word});
  });
  id = 0;
  w.raw(",\n\"components\":");
  w.lines(a.components, [&](const A::Component& c) { put_component(w, c, id++); });
  w.raw(",\n\"curve_components\":");
  w.lines(a.curve_components, [&](const A::CurveComponent& c) { put_curve_component(w, c); });
  w.raw("}");
}

Arrangement read_arrangement(const JsonNode& node, const Encasement& e) {
  const JsonNode vertices = node.member("vertices"), edges = node.member("edges"),
                 faces = node.member("faces"), pieces = node.member("pieces"),
                 components = node.member("components");
  const auto size = [](const JsonNode& list) { return static_cast<std::size_t>(list.size()); };
  const Sizes sizes{size(vertices), size(edges), size(faces), size(pieces), size(components)};
  Arrangement a;
  a.outside = node.member("outside").index(sizes.faces);
  a.vertices =
      read_list(vertices, [&](const JsonNode& item) { return read_vertex(item, e, sizes); });
  a.edges = read_list(edges, [&](const JsonNode& item) {
    read_half_edges(item, sizes, &a);
    return read_edge(item, e, sizes);
  });
  a.pieces = pieces.map([&](const JsonNode& item) {
    item.of_size(2);
    const int cell = item.item(0).index(e.cells.size());
    return A::Piece{cell, item.item(1).index(std::max<std::size_t>(1, e.cells[cell].word.size())),
                    -1};
  });
  int id = 0;
  a.faces =
      read_list(faces, [&](const JsonNode& item) { return read_face(item, id++, e, sizes, &a); });
  for (std::size_t h = 0; h < a.half_edges.size(); ++h)
    if (a.half_edges[h].next < 0)
      faces.fail("half-edge " + std::to_string(h) + " is on no boundary");
  for (std::size_t p = 0; p < a.pieces.size(); ++p)
    if (a.pieces[p].face < 0) faces.fail("piece " + std::to_string(p) + " is in no face");
  // Every half-edge has one before and one behind it, so that walks around vertices end.
  for (int v = 0; v < static_cast<int>(a.vertices.size()); ++v)
    if (vertices.item(v).member("half_edges").indices(a.half_edges.size()) != a.around(v))
      vertices.item(v).member("half_edges").fail("these are not the half-edges around the vertex");
  a.components =
      read_list(components, [&](const JsonNode& item) { return read_component(item, sizes); });
  a.curve_components = node.member("curve_components").map([&](const JsonNode& item) {
    return A::CurveComponent{item.member("curve").index(e.curves.size()),
                             item.member("closed").boolean(),
                             item.member("half_edges").indices(a.half_edges.size()),
                             item.member("crossings").indices(e.crossings.size())};
  });
  return a;
}

}  // namespace encase
