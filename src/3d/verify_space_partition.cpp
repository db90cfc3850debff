// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>

#include "3d/arc_direction.hpp"
#include "3d/certificate_tests.hpp"
#include "3d/solid_sides.hpp"
#include "3d/verify_isolation.hpp"
#include "3d/verify_space_claims.hpp"
#include "common/subdivision.hpp"

namespace encase::verification {

namespace {

using Vector = RationalPoint<3>;

Rational at(const HalfSpace& side, const Vector& p) {
  return side[0] * p[0] + side[1] * p[1] + side[2] * p[2] + side[3];
}

Rational squared_distance(const Vector& a, const Vector& b) {
  Rational sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

/// The largest and the smallest value of a half space's function on a box, exactly.
std::array<Rational, 2> range(const HalfSpace& side, const Box<3>& box) {
  Rational lowest = side[3], highest = side[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational lo = side[i] * Rational(box.lo[i]), hi = side[i] * Rational(box.hi[i]);
    lowest += std::min(lo, hi);
    highest += std::max(lo, hi);
  }
  return {lowest, highest};
}

/// The corners are those that the sides have.
bool has_its_corners(const Polyhedron& p) {
  const auto same = make_polyhedron(p.sides);
  return same && same.value().corners == p.corners;
}

/// Whether the polyhedron is its bounding box, with sides as make_box orders them.
bool is_box(const Polyhedron& p, const Box<3>& root) {
  RationalPoint<3> lo, hi;
  for (std::size_t i = 0; i < 3; ++i) {
    lo[i] = Rational(root.lo[i]);
    hi[i] = Rational(root.hi[i]);
  }
  const auto box = make_box(lo, hi);
  return box && box.value().sides == p.sides;
}

}  // namespace

bool check_space_regions(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  const Polyhedron &asked = e.region, &used = e.region_used;
  if (!claims.require(has_its_corners(asked), "The region is not the polyhedron of its sides.") ||
      !claims.require(has_its_corners(used), "The region used is not the polyhedron of its sides."))
    return false;
  if (used.corners != asked.corners) {
    bool larger = true, close = true;
    Rational diameter = 0;
    for (const Vector& corner : asked.corners) {
      for (const HalfSpace& side : used.sides) larger = larger && at(side, corner) <= 0;
      for (const Vector& other : asked.corners)
        diameter = std::max(diameter, squared_distance(corner, other));
    }
    claims.require(larger, "The region used does not contain the region.");
    // The distance from a convex set is a convex function, largest at corners.
    const Rational allowed = diameter * Rational(0x1p-60);
    for (const Vector& corner : used.corners)
      close = close &&
              std::any_of(asked.corners.begin(), asked.corners.end(),
                          [&](const Vector& c) { return squared_distance(corner, c) <= allowed; });
    claims.require(close, "The region used exceeds the region by more than 2^-30 of its diameter.");
  }
  bool sides = true;
  for (std::size_t k = 0; k < used.sides.size(); ++k)
    sides = claims.require(e.planes[k].exact() == used.sides[k], "Plane ", k, " is not side ", k,
                           " of the region used.") &&
            sides;
  claims.region.polyhedron = used;
  claims.root = used.bounding_box();
  claims.region.is_box = is_box(used, claims.root);
  return sides;
}

namespace {

/// Whether the part of a box in the region has an interior and lies in another box.
bool holds_its_part(const Polyhedron& region, const Box<3>& leaf, const Box<3>& around) {
  std::vector<HalfSpace> sides;
  for (const HalfSpace& side : region.sides) {
    const auto [lowest, highest] = range(side, leaf);
    if (lowest >= 0) return false;
    if (highest > 0) sides.push_back(side);
  }
  if (sides.empty()) return around.contains(leaf);
  for (std::size_t i = 0; i < 3; ++i) {
    HalfSpace below{0, 0, 0, Rational(leaf.lo[i])}, above{0, 0, 0, -Rational(leaf.hi[i])};
    below[i] = -1;
    above[i] = 1;
    sides.push_back(std::move(below));
    sides.push_back(std::move(above));
  }
  const auto part = make_polyhedron(std::move(sides));
  if (!part) return false;
  for (const Vector& corner : part.value().corners)
    for (std::size_t i = 0; i < 3; ++i)
      if (corner[i] < Rational(around.lo[i]) || corner[i] > Rational(around.hi[i])) return false;
  return true;
}

}  // namespace

bool replay_space_history(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  claims.leaf_box.assign(e.cells.size(), {});
  std::vector<int> visits(e.history.size(), 0), leaves(e.cells.size(), 0);
  struct Node {
    int index;
    int depth;
    Box<3> box;
  };
  std::vector<Node> stack{{e.history.empty() ? ~0 : 0, 0, claims.root}};
  bool cuts = true, depths = true;
  while (!stack.empty()) {
    const Node node = stack.back();
    stack.pop_back();
    if (node.index < 0) {
      const auto cell = static_cast<std::size_t>(~node.index);
      if (cell >= e.cells.size() || ++leaves[cell] > 1)
        return claims.require(false, "Cell ", cell,
                              " is missing or in several leaves of the history.");
      claims.leaf_box[cell] = node.box;
      depths = depths && e.cells[cell].depth == node.depth;
      continue;
    }
    const auto k = static_cast<std::size_t>(node.index);
    if (++visits[k] > 1)
      return claims.require(false, "Split ", k, " is in several places of the history.");
    const Split& split = e.history[k];
    const Plane& plane = e.planes[static_cast<std::size_t>(split.line)];
    std::size_t axis = 0;
    while (plane.normal[axis] == 0) ++axis;
    const bool along = plane.normal[axis] > 0;
    const double cut = along ? -plane.offset : plane.offset;
    cuts = cuts && node.box.lo[axis] < cut && cut < node.box.hi[axis];
    Node lower{along ? split.negative : split.positive, node.depth + 1, node.box},
        upper{along ? split.positive : split.negative, node.depth + 1, node.box};
    lower.box.hi[axis] = upper.box.lo[axis] = cut;
    stack.push_back(lower);
    stack.push_back(upper);
  }
  const auto once = [](int n) { return n == 1; };
  const bool whole = std::all_of(visits.begin(), visits.end(), once) &&
                     std::all_of(leaves.begin(), leaves.end(), once);
  claims.require(depths, "The cells' depths are not those of the history.");
  // Where all leaves have an interior in the region, every split cuts it properly.
  bool parts = cuts;
  for (std::size_t k = 0; k < e.cells.size() && parts; ++k)
    parts = claims.require(holds_its_part(e.region_used, claims.leaf_box[k], e.cells[k].box),
                           "Cell ", k, " is empty or exceeds its box.");
  return claims.require(whole && cuts,
                        "The history does not cut the region used into the cells.") &&
         parts;
}

void check_certificates(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  for (std::size_t k = 0; k < e.absence_certificates.size() && !claims.full(); ++k) {
    const AbsenceCertificate& c = e.absence_certificates[k];
    claims.require(holds(c, claims.surface(c.surface), claims.kernel), "Absence certificate ", k,
                   " is not proved.");
  }
  for (std::size_t k = 0; k < e.graph_certificates.size() && !claims.full(); ++k) {
    const GraphCertificate& c = e.graph_certificates[k];
    claims.require(holds(c, claims.surface(c.surface), claims.kernel), "Graph certificate ", k,
                   " is not proved.");
  }
  for (std::size_t k = 0; k < e.pair_certificates.size() && !claims.full(); ++k) {
    const PairCertificate& c = e.pair_certificates[k];
    if (c.kind != PairCertificate::Kind::Listed) {
      claims.require(
          holds(c, claims.surface(c.surfaces[0]), claims.surface(c.surfaces[1]), claims.kernel),
          "Pair certificate ", k, " is not proved.");
      continue;
    }
    const CurveCriticalPoints& list = e.critical_points[static_cast<std::size_t>(c.critical)];
    bool clear = list.surfaces == c.surfaces && list.direction == c.direction;
    for (const Box<3>& point : list.points) clear = clear && !point.meets(c.box);
    for (const Box<3>& open : leaves<3>(list.root, list.tokens, cover::kUnresolved))
      clear = clear && !open.meets(c.box);
    claims.require(clear, "A critical point may lie in the box of pair certificate ", k, ".");
  }
}

namespace {

void check_isolation(SpaceClaims& claims, const std::string& name, const System<3>& system,
                     RootIsolation<3> isolation) {
  isolation.unresolved = leaves<3>(isolation.root_box, isolation.tokens, cover::kUnresolved);
  claims.include(name, verify_isolation(system, claims.root, claims.region.polyhedron.sides,
                                        isolation, claims.options));
}

void check_critical_points(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  for (std::size_t k = 0; k < e.critical_points.size() && !claims.full(); ++k) {
    const CurveCriticalPoints& list = e.critical_points[k];
    const auto [f, g] = list.surfaces;
    const auto direction =
        arc_direction(e.surfaces[static_cast<std::size_t>(f)].function,
                      e.surfaces[static_cast<std::size_t>(g)].function, list.direction);
    if (!claims.require(direction.has_value(), "List ", k,
                        " of critical points is of surfaces that have none."))
      continue;
    const FilteredFunction<3> along(*direction);
    RootIsolation<3> isolation;
    isolation.roots = list.points;
    isolation.root_box = list.root;
    isolation.tokens = list.tokens;
    check_isolation(claims, "Critical points " + std::to_string(k),
                    {&claims.surface(f), &claims.surface(g), &along}, std::move(isolation));
  }
}

/// Whether the box lies in the interior of a cell.
bool inside(const SpaceClaims& claims, const Box<3>& box, std::size_t cell) {
  const Box<3>& leaf = claims.leaf_box[cell];
  for (std::size_t i = 0; i < 3; ++i)
    if (!(leaf.lo[i] < box.lo[i] && box.hi[i] < leaf.hi[i])) return false;
  return std::all_of(claims.region.polyhedron.sides.begin(), claims.region.polyhedron.sides.end(),
                     [&](const HalfSpace& side) { return range(side, box)[1] < 0; });
}

void check_location(SpaceClaims& claims, std::size_t k) {
  const TriplePoint& point = claims.result.triple_points[k];
  std::array<const Function<3>*, 3> functions;
  for (std::size_t i = 0; i < 3; ++i)
    functions[i] = &claims.result.surfaces[static_cast<std::size_t>(point.surfaces[i])].function;
  claims.require(point.location ==
                     location_of(functions, point.rounded ? neighbours_of(point.point) : point.box,
                                 point.point, claims.result.region),
                 "The location of triple point ", k, " in the region is not proved.");
}

void check_triple_points(SpaceClaims& claims) {
  const SurfaceEncasement& e = claims.result;
  std::map<std::array<int, 3>, std::vector<int>> points;
  for (std::size_t k = 0; k < e.triple_points.size(); ++k)
    points[e.triple_points[k].surfaces].push_back(static_cast<int>(k));
  std::map<std::array<int, 3>, int> covers;
  for (std::size_t k = 0; k < e.triple_point_covers.size() && !claims.full(); ++k) {
    const TriplePointCover& cover = e.triple_point_covers[k];
    const std::vector<int>& mine = points[cover.surfaces];
    claims.require(++covers[cover.surfaces] == 1, "Triple point cover ", k,
                   " is one of several of the same surfaces.");
    RootIsolation<3> isolation;
    isolation.root_box = cover.root;
    bool own = true;
    for (const int token : cover.tokens) {
      int local = token;
      if (token >= 0) {
        const auto found = std::find(mine.begin(), mine.end(), token);
        own = own && found != mine.end();
        local = static_cast<int>(found - mine.begin());
      }
      isolation.tokens.push_back(local);
    }
    if (!claims.require(own, "Triple point cover ", k, " names points of other surfaces."))
      continue;
    for (const int point : mine) {
      isolation.roots.push_back(e.triple_points[static_cast<std::size_t>(point)].box);
      isolation.rounded.push_back(e.triple_points[static_cast<std::size_t>(point)].rounded);
    }
    const auto [f, g, h] = cover.surfaces;
    check_isolation(claims, "Triple point cover " + std::to_string(k),
                    {&claims.surface(f), &claims.surface(g), &claims.surface(h)},
                    std::move(isolation));
  }
  for (std::size_t k = 0; k < e.triple_points.size() && !claims.full(); ++k) {
    const TriplePoint& point = e.triple_points[k];
    claims.require(covers.count(point.surfaces) == 1, "Triple point ", k, " has no cover.");
    claims.require(point.point == point.box.center(), "Triple point ", k,
                   " is not the centre of its box.");
    check_location(claims, k);
    if (point.cell >= 0) {
      claims.require(inside(claims, point.box, static_cast<std::size_t>(point.cell)),
                     "Triple point ", k, " is not in the interior of its cell.");
      continue;
    }
    const auto& sides = claims.region.polyhedron.sides;
    const bool outside = std::any_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
      return range(side, point.box)[0] > 0;
    });
    bool lost = false;
    for (std::size_t c = 0; c < e.cells.size(); ++c)
      lost = lost || (certified(e.cells[c]) && claims.leaf_box[c].meets(point.box));
    claims.require(outside || !lost, "Triple point ", k, " names no cell, but may lie in one.");
  }
}

}  // namespace

void check_point_lists(SpaceClaims& claims) {
  check_critical_points(claims);
  check_triple_points(claims);
}

}  // namespace encase::verification
