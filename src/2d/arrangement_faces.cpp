// SPDX-License-Identifier: MIT
#include "2d/arrangement_faces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "common/filtered_function.hpp"

namespace encase {
namespace {

/// A half-edge of every cycle, by the face to its left.
std::vector<std::vector<int>> cycles_by_face(const Arrangement& a) {
  std::vector<std::vector<int>> cycles(a.faces.size());
  std::vector<bool> seen(a.half_edges.size(), false);
  for (int h = 0; h < static_cast<int>(a.half_edges.size()); ++h) {
    if (seen[h]) continue;
    for (int k = h; !seen[k]; k = a.half_edges[k].next) seen[k] = true;
    cycles[a.half_edges[h].face].push_back(h);
  }
  return cycles;
}

/// The components of the graph of edges and vertices, still without faces.
void collect_components(Arrangement* arrangement) {
  Arrangement& a = *arrangement;
  std::vector<bool> seen(a.vertices.size(), false);
  for (int first = 0; first < static_cast<int>(a.edges.size()); ++first) {
    if (a.edges[first].component >= 0) continue;
    const int id = static_cast<int>(a.components.size());
    Arrangement::Component component;
    std::vector<int> stack = {first};
    a.edges[first].component = id;
    while (!stack.empty()) {
      const int edge = stack.back();
      stack.pop_back();
      ++component.edges;
      for (const int h : {2 * edge, 2 * edge + 1}) {
        const int v = a.half_edges[h].origin;
        if (v < 0 || seen[v]) continue;
        seen[v] = true;
        ++component.vertices;
        const int start = a.vertices[v].half_edge;
        int k = start;
        do {
          int& of = a.edges[Arrangement::edge_of(k)].component;
          if (of < 0) stack.push_back(Arrangement::edge_of(k));
          of = id;
          k = Arrangement::twin(a.half_edges[k].prev);
        } while (k != start);
      }
    }
    a.components.push_back(std::move(component));
  }
}

/// Faces and components, joined by the cycles along which they meet, form a tree. From the outside
/// on, a cycle met from a face is one of its holes, and the other cycles of the component there are
/// the outer boundaries of the faces within.
std::string nest_faces(const std::vector<std::vector<int>>& at_face, Arrangement* arrangement) {
  Arrangement& a = *arrangement;
  std::vector<std::vector<int>> at_component(a.components.size());
  for (const std::vector<int>& cycles : at_face)
    for (const int h : cycles)
      at_component[a.edges[Arrangement::edge_of(h)].component].push_back(h);
  std::vector<int> queue = {a.outside};
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const int f = queue[i];
    for (const int hole : at_face[f]) {
      if (a.faces[f].outer == hole) continue;
      const int id = a.edges[Arrangement::edge_of(hole)].component;
      Arrangement::Component& component = a.components[id];
      if (component.parent >= 0) return "a component of edges lies in two faces";
      component.parent = f;
      component.hole = hole;
      a.faces[f].holes.push_back(hole);
      for (const int outer : at_component[id]) {
        if (outer == hole) continue;
        const int inner = a.half_edges[outer].face;
        if (inner == a.outside || a.faces[inner].outer >= 0)
          return "a face has two outer boundaries";
        a.faces[inner].outer = outer;
        a.faces[inner].parent = f;
        component.faces.push_back(inner);
        queue.push_back(inner);
      }
    }
  }
  return queue.size() == a.faces.size() ? "" : "a face has no outer boundary";
}

/// Whether two faces have the same signs but for that of one curve, which changes.
bool change_in(int curve, const std::vector<Sign>& left, const std::vector<Sign>& right) {
  if (left.size() != right.size() || left[curve] != -right[curve]) return false;
  return std::equal(left.begin(), left.begin() + curve, right.begin()) &&
         std::equal(left.begin() + curve + 1, left.end(), right.begin() + curve + 1);
}

/// The signs at a corner of the region are computed; a curve's sign changes across its edges, where
/// it is smooth.
std::string find_signs(const Encasement& e, const std::vector<std::vector<int>>& at_face,
                       Arrangement* arrangement) {
  Arrangement& a = *arrangement;
  Kernel kernel;
  std::vector<Sign> signs;
  for (const Curve& curve : e.curves) {
    const FilteredFunction<2> f(curve.function);
    signs.push_back(f.sign_at(e.region_used.corners[0], kernel));
    if (signs.back() == Sign::Zero) return "a curve passes through a corner";
  }
  // The first vertex is that corner, the first half-edge of an edge has the region to its left.
  const int start = a.half_edges[a.vertices[0].half_edge].face;
  std::vector<bool> known(a.faces.size(), false);
  known[start] = known[a.outside] = true;
  a.faces[start].signs = std::move(signs);
  std::vector<int> queue = {start};
  for (std::size_t i = 0; i < queue.size(); ++i)
    for (const int first : at_face[queue[i]]) {
      int h = first;
      do {
        const int other = a.half_edges[Arrangement::twin(h)].face;
        const int curve = a.edges[Arrangement::edge_of(h)].curve;
        h = a.half_edges[h].next;
        if (known[other]) continue;
        known[other] = true;
        std::vector<Sign> changed = a.faces[queue[i]].signs;
        if (curve >= 0) changed[curve] = -changed[curve];
        a.faces[other].signs = std::move(changed);
        queue.push_back(other);
      } while (h != first);
    }
  if (queue.size() + 1 != a.faces.size()) return "a face has no neighbours";
  for (int edge = 0; edge < static_cast<int>(a.edges.size()); ++edge) {
    const auto [left, right] = a.faces_at(edge);
    const int curve = a.edges[edge].curve;
    if (curve < 0) continue;
    if (left == a.outside || right == a.outside ||
        !change_in(curve, a.faces[left].signs, a.faces[right].signs))
      return "the faces beside an edge disagree about their signs";
  }
  return "";
}

/// The component of a curve along a half-edge and straight on at crossings, up to the boundary or
/// back to where it begins.
Arrangement::CurveComponent follow_curve(const Arrangement& a, int first) {
  Arrangement::CurveComponent component;
  component.curve = a.edges[Arrangement::edge_of(first)].curve;
  int h = first;
  do {
    component.half_edges.push_back(h);
    const int v = a.half_edges[Arrangement::twin(h)].origin;
    if (v < 0) {
      component.closed = true;
      return component;
    }
    if (a.vertices[v].kind != Arrangement::Vertex::Kind::Crossing) return component;
    component.crossings.push_back(a.vertices[v].index);
    // Of the three half-edges that go on, clockwise, the one in the middle.
    h = a.half_edges[Arrangement::twin(a.half_edges[h].next)].next;
  } while (h != first);
  component.closed = true;
  return component;
}

void follow_curves(Arrangement* arrangement) {
  Arrangement& a = *arrangement;
  std::vector<bool> used(a.edges.size(), false);
  // From the boundary first; what is left are closed loops.
  for (const bool loops : {false, true})
    for (int h = 0; h < static_cast<int>(a.half_edges.size()); ++h) {
      const int origin = a.half_edges[h].origin;
      const bool begins =
          origin >= 0 && a.vertices[origin].kind == Arrangement::Vertex::Kind::OnBoundary;
      if (a.edges[Arrangement::edge_of(h)].curve < 0 || used[Arrangement::edge_of(h)] ||
          !(begins || loops))
        continue;
      a.curve_components.push_back(follow_curve(a, h));
      for (const int k : a.curve_components.back().half_edges) used[Arrangement::edge_of(k)] = true;
    }
  std::stable_sort(a.curve_components.begin(), a.curve_components.end(),
                   [](const auto& p, const auto& q) { return p.curve < q.curve; });
}

}  // namespace

std::string complete(const Encasement& encasement, Arrangement* arrangement) {
  collect_components(arrangement);
  const std::vector<std::vector<int>> cycles = cycles_by_face(*arrangement);
  std::string fault = nest_faces(cycles, arrangement);
  if (fault.empty()) fault = find_signs(encasement, cycles, arrangement);
  if (fault.empty()) follow_curves(arrangement);
  return fault;
}

}  // namespace encase
