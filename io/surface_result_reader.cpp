// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "encase/cover.hpp"
#include "encase/result_json.hpp"
#include "io/function_json.hpp"
#include "io/json_node.hpp"
#include "io/names.hpp"
#include "io/surface_json.hpp"
#include "io/surface_names.hpp"

namespace encase {
namespace {

Polyhedron read_region(const JsonNode& node) {
  const JsonNode sides = node.member("halfspaces");
  auto region = make_polyhedron(sides.map([](const JsonNode& side) {
    side.of_size(4);
    HalfSpace read;
    for (int k = 0; k < 4; ++k) read[k] = side.item(k).rational();
    return read;
  }));
  if (!region) sides.fail(region.error().message);
  return std::move(region).value();
}

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

template <std::size_t N>
std::array<int, N> read_ascending(const JsonNode& node, std::size_t surfaces) {
  node.of_size(static_cast<int>(N));
  std::array<int, N> read;
  for (std::size_t k = 0; k < N; ++k) {
    read[k] = node.item(static_cast<int>(k)).index(surfaces);
    if (k > 0 && read[k] <= read[k - 1]) node.fail("expected surfaces in ascending order");
  }
  return read;
}

/// Two indices, the second of which may be missing.
std::array<int, 2> read_one_or_two(const JsonNode& node, std::size_t size) {
  node.of_size(2);
  return {node.item(0).index(size), node.item(1).index_or_null(size)};
}

std::vector<int> read_tokens(const JsonNode& node, std::size_t items) {
  return node.map([&](const JsonNode& token) {
    return static_cast<int>(
        token.integer(cover::kUnresolved, static_cast<std::int64_t>(items) - 1));
  });
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
  const JsonNode polygon = node.member("polygon");
  auto region = make_region(polygon.map([](const JsonNode& corner) {
    corner.of_size(2);
    return RationalPoint<2>{corner.item(0).rational(), corner.item(1).rational()};
  }));
  if (!region) polygon.fail(region.error().message);
  facet.polygon = std::move(region).value();
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
  critical.tokens = read_tokens(node.member("tokens"), critical.points.size());
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

/// Children come after their parents and each has one parent, so that walks down the history end.
std::vector<Split> read_history(const JsonNode& node, std::size_t planes, std::size_t cells) {
  const int count = node.size();
  std::vector<bool> node_seen(count), cell_seen(cells);
  std::vector<Split> history(count);
  for (int k = 0; k < count; ++k) {
    const JsonNode split = node.item(k);
    split.of_size(3);
    history[k].line = split.item(0).index(planes);
    const auto read_child = [&](const JsonNode& child) {
      const int index =
          static_cast<int>(child.integer(-static_cast<std::int64_t>(cells), count - 1));
      if (index >= 0 && index <= k) child.fail("a cut refers to one that is not after it");
      std::vector<bool>& seen = index >= 0 ? node_seen : cell_seen;
      const std::size_t slot = index >= 0 ? index : ~index;
      if (seen[slot]) child.fail("a piece has two parents");
      seen[slot] = true;
      return index;
    };
    history[k].negative = read_child(split.item(1));
    history[k].positive = read_child(split.item(2));
  }
  return history;
}

std::vector<UnresolvedInSpace> read_unresolved(const JsonNode& node, const SurfaceEncasement& e) {
  return node.map([&](const JsonNode& item) {
    UnresolvedInSpace place;
    place.kind = item.member("kind").one_of(kUnresolvedKinds);
    const JsonNode box = item.member("box");
    place.has_box = !box.is_null();
    if (place.has_box) place.box = box.box<3>();
    place.surfaces =
        item.member("surfaces")
            .indices(names_input_curves(place.kind) ? e.input.size() : e.surfaces.size());
    place.cells = item.member("cells").indices(e.cells.size());
    place.proved = item.member("proved").boolean();
    place.reason = item.member("reason").text();
    return place;
  });
}

SpaceStatistics read_statistics(const JsonNode& node) {
  SpaceStatistics s;
  const JsonNode decisions = node.member("decisions");
  s.decisions.by_double = decisions.member("by_double").count();
  s.decisions.by_mpfr = decisions.member("by_mpfr").count();
  s.decisions.by_exact = decisions.member("by_exact").count();
  s.decisions.undecided = decisions.member("undecided").count();
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
  e.region = read_region(root.member("region"));
  e.region_used = read_region(root.member("region_used"));
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
                            read_tokens(item.member("tokens"), e.triple_points.size())};
  });
  e.critical_points = covers.member("critical").map([&](const JsonNode& item) {
    return read_critical(item, surfaces);
  });
  read_certificates(root.member("certificates"), &e);
  e.cells = root.member("cells").map([&](const JsonNode& item) { return read_cell(item, e); });
  e.history = read_history(root.member("history"), e.planes.size(), counts.cells);
  e.degenerate = read_unresolved(root.member("degenerate"), e);
  e.undecided = read_unresolved(root.member("undecided"), e);
  e.statistics = read_statistics(root.member("statistics"));
  if (root.has("arrangement")) stored.arrangement = read_arrangement(root.member("arrangement"), e);
  return stored;
}

}  // namespace encase
