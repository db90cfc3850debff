// SPDX-License-Identifier: MIT
#include "io/surface_json.hpp"

namespace encase {

void put_arrangement(JsonWriter& w, const SpaceArrangement& a) {
  w.raw("{\"components\":");
  w.lines(a.components, [&](const SpaceArrangement::Component& component) {
    w.raw("{");
    w.field("surface", component.surface);
    w.field("closed", component.closed);
    w.field("euler", component.euler);
    w.key("patches");
    w.list(component.patches, [&](const SpaceArrangement::PatchOfCell& patch) {
      w.put(std::array<int, 2>{patch.cell, patch.patch});
    });
    w.raw("}");
  });
  w.raw(",\n\"faces\":");
  w.lines(a.faces, [&](const SpaceArrangement::Face& face) {
    w.raw("{");
    w.field("surface", face.surface);
    w.field("component", face.component);
    w.field("regions", face.regions);
    w.raw("}");
  });
  w.raw(",\n\"regions\":");
  w.lines(a.regions, [&](const SpaceArrangement::Region& region) {
    w.raw("{");
    w.key("signs"), w.list(region.signs);
    w.field("faces", region.faces);
    w.field("touches_boundary", region.touches_boundary);
    w.field("cells", region.cells);
    w.raw("}");
  });
  w.raw(",\n\"facets\":");
  w.list(a.region_of_facet, [&](const std::vector<int>& regions) {
    w.list(regions, [&](int region) { w.put_index(region); });
  });
  w.raw("}");
}

SpaceArrangement read_arrangement(const JsonNode& node, const SurfaceEncasement& e) {
  SpaceArrangement a;
  a.components = node.member("components").map([&](const JsonNode& item) {
    SpaceArrangement::Component component;
    component.surface = item.member("surface").index(e.surfaces.size());
    component.closed = item.member("closed").boolean();
    component.euler = static_cast<int>(item.member("euler").integer(-1000000000, 1000000000));
    component.patches = item.member("patches").map([&](const JsonNode& patch) {
      patch.of_size(2);
      const int cell = patch.item(0).index(e.cells.size());
      return SpaceArrangement::PatchOfCell{cell, patch.item(1).index(e.cells[cell].patches.size())};
    });
    return component;
  });
  const auto regions = static_cast<std::size_t>(node.member("regions").size());
  a.faces = node.member("faces").map([&](const JsonNode& item) {
    const JsonNode beside = item.member("regions").of_size(2);
    return SpaceArrangement::Face{item.member("surface").index(e.surfaces.size()),
                                  item.member("component").index(a.components.size()),
                                  {beside.item(0).index(regions), beside.item(1).index(regions)}};
  });
  a.regions = node.member("regions").map([&](const JsonNode& item) {
    SpaceArrangement::Region region;
    const JsonNode signs = item.member("signs").of_size(static_cast<int>(e.surfaces.size()));
    region.signs = signs.map(
        [](const JsonNode& sign) { return sign_of(static_cast<int>(sign.integer(-1, 1))); });
    region.faces = item.member("faces").indices(a.faces.size());
    region.touches_boundary = item.member("touches_boundary").boolean();
    region.cells = item.member("cells").indices(e.cells.size());
    return region;
  });
  const JsonNode facets = node.member("facets").of_size(static_cast<int>(e.facets.size()));
  a.region_of_facet = facets.map([&](const JsonNode& facet) {
    return facet.map([&](const JsonNode& region) { return region.index_or_null(regions); });
  });
  return a;
}

}  // namespace encase
