// SPDX-License-Identifier: MIT
#include "3d/facet_places.hpp"

#include <algorithm>
#include <utility>

#include "common/interval.hpp"
#include "common/numerator.hpp"

namespace encase {

namespace {

/// A convex polygon; side k runs from corner k to the next one, in a plane.
struct NamedPolygon {
  std::vector<RationalPoint<2>> corners;
  std::vector<int> planes;

  void add(RationalPoint<2> corner, int plane) {
    corners.push_back(std::move(corner));
    planes.push_back(plane);
  }
};

/// The part where a u + b v + c <= 0; the new side lies in `plane`. A side that lies on the line
/// keeps its plane if it has one.
NamedPolygon clip(const NamedPolygon& polygon, const std::array<Rational, 3>& line, int plane) {
  NamedPolygon clipped;
  const std::size_t n = polygon.corners.size();
  std::vector<Rational> value;
  for (const RationalPoint<2>& p : polygon.corners)
    value.emplace_back(line[0] * p[0] + line[1] * p[1] + line[2]);
  for (std::size_t k = 0; k < n; ++k) {
    const RationalPoint<2>&p = polygon.corners[k], &q = polygon.corners[(k + 1) % n];
    const Rational &at_p = value[k], &at_q = value[(k + 1) % n];
    const int side = polygon.planes[k];
    if (at_p == 0 && at_q == 0)
      clipped.add(p, side < 0 ? plane : side);
    else if (at_p == 0)
      clipped.add(p, at_q > 0 ? plane : side);
    else if (at_p < 0)
      clipped.add(p, side);
    if (sgn(at_p) * sgn(at_q) >= 0) continue;
    const Rational t = at_p / (at_p - at_q);
    clipped.add({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])}, at_p < 0 ? plane : side);
  }
  // A line through a corner leaves a point.
  return clipped.corners.size() < 3 ? NamedPolygon{} : clipped;
}

/// A half space on a plane.
std::array<Rational, 3> restrict(const HalfSpace& half_space, const PlaneChart& chart) {
  const auto [u, v] = chart.axes();
  const int solved = 3 - u - v;
  const std::array<Rational, 4>& plane = chart.plane();
  const Rational slope = half_space[solved] / plane[solved];
  return {half_space[u] - slope * plane[u], half_space[v] - slope * plane[v],
          half_space[3] - slope * plane[3]};
}

/// The part of a box in a plane without regard to the third coordinate.
NamedPolygon rectangle(const Box<3>& box, const std::array<int, 6>& bounds,
                       const std::array<int, 2>& axes) {
  const auto [u, v] = axes;
  const auto bound = [&](int axis, int upper) {
    return bounds[static_cast<std::size_t>(2 * axis + upper)];
  };
  const Rational u0(box.lo[u]), u1(box.hi[u]), v0(box.lo[v]), v1(box.hi[v]);
  NamedPolygon polygon;
  polygon.add({u0, v0}, bound(v, 0));
  polygon.add({u1, v0}, bound(u, 1));
  polygon.add({u1, v1}, bound(v, 1));
  polygon.add({u0, v1}, bound(u, 0));
  return polygon;
}

HalfSpace bound_of(const Box<3>& box, int axis, bool upper) {
  HalfSpace half_space{0, 0, 0, upper ? Rational(-box.hi[axis]) : Rational(box.lo[axis])};
  half_space[axis] = upper ? 1 : -1;
  return half_space;
}

/// Whether a whole box is proved to lie in the interior of a half space; doubles only.
bool within(const Box<3>& box, const HalfSpace& half_space) {
  Interval value = Interval::enclose(half_space[3]);
  for (int i = 0; i < 3; ++i)
    value = value + Interval::enclose(half_space[i]) * Interval(box.lo[i], box.hi[i]);
  return value.hi < 0;
}

class PlaceFinder {
 public:
  PlaceFinder(const SolidRegion& region, PlaneCharts& charts) : region_(region), charts_(charts) {}

  void between(const LeafContact& contact) {
    const PlaneChart& chart = charts_.of(contact.plane);
    NamedPolygon polygon = rectangle(contact.rectangle, contact.bounds, chart.axes());
    if (!region_.is_box) clip_by_sides(contact.rectangle, chart, -1, &polygon);
    add(contact.plane, contact.leaves, contact.rectangle, std::move(polygon));
  }

  /// Where a leaf meets a side of a region that is no box.
  void on_side(int side, int leaf, const BoundedLeaf& bounded) {
    const auto& [box, bounds] = bounded;
    const HalfSpace& half_space = region_.polyhedron.sides[static_cast<std::size_t>(side)];
    if (within(box, half_space)) return;
    const PlaneChart& chart = charts_.of(side);
    const auto [u, v] = chart.axes();
    NamedPolygon polygon = rectangle(box, bounds, chart.axes());
    const int solved = 3 - u - v;
    for (const bool upper : {false, true})
      polygon = clip(polygon, restrict(bound_of(box, solved, upper), chart),
                     bounds[static_cast<std::size_t>(2 * solved + (upper ? 1 : 0))]);
    clip_by_sides(box, chart, side, &polygon);
    add(side, {leaf, -1}, box, std::move(polygon));
  }

  std::vector<FacetPlace> take() { return std::move(places_); }

 private:
  void clip_by_sides(const Box<3>& box, const PlaneChart& chart, int but, NamedPolygon* polygon) {
    const auto& sides = region_.polyhedron.sides;
    for (std::size_t k = 0; k < sides.size() && !polygon->corners.empty(); ++k)
      if (static_cast<int>(k) != but && !within(box, sides[k]))
        *polygon = clip(*polygon, restrict(sides[k], chart), static_cast<int>(k));
  }

  void add(int plane, const std::array<int, 2>& cells, const Box<3>& extent, NamedPolygon polygon) {
    if (polygon.corners.empty()) return;
    places_.push_back(
        {plane, cells, extent, {std::move(polygon.corners), false}, std::move(polygon.planes)});
  }

  const SolidRegion& region_;
  PlaneCharts& charts_;
  std::vector<FacetPlace> places_;
};

}  // namespace

const PlaneChart& PlaneCharts::of(int plane) {
  const auto index = static_cast<std::size_t>(plane);
  if (charts_.size() <= index) charts_.resize(planes_.size());
  if (!charts_[index]) charts_[index].emplace(planes_[index].exact());
  return *charts_[index];
}

Function<2> on_facet(const PlaneChart& chart, const Function<3>& surface) {
  if (!surface.is_expression()) return chart.restrict(surface);
  return chart.restrict(Function<3>(numerator_of(surface.expression()).numerator));
}

std::vector<FacetPlace> facet_places(const BoxPartition& partition, const SolidRegion& region,
                                     PlaneCharts& charts) {
  PlaceFinder finder(region, charts);
  for (const LeafContact& contact : leaf_contacts(partition)) finder.between(contact);
  if (region.is_box) return finder.take();
  const std::vector<BoundedLeaf> leaves = bounded_leaves(partition);
  for (std::size_t side = 0; side < region.polyhedron.sides.size(); ++side)
    for (std::size_t leaf = 0; leaf < leaves.size(); ++leaf)
      finder.on_side(static_cast<int>(side), static_cast<int>(leaf), leaves[leaf]);
  return finder.take();
}

}  // namespace encase
