// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "3d/segment_crossings.hpp"
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

/// Points of a facet to which straight ways are tried, and those tried first, for free ways.
constexpr int kTargets = 24, kFreeTargets = 4;

}  // namespace

struct RegionLocator::Tables {
  const SurfaceEncasement& e;
  const SpaceArrangement& arrangement;
  std::vector<FilteredFunction<3>> surfaces;
  std::vector<std::array<Rational, 4>> planes;
  std::vector<std::vector<int>> regions_of_cell;
  std::set<std::array<int, 3>> borders;  ///< a surface, and two regions with a face of it between

  Tables(const SurfaceEncasement& encasement, const SpaceArrangement& a)
      : e(encasement), arrangement(a), regions_of_cell(encasement.cells.size()) {
    for (const Surface& surface : e.surfaces) surfaces.emplace_back(surface.function);
    for (const Plane& plane : e.planes) planes.push_back(plane.exact());
    for (std::size_t r = 0; r < a.regions.size(); ++r)
      for (const int cell : a.regions[r].cells)
        regions_of_cell[cell].push_back(static_cast<int>(r));
    for (const SpaceArrangement::Face& face : a.faces)
      borders.insert({face.surface, std::min(face.regions[0], face.regions[1]),
                      std::max(face.regions[0], face.regions[1])});
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

  /// The region next to a point of a facet; -1 on a surface.
  int region_at(int f, const RationalPoint<2>& on_facet) const {
    const Facet& facet = e.facets[f];
    if (facet.surfaces.empty()) return arrangement.region_of_facet[f][0];
    const auto feature = PointLocator(facet.encasement, facet.arrangement).locate(on_facet);
    if (feature.kind != Arrangement::Feature::Kind::Face) return -1;
    return arrangement.region_of_facet[f][feature.index];
  }

  /// Which surfaces a segment in a cell crosses, in order, if that can be told; `freely`: only if
  /// it is none.
  std::optional<std::vector<int>> crossed(int cell, const RationalPoint<3>& from,
                                          const RationalPoint<3>& to, bool freely,
                                          Kernel& kernel) const {
    std::vector<int> met;
    std::vector<const Function<3>*> functions;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
      if (e.cells[cell].signs[s] != Sign::Zero || misses(surfaces[s], from, to, kernel)) continue;
      if (freely) return std::nullopt;
      met.push_back(static_cast<int>(s));
      functions.push_back(&e.surfaces[s].function);
    }
    if (met.empty()) return met;
    auto changes = sign_changes(functions, from, to);
    if (!changes) return std::nullopt;
    for (int& k : *changes) k = met[k];
    return changes;
  }

  /// The regions of a cell that border on one of some regions across a surface.
  std::vector<int> beyond(int cell, int surface, const std::vector<int>& regions) const {
    std::vector<int> result;
    for (const int r : regions_of_cell[cell])
      if (std::any_of(regions.begin(), regions.end(), [&](int other) {
            return borders.count({surface, std::min(r, other), std::max(r, other)}) == 1;
          }))
        result.push_back(r);
    return result;
  }

  /// Goes straight from a point to a point of a facet of its cell, and back from the region there
  /// across one surface after the other: the regions in which the point may lie. Nothing if the way
  /// does not tell.
  std::optional<std::vector<int>> regions_along(const RationalPoint<3>& point, int cell, int f,
                                                const RationalPoint<2>& on_facet, bool freely,
                                                Kernel& kernel) const {
    const RationalPoint<3> target = PlaneChart(planes[e.facets[f].plane]).lift(on_facet);
    const auto way = crossed(cell, point, target, freely, kernel);
    if (!way) return std::nullopt;
    const int last = region_at(f, on_facet);
    if (last < 0) return std::nullopt;
    std::vector<int> regions{last};
    for (std::size_t k = way->size(); k-- > 0;) regions = beyond(cell, (*way)[k], regions);
    return regions;
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
    // Every way leaves fewer of them. Those that cross nothing come first: they cost least.
    for (int k = -kFreeTargets; k < kTargets; ++k)
      for (const int f : e.cells[cell].facets) {
        const bool freely = k < 0;
        const auto regions = regions_along(
            point, cell, f, target(point, f, freely ? k + kFreeTargets : k), freely, kernel);
        if (!regions) continue;
        std::erase_if(candidates, [&](int r) {
          return std::find(regions->begin(), regions->end(), r) == regions->end();
        });
        if (candidates.size() == 1) return {Place::Kind::Region, candidates[0], {}};
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
