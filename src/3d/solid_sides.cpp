// SPDX-License-Identifier: MIT
#include "3d/solid_sides.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

Rational value_at(const HalfSpace& plane, const RationalPoint<3>& p) {
  return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + plane[3];
}

/// The coordinate of a plane at right angles to an axis.
std::optional<Rational> level_on(const HalfSpace& plane, std::size_t axis) {
  if (plane[axis] == 0 || plane[(axis + 1) % 3] != 0 || plane[(axis + 2) % 3] != 0)
    return std::nullopt;
  return Rational(-plane[3] / plane[axis]);
}

}  // namespace

Sign side_of(const HalfSpace& plane, const Box<3>& box) {
  Rational least = plane[3], greatest = plane[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational at_lo = plane[i] * Rational(box.lo[i]), at_hi = plane[i] * Rational(box.hi[i]);
    least += plane[i] < 0 ? at_hi : at_lo;
    greatest += plane[i] < 0 ? at_lo : at_hi;
  }
  return greatest < 0 ? Sign::Negative : least > 0 ? Sign::Positive : Sign::Zero;
}

std::optional<Location> location_of(const std::array<const Function<3>*, 3>& functions,
                                    const Box<3>& box, const Point<3>& guess,
                                    const Polyhedron& region) {
  bool inside = true;
  for (const HalfSpace& plane : region.sides) {
    const Sign side = side_of(plane, box);
    if (side == Sign::Positive) return Location::Outside;
    inside = inside && side == Sign::Negative;
  }
  if (inside) return Location::Inside;
  RationalPoint<3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational lo(box.lo[i]), hi(box.hi[i]);
    p[i] = guess[i];
    for (const HalfSpace& plane : region.sides)
      if (const auto level = level_on(plane, i); level && lo <= *level && *level <= hi)
        p[i] = *level;
    if (p[i] < lo || p[i] > hi) return std::nullopt;
  }
  for (const Function<3>* f : functions)
    if (!f->is_polynomial() || f->polynomial()(p) != 0) return std::nullopt;
  bool on_side = false;
  for (const HalfSpace& plane : region.sides) {
    const Rational value = value_at(plane, p);
    if (value > 0) return Location::Outside;
    on_side = on_side || value == 0;
  }
  return on_side ? Location::OnBoundary : Location::Inside;
}

Box<3> neighbours_of(const Point<3>& point) {
  Box<3> box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.lo[i] = std::nextafter(point[i], -HUGE_VAL);
    box.hi[i] = std::nextafter(point[i], HUGE_VAL);
  }
  return box;
}

}  // namespace encase
