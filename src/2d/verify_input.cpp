// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <set>

#include "common/box_tests.hpp"
#include "common/components.hpp"
#include "common/substitute.hpp"
#include "verify_claims.hpp"

namespace encase::verification {

namespace {

/// Whether f = c g for a constant c.
bool proportional(const Polynomial<2>& f, const Polynomial<2>& g) {
  if (f == g) return true;
  if (f.terms().size() != g.terms().size() || f.is_zero()) return false;
  const Rational ratio = f.terms()[0].coefficient / g.terms()[0].coefficient;
  for (std::size_t k = 0; k < f.terms().size(); ++k)
    if (f.terms()[k].exponent != g.terms()[k].exponent ||
        f.terms()[k].coefficient != ratio * g.terms()[k].coefficient)
      return false;
  return true;
}

/// The indices of the functions in a list that are polynomials, or of those that are none.
template <class Named>
std::vector<int> of_kind(const std::vector<Named>& list, bool polynomials) {
  std::vector<int> indices;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (list[k].function.is_polynomial() == polynomials) indices.push_back(static_cast<int>(k));
  return indices;
}

const Function<2>& input_function(const Encasement& e, int i) {
  return e.input[static_cast<std::size_t>(i)].function;
}
const Curve& curve_at(const Encasement& e, int c) { return e.curves[static_cast<std::size_t>(c)]; }

/// Whether the curves are, up to constants, the input curves one by one: of those that are
/// polynomials.
bool one_to_one(const Encasement& e, const std::vector<int>& inputs,
                const std::vector<int>& curves) {
  std::set<int> seen;
  for (const int c : curves) {
    const Curve& curve = curve_at(e, c);
    if (curve.sources.size() != 1 || !seen.insert(curve.sources[0]).second) return false;
    const Function<2>& source = input_function(e, curve.sources[0]);
    if (!source.is_polynomial() || !proportional(curve.function.polynomial(), source.polynomial()))
      return false;
  }
  return seen.size() == inputs.size();
}

/// The polynomials' common refinement assigns every irreducible factor its sources.
void check_factors(Claims& claims, std::set<int>* repeated) {
  const Encasement& e = claims.result;
  const std::vector<int> all_inputs = of_kind(e.input, true), all_curves = of_kind(e.curves, true);
  const bool generic = one_to_one(e, all_inputs, all_curves);
  std::vector<Polynomial<2>> polynomials;
  if (!generic)
    for (const int i : all_inputs) polynomials.push_back(input_function(e, i).polynomial());
  const std::size_t first_curve = polynomials.size();
  for (const int c : all_curves) polynomials.push_back(curve_at(e, c).function.polynomial());

  for (const auto& element : coprime_square_free_base(polynomials)) {
    std::vector<int> inputs, curves;
    for (const auto& source : element.sources) {
      const auto k = static_cast<std::size_t>(source.index);
      if (k < first_curve) {
        inputs.push_back(all_inputs[k]);
        if (source.multiplicity > 1) repeated->insert(inputs.back());
      } else {
        curves.push_back(all_curves[k - first_curve]);
        claims.require(source.multiplicity == 1, "Curve ", curves.back(),
                       " has a repeated component.");
      }
    }
    // Every factor in one curve alone: the curves are coprime, and no component is missing.
    if (curves.size() > 1)
      claims.require(false, "Curves ", curves[0], " and ", curves[1], " share a component.");
    else if (curves.empty())
      claims.require(false, "A component of input curve ", inputs[0], " is in no curve.");
    else if (!generic)
      claims.require(inputs == curve_at(e, curves[0]).sources, "Curve ", curves[0],
                     " does not have the components that its sources say.");
  }
}

/// What is no polynomial is taken as it is, equal ones once. (That they have no component in
/// common, and none twice, is not known beforehand: where they had one, no cover could be proved.)
void check_others(Claims& claims) {
  const Encasement& e = claims.result;
  std::vector<int> count(e.input.size(), 0);
  for (const int c : of_kind(e.curves, false)) {
    std::vector<int> equal;
    for (const int i : of_kind(e.input, false))
      if (input_function(e, i) == curve_at(e, c).function) equal.push_back(i);
    for (const int i : equal) ++count[static_cast<std::size_t>(i)];
    claims.require(equal == curve_at(e, c).sources, "Curve ", c,
                   " is not the function of its sources, or not of them alone.");
  }
  for (const int i : of_kind(e.input, false))
    claims.require(count[static_cast<std::size_t>(i)] == 1, "The function of input curve ", i,
                   " is not that of one curve.");
}

/// The reported components are those there are.
void check_components(Claims& claims, const std::set<int>& repeated) {
  const Encasement& e = claims.result;
  using Kind = Unresolved::Kind;
  for (const Unresolved& u : e.undecided)
    claims.require(u.kind != Kind::SharedComponent && u.kind != Kind::RepeatedComponent,
                   "A shared or repeated component is listed as undecided.");
  std::set<int> reported;
  std::set<std::pair<int, int>> reported_pairs;
  for (std::size_t i = 0; i < e.degenerate.size() && !claims.full(); ++i) {
    const Unresolved& u = e.degenerate[i];
    if (u.kind == Kind::RepeatedComponent) {
      reported.insert(u.curves.begin(), u.curves.end());
      claims.require(!u.curves.empty() && std::includes(repeated.begin(), repeated.end(),
                                                        u.curves.begin(), u.curves.end()),
                     "Degenerate entry ", i, " reports a repeated component that is not there.");
    }
    if (u.kind == Kind::SharedComponent) {
      for (std::size_t k = 0; k < u.curves.size(); ++k)
        for (std::size_t l = 0; l < k; ++l) reported_pairs.insert({u.curves[l], u.curves[k]});
      const bool shared =
          u.curves.size() > 1 && std::any_of(e.curves.begin(), e.curves.end(), [&](const Curve& c) {
            return std::includes(c.sources.begin(), c.sources.end(), u.curves.begin(),
                                 u.curves.end());
          });
      claims.require(shared, "Degenerate entry ", i,
                     " reports a shared component that is not there.");
    }
  }
  for (int k : repeated)
    claims.require(reported.count(k) > 0, "The repeated component of input curve ", k,
                   " is not reported.");
  for (const Curve& curve : e.curves)
    for (std::size_t k = 0; k < curve.sources.size(); ++k)
      for (std::size_t l = 0; l < k; ++l)
        claims.require(reported_pairs.count({curve.sources[l], curve.sources[k]}) > 0,
                       "The component that input curves ", curve.sources[l], " and ",
                       curve.sources[k], " share is not reported.");
}

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
  std::set<int> repeated;
  check_factors(claims, &repeated);
  check_others(claims);
  check_components(claims, repeated);
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
