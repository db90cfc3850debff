// SPDX-License-Identifier: MIT
#include "2d/curve_piece.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "common/interval.hpp"

namespace encase {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies
constexpr double kUnderflow = 0x1p-900;
constexpr double kChordError = 0x1p-47;  // of alpha + beta s, see docs/tracing.md

/// The relative error after so many roundings.
constexpr double roundings(int count) { return 1.02 * 0x1p-53 * count; }

/// A polynomial around a point: sum of c[i][j] s^i t^j.
struct Expansion {
  int degree = 0;
  alignas(64) std::array<std::array<double, Tile::kRow>, Tile::kRow> c;
};

using Rows = std::array<std::array<double, Tile::kRow>, Tile::kRow>;

/// Replaces the variable whose powers the rows belong to by itself plus o, by Horner's scheme. The
/// terms have total degree up to `degree`.
void shift_rows(double o, int degree, Rows* rows) {
  for (int k = 0; k < degree; ++k)
    for (int i = degree - 1; i >= k; --i) {
      auto &to = (*rows)[i], &from = (*rows)[i + 1];
      const int lanes = degree - i <= 8 ? 8 : Tile::kRow;
      for (int j = 0; j < lanes; ++j) to[j] += o * from[j];
    }
}

/// The polynomial of a tile around the point o of the tile's coordinates. Its first variable is the
/// tile's `axis`.
void shift(const Tile& tile, const Point<2>& o, int axis, Expansion* expansion) {
  const int m = tile.degree;
  expansion->degree = m;
  Rows turned;
  for (int j = 0; j < Tile::kRow; ++j)
    for (int i = 0; i < Tile::kRow; ++i) turned[j][i] = axis == 0 ? tile.a[i][j] : tile.a[j][i];
  shift_rows(o[1 - axis], m, &turned);
  for (int i = 0; i < Tile::kRow; ++i)
    for (int j = 0; j < Tile::kRow; ++j) expansion->c[i][j] = turned[j][i];
  shift_rows(o[axis], m, &expansion->c);
}

/// Replaces s by s * half[0] and t by t * half[1].
void scale(const Point<2>& half, Expansion* expansion) {
  double along = 1;
  for (int i = 0; i <= expansion->degree; ++i, along *= half[0]) {
    double both = along;
    for (int j = 0; i + j <= expansion->degree; ++j, both *= half[1]) expansion->c[i][j] *= both;
  }
}

/// Sums of absolute values of coefficients.
struct Sums {
  double all = 0;
  double high = 0;   ///< of the terms of degree 3 and more
  double slope = 0;  ///< of the derivative in t but for its constant term
};
Sums sums_of(const Expansion& e) {
  Sums sums;
  for (int i = 0; i <= e.degree; ++i)
    for (int j = 0; i + j <= e.degree; ++j) {
      const double size = std::fabs(e.c[i][j]);
      sums.all += size;
      if (i + j >= 3) sums.high += size;
      if (i > 0 || j > 1) sums.slope += j * size;
    }
  sums.all *= kUp;
  sums.high *= kUp;
  sums.slope *= kUp;
  return sums;
}

double value_at(const Expansion& e, double s, double t) {
  double value = 0;
  for (int i = e.degree; i >= 0; --i) {
    double row = 0;
    for (int j = e.degree - i; j >= 0; --j) row = row * t + e.c[i][j];
    value = value * s + row;
  }
  return value;
}

/// Bounds the absolute value, for |s| <= 1, of the terms up to degree 2 on the line t = alpha +
/// beta s, but for roundings.
double largest_on_line(const Expansion& e, double alpha, double beta) {
  double c0 = e.c[0][0] + e.c[0][1] * alpha, c1 = e.c[1][0] + e.c[0][1] * beta, c2 = 0;
  if (e.degree >= 2) {
    c0 += e.c[0][2] * alpha * alpha;
    c1 += e.c[1][1] * alpha + 2 * e.c[0][2] * alpha * beta;
    c2 = e.c[2][0] + (e.c[1][1] + e.c[0][2] * beta) * beta;
  }
  // (c0 + c2) + c1 s at its ends, and c2 (s^2 - 1).
  return std::fabs(c0 + c2) + std::fabs(c1) + std::fabs(c2);
}

bool inside(const Box<2>& box, const Point<2>& center, const Point<2>& half) {
  for (int k = 0; k < 2; ++k)
    if (!(round_up(center[k] - half[k]) <= box.lo[k] &&
          box.hi[k] <= round_down(center[k] + half[k])))
      return false;
  return true;
}

double clamped(double factor, double least, double most) {
  return std::isnan(factor) ? least : std::clamp(factor, least, most);
}

}  // namespace

bool Tube::may_meet(const Box<2>& box) const {
  // Coordinates and products of numbers up to `size` in absolute value, a few roundings each.
  double s[2], t[2], size = 2;
  for (const int end : {0, 1}) {
    const Point<2>& p = end == 0 ? box.lo : box.hi;
    s[end] = (p[axis] - center[axis]) / half[axis];
    t[end] = (p[1 - axis] - center[1 - axis]) / half[1 - axis];
    size = std::max({size, std::fabs(s[end]), std::fabs(t[end])});
  }
  const double margin = 0x1p-46 * size;
  if (s[1] < from - margin || s[0] > to + margin) return false;
  const double p = alpha + beta * s[0], q = alpha + beta * s[1];
  return !(t[1] < std::min(p, q) - delta - margin || t[0] > std::max(p, q) + delta + margin);
}

/// What is asked of a tile.
struct PieceProver::Question {
  const CurvePoint& from;
  const CurvePoint& to;
  bool free;
  int axis;
  int direction;
  double goal;
  Point<2> center;
  Point<2> half;  ///< of both ends with their boxes, around the centre
};

PieceProver::Fit PieceProver::try_with(const Tile& tile, const Question& q,
                                       Attempt* attempt) const {
  *attempt = {};
  attempt->factor = 0.5;
  attempt->to = q.to;
  if (tile.degree < 1) return Fit::Noisy;
  const int u = q.axis, v = 1 - q.axis, m = tile.degree;
  Point<2> o, part;  // in the tile's coordinates: the centre, and the half widths
  for (int k = 0; k < 2; ++k) o[k] = (q.center[k] - tile.center[k]) / tile.half[k];
  if (!(std::fabs(o[0]) <= 1 + 0x1p-11) || !(std::fabs(o[1]) <= 1 + 0x1p-11)) return Fit::Outside;
  Expansion e;
  shift(tile, o, u, &e);

  // A rectangle with room for what the curve bends.
  Tube& tube = attempt->tube;
  tube.axis = u;
  tube.center = q.center;
  const double du = 0.5 * (q.to.point[u] - q.from.point[u]) / tile.half[u];
  const double dv = 0.5 * (q.to.point[v] - q.from.point[v]) / tile.half[v];
  const double bend = m < 2 ? 0 : e.c[2][0] * du * du + (e.c[1][1] * du + e.c[0][2] * dv) * dv;
  const double lost = roundings(5 * m + 8);
  const double error = (tile.error + lost * tile.sum) * kUp + kUnderflow;
  const double noise = error / std::fabs(e.c[0][1]) * tile.half[v];
  const double room = 3 * (std::fabs(bend / e.c[0][1]) * tile.half[v] + noise);
  if (room > 4 * std::max(q.half[u], q.half[v])) {
    if (getenv("TR2") && noise > room / 6)
      fprintf(stderr,
              "NOISYROOM  tile half %g bits %d error %g (tile %g sum %g)  noise %g goal %g half %g "
              "%g room %g\n",
              tile.half[0], tile.bits, error, tile.error, tile.sum, noise, q.goal, q.half[0],
              q.half[1], room);
    return noise > room / 6 ? Fit::Noisy : Fit::Good;
  }
  tube.half[u] = q.half[u] * (1 + 0x1p-6);
  tube.half[v] = q.half[v] * (1 + 0x1p-6) + (std::isfinite(room) ? room : 0) + 0x1p-10 * q.half[u];
  for (int k = 0; k < 2; ++k) {
    part[k] = tube.half[k] / tile.half[k];
    if (!(std::fabs(o[k]) + part[k] <= 1 + 0x1p-11)) return Fit::Outside;
  }
  if (!inside(q.from.box, tube.center, tube.half) || !inside(q.to.box, tube.center, tube.half))
    return Fit::Good;
  scale({part[u], part[v]}, &e);
  const Sums sums = sums_of(e);
  const double slope_error = part[v] * (tile.slope_error + lost * tile.slope) * kUp + kUnderflow;
  const double steepness = std::fabs(e.c[0][1]);
  // Where the coefficients alone forbid a proof, it does not matter how precise they are.
  Fit fit = slope_error <= 0.125 * std::max(steepness, sums.slope) ? Fit::Good : Fit::Noisy;
  if (!(steepness > sums.slope)) {
    attempt->factor = clamped(0.8 * steepness / sums.slope, 0.1, 0.6);
    if (getenv("TR2") && (fit == Fit::Noisy))
      fprintf(stderr,
              "NOISYCOARSE  tile half %g bits %d error %g (tile %g sum %g) steep %g slope %g "
              "slope_error %g noise %g goal %g half %g %g room %g sumsall %g\n",
              tile.half[0], tile.bits, error, tile.error, tile.sum, steepness, sums.slope,
              slope_error, noise, q.goal, q.half[0], q.half[1], room, sums.all);
    return fit;
  }
  if (!(noise <= 0.125 * std::min(q.goal, q.half[u]))) fit = Fit::Noisy;

  if (getenv("TR2") && (fit == Fit::Noisy))
    fprintf(stderr,
            "NOISY  tile half %g bits %d error %g (tile %g sum %g) steep %g slope %g slope_error "
            "%g noise %g goal %g half %g %g room %g sumsall %g\n",
            tile.half[0], tile.bits, error, tile.error, tile.sum, steepness, sums.slope,
            slope_error, noise, q.goal, q.half[0], q.half[1], room, sums.all);
  // The curve is a graph if it has points at all.
  const double least_slope =
      (steepness - sums.slope - slope_error) * (1 - 0x1p-40) - roundings(8) * sums.all;
  if (!(least_slope > 0)) return fit;
  // It is beside the chord.
  Point<2> from = q.from.point;
  CurvePoint& to = attempt->to;
  double s[2], t[2], value = 0;
  for (const int end : {0, 1}) {
    Point<2>& p = end == 0 ? from : to.point;
    s[end] = (p[u] - tube.center[u]) / tube.half[u];
    t[end] = (p[v] - tube.center[v]) / tube.half[v];
    if (end == 0 || !q.free) continue;
    // To where this tile sees the curve, and then to where it is.
    constexpr int kIterations = 2;
    for (int k = 0; k < kIterations; ++k) t[1] -= value_at(e, s[1], t[1]) / e.c[0][1];
    p[v] = tube.center[v] + t[1] * tube.half[v];
    value = f_.value(p);
    const double change = value / e.c[0][1] * tube.half[v];
    if (std::fabs(change) > 0x1p-50 * std::fabs(p[v]) && std::fabs(change) < tube.half[v]) {
      p[v] -= change;
      value = f_.value(p);
    }
    t[1] = (p[v] - tube.center[v]) / tube.half[v];
  }
  if (!(std::fabs(s[1] - s[0]) >= 1)) return fit;
  tube.beta = (t[1] - t[0]) / (s[1] - s[0]);
  tube.alpha = t[0] - tube.beta * s[0];
  const double largest = (largest_on_line(e, tube.alpha, tube.beta) + sums.high + error) * kUp +
                         roundings(64) * sums.all;
  tube.delta = largest / least_slope * kUp + kChordError;
  if (!(std::fabs(tube.alpha) + std::fabs(tube.beta) + tube.delta <= 1 - 0x1p-40)) return fit;

  // The end's box, if it has none.
  if (q.free) {
    const double residue = (std::fabs(value) * (1 + 0x1p-51) + tile.value_error) * kUp;
    const double away = residue / least_slope * kUp;
    if (!(std::fabs(t[1]) + away <= 1 - 0x1p-40)) return fit;
    const double reach = away * tube.half[v] * kUp;
    to.box = {to.point, to.point};
    to.box.lo[v] = round_down(to.point[v] - reach);
    to.box.hi[v] = round_up(to.point[v] + reach);
  }

  // In the right direction: positive values are to the left of (f_y, -f_x).
  const bool grows = q.from.point[u] < q.to.point[u];
  const bool slope_positive = e.c[0][1] > 0;
  const bool left = u == 0 ? grows == slope_positive : grows != slope_positive;
  const bool apart = grows ? q.from.box.hi[u] < to.box.lo[u] : to.box.hi[u] < q.from.box.lo[u];
  if (left != (q.direction > 0) || !apart) return fit;

  double slack = 0;
  for (const CurvePoint* p : {&q.from, static_cast<const CurvePoint*>(&to)})
    slack = std::max({slack, p->box.hi[u] - p->point[u], p->point[u] - p->box.lo[u]});
  const Box<2> ends = hull(q.from.box, to.box);
  tube.from = (ends.lo[u] - tube.center[u]) / tube.half[u];
  tube.to = (ends.hi[u] - tube.center[u]) / tube.half[u];
  const double incline = std::fabs(tube.beta) * tube.half[v] / tube.half[u];
  attempt->proved = true;
  attempt->piece = {u, q.direction,
                    (tube.delta * tube.half[v] + (1 + incline) * slack) * kUp + kUnderflow};
  attempt->factor = clamped(0.9 * std::sqrt(q.goal / attempt->piece.distance), 0.1, 3);
  return fit;
}

/// Makes a tile of its own around the chord; false if it is no better than the one there is.
bool PieceProver::expand_around(const Question& q, double reach, int bits) {
  Box<2> box;
  for (int k = 0; k < 2; ++k) {
    box.lo[k] = q.center[k] - reach;
    box.hi[k] = q.center[k] + reach;
    if (!(box.lo[k] < q.center[k] && q.center[k] < box.hi[k])) return false;
  }
  f_.expand(box, bits, &own_);
  return true;
}

Attempt PieceProver::prove(const CurvePoint& from, const CurvePoint& to, bool free, int axis,
                           int direction, double goal) {
  Question q{from, to, free, axis, direction, goal, {}, {}};
  Box<2> ends = hull(hull(from.box, to.box),
                     hull(Box<2>{from.point, from.point}, Box<2>{to.point, to.point}));
  q.center = ends.center();
  double size = 0;
  for (int k = 0; k < 2; ++k) {
    q.half[k] = std::max(q.center[k] - ends.lo[k], ends.hi[k] - q.center[k]);
    size = std::max(size, q.half[k]);
  }
  Attempt attempt;
  if (own_holds(q.center) && try_with(own_, q, &attempt) == Fit::Good) return attempt;
  const Tile& shared = f_.at(q.center);
  if (try_with(shared, q, &attempt) == Fit::Good) return attempt;
  // Around many pieces to come, then around this one alone, with more and more bits.
  const double small = 2 * size, large = std::clamp(goal * 0x1p40, small, 64 * size);
  const double served = 0.5 * std::min(shared.half[0], shared.half[1]);
  if (small > served || !expand_around(q, std::min(large, served), Kernel::kDoubleBits) ||
      try_with(own_, q, &attempt) == Fit::Good)
    return attempt;
  for (int bits = Kernel::kDoubleBits; bits > 0; bits = kernel_.next(bits))
    if (!expand_around(q, small, bits) || try_with(own_, q, &attempt) != Fit::Noisy) return attempt;
  return attempt;
}

bool PieceProver::own_holds(const Point<2>& point) const {
  return own_.degree >= 0 && std::fabs(point[0] - own_.center[0]) <= own_.half[0] &&
         std::fabs(point[1] - own_.center[1]) <= own_.half[1];
}

ValueAndGradient PieceProver::look_at(const Point<2>& point) {
  const Tile& tile = own_holds(point) ? own_ : f_.at(point);
  Point<2> s;
  for (int k = 0; k < 2; ++k) s[k] = (point[k] - tile.center[k]) / tile.half[k];
  const auto [value, slope_0, slope_1] = value_and_gradient(tile, s);
  return {value, {slope_0 / tile.half[0], slope_1 / tile.half[1]}};
}

}  // namespace encase
