// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "common/box_tests.hpp"
#include "common/expression_program.hpp"
#include "encase/space_arrangement.hpp"

namespace encase {
namespace {

using Place = RegionLocator::Place;

Rational value_at(const std::array<Rational, 4>& plane, const RationalPoint<3>& p) {
  return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
}

RationalPoint<3> between(const RationalPoint<3>& a, const RationalPoint<3>& b, const Rational& t) {
  RationalPoint<3> p;
  for (int i = 0; i < 3; ++i) p[i] = a[i] + t * (b[i] - a[i]);
  return p;
}

/// The smallest box with double bounds around a segment.
Box<3> box_around(const RationalPoint<3>& a, const RationalPoint<3>& b) {
  Box<3> box;
  for (int i = 0; i < 3; ++i) {
    const Interval p = Interval::enclose(a[i]), q = Interval::enclose(b[i]);
    box.lo[i] = std::min(p.lo, q.lo);
    box.hi[i] = std::max(p.hi, q.hi);
  }
  return box;
}

/// The surface is proved not to meet the segment, by boxes around its parts.
bool misses(const FilteredFunction<3>& f, const RationalPoint<3>& a, const RationalPoint<3>& b,
            Kernel& kernel, int halvings = 8) {
  if (sign_on_box(f, box_around(a, b), kernel)) return true;
  if (halvings == 0) return false;
  const RationalPoint<3> middle = between(a, b, Rational(1, 2));
  // A change of sign ends the attempt early.
  const Sign here = f.sign_at(middle, kernel);
  if (here == Sign::Zero || here != f.sign_at(a, kernel)) return false;
  return misses(f, a, middle, kernel, halvings - 1) && misses(f, middle, b, kernel, halvings - 1);
}

/// Points of a facet to which straight ways are tried.
constexpr int kTargets = 24;

}  // namespace

struct RegionLocator::Tables {
  const SurfaceEncasement& e;
  const SpaceArrangement& arrangement;
  std::vector<FilteredFunction<3>> surfaces;
  std::vector<std::array<Rational, 4>> planes;
  std::vector<std::vector<int>> regions_of_cell;

  Tables(const SurfaceEncasement& encasement, const SpaceArrangement& a)
      : e(encasement), arrangement(a), regions_of_cell(encasement.cells.size()) {
    for (const Surface& surface : e.surfaces) surfaces.emplace_back(surface.function);
    for (const Plane& plane : e.planes) planes.push_back(plane.exact());
    for (std::size_t r = 0; r < a.regions.size(); ++r)
      for (const int cell : a.regions[r].cells)
        regions_of_cell[cell].push_back(static_cast<int>(r));
  }

  bool outside(const RationalPoint<3>& point) const {
    return std::any_of(e.region_used.sides.begin(), e.region_used.sides.end(),
                       [&](const HalfSpace& side) { return value_at(side, point) > 0; });
  }

  /// A cell that contains a point of the region used.
  int cell_of(const RationalPoint<3>& point) const {
    int at = e.history.empty() ? ~0 : 0;
    while (at >= 0) {
      const Split& split = e.history[at];
      at = value_at(planes[split.line], point) < 0 ? split.negative : split.positive;
    }
    return ~at;
  }

  /// Goes straight from a point to a point of a facet of its cell: the region there, if no surface
  /// lies between; else -1.
  int region_beyond(const RationalPoint<3>& point, int cell, int f,
                    const RationalPoint<2>& on_facet, Kernel& kernel) const {
    const Facet& facet = e.facets[f];
    const RationalPoint<3> target = PlaneChart(planes[facet.plane]).lift(on_facet);
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      if (e.cells[cell].signs[s] == Sign::Zero && !misses(surfaces[s], point, target, kernel))
        return -1;
    if (facet.surfaces.empty()) return arrangement.region_of_facet[f][0];
    const auto feature = PointLocator(facet.encasement, facet.arrangement).locate(on_facet);
    if (feature.kind != Arrangement::Feature::Kind::Face) return -1;
    return arrangement.region_of_facet[f][feature.index];
  }

  /// A point of a facet, another one for every k: first that straight along an axis from the given
  /// point, if it lies on the facet, then others ever nearer to and farther from it.
  RationalPoint<2> target(const RationalPoint<3>& point, int f, int k) const {
    const Region& polygon = e.facets[f].polygon;
    RationalPoint<2> sum{0, 0};
    Rational weights = 0;
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      // Any numbers from 1 to 97 will do, if they differ enough.
      const unsigned weight = (37 * k * (i + 2) + 11 * k * k * (i + 1)) % 97 + 1;
      weights += weight;
      for (int axis = 0; axis < 2; ++axis) sum[axis] += weight * polygon.corners[i][axis];
    }
    RationalPoint<2> any{sum[0] / weights, sum[1] / weights};
    const auto axes = PlaneChart(planes[e.facets[f].plane]).axes();
    const RationalPoint<2> foot{point[axes[0]], point[axes[1]]};
    for (int side = 0; side < polygon.side_count(); ++side) {
      const auto line = polygon.side(side).exact();
      if (line[0] * foot[0] + line[1] * foot[1] + line[2] > 0) return any;
    }
    if (k == 0) return foot;
    const Rational part = Rational(1) / (1 << (k % 5));
    for (int axis = 0; axis < 2; ++axis) any[axis] = foot[axis] + part * (any[axis] - foot[axis]);
    return any;
  }

  Place find_region(const RationalPoint<3>& point, const std::vector<Sign>& signs,
                    Kernel& kernel) const {
    const int cell = cell_of(point);
    std::vector<int> candidates;
    for (const int region : regions_of_cell[cell])
      if (arrangement.regions[region].signs == signs) candidates.push_back(region);
    if (candidates.size() == 1) return {Place::Kind::Region, candidates[0], {}};
    for (int k = 0; k < kTargets; ++k)
      for (const int f : e.cells[cell].facets) {
        const int region = region_beyond(point, cell, f, target(point, f, k), kernel);
        if (region >= 0) return {Place::Kind::Region, region, {}};
      }
    return {};
  }

  Place locate(const RationalPoint<3>& point) const {
    if (outside(point)) return {Place::Kind::Outside, -1, {}};
    Kernel kernel;
    std::vector<Sign> signs;
    Place place;
    bool proved = true;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      signs.push_back(surfaces[s].sign_at(point, kernel));
      if (signs.back() != Sign::Zero) continue;
      if (surfaces[s].is_polynomial() ||
          (surfaces[s].is_expression() &&
           ExpressionProgram<3>(surfaces[s].expression().exact()).sign_at(point, kernel) ==
               PointSign::Zero))
        place.surfaces.push_back(static_cast<int>(s));
      else
        proved = false;
    }
    if (!proved) return {};
    if (!place.surfaces.empty()) {
      place.kind = Place::Kind::OnSurface;
      return place;
    }
    return find_region(point, signs, kernel);
  }
};

RegionLocator::RegionLocator(const SurfaceEncasement& encasement,
                             const SpaceArrangement& arrangement)
    : tables_(std::make_unique<const Tables>(encasement, arrangement)) {}
RegionLocator::~RegionLocator() = default;
RegionLocator::RegionLocator(RegionLocator&&) noexcept = default;
RegionLocator& RegionLocator::operator=(RegionLocator&&) noexcept = default;

RegionLocator::Place RegionLocator::locate(const RationalPoint<3>& point) const {
  return tables_->locate(point);
}

}  // namespace encase
