// SPDX-License-Identifier: MIT
#include <algorithm>

#include "encase/intersection_curves.hpp"
#include "encase/surface_result_json.hpp"
#include "encase/surface_topology.hpp"
#include "io/json_writer.hpp"
#include "io/names.hpp"

namespace encase {

std::string summary_json(const SurfaceEncasement& e, const SpaceArrangement* arrangement) {
  const auto curves = intersection_curves(e);
  const auto closed = std::count_if(curves.begin(), curves.end(),
                                    [](const IntersectionCurve& c) { return c.closed; });
  const auto shapes = surface_topology(e);
  JsonWriter w;
  const auto per_surface = [&](const char* key, int SurfaceTopology::*count) {
    w.key(key);
    w.list(shapes, [&](const SurfaceTopology& shape) {
      if (shape.complete)
        w.put(shape.*count);
      else
        w.raw("null");
    });
  };
  w.raw("{");
  w.field("status", name_of(kOutcomes, e.outcome));
  w.field("surfaces", static_cast<int>(e.surfaces.size()));
  w.field("points", static_cast<int>(e.triple_points.size()));
  w.field("intersection_curves", static_cast<int>(curves.size()));
  w.field("closed_curves", static_cast<std::int64_t>(closed));
  w.field("cells", static_cast<int>(e.cells.size()));
  if (arrangement) w.field("regions", static_cast<int>(arrangement->regions.size()));
  per_surface("euler", &SurfaceTopology::euler);
  per_surface("components", &SurfaceTopology::components);
  w.field("seconds", e.seconds);
  w.raw("}");
  return w.take();
}

}  // namespace encase
