// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "encase/result_json.hpp"
#include "io/json_node.hpp"
#include "io/names.hpp"
#include "io/result_parts.hpp"
#include "io/surface_json.hpp"
#include "io/surface_names.hpp"

namespace encase {
namespace {

Plane read_plane(const JsonNode& node) {
  node.of_size(4);
  Plane plane;
  if (node.item(0).is_text()) {
    std::array<Rational, 4> c;
    for (int k = 0; k < 4; ++k) c[k] = node.item(k).rational();
    if (c[0] == 0 && c[1] == 0 && c[2] == 0) node.fail("a plane needs a normal");
    plane = Plane::from_rationals(c);
  } else {
    for (int k = 0; k < 3; ++k) plane.normal[k] = node.item(k).number();
    plane.offset = node.item(3).number();
  }
  const auto& n = plane.normal;
  if (!std::isfinite(n[0]) || !std::isfinite(n[1]) || !std::isfinite(n[2]) ||
      !std::isfinite(plane.offset) || (n[0] == 0 && n[1] == 0 && n[2] == 0))
    node.fail("the numbers are out of range");
  return plane;
}

/// Two indices, the second of which may be missing.
std::array<int, 2> read_one_or_two(const JsonNode& node, std::size_t size) {
  node.of_size(2);
  return {node.item(0).index(size), node.item(1).index_or_null(size)};
}

/// How long the lists are that others refer to.
struct Counts {
  std::size_t cells, facets, facet_points;
};

SurfacePatch read_patch(const JsonNode& node, const SurfaceEncasement& e) {
  SurfacePatch patch;
  patch.surface = node.member("surface").index(e.surfaces.size());
  patch.loop = node.member("loop").map([&](const JsonNode& edge) {
    edge.of_size(2);
    const int facet = edge.item(0).index(e.facets.size());
    return FacetEdge{facet, edge.item(1).index(e.facets[facet].arrangement.half_edges.size())};
  });
  return patch;
}

SurfaceArc read_arc(const JsonNode& node, const SurfaceEncasement& e, std::size_t patches) {
  SurfaceArc arc;
  arc.surfaces = read_ascending<2>(node.member("surfaces"), e.surfaces.size());
  const auto pair = [](const JsonNode& list, std::size_t size) {
    list.of_size(2);
    return std::array<int, 2>{list.item(0).index(size), list.item(1).index(size)};
  };
  arc.patches = pair(node.member("patches"), patches);
  arc.ends = pair(node.member("ends"), e.facet_points.size());
  arc.triple_points = node.member("points").indices(e.triple_points.size());
  arc.certificate = node.member("certificate").index(e.pair_certificates.size());
  return arc;
}

/// After all lists but that of the cells.
SpaceCell read_cell(const JsonNode& node, const SurfaceEncasement& e) {
  SpaceCell cell;
  cell.state = node.member("state").one_of(kCellStates);
  cell.depth = static_cast<int>(node.member("depth").integer(0, std::numeric_limits<int>::max()));
  cell.box = node.member("box").box<3>();
  cell.facets = node.member("facets").indices(e.facets.size());
  cell.signs = node.member("signs").map(
      [](const JsonNode& sign) { return static_cast<Sign>(sign.integer(-1, 1)); });
  node.member("signs").of_size(static_cast<int>(e.surfaces.size()));
  cell.absences = node.member("absences").indices(e.absence_certificates.size());
  cell.graphs = node.member("graphs").indices(e.graph_certificates.size());
  cell.pairs = node.member("pairs").indices(e.pair_certificates.size());
  cell.patches =
      node.member("patches").map([&](const JsonNode& item) { return read_patch(item, e); });
  cell.arcs = node.member("arcs").map(
      [&](const JsonNode& item) { return read_arc(item, e, cell.patches.size()); });
  return cell;
}

/// The facet's own result is read as one, with its messages.
void read_facet_encasement(const JsonNode& node, Facet* facet) {
  auto stored = result_from_json(node.dump(), "its encasement");
  if (!stored) node.fail(stored.error().message);
  if (!stored.value().arrangement) node.fail("the arrangement is missing");
  facet->encasement = std::move(stored.value().encasement);
  facet->arrangement = std::move(*stored.value().arrangement);
  if (facet->encasement.curves.size() != facet->surfaces.size())
    node.fail("expected a curve for each surface");
}

Facet read_facet(const JsonNode& node, const SurfaceEncasement& e, const Counts& counts) {
  Facet facet;
  facet.plane = node.member("plane").index(e.planes.size());
  const JsonNode cells = node.member("cells");
  cells.of_size(2);
  for (int k = 0; k < 2; ++k) facet.cells[k] = cells.item(k).index_or_null(counts.cells);
  facet.polygon = read_polygon(node.member("polygon"));
  facet.side_planes = node.member("side_planes").indices(e.planes.size());
  node.member("side_planes").of_size(facet.polygon.side_count());
  facet.surfaces = node.member("surfaces").indices(e.surfaces.size());
  facet.points = node.member("points").map(
      [&](const JsonNode& point) { return point.index_or_null(counts.facet_points); });
  if (!facet.surfaces.empty()) read_facet_encasement(node.member("encasement"), &facet);
  node.member("points").of_size(static_cast<int>(facet.arrangement.vertices.size()));
  return facet;
}

TriplePoint read_triple_point(const JsonNode& node, std::size_t surfaces, std::size_t cells) {
  TriplePoint t;
  t.surfaces = read_ascending<3>(node.member("surfaces"), surfaces);
  t.point = node.member("point").point<3>();
  t.rounded = node.member("rounded").boolean();
  t.box = node.member("box").box<3>();
  const JsonNode location = node.member("location");
  if (!location.is_null()) t.location = location.one_of(kLocations);
  t.cell = node.member("cell").index_or_null(cells);
  return t;
}

CurveCriticalPoints read_critical(const JsonNode& node, std::size_t surfaces) {
  CurveCriticalPoints critical;
  critical.surfaces = read_ascending<2>(node.member("surfaces"), surfaces);
  critical.direction = node.member("direction").point<3>();
  critical.points = node.member("points").map([](const JsonNode& box) { return box.box<3>(); });
  critical.root = node.member("root").box<3>();
  critical.tokens = read_tokens<3>(node.member("tokens"), critical.points.size());
  return critical;
}

void read_certificates(const JsonNode& node, SurfaceEncasement* e) {
  const std::size_t surfaces = e->surfaces.size();
  e->absence_certificates = node.member("absences").map([&](const JsonNode& item) {
    return AbsenceCertificate{item.member("surface").index(surfaces), item.member("box").box<3>(),
                              static_cast<Sign>(item.member("sign").integer(-1, 1))};
  });
  e->graph_certificates = node.member("graphs").map([&](const JsonNode& item) {
    GraphCertificate c;
    c.surface = item.member("surface").index(surfaces);
    c.box = item.member("box").box<3>();
    c.direction = item.member("direction").point<3>();
    c.spread = item.member("spread").number();
    c.center = item.member("center").point<3>();
    c.multiplier = item.member("multiplier").number();
    return c;
  });
  e->pair_certificates = node.member("pairs").map([&](const JsonNode& item) {
    PairCertificate c;
    c.kind = item.member("kind").one_of(kPairKinds);
    c.surfaces = read_ascending<2>(item.member("surfaces"), surfaces);
    c.box = item.member("box").box<3>();
    c.alpha = item.member("alpha").number();
    c.beta = item.member("beta").number();
    c.critical = item.member("critical").index_or_null(e->critical_points.size());
    c.direction = item.member("direction").point<3>();
    return c;
  });
}

SpaceStatistics read_statistics(const JsonNode& node) {
  SpaceStatistics s;
  s.decisions = read_decisions(node.member("decisions"));
  s.point_boxes = node.member("point_boxes").count();
  s.critical_boxes = node.member("critical_boxes").count();
  s.certificate_tests = node.member("certificate_tests").count();
  s.facets_encased = node.member("facets_encased").count();
  s.splits_after_reading = node.member("splits_after_reading").count();
  return s;
}

}  // namespace

StoredSurfaces read_surfaces(const JsonNode& root) {
  if (root.member("command").text() != "surfaces")
    root.member("command").fail("expected a result of 'surfaces'");
  StoredSurfaces stored;
  SurfaceEncasement& e = stored.encasement;
  e.outcome = root.member("status").one_of(kOutcomes);
  const JsonNode input = root.member("input");
  e.input = read_functions<3>(input.member("surfaces"));
  e.perturbation = input.member("delta").number();
  e.seed = input.member("seed").unsigned_integer();
  e.surfaces = root.member("surfaces").map([&](const JsonNode& surface) {
    return Surface{surface.member("name").text(), read_function<3>(surface),
                   surface.member("sources").indices(e.input.size())};
  });
  e.region = read_solid_region(root.member("region"));
  e.region_used = read_solid_region(root.member("region_used"));
  e.planes = root.member("planes").map(read_plane);
  if (e.planes.size() < e.region_used.sides.size())
    root.member("planes").fail("the sides of the region used are missing");

  // Whatever is referred to is read, or at least counted, before what refers to it.
  const std::size_t surfaces = e.surfaces.size();
  const Counts counts{static_cast<std::size_t>(root.member("cells").size()),
                      static_cast<std::size_t>(root.member("facets").size()),
                      static_cast<std::size_t>(root.member("facet_points").size())};
  e.triple_points = root.member("points").map(
      [&](const JsonNode& item) { return read_triple_point(item, surfaces, counts.cells); });
  e.facet_points = root.member("facet_points").map([&](const JsonNode& item) {
    return FacetPoint{read_one_or_two(item.member("surfaces"), surfaces),
                      read_one_or_two(item.member("planes"), e.planes.size()),
                      item.member("point").point<3>()};
  });
  e.facets =
      root.member("facets").map([&](const JsonNode& item) { return read_facet(item, e, counts); });
  const JsonNode covers = root.member("covers");
  e.triple_point_covers = covers.member("points").map([&](const JsonNode& item) {
    return TriplePointCover{read_ascending<3>(item.member("surfaces"), surfaces),
                            item.member("root").box<3>(),
                            read_tokens<3>(item.member("tokens"), e.triple_points.size())};
  });
  e.critical_points = covers.member("critical").map([&](const JsonNode& item) {
    return read_critical(item, surfaces);
  });
  read_certificates(root.member("certificates"), &e);
  e.cells = root.member("cells").map([&](const JsonNode& item) { return read_cell(item, e); });
  e.history = read_history(root.member("history"), e.planes.size(), counts.cells);
  const auto unresolved = [&](const char* key) {
    const JsonNode node = root.member(key);
    auto places =
        read_unresolved(node, "surfaces", &UnresolvedInSpace::surfaces, e.input.size(), surfaces);
    for (std::size_t k = 0; k < places.size(); ++k)
      places[k].cells = node.item(static_cast<int>(k)).member("cells").indices(counts.cells);
    return places;
  };
  e.degenerate = unresolved("degenerate");
  e.undecided = unresolved("undecided");
  e.statistics = read_statistics(root.member("statistics"));
  if (root.has("arrangement")) stored.arrangement = read_arrangement(root.member("arrangement"), e);
  if (root.has("meshes")) stored.meshes = read_meshes(root.member("meshes"), e);
  return stored;
}

}  // namespace encase
