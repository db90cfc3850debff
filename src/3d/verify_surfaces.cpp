// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "3d/verify_space_claims.hpp"
#include "common/verify_functions.hpp"
#include "common/well_formed.hpp"

namespace encase {

namespace verification {

namespace {

bool is_polyhedron(const Polyhedron& p) {
  for (const HalfSpace& side : p.sides)
    for (const Rational& c : side)
      if (!proper(c)) return false;
  for (const auto& corner : p.corners)
    for (const Rational& c : corner)
      if (!proper(c)) return false;
  return !p.sides.empty();
}

/// The splitting planes: {0, 0, +-1} and the like, with a double as offset.
bool is_axis_parallel(const Plane& plane) {
  int ones = 0, zeros = 0;
  for (const double c : plane.normal) {
    ones += std::fabs(c) == 1 ? 1 : 0;
    zeros += c == 0 ? 1 : 0;
  }
  return ones == 1 && zeros == 2 && finite(plane.offset) && !plane.rational;
}

void check_input_structure(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  for (std::size_t k = 0; k < e.input.size(); ++k)
    claims.require(is_proper(e.input[k].function), "Input surface ", k,
                   " has no proper polynomial or expression.");
  for (std::size_t k = 0; k < e.surfaces.size(); ++k) {
    claims.require(is_proper(e.surfaces[k].function), "Surface ", k,
                   " has no proper polynomial or expression.");
    const std::vector<int>& sources = e.surfaces[k].sources;
    claims.require(!sources.empty() && ascending(sources) && all_in_range(sources, e.input),
                   "Surface ", k, " does not name ascending indices of input surfaces.");
  }
  claims.require(is_polyhedron(e.region) && is_polyhedron(e.region_used),
                 "A region has bad coefficients.");
  claims.require(e.planes.size() >= e.region_used.sides.size(),
                 "There are fewer planes than sides of the region used.");
  for (std::size_t k = e.region_used.sides.size(); k < e.planes.size(); ++k)
    claims.require(is_axis_parallel(e.planes[k]), "Plane ", k, " is not parallel to two axes.");
}

bool is_child(int child, const SurfaceEncasement& e) {
  return child >= 0 ? in_range(child, e.history) : in_range(~child, e.cells);
}

bool is_pair(const std::array<int, 2>& pair, const SurfaceEncasement& e) {
  return in_range(pair[0], e.surfaces) && in_range(pair[1], e.surfaces) && pair[0] < pair[1];
}
bool is_triple(const std::array<int, 3>& triple, const SurfaceEncasement& e) {
  return triple[0] >= 0 && ascending(triple) && in_range(triple[2], e.surfaces);
}

template <class T>
bool are_tokens(const std::vector<int>& tokens, const std::vector<T>& items) {
  return std::all_of(tokens.begin(), tokens.end(), [&](int token) {
    return token >= 0 ? in_range(token, items) : token >= cover::kUnresolved;
  });
}

void check_list_structure(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  for (std::size_t k = 0; k < e.triple_points.size(); ++k) {
    const TriplePoint& t = e.triple_points[k];
    claims.require(is_triple(t.surfaces, e) && has_interior(t.box) && finite(t.point) &&
                       (t.cell == -1 || in_range(t.cell, e.cells)),
                   "Triple point ", k, " has a bad index, box or point.");
  }
  for (std::size_t k = 0; k < e.triple_point_covers.size(); ++k) {
    const TriplePointCover& c = e.triple_point_covers[k];
    claims.require(
        is_triple(c.surfaces, e) && has_interior(c.root) && are_tokens(c.tokens, e.triple_points),
        "Triple point cover ", k, " has a bad index, root or token.");
  }
  for (std::size_t k = 0; k < e.critical_points.size(); ++k) {
    const CurveCriticalPoints& c = e.critical_points[k];
    claims.require(is_pair(c.surfaces, e) && finite(c.direction) && has_interior(c.root) &&
                       std::all_of(c.points.begin(), c.points.end(), has_interior<3>) &&
                       are_tokens(c.tokens, c.points),
                   "List ", k, " of critical points has a bad index, box or token.");
  }
  for (std::size_t k = 0; k < e.absence_certificates.size(); ++k) {
    const AbsenceCertificate& c = e.absence_certificates[k];
    claims.require(in_range(c.surface, e.surfaces) && has_interior(c.box) &&
                       (c.sign == Sign::Positive || c.sign == Sign::Negative),
                   "Absence certificate ", k, " has a bad index, box or sign.");
  }
  for (std::size_t k = 0; k < e.graph_certificates.size(); ++k) {
    const GraphCertificate& c = e.graph_certificates[k];
    claims.require(in_range(c.surface, e.surfaces) && has_interior(c.box) && finite(c.direction) &&
                       finite(c.center) && finite(c.spread) && finite(c.multiplier),
                   "Graph certificate ", k, " has a bad index, box or number.");
  }
  using Kind = PairCertificate::Kind;
  for (std::size_t k = 0; k < e.pair_certificates.size(); ++k) {
    const PairCertificate& c = e.pair_certificates[k];
    const bool kind = c.kind == Kind::Apart || c.kind == Kind::Local ||
                      (c.kind == Kind::Listed && in_range(c.critical, e.critical_points));
    claims.require(kind && is_pair(c.surfaces, e) && has_interior(c.box) && finite(c.direction) &&
                       finite(c.alpha) && finite(c.beta),
                   "Pair certificate ", k, " has a bad kind, index, box or number.");
  }
}

bool is_facet_edge(const FacetEdge& edge, const SurfaceEncasement& e) {
  return in_range(edge.facet, e.facets) &&
         in_range(edge.half_edge,
                  e.facets[static_cast<std::size_t>(edge.facet)].arrangement.half_edges);
}

void check_cell_structure(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  for (std::size_t k = 0; k < e.history.size(); ++k) {
    const Split& split = e.history[k];
    claims.require(in_range(split.line, e.planes) && is_child(split.negative, e) &&
                       is_child(split.positive, e) &&
                       split.line >= static_cast<int>(e.region_used.sides.size()),
                   "Split ", k, " has a bad plane or child.");
  }
  for (std::size_t k = 0; k < e.facets.size(); ++k) {
    const Facet& f = e.facets[k];
    bool good = in_range(f.plane, e.planes) && f.polygon.corners.size() >= 3 &&
                ascending(f.surfaces) && all_in_range(f.surfaces, e.surfaces) &&
                (f.cells[0] == -1 || in_range(f.cells[0], e.cells)) &&
                (f.cells[1] == -1 || in_range(f.cells[1], e.cells)) &&
                f.points.size() == f.arrangement.vertices.size();
    for (const int p : f.points) good = good && (p == -1 || in_range(p, e.facet_points));
    claims.require(good, "Facet ", k, " has a bad index or polygon.");
  }
  for (std::size_t k = 0; k < e.cells.size() && !claims.full(); ++k) {
    const SpaceCell& c = e.cells[k];
    bool good = has_interior(c.box) && all_in_range(c.facets, e.facets) && ascending(c.facets) &&
                c.signs.size() == e.surfaces.size() &&
                all_in_range(c.absences, e.absence_certificates) &&
                all_in_range(c.graphs, e.graph_certificates) &&
                all_in_range(c.pairs, e.pair_certificates) &&
                (c.state == CellState::Certified || c.state == CellState::Degenerate ||
                 c.state == CellState::Undecided);
    for (const SurfacePatch& patch : c.patches) {
      good = good && in_range(patch.surface, e.surfaces);
      for (const FacetEdge& edge : patch.loop) good = good && is_facet_edge(edge, e);
    }
    for (const SurfaceArc& arc : c.arcs) {
      good = good && is_pair(arc.surfaces, e) && in_range(arc.certificate, e.pair_certificates) &&
             all_in_range(arc.triple_points, e.triple_points);
      for (std::size_t i = 0; i < 2; ++i)
        good = good && in_range(arc.patches[i], c.patches) && in_range(arc.ends[i], e.facet_points);
    }
    claims.require(good, "Cell ", k, " has a bad index, box or state.");
  }
}

void check_entry_structure(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  using Kind = Unresolved::Kind;
  for (const auto* list : {&e.degenerate, &e.undecided})
    for (std::size_t k = 0; k < list->size(); ++k) {
      const UnresolvedInSpace& u = (*list)[k];
      const char* name = list == &e.degenerate ? "Degenerate" : "Undecided";
      const bool component = u.kind == Kind::SharedComponent || u.kind == Kind::RepeatedComponent;
      claims.require(ascending(u.surfaces) && (component ? all_in_range(u.surfaces, e.input)
                                                         : all_in_range(u.surfaces, e.surfaces)),
                     name, " entry ", k, " does not name ascending indices of surfaces.");
      claims.require(!u.has_box || ordered(u.box), name, " entry ", k, " has a bad box.");
      claims.require(ascending(u.cells) && all_in_range(u.cells, e.cells), name, " entry ", k,
                     " does not name ascending indices of cells.");
    }
}

}  // namespace

bool check_space_structure(SpaceClaims& claims) {
  check_input_structure(claims);
  check_list_structure(claims);
  check_cell_structure(claims);
  check_entry_structure(claims);
  return claims.report.ok();
}

namespace {

/// Every cell that is not certified is named by one entry, in the list of its state.
void check_open_cells(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  std::vector<int> degenerate(e.cells.size(), 0), undecided(e.cells.size(), 0);
  for (const UnresolvedInSpace& u : e.degenerate)
    for (const int cell : u.cells) ++degenerate[static_cast<std::size_t>(cell)];
  for (const UnresolvedInSpace& u : e.undecided)
    for (const int cell : u.cells) ++undecided[static_cast<std::size_t>(cell)];
  for (std::size_t k = 0; k < e.cells.size(); ++k)
    claims.require(degenerate[k] == (e.cells[k].state == CellState::Degenerate ? 1 : 0) &&
                       undecided[k] == (e.cells[k].state == CellState::Undecided ? 1 : 0),
                   "Cell ", k, " is not named by one entry of what its state says.");
}

}  // namespace

void check_surfaces(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  FunctionClaims<3> functions{e.input};
  for (const Surface& s : e.surfaces) functions.encased.push_back({s.function, s.sources});
  for (const UnresolvedInSpace& u : e.degenerate)
    functions.degenerate.push_back({u.kind, u.surfaces});
  for (const UnresolvedInSpace& u : e.undecided)
    functions.undecided.push_back({u.kind, u.surfaces});
  check_functions(claims, functions);
}

}  // namespace verification

Verification verify(const SurfaceEncasement& encasement, const VerifyOptions& options) {
  using namespace verification;
  SpaceClaims claims(encasement, options);

  // Index errors and the like first, so that everything below may follow indices freely.
  if (!check_space_structure(claims)) return claims.report;
  claims.surfaces.reserve(encasement.surfaces.size());
  for (const Surface& surface : encasement.surfaces) claims.surfaces.emplace_back(surface.function);

  // What everything refers to: the surfaces, the region, its partition.
  check_outcome(claims, encasement);
  check_open_cells(claims);
  check_surfaces(claims);
  if (!check_space_regions(claims) || !replay_space_history(claims)) return claims.report;

  // What is known of single boxes.
  check_certificates(claims);
  check_point_lists(claims);

  // The planes, and what follows from them for the cells.
  if (check_facets(claims)) check_space_cells(claims);
  if (claims.report.ok()) check_space_gluing(claims);
  return claims.report;
}

}  // namespace encase
