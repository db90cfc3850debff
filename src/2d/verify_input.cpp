// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "common/box_tests.hpp"
#include "common/substitute.hpp"
#include "common/verify_functions.hpp"
#include "verify_claims.hpp"

namespace encase::verification {

namespace {

using Vector = RationalPoint<2>;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1]}; }
Rational cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }

/// Whether a point lies strictly left of (1), on (0) or right of (-1) side k of a region.
int left_of_side(const Region& region, std::size_t k, const Vector& point) {
  const Vector& p = region.corners[k];
  const Vector& q = region.corners[(k + 1) % region.corners.size()];
  return sgn(cross(difference(q, p), difference(point, p)));
}

/// All other corners lie strictly left of every side: then the sides, in order, are those of the
/// corners' convex hull, counter-clockwise.
bool convex(const Region& region) {
  const std::size_t n = region.corners.size();
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      if (i != k && i != (k + 1) % n && left_of_side(region, k, region.corners[i]) <= 0)
        return false;
  return true;
}

bool contains(const Region& region, const Vector& point) {
  for (std::size_t k = 0; k < region.corners.size(); ++k)
    if (left_of_side(region, k, point) < 0) return false;
  return true;
}

/// The squared distance of a point from a side.
Rational squared_distance(const Region& region, std::size_t k, const Vector& point) {
  const Vector& p = region.corners[k];
  const Vector along = difference(region.corners[(k + 1) % region.corners.size()], p);
  Rational t = dot(difference(point, p), along) / dot(along, along);
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const Vector offset = difference(point, {p[0] + t * along[0], p[1] + t * along[1]});
  return dot(offset, offset);
}

/// The half widths of a rectangle around the origin that are doubles; zero if it is none.
Point<2> half_widths(const Region& region) {
  Point<2> half{0, 0};
  for (int i = 0; i < 2; ++i) half[i] = std::fabs(region.corners[0][i].get_d());
  bool right = region.corners.size() == 4 && half[0] > 0 && half[1] > 0;
  for (const Vector& corner : region.corners)
    for (int i = 0; i < 2; ++i) right = right && abs(corner[i]) == Rational(half[i]);
  return right ? half : Point<2>{0, 0};
}

/// The pieces cover every chart from -1 to 1. In a piece without a curve none has a zero; in the
/// others only one has, and its derivative along v has none there. The corners of the rectangle,
/// where the charts meet, are in pieces without a curve. So a curve has in a row of its pieces
/// either no zero or one for every u, and it goes from the rectangle to infinity and on without
/// meeting another.
void check_infinity(Claims& claims) {
  const Encasement& e = claims.result;
  const Point<2> half = half_widths(e.region_used);
  if (!claims.require(half[0] > 0, "The region used is not a rectangle around the origin.")) return;
  const bool reported =
      std::any_of(e.degenerate.begin(), e.degenerate.end(),
                  [](const Unresolved& u) { return u.kind == Unresolved::Kind::Infinity; });
  if (e.infinity.empty()) {
    claims.require(reported, "Nothing is said of the plane outside of the region used.");
    return;
  }
  for (int chart = 0; chart < 2; ++chart) {
    std::vector<FilteredFunction<2>> curves, slopes;
    for (const Curve& curve : e.curves) {
      const Polynomial<2> f = outside_of_rectangle(curve.function.polynomial(), half, chart);
      curves.emplace_back(f);
      slopes.emplace_back(f.derivative(1));
    }
    double reached = -1;
    for (std::size_t k = 0; k < e.infinity.size(); ++k) {
      const InfinityPiece& piece = e.infinity[k];
      if (piece.chart != chart) continue;
      const bool corner = piece.lo == -1 || piece.hi == 1;
      claims.require(piece.lo == reached && piece.hi > piece.lo && piece.hi <= 1, "Piece ", k,
                     " at infinity does not follow the one before.");
      claims.require(piece.curve == -1 || (piece.curve >= 0 && !corner &&
                                           piece.curve < static_cast<int>(e.curves.size())),
                     "Piece ", k, " at infinity cannot have curve ", piece.curve, ".");
      if (claims.full()) return;
      const Box<2> box{{-1, piece.lo}, {1, piece.hi}};
      for (std::size_t c = 0; c < curves.size() && box.lo[1] < box.hi[1]; ++c) {
        const bool its = static_cast<int>(c) == piece.curve;
        const auto& f = its ? slopes[c] : curves[c];
        claims.require(f.degree() >= 0 && sign_on_box(f, box, claims.kernel),
                       its ? "The direction of curve " : "The sign of curve ", c, " in piece ", k,
                       " at infinity is not proved.");
      }
      reached = piece.hi;
    }
    claims.require(reached == 1, "The pieces at infinity do not cover chart ", chart, ".");
  }
}

}  // namespace

void check_curves(Claims& claims) {
  const Encasement& e = claims.result;
  FunctionClaims<2> functions{e.input};
  for (const Curve& c : e.curves) functions.encased.push_back({c.function, c.sources});
  for (const Unresolved& u : e.degenerate) functions.degenerate.push_back({u.kind, u.curves});
  for (const Unresolved& u : e.undecided) functions.undecided.push_back({u.kind, u.curves});
  check_functions(claims, functions);
}

bool check_regions(Claims& claims) {
  const Encasement& e = claims.result;
  const Region& asked = e.region;
  const Region& used = e.region_used;
  if (!claims.require(asked.plane || convex(asked),
                      "The region is not a convex polygon, counter-clockwise.") ||
      !claims.require(convex(used), "The region used is not a convex polygon, counter-clockwise."))
    return false;

  if (asked.plane) {
    check_infinity(claims);
  } else if (used.corners != asked.corners) {
    bool larger = true;
    for (const Vector& corner : asked.corners) larger = larger && contains(used, corner);
    claims.require(larger, "The region used does not contain the region.");
    // The distance from a convex set is a convex function, largest at corners.
    Rational diameter = 0;
    for (const Vector& a : asked.corners)
      for (const Vector& b : asked.corners) {
        const Vector d = difference(a, b);
        diameter = std::max(diameter, dot(d, d));
      }
    const Rational allowed = diameter * Rational(0x1p-60);
    bool close = true;
    for (const Vector& corner : used.corners) {
      bool near = contains(asked, corner);
      for (std::size_t k = 0; k < asked.corners.size() && !near; ++k)
        near = squared_distance(asked, k, corner) <= allowed;
      close = close && near;
    }
    claims.require(close, "The region used exceeds the region by more than 2^-30 of its diameter.");
  }

  const std::size_t n = used.corners.size();
  bool sides = true;
  for (std::size_t k = 0; k < n; ++k) {
    const auto c = e.lines[k].exact();
    const auto at = [&](const Vector& p) {
      return sgn(Rational(c[0] * p[0] + c[1] * p[1] + c[2]));
    };
    const bool side = at(used.corners[k]) == 0 && at(used.corners[(k + 1) % n]) == 0 &&
                      at(used.corners[(k + 2) % n]) < 0;
    sides = claims.require(side, "Line ", k, " is not side ", k, " of the region used.") && sides;
  }
  return sides;
}

}  // namespace encase::verification
