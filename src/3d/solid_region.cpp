// SPDX-License-Identifier: MIT
#include "3d/solid_region.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace encase {

namespace {

/// By how much a side is moved, in parts of the diameter: by the golden ratio different for every
/// side and attempt.
double growth(std::size_t side, int attempt) {
  if (attempt == 0) return 0;
  const double turn =
      std::fmod(0.6180339887498949 * (7.0 * attempt + static_cast<double>(side)), 1.0);
  return std::ldexp(1 + 0.2 * turn, -33 - (attempt - 1) % 3);
}

/// Whether the corners are those of their bounding box.
bool is_box(const Polyhedron& region) {
  if (region.corners.size() != 8) return false;
  RationalPoint<3> lo = region.corners.front(), hi = region.corners.front();
  for (const RationalPoint<3>& corner : region.corners)
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], corner[i]);
      hi[i] = std::max(hi[i], corner[i]);
    }
  return std::all_of(region.corners.begin(), region.corners.end(), [&](const auto& corner) {
    for (std::size_t i = 0; i < 3; ++i)
      if (corner[i] != lo[i] && corner[i] != hi[i]) return false;
    return true;
  });
}

/// The sides, scaled to a largest component of the normal of 1, that have a facet; each once.
std::vector<HalfSpace> proper_sides(const Polyhedron& region) {
  std::vector<HalfSpace> sides;
  for (HalfSpace side : region.sides) {
    if (!PlaneChart(side).restrict(region)) continue;
    const Rational size =
        std::max({Rational(abs(side[0])), Rational(abs(side[1])), Rational(abs(side[2]))});
    for (Rational& c : side) c /= size;
    if (std::find(sides.begin(), sides.end(), side) == sides.end()) sides.push_back(side);
  }
  return sides;
}

}  // namespace

std::optional<SolidRegion> usable_region(const Polyhedron& region, int attempt) {
  const Box<3> around = region.bounding_box();
  const double diameter = around.largest_width();
  std::vector<HalfSpace> sides;
  const bool box = is_box(region);
  if (box) {
    Box<3> moved = around;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(2 * i);
      moved.lo[i] -= growth(k, attempt) * diameter;
      moved.hi[i] += growth(k + 1, attempt) * diameter;
    }
    RationalPoint<3> lo, hi;
    for (std::size_t i = 0; i < 3; ++i) {
      lo[i] = Rational(moved.lo[i]);
      hi[i] = Rational(moved.hi[i]);
    }
    sides = make_box(lo, hi).value().sides;
  } else {
    sides = proper_sides(region);
    for (std::size_t k = 0; k < sides.size(); ++k)
      sides[k][3] -= Rational(growth(k, attempt) * diameter);
  }
  auto polyhedron = make_polyhedron(std::move(sides));
  if (!polyhedron) return std::nullopt;
  for (const HalfSpace& side : polyhedron.value().sides)
    for (const RationalPoint<3>& corner : region.corners)
      if (side[0] * corner[0] + side[1] * corner[1] + side[2] * corner[2] + side[3] > 0)
        return std::nullopt;
  return SolidRegion{std::move(polyhedron).value(), box};
}

std::vector<Plane> planes_of(const Polyhedron& region) {
  std::vector<Plane> planes;
  for (const HalfSpace& side : region.sides) planes.push_back(Plane::from_rationals(side));
  return planes;
}

}  // namespace encase
