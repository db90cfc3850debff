// SPDX-License-Identifier: MIT
#include "3d/region_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "common/interval.hpp"

namespace encase {

namespace {

enum class Side { Inside, Across, Outside };

/// Where a box lies to a half space: in it, or with no interior point in it.
Side side_of(const Plane& plane, const Box<3>& box) {
  const auto at = [&](bool farthest, auto number) {
    using Number = decltype(number);
    const auto exact = plane.exact();
    Number value;
    if constexpr (std::is_same_v<Number, Rational>)
      value = exact[3];
    else
      value = Interval::enclose(exact[3]);
    for (std::size_t i = 0; i < 3; ++i) {
      const bool high = (sgn(exact[i]) > 0) == farthest;
      const double x = high ? box.hi[i] : box.lo[i];
      if constexpr (std::is_same_v<Number, Rational>)
        value += exact[i] * Rational(x);
      else
        value = value + Interval::enclose(exact[i]) * Interval(x);
    }
    return value;
  };
  const Interval highest = at(true, Interval()), lowest = at(false, Interval());
  if (highest.lo > 0 && lowest.hi < 0) return Side::Across;
  if (at(true, Rational()) <= 0) return Side::Inside;
  return at(false, Rational()) >= 0 ? Side::Outside : Side::Across;
}

}  // namespace

RegionSides::RegionSides(const Polyhedron& region) : region_(region) {
  for (const HalfSpace& side : region.sides) planes_.push_back(Plane::from_rationals(side));
}

std::vector<int> RegionSides::all() const {
  std::vector<int> sides(planes_.size());
  std::iota(sides.begin(), sides.end(), 0);
  return sides;
}

std::vector<int> RegionSides::across(const Box<3>& box, const std::vector<int>& sides,
                                     bool* empty) const {
  std::vector<int> result;
  *empty = false;
  for (const int s : sides) {
    const Side side = side_of(planes_[static_cast<std::size_t>(s)], box);
    *empty = *empty || side == Side::Outside;
    if (side == Side::Across) result.push_back(s);
  }
  if (!*empty) *empty = !has_interior(box, result);
  return result;
}

bool RegionSides::has_interior(const Box<3>& box, const std::vector<int>& sides) const {
  // One half space that cuts a box has a part of its interior.
  if (sides.size() < 2 || sides.size() + 6 > kMaxSides) return true;
  const Point<3> center = box.center();
  Box<3> middle;
  middle.lo = middle.hi = center;
  if (std::all_of(sides.begin(), sides.end(), [&](int s) {
        Interval value = planes_[static_cast<std::size_t>(s)].offset;
        const Plane& plane = planes_[static_cast<std::size_t>(s)];
        double size = std::fabs(plane.offset);
        for (int i = 0; i < 3; ++i) {
          value = value + Interval(plane.normal[i]) * Interval(center[i]);
          size += std::fabs(plane.normal[i] * center[i]);
        }
        return value.hi < -0x1p-48 * size;
      }))
    return true;
  std::vector<HalfSpace> all;
  for (const int s : sides) all.push_back(region_.sides[static_cast<std::size_t>(s)]);
  for (int i = 0; i < 3; ++i) {
    HalfSpace below{0, 0, 0, Rational(box.lo[i])}, above{0, 0, 0, -Rational(box.hi[i])};
    below[static_cast<std::size_t>(i)] = -1;
    above[static_cast<std::size_t>(i)] = 1;
    all.push_back(below);
    all.push_back(above);
  }
  return make_polyhedron(std::move(all)).ok();
}

}  // namespace encase
