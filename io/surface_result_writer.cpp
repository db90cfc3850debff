// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/result_json.hpp"
#include "encase/surface_result_json.hpp"
#include "io/function_json.hpp"
#include "io/json_writer.hpp"
#include "io/names.hpp"
#include "io/surface_json.hpp"
#include "io/surface_names.hpp"

namespace encase {
namespace {

void put_region(JsonWriter& w, const Polyhedron& region) {
  w.raw("{\"halfspaces\":"), w.list(region.sides), w.raw("}");
}

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
  w.key("polygon"), w.list(facet.polygon.corners);
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
    w.field("root", cover.root);
    w.field("tokens", cover.tokens);
    w.raw("}");
  });
  w.raw(",\n\"critical\":");
  w.lines(e.critical_points, [&](const CurveCriticalPoints& critical) {
    w.raw("{");
    w.field("surfaces", critical.surfaces);
    w.field("direction", critical.direction);
    w.key("points"), w.list(critical.points);
    w.field("root", critical.root);
    w.field("tokens", critical.tokens);
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
  w.lines(places, [&](const UnresolvedInSpace& place) {
    w.raw("{");
    w.field("kind", name_of(kUnresolvedKinds, place.kind));
    w.key("box");
    if (place.has_box)
      w.put(place.box);
    else
      w.raw("null");
    w.field("surfaces", place.surfaces);
    w.field("cells", place.cells);
    w.field("proved", place.proved);
    w.field("reason", place.reason);
    w.raw("}");
  });
}

void put_statistics(JsonWriter& w, const SpaceStatistics& s) {
  w.raw("{\"decisions\":{");
  w.field("by_double", s.decisions.by_double);
  w.field("by_mpfr", s.decisions.by_mpfr);
  w.field("by_exact", s.decisions.by_exact);
  w.field("undecided", s.decisions.undecided);
  w.raw("}");
  w.field("point_boxes", s.point_boxes);
  w.field("critical_boxes", s.critical_boxes);
  w.field("certificate_tests", s.certificate_tests);
  w.field("facets_encased", s.facets_encased);
  w.field("splits_after_reading", s.splits_after_reading);
  w.raw("}");
}

}  // namespace

std::string to_json(const SurfaceEncasement& e, const SpaceArrangement* arrangement) {
  JsonWriter w;
  w.raw("{\n");
  w.field("format", "encase-result");
  const auto top = [&w](const char* key) {
    w.raw(",\n");
    w.key(key);
  };
  top("version"), w.put(kResultVersion);
  top("command"), w.put("surfaces");
  top("status"), w.put(name_of(kOutcomes, e.outcome));
  top("input"), w.raw("{\"surfaces\":");
  w.lines(e.input, [&](const NamedSurface& surface) {
    w.raw("{");
    w.field("name", surface.name);
    put_function(w, surface.function);
    w.raw("}");
  });
  w.field("delta", e.perturbation);
  w.field("seed", e.seed);
  w.raw("}");
  top("surfaces");
  w.lines(e.surfaces, [&](const Surface& surface) {
    w.raw("{");
    w.field("name", surface.name);
    put_function(w, surface.function);
    w.field("sources", surface.sources);
    w.raw("}");
  });
  top("region"), put_region(w, e.region);
  top("region_used"), put_region(w, e.region_used);
  top("planes"), w.lines(e.planes, [&](const Plane& plane) { put_plane(w, plane); });
  top("points"), put_points(w, e);
  top("intersection_curves"), put_curves(w, e);
  int id = 0;
  top("cells"), w.lines(e.cells, [&](const SpaceCell& cell) { put_cell(w, cell, id++); });
  id = 0;
  top("facets"), w.lines(e.facets, [&](const Facet& facet) { put_facet(w, facet, id++); });
  top("facet_points"), put_facet_points(w, e);
  top("covers"), put_covers(w, e);
  top("certificates"), put_certificates(w, e);
  top("history");
  w.lines(e.history, [&](const Split& split) {
    w.put(std::array<int, 3>{split.line, split.negative, split.positive});
  });
  if (arrangement) top("arrangement"), put_arrangement(w, *arrangement);
  top("degenerate"), put_unresolved(w, e.degenerate);
  top("undecided"), put_unresolved(w, e.undecided);
  top("statistics"), put_statistics(w, e.statistics);
  w.raw("\n}\n");
  return w.take();
}

}  // namespace encase
