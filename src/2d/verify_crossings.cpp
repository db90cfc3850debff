// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include "common/box_tests.hpp"
#include "common/components.hpp"
#include "common/segments.hpp"
#include "verify_claims.hpp"

namespace encase::verification {

namespace {

using Univariate = Polynomial<1>;

/// t -> f(p + t (q - p)).
Univariate restriction(const Polynomial<2>& f, const RationalPoint<2>& p,
                       const RationalPoint<2>& q) {
  // Powers of the two coordinates, which are linear in t.
  std::array<std::vector<Univariate>, 2> powers;
  for (std::size_t i = 0; i < 2; ++i) {
    const Univariate coordinate =
        Univariate::from_terms({{{0}, p[i]}, {{1}, Rational(q[i] - p[i])}});
    powers[i].push_back(Univariate::constant(1));
    for (int k = 1; k <= f.degree(static_cast<int>(i)); ++k)
      powers[i].push_back(powers[i].back() * coordinate);
  }
  Univariate sum;
  for (const auto& term : f.terms())
    sum = sum + Univariate::constant(term.coefficient) *
                    powers[0][static_cast<std::size_t>(term.exponent[0])] *
                    powers[1][static_cast<std::size_t>(term.exponent[1])];
  return sum;
}

/// Whether a crossing's curves have a common zero on the closed segment from p to q within the
/// crossing's closed box, proved by the greatest common divisor of their restrictions. Of others
/// than polynomials that is never proved.
bool common_zero_on_segment(const Encasement& e, const Crossing& crossing,
                            const RationalPoint<2>& p, const RationalPoint<2>& q) {
  const Function<2>& first_curve = e.curves[static_cast<std::size_t>(crossing.curves[0])].function;
  const Function<2>& second_curve = e.curves[static_cast<std::size_t>(crossing.curves[1])].function;
  if (!first_curve.is_polynomial() || !second_curve.is_polynomial()) return false;
  const Box<2>& box = crossing.box;
  Rational first = 0, last = 1;
  for (std::size_t i = 0; i < 2; ++i) {
    const Rational lo(box.lo[i]), hi(box.hi[i]), along = q[i] - p[i];
    if (along == 0) {
      if (p[i] < lo || p[i] > hi) return false;
      continue;
    }
    const Rational at_lo = (lo - p[i]) / along, at_hi = (hi - p[i]) / along;
    first = std::max(first, std::min(at_lo, at_hi));
    last = std::min(last, std::max(at_lo, at_hi));
  }
  if (first > last) return false;
  const Univariate common = gcd(restriction(first_curve.polynomial(), p, q),
                                restriction(second_curve.polynomial(), p, q));
  if (common.is_zero() || common.is_constant()) return common.is_zero();
  if (first == last) return common({first}) == 0;
  return count_real_roots(common, first, last) > 0;
}

Interval derivative_range(const Bernstein<2>& net, int axis) {
  Bernstein<2> derivative;
  differentiate(net, axis, &derivative);
  const auto [lo, hi] = std::minmax_element(derivative.b.begin(), derivative.b.end());
  return Interval(*lo, *hi) + Interval(-derivative.radius, derivative.radius);
}

/// The half width by which a box is mapped to the cube of its net.
Interval half_width(const Box<2>& box, std::size_t axis) {
  return centered(box.lo[axis], box.hi[axis]).half;
}

/// Encloses z - p, where z is the only common zero of f and g in the crossing's box and p its
/// point: with J the matrix whose rows are gradients of f and g at points of the segment from p to
/// z, 0 = F(z) = F(p) + J (z - p), solved by Cramer's rule over an enclosure of J on a box around
/// the crossing's. That box may be larger by 2^-shift of p: its half widths are then known more
/// precisely.
std::array<Interval, 2> offset_from_point(Claims& claims, const Crossing& crossing, int shift,
                                          int bits) {
  const auto& f = claims.curves[static_cast<std::size_t>(crossing.curves[0])];
  const auto& g = claims.curves[static_cast<std::size_t>(crossing.curves[1])];
  const Point<2>& p = crossing.point;
  Box<2> box;
  for (std::size_t i = 0; i < 2; ++i) {
    const double reach = std::fmax(std::ldexp(std::fabs(p[i]), -shift),
                                   std::fmax(crossing.box.hi[i] - p[i], p[i] - crossing.box.lo[i]));
    box.lo[i] = std::fmin(p[i] - reach, crossing.box.lo[i]);
    box.hi[i] = std::fmax(p[i] + reach, crossing.box.hi[i]);
  }
  std::array<std::array<Interval, 2>, 2> j;
  std::array<Interval, 2> value;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto& h = k == 0 ? f : g;
    Bernstein<2> net;
    h.expand(box, h.degree(), bits, claims.kernel, &net);
    for (std::size_t i = 0; i < 2; ++i) j[k][i] = derivative_range(net, static_cast<int>(i));
    // At a zero of f and g nothing but the rounding error is left of their values in doubles.
    const auto v = h.evaluate(p, 4 * Kernel::kDoubleBits);
    value[k] = Interval(v.value) + Interval(-v.error, v.error);
  }
  const Interval determinant = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  return {half_width(box, 0) * ((j[0][1] * value[1] - j[1][1] * value[0]) / determinant),
          half_width(box, 1) * ((j[1][0] * value[0] - j[0][0] * value[1]) / determinant)};
}

/// Whether each coordinate of the crossing's point is the double nearest to that of the only common
/// zero of its curves in its box.
bool rounding_is_proved(Claims& claims, const Crossing& crossing) {
  std::array<bool, 2> proved{};
  for (const auto& [shift, bits] : {std::pair(26, Kernel::kDoubleBits), std::pair(40, 212)}) {
    const auto offset = offset_from_point(claims, crossing, shift, bits);
    for (std::size_t i = 0; i < 2; ++i) {
      const double p = crossing.point[i];
      const double above = 0.5 * (std::nextafter(p, HUGE_VAL) - p);
      const double below = 0.5 * (p - std::nextafter(p, -HUGE_VAL));
      proved[i] = proved[i] || (-below < offset[i].lo && offset[i].hi < above);
    }
    if (proved[0] && proved[1]) return true;
  }
  // The coordinate may be the double itself.
  for (std::size_t i = 0; i < 2; ++i) {
    if (proved[i]) continue;
    RationalPoint<2> from, to;
    from[i] = to[i] = crossing.point[i];
    from[1 - i] = crossing.box.lo[1 - i];
    to[1 - i] = crossing.box.hi[1 - i];
    if (!common_zero_on_segment(claims.result, crossing, from, to)) return false;
  }
  return true;
}

/// Whether all of a box lies strictly inside (1) or strictly outside (-1) a side of the region
/// asked for; 0 if it meets the side's line.
int side_of_region(const Region& region, std::size_t k, const Box<2>& box) {
  const auto& p = region.corners[k];
  const auto& q = region.corners[(k + 1) % region.corners.size()];
  int common = 2;
  for (const double x : {box.lo[0], box.hi[0]})
    for (const double y : {box.lo[1], box.hi[1]}) {
      const int left = sgn(
          Rational((q[0] - p[0]) * (Rational(y) - p[1]) - (q[1] - p[1]) * (Rational(x) - p[0])));
      if (left == 0 || (common != 2 && left != common)) return 0;
      common = left;
    }
  return common;
}

bool location_is_proved(const Encasement& e, const Crossing& crossing) {
  const std::size_t n = e.region.corners.size();
  bool inside = true, outside = false;
  for (std::size_t k = 0; k < n; ++k) {
    const int s = side_of_region(e.region, k, crossing.box);
    inside = inside && s > 0;
    outside = outside || s < 0;
  }
  if (crossing.location == Location::Inside) return inside;
  if (crossing.location == Location::Outside) return outside;
  if (inside || outside) return false;
  // The box holds one common zero: one on a side is that one.
  for (std::size_t k = 0; k < n; ++k)
    if (common_zero_on_segment(e, crossing, e.region.corners[k], e.region.corners[(k + 1) % n]))
      return true;
  return false;
}

/// Whether an undecided entry with the crossing's box says that something about it is open.
bool is_left_open(const Encasement& e, const Crossing& crossing) {
  return std::any_of(e.undecided.begin(), e.undecided.end(), [&](const Unresolved& u) {
    return u.has_box && u.kind == Unresolved::Kind::Budget && u.box.contains(crossing.box) &&
           std::includes(u.curves.begin(), u.curves.end(), crossing.curves.begin(),
                         crossing.curves.end());
  });
}

void check_place(Claims& claims, const Partition& partition, std::size_t i) {
  const Encasement& e = claims.result;
  const Crossing& crossing = e.crossings[i];
  if (crossing.cell >= 0) {
    claims.require(strictly_inside(claims, partition.cells[static_cast<std::size_t>(crossing.cell)],
                                   crossing.box),
                   "The box of crossing ", i, " is not inside cell ", crossing.cell, ".");
    return;
  }
  for (int c : cells_near(claims, partition, crossing.box))
    claims.require(!certified(e.cells[static_cast<std::size_t>(c)]), "Crossing ", i,
                   " has no cell, but its box meets the certified cell ", c, ".");
}

/// Boxes of one pair do not meet, so their zeros are different.
void check_disjoint(Claims& claims) {
  const auto& crossings = claims.result.crossings;
  std::map<std::array<int, 2>, std::vector<std::size_t>> of_pair;
  for (std::size_t i = 0; i < crossings.size(); ++i) of_pair[crossings[i].curves].push_back(i);
  for (auto& [pair, ids] : of_pair) {
    std::sort(ids.begin(), ids.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(crossings[a].box.lo[0], a) < std::pair(crossings[b].box.lo[0], b);
    });
    for (std::size_t a = 0; a < ids.size(); ++a) {
      const Box<2>& box = crossings[ids[a]].box;
      bool disjoint = true;
      for (std::size_t b = a + 1;
           b < ids.size() && disjoint && crossings[ids[b]].box.lo[0] <= box.hi[0]; ++b)
        disjoint = claims.require(!box.meets(crossings[ids[b]].box), "The boxes of crossings ",
                                  ids[a], " and ", ids[b], " of one pair of curves meet.");
      if (claims.full()) return;
    }
  }
}

}  // namespace

void check_crossings(Claims& claims, const Partition& partition) {
  const Encasement& e = claims.result;
  for_each(claims, e.crossings.size(), [&](Claims& part, std::size_t i) {
    const Crossing& c = e.crossings[i];
    const System<2> pair{&part.curves[static_cast<std::size_t>(c.curves[0])],
                         &part.curves[static_cast<std::size_t>(c.curves[1])]};
    part.require(c.box.contains(c.point), "The point of crossing ", i, " is not in its box.");
    if (!part.require(exactly_one_zero<2>(pair, c.box, part.kernel), "The box of crossing ", i,
                      " is not proved to hold exactly one common point."))
      return;
    check_place(part, partition, i);
    part.require(location_is_proved(e, c) || (c.location == Location::Inside && is_left_open(e, c)),
                 "The location of crossing ", i, " in the region is not proved.");
    if (c.rounded)
      part.require(rounding_is_proved(part, c), "The point of crossing ", i,
                   " is not proved to be correctly rounded.");
  });
  if (!claims.full()) check_disjoint(claims);
}

}  // namespace encase::verification
