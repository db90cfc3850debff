// SPDX-License-Identifier: MIT
// What is true of patches and arcs whatever they were read from, and however.
#include <algorithm>
#include <map>
#include <utility>

#include "3d/verify_space_claims.hpp"

namespace encase::verification {

namespace {

/// Every edge of a surface on a facet is in one loop of each certified cell beside it, every
/// crossing on it is the end of one arc there, and every triple point is on three arcs of its cell.
void check_counts(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  std::map<std::array<int, 2>, int> loops, ends;  // by cell, and half-edge or facet point
  std::vector<std::size_t> first_edge{0};
  for (const Facet& f : e.facets)
    first_edge.push_back(first_edge.back() + f.arrangement.edges.size());
  std::vector<int> arcs_through(e.triple_points.size(), 0);
  for (std::size_t c = 0; c < e.cells.size(); ++c) {
    const int cell = static_cast<int>(c);
    for (const SurfacePatch& patch : e.cells[c].patches)
      for (const FacetEdge& edge : patch.loop)
        ++loops[{cell, static_cast<int>(first_edge[static_cast<std::size_t>(edge.facet)]) +
                           edge.half_edge / 2}];
    for (const SurfaceArc& arc : e.cells[c].arcs) {
      for (const int end : arc.ends) ++ends[{cell, end}];
      for (const int t : arc.triple_points) ++arcs_through[static_cast<std::size_t>(t)];
    }
  }
  bool edges = true, crossings = true, triples = true;
  for (std::size_t k = 0; k < e.facets.size(); ++k) {
    const Facet& facet = e.facets[k];
    const Arrangement& a = facet.arrangement;
    for (const int cell : facet.cells) {
      if (cell < 0 || !certified(claims.cell(cell))) continue;
      for (std::size_t i = 0; i < a.edges.size(); ++i)
        if (a.edges[i].curve >= 0)
          edges = edges && loops[{cell, static_cast<int>(first_edge[k] + i)}] == 1;
      for (std::size_t v = 0; v < a.vertices.size(); ++v)
        if (a.vertices[v].kind == Arrangement::Vertex::Kind::Crossing)
          crossings = crossings && ends[{cell, facet.points[v]}] == 1;
    }
  }
  for (std::size_t t = 0; t < e.triple_points.size(); ++t)
    triples = triples && arcs_through[t] == (e.triple_points[t].cell >= 0 ? 3 : 0);
  claims.require(edges,
                 "An edge of a surface on a facet is not in one loop of each cell beside it.");
  claims.require(crossings,
                 "A crossing on a facet is not the end of one arc of each cell beside it.");
  claims.require(triples, "A triple point is not on three arcs of its cell.");
}

/// The facet point where a half-edge of a facet begins; -1 for one without ends.
int start_of(const SurfaceEncasement& e, int facet, int half_edge) {
  const Facet& f = e.facets[static_cast<std::size_t>(facet)];
  const int vertex = f.arrangement.half_edges[static_cast<std::size_t>(half_edge)].origin;
  return vertex < 0 ? -1 : f.points[static_cast<std::size_t>(vertex)];
}

/// Whether each edge of a loop begins where the one before ends.
bool is_closed(const SurfaceEncasement& e, const std::vector<FacetEdge>& loop) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const FacetEdge &edge = loop[k], &next = loop[(k + 1) % loop.size()];
    const int end = start_of(e, edge.facet, edge.half_edge ^ 1);
    if (end != start_of(e, next.facet, next.half_edge)) return false;
    if (end < 0 && loop.size() > 1) return false;
  }
  return true;
}

/// An arc on a patch: where on the loop its ends are, in the order of the loop.
struct Chord {
  const SurfaceArc* arc;
  int first, second;

  bool separates(const Chord& other) const {
    const auto is_between = [&](int at) { return first < at && at < second; };
    return is_between(other.first) != is_between(other.second);
  }
  bool crosses_oddly(const Chord& other) const {
    const std::vector<int>& points = other.arc->triple_points;
    const auto common = std::count_if(
        arc->triple_points.begin(), arc->triple_points.end(),
        [&](int t) { return std::find(points.begin(), points.end(), t) != points.end(); });
    return common % 2 == 1;
  }
};

/// The arcs that lie on a patch; nothing if an end of one is not on the loop.
std::optional<std::vector<Chord>> chords_of(const SurfaceEncasement& e, const SpaceCell& cell,
                                            int patch) {
  const SurfacePatch& disc = cell.patches[static_cast<std::size_t>(patch)];
  std::map<int, int> place;  // on the loop, of the points
  for (const FacetEdge& edge : disc.loop)
    place.emplace(start_of(e, edge.facet, edge.half_edge), static_cast<int>(place.size()));
  std::vector<Chord> chords;
  for (const SurfaceArc& arc : cell.arcs)
    for (std::size_t i = 0; i < 2; ++i) {
      if (arc.patches[i] != patch) continue;
      const auto from = place.find(arc.ends[0]), to = place.find(arc.ends[1]);
      if (disc.surface != arc.surfaces[i] || from == place.end() || to == place.end() || from == to)
        return std::nullopt;
      const auto [first, second] = std::minmax(from->second, to->second);
      chords.push_back({&arc, first, second});
    }
  return chords;
}

/// A patch is a disc, and an arc on it goes from one point of its rim to another. Two arcs cross
/// where they have a triple point in common, transversally, and nowhere else. So the ends of one
/// separate those of the other on the rim if and only if these points are odd in number.
void check_discs(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  for (std::size_t c = 0; c < e.cells.size() && !claims.full(); ++c) {
    const SpaceCell& cell = e.cells[c];
    bool loops = true, ends = true, pairing = true;
    for (std::size_t p = 0; p < cell.patches.size(); ++p) {
      loops = loops && is_closed(e, cell.patches[p].loop);
      const auto chords = chords_of(e, cell, static_cast<int>(p));
      ends = ends && chords;
      for (std::size_t a = 0; chords && a < chords->size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
          pairing = pairing && (*chords)[a].separates((*chords)[b]) ==
                                   (*chords)[a].crosses_oddly((*chords)[b]);
    }
    claims.require(loops, "A loop of cell ", c, " is not closed.");
    claims.require(ends, "An arc of cell ", c, " does not end on the loops of its patches.");
    claims.require(pairing, "Arcs of cell ", c, " cannot have these ends and triple points.");
  }
}

}  // namespace

void check_space_gluing(SpaceClaims& claims) {
  check_counts(claims);
  check_discs(claims);
}

}  // namespace encase::verification
