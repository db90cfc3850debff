// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "3d/solid_sides.hpp"
#include "3d/verify_isolation.hpp"
#include "common/interval.hpp"
#include "encase/common_points.hpp"

namespace encase {
namespace {

/// The smallest box with double bounds around the corners of a region.
Box<3> box_around(const Polyhedron& region) {
  Box<3> box;
  for (std::size_t k = 0; k < region.corners.size(); ++k)
    for (std::size_t i = 0; i < 3; ++i) {
      const Interval at = Interval::enclose(region.corners[k][i]);
      box.lo[i] = k == 0 ? at.lo : std::min(box.lo[i], at.lo);
      box.hi[i] = k == 0 ? at.hi : std::max(box.hi[i], at.hi);
    }
  return box;
}

}  // namespace

Verification verify(const CommonPoints& points, const VerifyOptions& options) {
  Verification result;
  const auto require = [&](bool proved, const std::string& objection) {
    if (proved)
      ++result.claims;
    else
      result.objections.push_back(objection);
    return proved;
  };
  // The corners are those of the sides.
  const auto region = make_polyhedron(points.region.sides);
  if (!require(region.ok() && region.value().corners == points.region.corners,
               "The corners of the region are not those that its sides make."))
    return result;

  RootIsolation<3> isolation;
  isolation.root_box = points.root;
  isolation.tokens = points.tokens;
  isolation.unresolved = points.degenerate;
  isolation.unresolved.insert(isolation.unresolved.end(), points.undecided.begin(),
                              points.undecided.end());
  for (const CommonPoint& c : points.points) {
    isolation.roots.push_back(c.box);
    isolation.rounded.push_back(c.rounded);
  }
  std::vector<FilteredFunction<3>> functions;
  for (const NamedSurface& surface : points.surfaces) functions.emplace_back(surface.function);
  const System<3> system{&functions[0], &functions[1], &functions[2]};
  Verification proof =
      verify_isolation(system, box_around(points.region), points.region.sides, isolation, options);
  result.claims += proof.claims;
  std::move(proof.objections.begin(), proof.objections.end(),
            std::back_inserter(result.objections));
  if (!result.ok()) return result;

  const std::array<const Function<3>*, 3> surfaces{
      &points.surfaces[0].function, &points.surfaces[1].function, &points.surfaces[2].function};
  for (std::size_t k = 0; k < points.points.size(); ++k) {
    const CommonPoint& c = points.points[k];
    const std::string name = "Point " + std::to_string(k);
    require(c.point == c.box.center(), name + " is not the centre of its box.");
    const auto location =
        location_of(surfaces, c.rounded ? neighbours_of(c.point) : c.box, c.point, points.region);
    const bool open = std::find(points.undecided.begin(), points.undecided.end(), c.box) !=
                      points.undecided.end();
    require(location ? *location == c.location : open,
            "The location of point " + std::to_string(k) + " in the region is not proved.");
  }
  const Outcome outcome = !points.undecided.empty()    ? Outcome::Undecided
                          : !points.degenerate.empty() ? Outcome::Degenerate
                                                       : Outcome::Certified;
  require(points.outcome == outcome, "The outcome is not what the lists make it.");
  return result;
}

}  // namespace encase
