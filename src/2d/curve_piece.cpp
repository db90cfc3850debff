// SPDX-License-Identifier: MIT
#include "2d/curve_piece.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/interval.hpp"

namespace encase {
namespace {

constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies
constexpr double kUnderflow = 0x1p-900;
constexpr double kReach = 1 + 0x1p-11;   // of a tile, with room for roundings
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

/// Replaces t by t + slope * s, by Horner's scheme among the terms of each degree.
void shear(double slope, Expansion* e) {
  auto& c = e->c;
  for (int d = 1; d <= e->degree; ++d)
    for (int k = 0; k < d; ++k)
      for (int j = d - 1; j >= k; --j) c[d - j][j] += slope * c[d - j - 1][j + 1];
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

double clamped(double factor, double least, double most) {
  return std::isnan(factor) ? least : std::clamp(factor, least, most);
}

}  // namespace

Interval Tube::along(const Box<2>& box) const {
  const double low = (box.lo[axis] - center[axis]) / half[axis],
               high = (box.hi[axis] - center[axis]) / half[axis];
  const double margin = 0x1p-49 * std::max(std::fabs(low), std::fabs(high));
  return {low - margin, high + margin};
}

Interval Tube::across(const Box<2>& box) const {
  const int v = 1 - axis;
  Interval result(HUGE_VAL, -HUGE_VAL);
  for (const double p : {box.lo[axis], box.hi[axis]})
    for (const double q : {box.lo[v], box.hi[v]}) {
      const double straight = q - center[v], inclined = slope * (p - center[axis]);
      const double t = (straight - inclined) / half[v];
      const double margin =
          0x1p-49 * (std::fabs(straight) + std::fabs(inclined)) / half[v] + 0x1p-900;
      result.lo = std::min(result.lo, t - margin);
      result.hi = std::max(result.hi, t + margin);
    }
  return result;
}

bool Tube::holds(const Box<2>& box) const {
  const Interval s = along(box), t = across(box);
  return -1 <= s.lo && s.hi <= 1 && -1 <= t.lo && t.hi <= 1;
}

bool Tube::may_meet(const Box<2>& box) const {
  const Interval s = along(box), t = across(box);
  if (s.hi < from - 0x1p-48 || s.lo > to + 0x1p-48) return false;
  const double p = alpha + beta * s.lo, q = alpha + beta * s.hi;
  const double margin = delta + 0x1p-50 * (std::fabs(p) + std::fabs(q) + 1);
  return !(t.hi < std::min(p, q) - margin || t.lo > std::max(p, q) + margin);
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
  Point<2> half;     ///< of both ends with their boxes, around the centre
  double thickness;  ///< the largest distance, in a coordinate, of a box from its point
};

/// One attempt with one tile. Its steps fill in `attempt`.
class PieceProver::Trial {
 public:
  Trial(const TiledFunction& f, const Tile& tile, const Question& question, Attempt* attempt)
      : f_(f),
        tile_(tile),
        q_(question),
        u_(question.axis),
        v_(1 - question.axis),
        attempt_(*attempt),
        tube_(attempt->tube),
        to_(attempt->to) {
    *attempt = {};
    attempt->factor = 0.5;
    to_ = q_.to;
    tube_.axis = u_;
    tube_.center = q_.center;
  }

  Fit run() {
    if (tile_.degree < 1) return Fit::Noisy;
    if (const std::optional<Fit> misfit = expand()) return *misfit;
    const Fit fit = weigh();
    if (least_slope_ > 0 && lay_line() && (!q_.free || enclose_end()) && runs_right()) conclude();
    return fit;
  }

 private:
  /// The polynomial in a rectangle with room for what the curve bends; nothing if that is done.
  std::optional<Fit> expand() {
    Point<2> o, part;  // in the tile's coordinates: the centre, and the half widths
    for (int k = 0; k < 2; ++k) {
      o[k] = (q_.center[k] - tile_.center[k]) / tile_.half[k];
      if (!(std::fabs(o[k]) <= kReach)) return Fit::Outside;
    }
    shift(tile_, o, u_, &e_);
    // In a parallelogram along the chord.
    const double du = 0.5 * (q_.to.point[u_] - q_.from.point[u_]) / tile_.half[u_];
    const double dv = 0.5 * (q_.to.point[v_] - q_.from.point[v_]) / tile_.half[v_];
    const double incline = dv / du;
    if (!(std::fabs(incline) <= 0x1p20)) return Fit::Good;
    shear(incline, &e_);
    tube_.slope = incline * tile_.half[v_] / tile_.half[u_];
    const auto& c = e_.c;
    double bend = 0, power = du;
    for (int i = 2; i <= e_.degree; ++i) bend += std::fabs(c[i][0] * (power *= du));
    lost_ = roundings(8 * e_.degree + 16);
    error_ = (tile_.error + lost_ * tile_.sum) * kUp + kUnderflow;
    const double across = tile_.half[v_] / std::fabs(c[0][1]);
    noise_ = error_ * across;
    const double room = 3 * (bend * across + noise_);
    if (!(room <= 4 * std::max(q_.half[u_], q_.half[v_])))
      return noise_ > bend * across ? Fit::Noisy : Fit::Good;
    tube_.half[u_] = q_.half[u_] * (1 + 0x1p-6);
    tube_.half[v_] = q_.thickness * (1 + std::fabs(tube_.slope)) * (1 + 0x1p-6) + room +
                     0x1p-20 * (q_.half[u_] + q_.half[v_]);
    for (int k = 0; k < 2; ++k) part[k] = tube_.half[k] / tile_.half[k];
    if (!(std::fabs(o[u_]) + part[u_] <= kReach) ||
        !(std::fabs(o[v_]) + std::fabs(incline) * part[u_] + part[v_] <= kReach))
      return Fit::Outside;
    if (!tube_.holds(q_.from.box) || !tube_.holds(q_.to.box)) return Fit::Good;
    scale({part[u_], part[v_]}, &e_);
    chord_error_ = kChordError * (1 + 2 * std::fabs(incline) * part[u_] / part[v_]);
    slope_error_ = part[v_] * (tile_.slope_error + lost_ * tile_.slope) * kUp + kUnderflow;
    return std::nullopt;
  }

  /// How steep the polynomial is across the axis, at least, and whether the tile's errors matter.
  Fit weigh() {
    sums_ = sums_of(e_);
    const double steepness = std::fabs(e_.c[0][1]);
    least_slope_ =
        (steepness - sums_.slope - slope_error_) * (1 - 0x1p-40) - roundings(8) * sums_.all;
    // Where the coefficients alone forbid a proof, it does not matter how precise they are.
    const bool coarse = !(steepness > sums_.slope);
    if (coarse) attempt_.factor = clamped(0.8 * steepness / sums_.slope, 0.1, 0.6);
    const bool precise = slope_error_ <= 0.125 * std::max(steepness, sums_.slope) &&
                         (coarse || noise_ <= 0.125 * std::min(q_.goal, q_.half[u_]));
    return precise ? Fit::Good : Fit::Noisy;
  }

  /// The line through the ends, and how far the curve is from it at most. An end that is free is
  /// moved to where the curve is.
  bool lay_line() {
    for (const int end : {0, 1}) {
      const Point<2>& p = (end == 0 ? q_.from : to_).point;
      s_[end] = (p[u_] - tube_.center[u_]) / tube_.half[u_];
      t_[end] = across(p);
    }
    if (q_.free) move_end();
    if (!(std::fabs(s_[1] - s_[0]) >= 1)) return false;
    tube_.beta = (t_[1] - t_[0]) / (s_[1] - s_[0]);
    tube_.alpha = t_[0] - tube_.beta * s_[0];
    const double largest =
        (largest_on_line(e_, tube_.alpha, tube_.beta) + sums_.high + error_) * kUp +
        roundings(64) * sums_.all;
    tube_.delta = largest / least_slope_ * kUp + chord_error_;
    return std::fabs(tube_.alpha) + std::fabs(tube_.beta) + tube_.delta <= 1 - 0x1p-40;
  }

  double across(const Point<2>& p) const {
    return (p[v_] - tube_.center[v_] - tube_.slope * (p[u_] - tube_.center[u_])) / tube_.half[v_];
  }

  /// To where the tile sees the curve, and then to where it is.
  void move_end() {
    constexpr int kIterations = 2;
    for (int k = 0; k < kIterations; ++k) t_[1] -= value_at(e_, s_[1], t_[1]) / e_.c[0][1];
    double& place = to_.point[v_];
    place = tube_.center[v_] + tube_.slope * (to_.point[u_] - tube_.center[u_]) +
            t_[1] * tube_.half[v_];
    value_ = f_.value(to_.point);
    const double change = value_ / e_.c[0][1] * tube_.half[v_];
    if (std::fabs(change) > 0x1p-50 * std::fabs(place) && std::fabs(change) < tube_.half[v_]) {
      place -= change;
      value_ = f_.value(to_.point);
    }
    t_[1] = across(to_.point);
  }

  /// Gives an end that is free its box, a segment across the axis.
  bool enclose_end() {
    const double residue = (std::fabs(value_) * (1 + 0x1p-51) + tile_.value_error) * kUp;
    const double away = residue / least_slope_ * kUp;
    if (!(std::fabs(t_[1]) + away + chord_error_ <= 1 - 0x1p-40)) return false;
    const double reach = away * tube_.half[v_] * kUp + kUnderflow;
    to_.box = {to_.point, to_.point};
    to_.box.lo[v_] = round_down(to_.point[v_] - reach);
    to_.box.hi[v_] = round_up(to_.point[v_] + reach);
    return true;
  }

  /// In the direction asked, from one end's box to the other. Positive values are to the left of
  /// (f_y, -f_x).
  bool runs_right() const {
    const bool grows = q_.from.point[u_] < q_.to.point[u_];
    const bool left = (e_.c[0][1] > 0) == (grows == (u_ == 0));
    const bool apart =
        grows ? q_.from.box.hi[u_] < to_.box.lo[u_] : to_.box.hi[u_] < q_.from.box.lo[u_];
    return apart && left == (q_.direction > 0);
  }

  void conclude() {
    double slack = 0;
    for (const CurvePoint* p : {&q_.from, static_cast<const CurvePoint*>(&to_)})
      slack = std::max({slack, p->box.hi[u_] - p->point[u_], p->point[u_] - p->box.lo[u_]});
    const Box<2> ends = hull(q_.from.box, to_.box);
    tube_.from = (ends.lo[u_] - tube_.center[u_]) / tube_.half[u_];
    tube_.to = (ends.hi[u_] - tube_.center[u_]) / tube_.half[u_];
    const double incline =
        std::fabs(tube_.slope) + std::fabs(tube_.beta) * tube_.half[v_] / tube_.half[u_];
    const double distance =
        (tube_.delta * tube_.half[v_] + (1 + incline) * slack) * kUp + kUnderflow;
    attempt_.proved = true;
    attempt_.piece = {u_, q_.direction, distance};
    attempt_.factor = clamped(0.9 * std::sqrt(q_.goal / distance), 0.1, 3);
  }

  const TiledFunction& f_;
  const Tile& tile_;
  const Question& q_;
  int u_, v_;
  Attempt& attempt_;
  Tube& tube_;
  CurvePoint& to_;
  Expansion e_;  ///< in the rectangle's coordinates
  Sums sums_;
  double lost_ = 0, error_ = 0, slope_error_ = 0;
  double chord_error_ = 0;
  double noise_ = 0;  ///< what the error amounts to, in input units
  double least_slope_ = 0;
  double s_[2], t_[2];  ///< the ends
  double value_ = 0;    ///< at the end that is free
};

PieceProver::Fit PieceProver::try_with(const Tile& tile, const Question& question,
                                       Attempt* attempt) const {
  return Trial(f_, tile, question, attempt).run();
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
  Question q{from, to, free, axis, direction, goal, {}, {}, 0};
  Box<2> ends = hull(hull(from.box, to.box),
                     hull(Box<2>{from.point, from.point}, Box<2>{to.point, to.point}));
  q.center = ends.center();
  for (const CurvePoint* p : {&from, &to})
    for (int k = 0; k < 2; ++k)
      q.thickness = std::max({q.thickness, p->box.hi[k] - p->point[k], p->point[k] - p->box.lo[k]});
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
