// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "encase/arrangement.hpp"

namespace encase {
namespace {

using Arr = Arrangement;

bool in(int index, std::size_t size) { return index >= 0 && index < static_cast<int>(size); }

std::string half_edge(int h) { return "half-edge " + std::to_string(h); }

std::string check_half_edges(const Arr& a) {
  if (a.half_edges.size() != 2 * a.edges.size()) return "An edge has not just two half-edges.";
  for (int h = 0; h < static_cast<int>(a.half_edges.size()); ++h) {
    const Arr::HalfEdge& e = a.half_edges[h];
    if (!in(e.next, a.half_edges.size()) || !in(e.prev, a.half_edges.size()) ||
        !in(e.face, a.faces.size()) || e.origin < -1 ||
        e.origin >= static_cast<int>(a.vertices.size()))
      return "A part of " + half_edge(h) + " does not exist.";
    if (a.half_edges[e.next].prev != h || a.half_edges[e.prev].next != h)
      return "Next and previous of " + half_edge(h) + " disagree.";
    if (a.half_edges[e.next].face != e.face) return "The face changes behind " + half_edge(h) + ".";
    if (a.half_edges[e.next].origin != a.half_edges[Arr::twin(h)].origin)
      return "What follows " + half_edge(h) + " does not begin where it ends.";
    if (e.origin < 0 && e.next != h) return "The loop of " + half_edge(h) + " is not closed.";
  }
  return {};
}

std::string check_vertices(const Arr& a) {
  std::size_t around = 0;
  for (int v = 0; v < static_cast<int>(a.vertices.size()); ++v) {
    const Arr::Vertex& vertex = a.vertices[v];
    const std::string name = "Vertex " + std::to_string(v);
    if (!in(vertex.half_edge, a.half_edges.size()) || a.half_edges[vertex.half_edge].origin != v)
      return name + " does not begin its half-edge.";
    std::vector<int> curves;
    for (const int h : a.around(v)) curves.push_back(a.edges[Arr::edge_of(h)].curve);
    around += curves.size();
    const auto boundary = std::count(curves.begin(), curves.end(), -1);
    bool right = false;
    switch (vertex.kind) {
      case Arr::Vertex::Kind::Crossing:
        right = curves.size() == 4 && boundary == 0 && curves[0] != curves[1] &&
                curves[0] == curves[2] && curves[1] == curves[3];
        break;
      case Arr::Vertex::Kind::OnBoundary:
        right = curves.size() == 3 && boundary == 2;
        break;
      case Arr::Vertex::Kind::Corner:
        right = curves.size() == 2 && boundary == 2;
        break;
    }
    if (!right) return name + " has not the edges of its kind.";
  }
  for (const Arr::HalfEdge& e : a.half_edges) around += e.origin < 0;
  return around == a.half_edges.size() ? "" : "A half-edge is not around its origin.";
}

/// Every cycle is the outer boundary or a hole of its face, once.
std::string check_faces(const Arr& a) {
  if (!in(a.outside, a.faces.size())) return "There is no outside.";
  std::vector<int> seen(a.half_edges.size(), 0);
  for (int f = 0; f < static_cast<int>(a.faces.size()); ++f) {
    const std::string name = "Face " + std::to_string(f);
    const Arr::Face& face = a.faces[f];
    std::vector<int> cycles = face.holes;
    if ((f == a.outside) != (face.outer < 0) || (f == a.outside) != face.pieces.empty() ||
        (f == a.outside) != (face.parent < 0))
      return name + " is and is not the outside.";
    if (face.outer >= 0) cycles.push_back(face.outer);
    for (const int first : cycles) {
      if (!in(first, a.half_edges.size()) || a.half_edges[first].face != f)
        return name + " does not have its boundary.";
      for (const int h : a.cycle(first)) ++seen[h];
    }
    for (const int p : face.pieces)
      if (!in(p, a.pieces.size()) || a.pieces[p].face != f)
        return name + " does not have its pieces.";
  }
  return std::count(seen.begin(), seen.end(), 1) == static_cast<long>(seen.size())
             ? ""
             : "A half-edge is not once on a boundary of its face.";
}

std::string check_signs(const Arr& a) {
  for (int h = 0; h < static_cast<int>(a.half_edges.size()); h += 2) {
    const int edge = Arr::edge_of(h), curve = a.edges[edge].curve;
    const auto [left, right] = a.faces_at(edge);
    if (curve < 0) {
      if ((left == a.outside) == (right == a.outside))
        return "The boundary's edge " + std::to_string(edge) + " has not the outside on one side.";
      continue;
    }
    std::vector<Sign> signs = a.faces[left].signs;
    if (in(curve, signs.size())) signs[curve] = -signs[curve];
    if (left == right || signs != a.faces[right].signs)
      return "The signs do not change as they must across edge " + std::to_string(edge) + ".";
  }
  return {};
}

std::string check_components(const Arr& a) {
  int vertices = 0, edges = 0;
  for (int k = 0; k < static_cast<int>(a.components.size()); ++k) {
    const Arr::Component& c = a.components[k];
    const std::string name = "Component " + std::to_string(k);
    vertices += c.vertices;
    edges += c.edges;
    // Euler for one connected component, all its cycles counted: a loop without vertices has one
    // added.
    const int loops = c.vertices == 0 ? 1 : 0;
    if (c.vertices + loops - c.edges + static_cast<int>(c.faces.size()) != 1)
      return name + " contradicts Euler's relation.";
    if (!in(c.parent, a.faces.size())) return name + " lies in no face.";
    const std::vector<int>& holes = a.faces[c.parent].holes;
    if (std::count(holes.begin(), holes.end(), c.hole) != 1 ||
        a.edges[Arr::edge_of(c.hole)].component != k)
      return name + " fills no hole.";
    for (const int f : c.faces)
      if (a.faces[f].parent != c.parent) return name + " has faces that lie elsewhere.";
  }
  if (vertices != static_cast<int>(a.vertices.size()) || edges != static_cast<int>(a.edges.size()))
    return "The components do not have all vertices and edges.";
  int loops = 0;
  for (std::size_t e = 0; e < a.edges.size(); ++e) loops += a.half_edges[2 * e].origin < 0;
  if (vertices + loops - edges + static_cast<int>(a.faces.size()) !=
      1 + static_cast<int>(a.components.size()))
    return "V - E + F is not 1 + C.";
  return {};
}

std::string check_curves(const Arr& a) {
  std::vector<int> seen(a.edges.size(), 0);
  for (std::size_t k = 0; k < a.curve_components.size(); ++k) {
    const Arr::CurveComponent& c = a.curve_components[k];
    const std::string name = "Curve component " + std::to_string(k);
    if (c.half_edges.size() != c.crossings.size() + (c.crossings.empty() || !c.closed ? 1 : 0))
      return name + " has not its crossings.";
    for (std::size_t i = 0; i < c.half_edges.size(); ++i) {
      const int h = c.half_edges[i];
      if (!in(h, a.half_edges.size()) || a.edges[Arr::edge_of(h)].curve != c.curve)
        return name + " has an edge of another curve.";
      ++seen[Arr::edge_of(h)];
      const int end = a.half_edges[Arr::twin(h)].origin;
      if (i < c.crossings.size() && (end < 0 || a.vertices[end].index != c.crossings[i]))
        return name + " does not pass through its crossings.";
    }
  }
  for (std::size_t e = 0; e < a.edges.size(); ++e)
    if (seen[e] != (a.edges[e].curve >= 0 ? 1 : 0))
      return "Edge " + std::to_string(e) + " is not once on its curve.";
  return {};
}

char letter(Sign sign) { return sign == Sign::Negative ? '-' : sign == Sign::Zero ? '0' : '+'; }

/// The codes of components and of what lies in them, from the inside out.
class Canonical {
 public:
  explicit Canonical(const Arr& a) : a_(a), components_in_(a.faces.size()) {
    for (int k = 0; k < static_cast<int>(a.components.size()); ++k)
      components_in_[a.components[k].parent].push_back(k);
  }

  std::string of_all() { return contents(a_.outside); }

 private:
  /// What lies in the holes of a face, in an order of the texts.
  std::string contents(int face) {
    std::vector<std::string> codes;
    for (const int k : components_in_[face]) codes.push_back(component(k));
    std::sort(codes.begin(), codes.end());
    std::string text;
    for (const std::string& code : codes) text += "(" + code + ")";
    return text;
  }

  /// The least of the texts from all beginnings along the component's outer boundary; on the
  /// region's boundary there is one beginning, at its first corner.
  std::string component(int k) {
    std::map<int, std::string> inside;
    for (const int f : a_.components[k].faces) {
      std::string text;
      for (const Sign s : a_.faces[f].signs) text += letter(s);
      inside[f] = text + contents(f);
    }
    std::string least;
    for (const int h : a_.cycle(a_.components[k].hole)) {
      if (a_.components[k].parent == a_.outside && !at_first_corner(h)) continue;
      std::string text = from(h, inside);
      if (least.empty() || text < least) least = std::move(text);
    }
    return least;
  }

  bool at_first_corner(int h) const {
    const int v = a_.half_edges[h].origin;
    return v >= 0 && a_.vertices[v].kind == Arr::Vertex::Kind::Corner && a_.vertices[v].index == 0;
  }

  /// Numbers half-edges in the order in which they are reached by `twin` and `next`, and writes
  /// both numbers, the curve, and the face where it is first reached.
  std::string from(int root, const std::map<int, std::string>& inside) const {
    std::map<int, int> number = {{root, 0}};
    std::vector<int> order = {root};
    std::map<int, bool> face_seen;
    const auto number_of = [&](int h) {
      const auto [entry, is_new] = number.try_emplace(h, static_cast<int>(order.size()));
      if (is_new) order.push_back(h);
      return std::to_string(entry->second);
    };
    std::string text;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const int h = order[i];
      const Arr::HalfEdge& e = a_.half_edges[h];
      const Arr::Edge& edge = a_.edges[Arr::edge_of(h)];
      text += number_of(Arr::twin(h)) + "," + number_of(e.next) + ":";
      text += edge.curve >= 0 ? "c" + std::to_string(edge.curve) : "s" + std::to_string(edge.side);
      const auto face = inside.find(e.face);
      if (face != inside.end() && !face_seen[e.face]) {
        face_seen[e.face] = true;
        text += "[" + face->second + "]";
      }
      text += ";";
    }
    return text;
  }

  const Arr& a_;
  std::vector<std::vector<int>> components_in_;
};

}  // namespace

std::string check(const Arrangement& arrangement) {
  for (const auto rule : {check_half_edges, check_vertices, check_faces, check_signs,
                          check_components, check_curves}) {
    std::string objection = rule(arrangement);
    if (!objection.empty()) return objection;
  }
  return {};
}

std::string canonical_topology(const Arrangement& arrangement) {
  return Canonical(arrangement).of_all();
}

}  // namespace encase
