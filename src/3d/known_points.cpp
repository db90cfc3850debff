// SPDX-License-Identifier: MIT
#include "3d/known_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/interval.hpp"
#include "encase/crossing.hpp"

namespace encase {

namespace {

/// What rounds to the doubles of the point.
template <int D>
Box<D> rounding_box(const Point<D>& p) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box<D> box;
  for (int i = 0; i < D; ++i) {
    box.lo[i] = std::nextafter(p[i], -kInfinity);
    box.hi[i] = std::nextafter(p[i], kInfinity);
  }
  return box;
}

/// The crossing's box, or one of 2^-50 of its coordinates' size.
Box<2> small_box(const Encasement& encasement, int crossing) {
  const Crossing& c = encasement.crossings[crossing];
  if (c.rounded) return rounding_box<2>(c.point);
  const double size = encasement.region_used.bounding_box().largest_width();
  const auto refined = refine(encasement, crossing, 50 - std::ilogb(size));
  if (!refined) return c.box;
  Box<2> box;
  for (int i = 0; i < 2; ++i) {
    box.lo[i] = Interval::enclose(refined.value().lo[i]).lo;
    box.hi[i] = Interval::enclose(refined.value().hi[i]).hi;
  }
  return box;
}

}  // namespace

Box<3> lift(const PlaneChart& chart, const Box<2>& box) {
  // The map is affine: the corners' images span the box.
  Box<3> result;
  for (int corner = 0; corner < 4; ++corner) {
    const RationalPoint<3> p =
        chart.lift(RationalPoint<2>{Rational(corner & 1 ? box.hi[0] : box.lo[0]),
                                    Rational(corner & 2 ? box.hi[1] : box.lo[1])});
    Box<3> at;
    for (int i = 0; i < 3; ++i) {
      const Interval around = Interval::enclose(p[i]);
      at.lo[i] = around.lo;
      at.hi[i] = around.hi;
    }
    result = corner == 0 ? at : hull(result, at);
  }
  return result;
}

KnownPoints::KnownPoints(const SurfaceEncasement& encasement)
    : encasement_(encasement), places_(encasement.facet_points.size()) {
  for (std::size_t f = 0; f < encasement.facets.size(); ++f) {
    const Facet& facet = encasement.facets[f];
    for (std::size_t v = 0; v < facet.points.size(); ++v)
      if (facet.points[v] >= 0 &&
          facet.arrangement.vertices[v].kind == Arrangement::Vertex::Kind::Crossing)
        places_[facet.points[v]] = {static_cast<int>(f), static_cast<int>(v)};
  }
}

SpacePoint KnownPoints::facet_point(int k) const {
  const Point<3> about = encasement_.facet_points[k].point;
  const Place& place = places_[k];
  // (An encasement that does not name its facets proves nothing.)
  if (place.facet < 0) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {about, {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}}};
  }
  const Facet& facet = encasement_.facets[place.facet];
  const PlaneChart chart(encasement_.planes[facet.plane].exact());
  const int crossing = facet.arrangement.vertices[place.vertex].index;
  const Box<2> box = small_box(facet.encasement, crossing);
  return {chart.lift(box.center()), lift(chart, box)};
}

SpacePoint KnownPoints::triple_point(int k) const {
  const TriplePoint& t = encasement_.triple_points[k];
  return {t.point, t.rounded ? rounding_box<3>(t.point) : t.box};
}

}  // namespace encase
