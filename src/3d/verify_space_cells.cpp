// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>

#include "3d/arc_direction.hpp"
#include "3d/cell_reading.hpp"
#include "3d/edge_lines.hpp"
#include "3d/facet_places.hpp"
#include "3d/verify_space_claims.hpp"
#include "common/subdivision.hpp"
#include "encase/slice.hpp"

namespace encase::verification {

namespace {

BoxPartition partition_of(const SpaceClaims& claims) {
  BoxPartition partition{
      claims.result.planes, claims.result.history, claims.root, {-1, -1, -1, -1, -1, -1}};
  if (claims.region.is_box) partition.root_planes = {0, 1, 2, 3, 4, 5};
  return partition;
}

bool touches_certified(const SpaceClaims& claims, const Facet& facet) {
  return std::any_of(facet.cells.begin(), facet.cells.end(),
                     [&](int c) { return c >= 0 && certified(claims.cell(c)); });
}

/// Whether a function on a plane is a constant other than zero.
bool is_constant_but_zero(const Function<2>& f, Kernel& kernel) {
  if (f.is_polynomial()) return f.polynomial().is_constant() && !f.polynomial().is_zero();
  if (f.is_inclusion() || f.expression().uses(0) || f.expression().uses(1)) return false;
  return FilteredFunction<2>(f).sign_at({0, 0}, kernel) != Sign::Zero;
}

/// The facet's surfaces are those absent in neither cell, but for those whose function on the plane
/// is a constant other than zero; its encasement is theirs, on its polygon exactly.
void check_facet(SpaceClaims& claims, std::size_t k) {
  const SurfaceEncasement& e = claims.result;
  const Facet& facet = e.facets[k];
  const PlaneChart& chart = claims.charts.of(facet.plane);
  std::vector<int> expected;
  std::vector<Function<2>> functions;
  for (int s = 0; s < static_cast<int>(e.surfaces.size()); ++s) {
    bool may_meet = true;
    for (const int c : facet.cells)
      may_meet =
          may_meet && (c < 0 || claims.cell(c).signs[static_cast<std::size_t>(s)] == Sign::Zero);
    if (!may_meet) continue;
    Function<2> f = on_facet(chart, e.surfaces[static_cast<std::size_t>(s)].function);
    if (is_constant_but_zero(f, claims.kernel)) continue;
    expected.push_back(s);
    functions.push_back(std::move(f));
  }
  if (!claims.require(facet.surfaces == expected, "Facet ", k,
                      " does not name the surfaces that may meet it.") ||
      expected.empty())
    return;
  const Encasement& on_plane = facet.encasement;
  bool same = on_plane.curves.size() == functions.size() &&
              on_plane.input.size() == functions.size() && on_plane.perturbation == 0;
  for (std::size_t c = 0; same && c < functions.size(); ++c)
    same =
        on_plane.curves[c].function == functions[c] && on_plane.input[c].function == functions[c];
  const bool whole = on_plane.region_used.corners == facet.polygon.corners &&
                     on_plane.region.corners == facet.polygon.corners && !on_plane.region.plane &&
                     on_plane.outcome == Outcome::Certified;
  claims.require(same, "The curves of facet ", k, " are not the surfaces on its plane.");
  claims.require(whole, "The encasement of facet ", k, " is not certified on its polygon.");
  if (same && whole)
    claims.include("Facet " + std::to_string(k),
                   verify(on_plane, facet.arrangement, claims.options));
}

bool same_place(const Facet& facet, const FacetPlace& place) {
  return facet.plane == place.plane && facet.cells == place.cells &&
         facet.polygon.corners == place.polygon.corners && !facet.polygon.plane &&
         facet.side_planes == place.side_planes;
}

bool check_facet_points(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  std::vector<Facet> copies = e.facets;
  std::vector<Facet*> facets;
  for (Facet& facet : copies) facets.push_back(&facet);
  const std::vector<FacetPoint> points =
      number_facet_points(claims.surfaces, e.planes, claims.charts, facets);
  bool same = points.size() == e.facet_points.size();
  for (std::size_t k = 0; same && k < points.size(); ++k)
    same = points[k].surfaces == e.facet_points[k].surfaces &&
           points[k].planes == e.facet_points[k].planes &&
           points[k].point == e.facet_points[k].point;
  for (std::size_t k = 0; same && k < copies.size(); ++k)
    same = copies[k].points == e.facets[k].points;
  return claims.require(same, "The facets' points are not numbered as they are found.");
}

}  // namespace

bool check_facets(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  const std::vector<FacetPlace> places =
      facet_places(partition_of(claims), claims.region, claims.charts);
  if (!claims.require(places.size() == e.facets.size(),
                      "The facets are not as many as the cells of the partition have."))
    return false;
  std::vector<std::vector<int>> facets_of(e.cells.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (!claims.require(same_place(e.facets[k], places[k]), "Facet ", k,
                        " is not that of the partition."))
      return false;
    for (const int c : places[k].cells)
      if (c >= 0) facets_of[static_cast<std::size_t>(c)].push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < e.cells.size(); ++k)
    claims.require(e.cells[k].facets == facets_of[k], "Cell ", k, " does not name its facets.");
  for (std::size_t k = 0; k < e.facets.size() && !claims.full(); ++k)
    if (touches_certified(claims, e.facets[k])) check_facet(claims, k);
  return claims.report.ok() && check_facet_points(claims);
}

namespace {

class CellChecker {
 public:
  CellChecker(SpaceClaims& claims, const ReadingScene& scene) : claims_(claims), scene_(scene) {
    const SurfaceEncasement& e = claims.result;
    points_of_.resize(e.cells.size());
    for (std::size_t k = 0; k < e.triple_points.size(); ++k)
      if (e.triple_points[k].cell >= 0)
        points_of_[static_cast<std::size_t>(e.triple_points[k].cell)].push_back(
            static_cast<int>(k));
    for (const TriplePointCover& cover : e.triple_point_covers)
      open_triples_[cover.surfaces] = leaves<3>(cover.root, cover.tokens, cover::kUnresolved);
  }

  void check(std::size_t index) {
    const SpaceCell& cell = claims_.result.cells[index];
    if (!certified(cell)) {
      claims_.require(cell.patches.empty() && cell.arcs.empty(), "Cell ", index,
                      " is not certified but has patches or arcs.");
      return;
    }
    if (!check_surfaces(index, cell) || !check_pairs(index, cell)) return;
    check_reading(index, cell);
  }

 private:
  /// Every surface has a proved sign, or a graph.
  bool check_surfaces(std::size_t index, const SpaceCell& cell) {
    const SurfaceEncasement& e = claims_.result;
    std::vector<int> proofs(e.surfaces.size(), 0);
    bool good = true;
    for (const int k : cell.absences) {
      const AbsenceCertificate& c = e.absence_certificates[static_cast<std::size_t>(k)];
      good = good && c.box.contains(cell.box) &&
             cell.signs[static_cast<std::size_t>(c.surface)] == c.sign;
      ++proofs[static_cast<std::size_t>(c.surface)];
    }
    for (const int k : cell.graphs) {
      const GraphCertificate& c = e.graph_certificates[static_cast<std::size_t>(k)];
      good = good && c.box.contains(cell.box) &&
             cell.signs[static_cast<std::size_t>(c.surface)] == Sign::Zero;
      ++proofs[static_cast<std::size_t>(c.surface)];
    }
    for (const int n : proofs) good = good && n == 1;
    return claims_.require(good, "Cell ", index, " has not one certificate for every surface.");
  }

  /// Every pair of surfaces that may meet the cell has a certificate, and all common points of
  /// three are known.
  bool check_pairs(std::size_t index, const SpaceCell& cell) {
    const SurfaceEncasement& e = claims_.result;
    std::vector<int> alive;
    for (std::size_t s = 0; s < cell.signs.size(); ++s)
      if (cell.signs[s] == Sign::Zero) alive.push_back(static_cast<int>(s));
    std::set<std::array<int, 2>> meeting, proved;
    bool good = true;
    for (const int k : cell.pairs) {
      const PairCertificate& c = e.pair_certificates[static_cast<std::size_t>(k)];
      good = good && c.box.contains(cell.box) && proved.insert(c.surfaces).second;
      if (c.kind != PairCertificate::Kind::Apart) meeting.insert(c.surfaces);
    }
    for (std::size_t a = 0; a < alive.size(); ++a)
      for (std::size_t b = a + 1; b < alive.size(); ++b) {
        good = good && proved.count({alive[a], alive[b]}) == 1;
        if (meeting.count({alive[a], alive[b]}) == 0) continue;
        for (std::size_t c = b + 1; c < alive.size(); ++c)
          if (meeting.count({alive[a], alive[c]}) + meeting.count({alive[b], alive[c]}) == 2)
            good = good && triples_known({alive[a], alive[b], alive[c]}, cell.box);
      }
    good = good && proved.size() * 2 == alive.size() * (alive.size() - (alive.empty() ? 0 : 1));
    return claims_.require(good, "Cell ", index,
                           " has not one certificate for every pair of surfaces, or not all of "
                           "their common points are known.");
  }

  bool triples_known(const std::array<int, 3>& surfaces, const Box<3>& box) const {
    const auto open = open_triples_.find(surfaces);
    return open != open_triples_.end() &&
           std::none_of(open->second.begin(), open->second.end(),
                        [&](const Box<3>& leaf) { return leaf.meets(box); });
  }

  void check_reading(std::size_t index, const SpaceCell& cell) {
    SpacePartition::Leaf leaf;
    leaf.box = cell.box;
    leaf.depth = cell.depth;
    leaf.state = cell.state;
    leaf.signs = cell.signs;
    leaf.absences = cell.absences;
    leaf.graphs = cell.graphs;
    leaf.pairs = cell.pairs;
    leaf.triple_points = points_of_[index];
    const Reading reading = read_cell(scene_, static_cast<int>(index), leaf, cell.facets);
    if (!claims_.require(reading.kind == Reading::Kind::Certified, "Cell ", index,
                         " cannot be read: ", reading.reason, "."))
      return;
    bool patches = reading.patches.size() == cell.patches.size();
    for (std::size_t k = 0; patches && k < cell.patches.size(); ++k)
      patches = reading.patches[k].surface == cell.patches[k].surface &&
                same_loop(reading.patches[k].loop, cell.patches[k].loop);
    claims_.require(patches, "The patches of cell ", index, " are not those of its facets.");
    bool arcs = reading.arcs.size() == cell.arcs.size();
    for (std::size_t k = 0; arcs && k < cell.arcs.size(); ++k) {
      const SurfaceArc &a = reading.arcs[k], &b = cell.arcs[k];
      arcs = a.surfaces == b.surfaces && a.patches == b.patches && a.ends == b.ends &&
             a.triple_points == b.triple_points && a.certificate == b.certificate;
    }
    claims_.require(arcs, "The arcs of cell ", index, " are not those of its facets.");
  }

  static bool same_loop(const std::vector<FacetEdge>& a, const std::vector<FacetEdge>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const FacetEdge& x, const FacetEdge& y) {
                        return x.facet == y.facet && x.half_edge == y.half_edge;
                      });
  }

  SpaceClaims& claims_;
  const ReadingScene& scene_;
  std::vector<std::vector<int>> points_of_;  ///< triple points
  std::map<std::array<int, 3>, std::vector<Box<3>>> open_triples_;
};

}  // namespace

void check_space_cells(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  std::vector<const Facet*> facets;
  for (const Facet& facet : e.facets) facets.push_back(&facet);
  std::vector<FilteredFunction<3>> directions;
  for (const CurveCriticalPoints& list : e.critical_points) {
    const auto [f, g] = list.surfaces;
    // (That it exists was checked with the list.)
    const auto direction =
        arc_direction(e.surfaces[static_cast<std::size_t>(f)].function,
                      e.surfaces[static_cast<std::size_t>(g)].function, list.direction);
    directions.emplace_back(direction.value_or(Polynomial<3>()));
  }
  const FacetComplex complex{claims.surfaces, e.planes, facets, claims.charts, claims.kernel};
  std::vector<char> inside;
  for (const TriplePoint& point : e.triple_points) inside.push_back(point.cell >= 0 ? 1 : 0);
  const ReadingScene scene{complex,   e.facet_points,       e.triple_points,
                           inside,    e.graph_certificates, e.pair_certificates,
                           directions};
  CellChecker checker(claims, scene);
  for (std::size_t k = 0; k < e.cells.size() && !claims.full(); ++k) checker.check(k);
}

}  // namespace encase::verification
