// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/result_json.hpp"
#include "encase/surface_result_json.hpp"
#include "io/json_writer.hpp"
#include "io/names.hpp"
#include "io/result_parts.hpp"
#include "io/surface_json.hpp"
#include "io/surface_names.hpp"

namespace encase {
namespace {

void put_plane(JsonWriter& w, const Plane& plane) {
  if (plane.rational)
    w.put(*plane.rational);
  else
    w.put(std::array<double, 4>{plane.normal[0], plane.normal[1], plane.normal[2], plane.offset});
}

void put_patch(JsonWriter& w, const SurfacePatch& patch) {
  w.raw("{");
  w.field("surface", patch.surface);
  w.key("loop");
  w.list(patch.loop, [&](const FacetEdge& edge) {
    w.put(std::array<int, 2>{edge.facet, edge.half_edge});
  });
  w.raw("}");
}

void put_arc(JsonWriter& w, const SurfaceArc& arc) {
  w.raw("{");
  w.field("surfaces", arc.surfaces);
  w.field("patches", arc.patches);
  w.field("ends", arc.ends);
  w.field("points", arc.triple_points);
  w.field("certificate", arc.certificate);
  w.raw("}");
}

void put_cell(JsonWriter& w, const SpaceCell& cell, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("state", name_of(kCellStates, cell.state));
  w.field("depth", cell.depth);
  w.field("box", cell.box);
  w.field("facets", cell.facets);
  w.key("signs"), w.list(cell.signs);
  w.field("absences", cell.absences);
  w.field("graphs", cell.graphs);
  w.field("pairs", cell.pairs);
  w.key("patches"), w.list(cell.patches, [&](const SurfacePatch& p) { put_patch(w, p); });
  w.key("arcs"), w.list(cell.arcs, [&](const SurfaceArc& a) { put_arc(w, a); });
  w.raw("}");
}

/// The encasement of a facet is a result of its own, with its arrangement.
void put_facet(JsonWriter& w, const Facet& facet, int id) {
  w.raw("{");
  w.field("id", id);
  w.field("plane", facet.plane);
  w.key("cells"), w.list(facet.cells, [&](int cell) { w.put_index(cell); });
  w.key("polygon"), put_polygon(w, facet.polygon);
  w.field("side_planes", facet.side_planes);
  w.field("surfaces", facet.surfaces);
  w.key("points"), w.list(facet.points, [&](int point) { w.put_index(point); });
  w.key("encasement");
  if (facet.surfaces.empty())
    w.raw("null");
  else
    w.raw(to_json(facet.encasement, &facet.arrangement));
  w.raw("}");
}

void put_points(JsonWriter& w, const SurfaceEncasement& e) {
  int id = 0;
  w.lines(e.triple_points, [&](const TriplePoint& t) {
    w.raw("{");
    w.field("id", id++);
    w.field("surfaces", t.surfaces);
    w.field("point", t.point);
    w.field("rounded", t.rounded);
    w.field("box", t.box);
    w.key("location");
    if (t.location)
      w.put(name_of(kLocations, *t.location));
    else
      w.raw("null");
    w.key("cell"), w.put_index(t.cell);
    w.raw("}");
  });
}

void put_facet_points(JsonWriter& w, const SurfaceEncasement& e) {
  w.lines(e.facet_points, [&](const FacetPoint& p) {
    w.raw("{");
    w.key("surfaces"), w.list(p.surfaces, [&](int k) { w.put_index(k); });
    w.key("planes"), w.list(p.planes, [&](int k) { w.put_index(k); });
    w.field("point", p.point);
    w.raw("}");
  });
}

/// They follow from the cells; readers pass them over.
void put_curves(JsonWriter& w, const SurfaceEncasement& e) {
  w.lines(intersection_curves(e), [&](const IntersectionCurve& curve) {
    w.raw("{");
    w.field("surfaces", curve.surfaces);
    w.field("closed", curve.closed);
    w.key("arcs");
    w.list(curve.arcs, [&](const ArcUse& use) {
      w.put(std::array<int, 3>{use.cell, use.arc, use.forward ? 1 : -1});
    });
    w.field("facet_points", curve.facet_points);
    w.raw("}");
  });
}

void put_covers(JsonWriter& w, const SurfaceEncasement& e) {
  w.raw("{\"points\":");
  w.lines(e.triple_point_covers, [&](const TriplePointCover& cover) {
    w.raw("{");
    w.field("surfaces", cover.surfaces);
    put_cover(w, cover.root, cover.tokens);
    w.raw("}");
  });
  w.raw(",\n\"critical\":");
  w.lines(e.critical_points, [&](const CurveCriticalPoints& critical) {
    w.raw("{");
    w.field("surfaces", critical.surfaces);
    w.field("direction", critical.direction);
    w.key("points"), w.list(critical.points);
    put_cover(w, critical.root, critical.tokens);
    w.raw("}");
  });
  w.raw("}");
}

void put_certificates(JsonWriter& w, const SurfaceEncasement& e) {
  w.raw("{\"absences\":");
  w.lines(e.absence_certificates, [&](const AbsenceCertificate& c) {
    w.raw("{");
    w.field("surface", c.surface);
    w.field("box", c.box);
    w.field("sign", c.sign);
    w.raw("}");
  });
  w.raw(",\n\"graphs\":");
  w.lines(e.graph_certificates, [&](const GraphCertificate& c) {
    w.raw("{");
    w.field("surface", c.surface);
    w.field("box", c.box);
    w.field("direction", c.direction);
    w.field("spread", c.spread);
    w.field("center", c.center);
    w.field("multiplier", c.multiplier);
    w.raw("}");
  });
  w.raw(",\n\"pairs\":");
  w.lines(e.pair_certificates, [&](const PairCertificate& c) {
    w.raw("{");
    w.field("kind", name_of(kPairKinds, c.kind));
    w.field("surfaces", c.surfaces);
    w.field("box", c.box);
    w.field("alpha", c.alpha);
    w.field("beta", c.beta);
    w.key("critical"), w.put_index(c.critical);
    w.field("direction", c.direction);
    w.raw("}");
  });
  w.raw("}");
}

void put_unresolved(JsonWriter& w, const std::vector<UnresolvedInSpace>& places) {
  put_unresolved(w, places, "surfaces", &UnresolvedInSpace::surfaces,
                 [&](const UnresolvedInSpace& place) { w.field("cells", place.cells); });
}

void put_statistics(JsonWriter& w, const SpaceStatistics& s) {
  w.raw("{");
  put_decisions(w, s.decisions);
  w.field("point_boxes", s.point_boxes);
  w.field("critical_boxes", s.critical_boxes);
  w.field("certificate_tests", s.certificate_tests);
  w.field("facets_encased", s.facets_encased);
  w.field("splits_after_reading", s.splits_after_reading);
  w.raw("}");
}

}  // namespace

std::string to_json(const SurfaceEncasement& e, const SpaceArrangement* arrangement,
                    const std::vector<SurfaceMesh>& meshes) {
  JsonWriter w;
  put_head(w, "surfaces", name_of(kOutcomes, e.outcome));
  w.section("input"), w.raw("{\"surfaces\":"), put_functions(w, e.input);
  w.field("delta", e.perturbation);
  w.field("seed", e.seed);
  w.raw("}");
  w.section("surfaces"), put_encased(w, e.surfaces);
  w.section("region"), put_solid_region(w, e.region);
  w.section("region_used"), put_solid_region(w, e.region_used);
  w.section("planes"), w.lines(e.planes, [&](const Plane& plane) { put_plane(w, plane); });
  w.section("points"), put_points(w, e);
  w.section("intersection_curves"), put_curves(w, e);
  int id = 0;
  w.section("cells"), w.lines(e.cells, [&](const SpaceCell& cell) { put_cell(w, cell, id++); });
  id = 0;
  w.section("facets"), w.lines(e.facets, [&](const Facet& facet) { put_facet(w, facet, id++); });
  w.section("facet_points"), put_facet_points(w, e);
  w.section("covers"), put_covers(w, e);
  w.section("certificates"), put_certificates(w, e);
  w.section("history"), put_history(w, e.history);
  if (arrangement) w.section("arrangement"), put_arrangement(w, *arrangement);
  if (!meshes.empty()) w.section("meshes"), put_meshes(w, meshes);
  w.section("degenerate"), put_unresolved(w, e.degenerate);
  w.section("undecided"), put_unresolved(w, e.undecided);
  w.section("statistics"), put_statistics(w, e.statistics);
  w.raw("\n}\n");
  return w.take();
}

}  // namespace encase
