// SPDX-License-Identifier: MIT
#include "3d/arc_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "3d/space_vectors.hpp"

namespace encase {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Outweighs the roundings of a few operations, and of a basis that is orthonormal up to them.
constexpr double kUp = 1 + 0x1p-40;
/// How far the planes across a chord reach beyond its ends, at most, as a part of its length.
constexpr double kMostOverhang = 1.0 / 16;

/// The largest distance of a point of the box from the point.
double radius(const SpacePoint& p) {
  Point<3> reach;
  for (int i = 0; i < 3; ++i)
    reach[i] = std::max(std::fabs(p.box.hi[i] - p.point[i]), std::fabs(p.point[i] - p.box.lo[i]));
  return length(reach) * kUp;
}

/// A box around the point that reaches `by` in every coordinate.
Box<3> box_around(const Point<3>& p, double by) { return inflated({p, p}, by); }

using Pair = std::array<Interval, 2>;

}  // namespace

/// The chord from p to q as one axis of coordinates p + t (q - p) + a u + b v.
struct ArcTracer::Chord {
  Point<3> p, q, d, u, v;
  double length;

  Chord(const Point<3>& from, const Point<3>& to)
      : p(from), q(to), d(to - from), length(encase::length(d)) {
    const auto basis = across(unit(d));
    u = basis[0];
    v = basis[1];
  }
  /// A lower bound of t on a box.
  double least_t(const Box<3>& box) const {
    Interval sum(0);
    for (int i = 0; i < 3; ++i)
      sum = sum + (Interval(box.lo[i], box.hi[i]) - Interval(p[i])) * d[i];
    return (sum / (Interval(length) * length)).lo - 0x1p-40;
  }
};

struct ArcTracer::Attempt {
  bool proved = false;
  double distance = kInfinity;  ///< of the piece
  SpacePoint to;                ///< the end, with its box
  /// By which the chord's length is to be multiplied, to have the distance wished or for another
  /// attempt.
  double factor = 0.5;
  bool drowned = false;  ///< more bits may help
};

/// That the curve has exactly one point in every plane across the chord, near it.
///
/// With F = (f, g), let D be its derivatives along u and v, Y the inverse of D in the middle, and
/// |I - Y D| <= k < 1 on a box B (rows may be taken at different points). Then a plane t = const
/// has at most one zero of F in B, and if |Y F| <= r at the chord's point there, one within r / (1
/// - k) of it in a and b, as long as that stays in B. The zeros form a curve along which t grows.
ArcTracer::Attempt ArcTracer::prove(const SpacePoint& from, const SpacePoint& to, bool free,
                                    const SpacePoint* beyond, int sense, double tolerance,
                                    int bits) {
  Attempt attempt;
  attempt.to = to;
  const Chord chord(from.point, to.point);
  const double reach = std::max(radius(from), free ? 0.0 : radius(to));
  const double overhang = kUp * reach / chord.length;
  if (!(overhang <= kMostOverhang)) return attempt;

  Box<3> along = hull(Box<3>{from.point, from.point}, {to.point, to.point});
  const double pad =
      std::min(1.5 * tolerance, 0.25 * chord.length) + 2 * reach + kMostOverhang * chord.length;
  const Box<3> box = inflated(along, pad);
  if (!box.contains(from.box) || !(free || box.contains(to.box))) return attempt;

  const DerivativeRanges df = f_.derivatives(box, bits, kernel_);
  const DerivativeRanges dg = g_.derivatives(box, bits, kernel_);
  const IntervalVector u = exactly(chord.u), v = exactly(chord.v);
  const Pair fs{dot(df.first, u), dot(df.first, v)};
  const Pair gs{dot(dg.first, u), dot(dg.first, v)};
  // The inverse of the middle, in doubles.
  const double a = fs[0].mid(), b = fs[1].mid(), c = gs[0].mid(), d = gs[1].mid();
  const double det = a * d - b * c;
  const double y[2][2] = {{d / det, -b / det}, {-c / det, a / det}};
  // Where |I - Y D| < 1, D has a determinant of the sign of Y's, which is that of (grad f x grad g)
  // . (u x v): whether t grows along the curve.
  const auto turn = (Interval(y[0][0]) * y[1][1] - Interval(y[0][1]) * y[1][0]).sign();
  if (!turn || *turn != sign_of(sense)) return attempt;
  double k = 0;
  for (int i = 0; i < 2; ++i) {
    double row = 0;
    for (int j = 0; j < 2; ++j)
      row += magnitude(Interval(i == j) - (Interval(y[i][0]) * fs[j] + Interval(y[i][1]) * gs[j]));
    k = std::max(k, row * kUp);
  }
  if (!(k < 0.5)) {
    attempt.factor = std::isfinite(k) ? std::clamp(0.4 / k, 0.125, 0.7) : 0.25;
    return attempt;
  }
  const double amplify = kUp / (1 - k);

  // Y F at the ends, and what it can differ from the linear function between them.
  const auto ends = [&](const Point<3>& at) {
    return Pair{f_.value(at, bits), g_.value(at, bits)};
  };
  const Pair at_p = ends(chord.p), at_q = ends(chord.q);
  IntervalVector step;
  for (int i = 0; i < 3; ++i) step[i] = Interval(chord.q[i]) - Interval(chord.p[i]);
  const Interval bend_f = df.second_along(step), bend_g = dg.second_along(step);
  double r = 0, r_end = 0, noise = 0;
  for (int i = 0; i < 2; ++i) {
    const auto combined = [&](const Interval& of_f, const Interval& of_g) {
      return Interval(y[i][0]) * of_f + Interval(y[i][1]) * of_g;
    };
    const Interval yp = combined(at_p[0], at_p[1]), yq = combined(at_q[0], at_q[1]);
    const double end = std::max(magnitude(yp), magnitude(yq));
    const double arc = 0.125 * magnitude(combined(bend_f, bend_g));
    r = std::max(r, ((1 + 2 * overhang) * end + arc) * kUp);
    r_end = std::max(r_end, magnitude(yq));
    noise = std::max({noise, yp.width(), yq.width()});
  }
  const double delta = r * amplify;
  attempt.drowned = noise > 0.1 * tolerance;
  attempt.distance = std::sqrt(2.0) * kUp * delta + overhang * chord.length * kUp;
  attempt.factor = std::clamp(0.9 * std::sqrt(tolerance / attempt.distance), 0.125, 2.0);
  // The zeros stay in B: B reaches pad beyond the chord, of which the overhang is a part.
  if (!(2 * delta * kUp + overhang * chord.length < pad * (1 - 0x1p-40))) {
    attempt.factor = std::min(attempt.factor, 0.7);
    return attempt;
  }
  if (free) {
    attempt.to.box = box_around(to.point, 2 * r_end * amplify);
  }
  // The way does not yet come to its end.
  if (beyond && box.meets(beyond->box) &&
      !(chord.least_t(beyond->box) > 1 + kUp * radius(attempt.to) / chord.length)) {
    attempt.factor = 0.5;
    return attempt;
  }
  attempt.proved = attempt.distance <= tolerance;
  return attempt;
}

ArcTracer::Attempt ArcTracer::prove(const SpacePoint& from, const SpacePoint& to, bool free,
                                    const SpacePoint* beyond, int sense, double tolerance) {
  Attempt attempt = prove(from, to, free, beyond, sense, tolerance, Kernel::kDoubleBits);
  for (int bits : {128, 256})
    if (!attempt.proved && attempt.drowned && bits <= kernel_.max_bits)
      attempt = prove(from, to, free, beyond, sense, tolerance, bits);
  return attempt;
}

Sign ArcTracer::sense(const Box<3>& box, const Point<3>& w) {
  for (int bits = Kernel::kDoubleBits; bits > 0; bits = kernel_.next(bits)) {
    const IntervalVector f = f_.gradient(box, bits, kernel_), g = g_.gradient(box, bits, kernel_);
    const IntervalVector t{f[1] * g[2] - f[2] * g[1], f[2] * g[0] - f[0] * g[2],
                           f[0] * g[1] - f[1] * g[0]};
    const auto sign = dot(t, exactly(w)).sign();
    if (sign && *sign != Sign::Zero) return *sign;
    if (bits >= 256) break;
  }
  return Sign::Zero;
}

Point<3> ArcTracer::tangent(const Point<3>& point) const {
  return unit(cross(f_.function().gradient(point), g_.function().gradient(point)));
}

/// Newton's iteration in the plane across a direction.
Point<3> ArcTracer::on_curve(Point<3> point, const Point<3>& along) const {
  for (int step = 0; step < 8; ++step) {
    const auto f = f_.function().value_and_gradient(point);
    const auto g = g_.function().value_and_gradient(point);
    const Point<3> gh = cross(g.gradient, along), hf = cross(along, f.gradient);
    const double det = dot(f.gradient, gh);
    if (det == 0 || !std::isfinite(det)) break;
    const Point<3> move = (-1 / det) * (f.value * gh + g.value * hf);
    if (!std::isfinite(length(move))) break;
    point = point + move;
    if (length(move) <= 0x1p-50 * size_) break;
  }
  return point;
}

SpacePath ArcTracer::trace(const SpacePoint& from, const SpacePoint& to, int sense,
                           double tolerance, int most) {
  SpacePath path;
  path.points.push_back(from);
  double step = 0.05 * size_;
  const double least = 0x1p-45 * size_;
  bool lost = false;
  while (!lost && static_cast<int>(path.distances.size()) < most) {
    const SpacePoint here = path.points.back();
    const double left = length(to.point - here.point);
    // The end, if it is ahead and near.
    if (left <= step) {
      const Attempt last = prove(here, to, false, nullptr, sense, tolerance);
      if (last.proved) {
        path.points.push_back(to);
        path.distances.push_back(last.distance);
        return path;
      }
      step = std::min(step, left) * std::min(last.factor, 0.7);
    } else if (left < 1.5 * step) {
      step = 0.5 * left;
    }
    for (;;) {
      if (!(step > least)) {
        lost = true;
        break;
      }
      const Point<3> along = sense * tangent(here.point);
      SpacePoint next;
      next.point = on_curve(here.point + step * along, along);
      const bool plausible = length(next.point - here.point) < 2 * step &&
                             length(next.point - here.point) > 0.5 * step;
      const Attempt attempt =
          plausible ? prove(here, next, true, &to, sense, tolerance) : Attempt();
      if (attempt.proved) {
        path.points.push_back(attempt.to);
        path.distances.push_back(attempt.distance);
        step *= std::max(attempt.factor, 0.5);
        break;
      }
      step *= std::min(attempt.factor, 0.7);
    }
  }
  path.points.push_back(to);
  path.distances.push_back(kInfinity);
  return path;
}

}  // namespace encase
