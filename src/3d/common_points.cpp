// SPDX-License-Identifier: MIT
#include "encase/common_points.hpp"

#include <algorithm>
#include <cfenv>
#include <optional>
#include <string>
#include <utility>

#include "3d/solid_sides.hpp"
#include "common/input_functions.hpp"
#include "common/isolate_roots.hpp"
#include "common/run_clock.hpp"

namespace encase {
namespace {

/// A place made of unresolved leaves.
struct Place {
  Box<3> box;
  bool exhausted;  ///< all were halved as far as they may be
};

/// The hulls of the unresolved leaves under each node `depth` halvings below the root.
std::vector<Place> places_at(const RootIsolation<3>& isolation, int depth, double smallest) {
  struct Node {
    Box<3> box;
    int depth;
    int place;  ///< of the node at `depth` above it, or -1: there is none yet
  };
  std::vector<Place> places;
  std::vector<Node> stack{{isolation.root_box, 0, -1}};
  int ancestor = 0;  // numbers of nodes at `depth`
  std::vector<int> of_ancestor;
  for (const int token : isolation.tokens) {
    Node node = stack.back();
    stack.pop_back();
    if (node.depth == depth) node.place = ancestor++;
    if (token <= cover::kSplitX && token >= cover::kSplitZ) {
      Node lower = node, upper = node;
      halve_box(node.box, cover::kSplitX - token, &lower.box, &upper.box);
      lower.depth = upper.depth = node.depth + 1;
      stack.push_back(upper);
      stack.push_back(lower);
      continue;
    }
    if (token != cover::kUnresolved) continue;
    bool exhausted = false;
    for (int i = 0; i < 3; ++i)
      exhausted = exhausted || node.box.width(i) <= smallest * isolation.root_box.width(i);
    if (node.place >= 0 && !of_ancestor.empty() && of_ancestor.back() == node.place) {
      places.back().box = hull<3>(places.back().box, node.box);
      places.back().exhausted = places.back().exhausted && exhausted;
    } else {
      places.push_back({node.box, exhausted});
      of_ancestor.push_back(node.place);
    }
  }
  return places;
}

/// Boxes around the unresolved leaves that do not meet; not many.
std::vector<Place> join_unresolved(const RootIsolation<3>& isolation, double smallest) {
  constexpr std::size_t kMost = 256;
  int depth = 3 * 64;
  std::vector<Place> places = places_at(isolation, depth, smallest);
  while (places.size() > kMost && depth > 0) {
    depth = depth > 8 ? depth * 3 / 4 : depth - 1;
    places = places_at(isolation, depth, smallest);
  }
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t m = 0; m < k; ++m) {
      if (!places[m].box.meets(places[k].box)) continue;
      places[m].box = hull<3>(places[m].box, places[k].box);
      places[m].exhausted = places[m].exhausted && places[k].exhausted;
      places.erase(places.begin() + static_cast<std::ptrdiff_t>(k));
      // The larger one may meet others.
      k = 0;
      break;
    }
  return places;
}

/// Adds a point, and where it lies if that is proved.
void add_point(const Box<3>& box, bool rounded, CommonPoints* result) {
  CommonPoint c;
  c.box = box;
  c.point = box.center();
  c.rounded = rounded;
  const std::array<const Function<3>*, 3> functions{
      &result->surfaces[0].function, &result->surfaces[1].function, &result->surfaces[2].function};
  const auto location =
      location_of(functions, rounded ? neighbours_of(c.point) : box, c.point, result->region);
  if (location)
    c.location = *location;
  else
    result->undecided.push_back(box);
  result->points.push_back(c);
}

}  // namespace

Result<CommonPoints> common_points(const std::array<NamedSurface, 3>& surfaces,
                                   const Polyhedron& region, const CommonPointsOptions& options) {
  if (std::fegetround() != FE_TONEAREST)
    return Error{Error::Code::BadInput,
                 "the processor must round to nearest while common points are sought; call "
                 "std::fesetround(FE_TONEAREST)"};
  for (const NamedSurface& surface : surfaces)
    if (Status bad = check_function(surface, region.bounding_box())) return *bad;
  RunClock clock;
  CommonPoints result;
  result.surfaces = surfaces;
  result.region = region;
  std::vector<FilteredFunction<3>> functions;
  for (const NamedSurface& surface : surfaces) functions.emplace_back(surface.function);
  const System<3> system{&functions[0], &functions[1], &functions[2]};
  std::vector<Plane> sides;
  for (const HalfSpace& side : region.sides) sides.push_back(Plane::from_rationals(side));
  SubdivisionLimits limits;
  limits.max_boxes = std::max(1, options.max_boxes);
  limits.stop = [&] { return clock.exceeds(options.max_seconds); };
  Kernel kernel;
  kernel.max_bits = options.max_bits;
  kernel.start_bits = options.start_bits;
  RootIsolation<3> isolation =
      isolate_roots<3>(system, region.bounding_box(), sides, limits, kernel);

  for (const Place& place : join_unresolved(isolation, limits.smallest))
    (place.exhausted ? result.degenerate : result.undecided).push_back(place.box);
  for (std::size_t k = 0; k < isolation.roots.size(); ++k)
    add_point(isolation.roots[k], isolation.rounded[k], &result);
  result.outcome = !result.undecided.empty()    ? Outcome::Undecided
                   : !result.degenerate.empty() ? Outcome::Degenerate
                                                : Outcome::Certified;
  result.root = isolation.root_box;
  result.tokens = std::move(isolation.tokens);
  result.boxes = isolation.boxes;
  result.seconds = clock.seconds();
  return result;
}

}  // namespace encase
