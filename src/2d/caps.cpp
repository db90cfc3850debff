// SPDX-License-Identifier: MIT
#include "encase/caps.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "2d/caps_graph.hpp"
#include "2d/caps_tree.hpp"
#include "2d/curve_bounds.hpp"
#include "common/input_functions.hpp"
#include "common/run_clock.hpp"

namespace encase {
namespace {

Error bad_input(const std::string& message) { return {Error::Code::BadInput, message}; }

/// Whether the region is its bounding box, but for the rounding of that.
bool is_rectangle(const Region& region) {
  if (region.plane || region.side_count() != 4) return false;
  for (int k = 0; k < 4; ++k) {
    const auto &a = region.corners[static_cast<std::size_t>(k)],
               &b = region.corners[static_cast<std::size_t>((k + 1) % 4)];
    if (a[0] != b[0] && a[1] != b[1]) return false;
  }
  return true;
}

Status check_input(const std::vector<NamedCurve>& curves, const Region& region,
                   const CapsOptions& options) {
  if (curves.empty()) return bad_input("there are no curves");
  if (!is_rectangle(region))
    return bad_input(
        "CAPS subdivides a rectangle along the axes: give the region as \"xmin xmax ymin ymax\"");
  const Box<2> box = region.bounding_box();
  if (!std::isfinite(box.width(0)) || !std::isfinite(box.width(1)))
    return bad_input("the region is too large");
  for (const NamedCurve& curve : curves)
    if (Status bad = check_function(curve, box)) return bad;
  if (!(options.epsilon > 0) || !std::isfinite(options.epsilon))
    return bad_input("epsilon must be a positive number");
  if (options.epsilon > box.width(0) || options.epsilon > box.width(1))
    return bad_input("epsilon is larger than the region");
  if (!(options.max_seconds > 0) || options.max_boxes < 1)
    return bad_input("the limits on boxes and seconds must be positive");
  return {};
}

/// What keeps the graph from being proved.
CapsObstacles obstacles_of(const CapsResult& r) {
  CapsObstacles obstacles;
  for (const CapsLeaf& leaf : r.leaves) {
    const auto count = r.curve_sets[static_cast<std::size_t>(leaf.curves)].size();
    obstacles.unexamined_leaves += count == 1 && leaf.graph_axis < 0;
    obstacles.indeterminate_leaves += count > 1 && leaf.label == CapsLabel::Indeterminate;
  }
  for (const CapsVertex& vertex : r.vertices)
    obstacles.open_vertices +=
        vertex.kind != CapsVertex::Kind::Crossing && vertex.kind != CapsVertex::Kind::Boundary;
  for (const CapsEdge& edge : r.edges) obstacles.open_edges += !edge.proved;
  return obstacles;
}

}  // namespace

Result<CapsResult> caps(const std::vector<NamedCurve>& curves, const Region& region,
                        const CapsOptions& options) {
  if (const Status status = check_input(curves, region, options)) return *status;
  RunClock clock;
  const char* stage = "subdividing";
  const std::function<bool()> stop = [&] {
    return clock.exceeds(options.max_seconds) || (options.progress && !options.progress(stage, -1));
  };

  // 1. Inclusion functions (section 2 of the paper).
  std::vector<CurveBounds> bounds;
  for (const NamedCurve& curve : curves) bounds.emplace_back(curve.function);

  // 2. The quadtree: `classify`, box by box.
  CapsTree tree = subdivide(bounds, region.bounding_box(), options, stop);
  CapsResult result;
  result.tree_seconds = clock.seconds();

  // 3. Region labelling and region adjacency.
  result.regions = label_regions(tree, options.self_crossings);

  // 4. The arrangement graph.
  stage = "making the graph";
  CapsGraph graph = make_graph(tree, result.regions, bounds, options.polylines, stop);

  // 5. How good it is.
  result.epsilon = options.epsilon;
  result.delta = 2 * options.epsilon;
  result.self_crossings = options.self_crossings;
  result.curves = curves;
  result.box = tree.box;
  result.tokens = tree.tokens();
  result.nodes = static_cast<std::int64_t>(tree.nodes.size());
  result.leaves = std::move(tree.leaves);
  result.curve_sets = std::move(tree.curve_sets);
  result.vertices = std::move(graph.vertices);
  result.edges = std::move(graph.edges);
  for (const CurveBounds& b : bounds) result.evaluations += b.evaluations();
  result.obstacles = obstacles_of(result);
  result.answer = CapsClass::Exact;
  if (result.obstacles.any()) result.answer = CapsClass::DeltaWeak;
  if (tree.cut_short || graph.cut_short) result.answer = CapsClass::Undecided;
  result.seconds = clock.seconds();
  return result;
}

}  // namespace encase
