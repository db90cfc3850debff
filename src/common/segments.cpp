// SPDX-License-Identifier: MIT
#include "common/segments.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

Interval coefficient(const Line& line, int i) {
  const double c = i < 2 ? line.normal[i] : line.offset;
  if (!line.rational) return c;
  return {round_down(round_down(c)), round_up(round_up(c))};
}

/// How many roots lie in the open interval of a net, each simple: none or one, if that is proved.
enum class Count { None, One, Unknown };

Count count_roots(const FilteredFunction<2>& f, const Bernstein<1>& net) {
  // Descartes' rule in Bernstein form: no sign variation, no root; one variation, one simple root
  // in the open interval, of a polynomial: what is only close to one has one at least. The ends
  // must have proved signs: they are the values there.
  const double r = net.radius;
  const auto sign = [r](double b) { return b > r ? 1 : b < -r ? -1 : 0; };
  int last = sign(net.b.front());
  if (last == 0 || sign(net.b.back()) == 0) return Count::Unknown;
  int variations = 0, unknown = 0;
  bool certain = true;
  for (double b : net.b) {
    const int s = sign(b);
    if (s == 0) {
      ++unknown;
      continue;
    }
    if (s != last) {
      ++variations;
      // A single unknown sign between opposite ones changes nothing, two may add variations.
      if (unknown > 1) certain = false;
    } else if (unknown > 0) {
      certain = false;
    }
    last = s;
    unknown = 0;
  }
  if (certain && variations == 0) return Count::None;
  if (certain && variations == 1 && f.is_polynomial()) return Count::One;
  // A monotone function has the roots that its ends tell.
  thread_local Bernstein<1> derivative;
  differentiate(net, 0, &derivative);
  if (sign_on_cube(derivative))
    return sign(net.b.front()) == sign(net.b.back()) ? Count::None : Count::One;
  return Count::Unknown;
}

/// A part of a line or segment with the net on it, `bits` telling where the net comes from (0: from
/// halving a larger one).
struct Piece {
  double lo = 0;
  double hi = 0;
  int bits = 0;
  Bernstein<1> net;
};

/// Whether a fresh or more precise net could help: the rounding error hides the sign at an end or
/// stands alone between the coefficients and one sign.
bool wants_precision(const Bernstein<1>& net) {
  return !(std::fabs(net.b.front()) > net.radius) || !(std::fabs(net.b.back()) > net.radius) ||
         drowned(net);
}

/// Computes the net anew, first in doubles, then in MPFR, until `settled(net)` or more precision
/// does not help any more.
template <class Settled>
bool sharpen(const FilteredFunction<2>& f, const Line& line, Piece* piece, Kernel& kernel,
             Settled settled) {
  int bits = piece->bits == 0 ? kernel.start_bits : kernel.next(std::max(piece->bits, 53));
  while (bits > 0) {
    const double before = piece->net.radius;
    const int from = piece->bits;
    f.restrict_to(SegmentChart::of_line(line, piece->lo, piece->hi), bits, kernel, &piece->net);
    piece->bits = bits;
    if (settled(piece->net)) return true;
    if (!f.precision_helps(piece->net)) return false;
    // The rounding to doubles bounds what precision can gain.
    if (from > Kernel::kDoubleBits && !(piece->net.radius < 0.5 * before)) return false;
    bits = kernel.next(bits);
  }
  return false;
}

/// [lo, hi] enlarged to multiples of a power of two, so that many halvings stay exact in doubles;
/// returns that power, or 0 where the ends are left as they are.
double snap_outward(double* lo, double* hi) {
  int e;
  std::frexp(*hi - *lo, &e);
  const double unit = std::ldexp(1.0, e - 7);
  const double low = std::floor(*lo / unit), high = std::ceil(*hi / unit);
  if (!(std::fabs(low) < 0x1p45 && std::fabs(high) < 0x1p45)) return 0;
  *lo = low * unit;
  *hi = high * unit;
  return unit;
}

bool exact_middle(double lo, double hi, double* middle) {
  const Centered chart = centered(lo, hi);
  *middle = chart.center;
  return chart.exact && chart.half > 0;
}

}  // namespace

std::optional<std::vector<RootInterval>> isolate_on_line(const FilteredFunction<2>& f,
                                                         const Line& line, double lo, double hi,
                                                         int max_nodes, Kernel& kernel) {
  if (!(lo < hi) || !std::isfinite(lo) || !std::isfinite(hi)) return std::nullopt;
  double low = lo, high = hi;
  const double unit = snap_outward(&low, &high);
  std::vector<RootInterval> roots;
  std::vector<Piece> stack(1);
  stack[0].bits = kernel.start_bits;
  const Bernstein<1>& whole = stack[0].net;
  for (int tries = 0;; ++tries) {
    double middle_of_all;
    if (!exact_middle(low, high, &middle_of_all)) return std::nullopt;
    stack[0].lo = low;
    stack[0].hi = high;
    f.restrict_to(SegmentChart::of_line(line, low, high), kernel.start_bits, kernel, &stack[0].net);
    // A zero at or near an end that only the enlargement brought in: enlarge further.
    const auto zero_end = [&](double value, double end, double asked) {
      return end != asked && !(std::fabs(value) > whole.radius);
    };
    const bool at_low = zero_end(whole.b.front(), low, lo),
               at_high = zero_end(whole.b.back(), high, hi);
    if (tries == 3 || !(at_low || at_high)) break;
    if (at_low) low -= unit;
    if (at_high) high += unit;
  }
  int nodes = 0;
  while (!stack.empty()) {
    if (++nodes > max_nodes) return std::nullopt;
    Piece piece = std::move(stack.back());
    stack.pop_back();
    // A net is valid on just [lo, hi] only if its middle is a double: neighbours must not overlap.
    double middle;
    if (!exact_middle(piece.lo, piece.hi, &middle)) return std::nullopt;
    Count count = count_roots(f, piece.net);
    if (count == Count::Unknown && wants_precision(piece.net)) {
      sharpen(f, line, &piece, kernel, [&](const Bernstein<1>& net) {
        count = count_roots(f, net);
        return count != Count::Unknown || !wants_precision(net);
      });
    }
    if (count != Count::Unknown) {
      kernel.count(std::max(piece.bits, kernel.start_bits));
      if (count == Count::One) roots.push_back({piece.lo, piece.hi});
      continue;
    }
    Piece lower, upper;
    halve(piece.net, 0, &lower.net, &upper.net);
    // A cut at which f may vanish would settle neither side: sharpen the net, then cut elsewhere.
    const auto nonzero_cut = [&] {
      return std::fabs(upper.net.b.front()) > upper.net.radius &&
             std::fabs(lower.net.b.back()) > lower.net.radius;
    };
    bool cut = nonzero_cut() || (!f.precision_helps(piece.net) &&
                                 sign_on_line(f, line, middle, kernel) != Sign::Zero);
    if (!cut && sharpen(f, line, &piece, kernel, [&](const Bernstein<1>& net) {
          halve(net, 0, &lower.net, &upper.net);
          return nonzero_cut();
        })) {
      stack.push_back(std::move(piece));
      continue;
    }
    for (const int sixteenths : {7, 9, 6, 10}) {
      if (cut) break;
      const double at = piece.lo + (piece.hi - piece.lo) * (sixteenths / 16.0);
      double unused;
      if (!exact_middle(piece.lo, at, &unused) || !exact_middle(at, piece.hi, &unused))
        return std::nullopt;
      middle = at;
      lower.bits = upper.bits = std::max(piece.bits, kernel.start_bits);
      f.restrict_to(SegmentChart::of_line(line, piece.lo, at), lower.bits, kernel, &lower.net);
      f.restrict_to(SegmentChart::of_line(line, at, piece.hi), upper.bits, kernel, &upper.net);
      cut = nonzero_cut();
    }
    if (!cut) return std::nullopt;
    lower.lo = piece.lo;
    lower.hi = upper.lo = middle;
    upper.hi = piece.hi;
    stack.push_back(std::move(upper));
    stack.push_back(std::move(lower));
  }
  // Drop what the enlargement brought in; a root that cannot be told from an end is a failure.
  std::vector<RootInterval> inside;
  for (RootInterval root : roots) {
    for (const double end : {lo, hi})
      if (!narrow_on_line(f, line, end, &root, kernel)) return std::nullopt;
    if (root.lo >= lo && root.hi <= hi) inside.push_back(root);
  }
  return inside;
}

namespace {

/// The value of f at the line's point with a parameter, in doubles, with a proved error.
typename FilteredFunction<2>::Value value_on_line(const FilteredFunction<2>& f, const Line& line,
                                                  double parameter) {
  const int p = parameter_axis(line), q = 1 - p;
  Point<2> at, reach;
  at[p] = parameter;
  at[q] = -(line.normal[p] * parameter + line.offset) / line.normal[q];
  reach[p] = std::fabs(parameter);
  reach[q] = reach_across(line, reach[p]);
  // The other coordinate carries up to nine roundings, relative to reach[q] (as in SegmentChart).
  return f.evaluate_rounded(at, reach, 9);
}

}  // namespace

bool narrow_on_line(const FilteredFunction<2>& f, const Line& line, double at, RootInterval* root,
                    Kernel& kernel) {
  if (!(root->lo < at && at < root->hi)) return true;
  const Sign here = sign_on_line(f, line, at, kernel);
  if (here == Sign::Zero) return false;
  const Sign low = sign_on_line(f, line, root->lo, kernel);
  if (low == Sign::Zero) return false;
  (here == low ? root->lo : root->hi) = at;
  return true;
}

Sign sign_on_line(const FilteredFunction<2>& f, const Line& line, double parameter,
                  Kernel& kernel) {
  if (kernel.start_bits <= Kernel::kDoubleBits) {
    const auto v = value_on_line(f, line, parameter);
    if (std::fabs(v.value) > v.error) {
      ++kernel.decisions.by_double;
      return v.value > 0 ? Sign::Positive : Sign::Negative;
    }
  }
  return f.sign_at(point_on_line(line, Rational(parameter)), kernel);
}

bool refine_on_line(const FilteredFunction<2>& f, const Line& line, RootInterval* root,
                    Kernel& kernel) {
  const double width = root->hi - root->lo;
  const double middle = root->lo + 0.5 * width;
  if (!(root->lo < middle && middle < root->hi)) return false;
  const Sign low = sign_on_line(f, line, root->lo, kernel);
  if (low == Sign::Zero) return false;
  // A secant step, fenced in; the middle if it does not help.
  const auto at_lo = value_on_line(f, line, root->lo), at_hi = value_on_line(f, line, root->hi);
  const double guess = root->lo - at_lo.value * width / (at_hi.value - at_lo.value);
  if (guess > root->lo && guess < root->hi) {
    const double margin = width / 32;
    const double left = guess - margin, right = guess + margin;
    bool left_ok = left <= root->lo, right_ok = right >= root->hi;
    if (!left_ok && sign_on_line(f, line, left, kernel) == low) {
      root->lo = left;
      left_ok = true;
    }
    if (!right_ok && sign_on_line(f, line, right, kernel) == -low) {
      root->hi = right;
      right_ok = true;
    }
    if (root->hi - root->lo <= 0.5 * width) return true;
  }
  // The signs at lo and hi differ, so the sign at a point between tells the side of the one root.
  for (const double at :
       {root->lo + 0.5 * (root->hi - root->lo), root->lo + 0.4375 * (root->hi - root->lo)}) {
    if (!(root->lo < at && at < root->hi)) return false;
    const Sign s = sign_on_line(f, line, at, kernel);
    if (s == Sign::Zero) continue;
    (s == low ? root->lo : root->hi) = at;
    return true;
  }
  return false;
}

namespace {

/// f has at most one root, a simple one, on the part of the line: one variation on an interval that
/// contains it, or a derivative without zero.
bool at_most_one_root(const FilteredFunction<2>& f, const Line& line, double lo, double hi,
                      Kernel& kernel) {
  Piece piece;
  piece.lo = lo;
  piece.hi = hi;
  bool proved = false;
  Bernstein<1> derivative;
  sharpen(f, line, &piece, kernel, [&](const Bernstein<1>& net) {
    differentiate(net, 0, &derivative);
    proved = count_roots(f, net) == Count::One || sign_on_cube(derivative).has_value();
    return proved || !drowned(derivative);
  });
  if (proved) kernel.count(piece.bits);
  return proved;
}

}  // namespace

bool one_root_on_line(const FilteredFunction<2>& f, const Line& line, double lo, double hi,
                      Kernel& kernel) {
  if (!(lo < hi) || !std::isfinite(lo) || !std::isfinite(hi)) return false;
  // Opposite signs at the ends: at least one root.
  const Sign low = sign_on_line(f, line, lo, kernel), high = sign_on_line(f, line, hi, kernel);
  if (low == Sign::Zero || high == Sign::Zero || low == high) return false;
  for (int halvings = 0; halvings < 40; ++halvings) {
    if (at_most_one_root(f, line, lo, hi, kernel)) return true;
    // An extremum beside the root, or another root just beyond an end: it is enough that the half
    // between equal signs has no root.
    double cut = lo + 0.5 * (hi - lo);
    Sign sign = sign_on_line(f, line, cut, kernel);
    if (sign == Sign::Zero) {
      cut = lo + 0.4375 * (hi - lo);
      sign = sign_on_line(f, line, cut, kernel);
    }
    if (sign == Sign::Zero || !(lo < cut && cut < hi)) return false;
    if (!no_root_on_line(f, line, sign == low ? lo : cut, sign == low ? cut : hi, kernel))
      return false;
    (sign == low ? lo : hi) = cut;
  }
  return false;
}

namespace {

/// f has no zero on the chart of a part of a segment; `chart(lo, hi)` for lo, hi in [-1, 1] or in
/// the line's parameter. `same_sign(lo, hi)`: f is proved to have one sign, not zero, at both.
template <class Chart, class SameSign>
bool no_root(const FilteredFunction<2>& f, double lo, double hi, Kernel& kernel, Chart chart,
             SameSign same_sign) {
  Bernstein<1> derivative;
  std::vector<Piece> stack(1);
  stack[0].lo = lo;
  stack[0].hi = hi;
  int nodes = 0;
  while (!stack.empty()) {
    Piece piece = std::move(stack.back());
    stack.pop_back();
    if (++nodes > 4000) return false;
    std::optional<Sign> sign;
    if (!piece.net.b.empty()) sign = sign_on_cube(piece.net);
    double radius = HUGE_VAL;
    if (!sign && (piece.net.b.empty() || drowned(piece.net))) {
      for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
        f.restrict_to(chart(piece.lo, piece.hi), bits, kernel, &piece.net);
        piece.bits = bits;
        sign = sign_on_cube(piece.net);
        if (sign || !drowned(piece.net) || !f.precision_helps(piece.net)) break;
        if (bits > Kernel::kDoubleBits && !(piece.net.radius < 0.5 * radius)) break;
        radius = piece.net.radius;
      }
    }
    if (sign) {
      kernel.count(std::max(piece.bits, kernel.start_bits));
      continue;
    }
    // A monotone function has no zero between values of one sign. (Needed where a zero lies just
    // beyond an end.)
    differentiate(piece.net, 0, &derivative);
    if (sign_on_cube(derivative) && same_sign(piece.lo, piece.hi)) continue;
    // Values of opposite signs at the ends: there is a root.
    const double first = piece.net.b.front(), last = piece.net.b.back(), r = piece.net.radius;
    if ((first > r && last < -r) || (first < -r && last > r)) return false;
    double middle = piece.lo + 0.5 * (piece.hi - piece.lo);
    if (!(piece.lo < middle && middle < piece.hi)) return false;
    Piece lower, upper;
    if (exact_middle(piece.lo, piece.hi, &middle)) halve(piece.net, 0, &lower.net, &upper.net);
    lower.lo = piece.lo;
    lower.hi = upper.lo = middle;
    upper.hi = piece.hi;
    stack.push_back(std::move(upper));
    stack.push_back(std::move(lower));
  }
  return true;
}

}  // namespace

bool no_root_on_line(const FilteredFunction<2>& f, const Line& line, double lo, double hi,
                     Kernel& kernel) {
  if (!std::isfinite(lo) || !std::isfinite(hi) || !(lo <= hi)) return false;
  if (lo == hi) return sign_on_line(f, line, lo, kernel) != Sign::Zero;
  return no_root(
      f, lo, hi, kernel, [&](double a, double b) { return SegmentChart::of_line(line, a, b); },
      [&](double a, double b) {
        const Sign sign = sign_on_line(f, line, a, kernel);
        return sign != Sign::Zero && sign == sign_on_line(f, line, b, kernel);
      });
}

bool no_root_on_segment(const FilteredFunction<2>& f, const Point<2>& from, const Point<2>& to,
                        Kernel& kernel) {
  for (int i = 0; i < 2; ++i)
    if (!std::isfinite(from[i]) || !std::isfinite(to[i])) return false;
  return no_root(
      f, -1.0, 1.0, kernel,
      [&](double a, double b) { return SegmentChart::between(from, to).part(a, b); },
      [](double, double) { return false; });
}

std::array<Interval, 2> point_on_line(const Line& line, const Interval& parameter) {
  const int p = parameter_axis(line), q = 1 - p;
  std::array<Interval, 2> at;
  at[p] = parameter;
  at[q] = -(coefficient(line, p) * parameter + coefficient(line, 2)) / coefficient(line, q);
  return at;
}

RationalPoint<2> point_on_line(const Line& line, const Rational& parameter) {
  const int p = parameter_axis(line), q = 1 - p;
  const auto c = line.exact();
  RationalPoint<2> at;
  at[p] = parameter;
  at[q] = -(c[p] * parameter + c[2]) / c[q];
  return at;
}

bool parameter_grows(const Line& line, bool positive) {
  // With the inside to the left, the direction is (-b, a) on the negative side of a x + b y + c.
  const double along = parameter_axis(line) == 0 ? -line.normal[1] : line.normal[0];
  return (along > 0) != positive;
}

std::array<Interval, 2> meet(const Line& first, const Line& second) {
  const Interval a = coefficient(first, 0), b = coefficient(first, 1), c = coefficient(first, 2);
  const Interval d = coefficient(second, 0), e = coefficient(second, 1), f = coefficient(second, 2);
  const Interval determinant = a * e - b * d;
  return {(b * f - c * e) / determinant, (c * d - a * f) / determinant};
}

RationalPoint<2> exact_meet(const Line& first, const Line& second) {
  const auto p = first.exact(), q = second.exact();
  const Rational determinant = p[0] * q[1] - p[1] * q[0];
  return {Rational((p[1] * q[2] - p[2] * q[1]) / determinant),
          Rational((p[2] * q[0] - p[0] * q[2]) / determinant)};
}

namespace {

std::optional<Sign> side(const Line& line, const std::array<Interval, 2>& at) {
  return (coefficient(line, 0) * at[0] + coefficient(line, 1) * at[1] + coefficient(line, 2))
      .sign();
}

Sign exact_side(const Line& line, const RationalPoint<2>& point) {
  const auto c = line.exact();
  return sign_of(sgn(Rational(c[0] * point[0] + c[1] * point[1] + c[2])));
}

}  // namespace

Sign side(const Line& line, const Point<2>& point, Kernel& kernel) {
  if (const auto s = side(line, {Interval(point[0]), Interval(point[1])}); s && *s != Sign::Zero) {
    ++kernel.decisions.by_double;
    return *s;
  }
  ++kernel.decisions.by_exact;
  return exact_side(line, {Rational(point[0]), Rational(point[1])});
}

Sign side(const Line& line, const RationalPoint<2>& point, Kernel& kernel) {
  const std::array<Interval, 2> at{Interval::enclose(point[0]), Interval::enclose(point[1])};
  if (const auto s = side(line, at); s && *s != Sign::Zero) {
    ++kernel.decisions.by_double;
    return *s;
  }
  ++kernel.decisions.by_exact;
  return exact_side(line, point);
}

Sign side(const Line& line, const Line& first, const Line& second, Kernel& kernel) {
  if (const auto s = side(line, meet(first, second)); s && *s != Sign::Zero) {
    ++kernel.decisions.by_double;
    return *s;
  }
  ++kernel.decisions.by_exact;
  return exact_side(line, exact_meet(first, second));
}

std::optional<Sign> side(const Line& line, const Box<2>& box, Kernel& kernel) {
  // The extreme corners with respect to the line's normal.
  Point<2> low, high;
  for (int i = 0; i < 2; ++i) {
    const bool falls = line.rational ? sgn((*line.rational)[i]) < 0 : line.normal[i] < 0;
    low[i] = falls ? box.hi[i] : box.lo[i];
    high[i] = falls ? box.lo[i] : box.hi[i];
  }
  if (side(line, low, kernel) == Sign::Positive) return Sign::Positive;
  if (side(line, high, kernel) == Sign::Negative) return Sign::Negative;
  return std::nullopt;
}

}  // namespace encase
