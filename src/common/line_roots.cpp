// SPDX-License-Identifier: MIT
#include "common/line_roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/analytic_gaps.hpp"
#include "common/line_net.hpp"
#include "common/segments.hpp"

// The bounds are derived in docs/error-bounds.md, "Roots on a line from tiles".
namespace encase {
namespace {

constexpr double kRounding = 0x1p-53;
constexpr double kUp = 1 + 0x1p-40;      // outweighs the roundings of a bound's own evaluation
constexpr double kTiny = 0x1p-1000;      // beside which no underflow counts
constexpr double kUnderflow = 0x1p-960;  // more than all underflows of one net add up to

constexpr int kMaxTiles = 1000;              // along one path
constexpr int kMaxLevel = 10;                // nested looks at a part of a piece
constexpr int kMaxWaiting = 500;             // parts that wait for their turn, on all levels
constexpr double kLeastPart = 0x1p-24;       // of a piece that is still cut
constexpr double kLeastCutPart = 0x1p-5;     // of one that is cut for its bend where errors matter
constexpr double kExpansionError = 0x1p-50;  // of a tile that lacks no terms, about
constexpr double kLocalError = 0x1p-28;      // of a local tile that serves, relative to its sum
constexpr double kLocalErrorOfSquares = 0x1p-7;  // likewise, of an inclusion function's
constexpr int kMaxNodesWithoutRoot = 4000;

double roundings(int count) { return 1.01 * count * kRounding; }

/// Points base + direction t of the plane: a line by its parameter, or a segment by t in [0, 1].
class Path {
 public:
  /// Of a line; t at most `reach` in absolute value.
  Path(const Line& line, double reach) : line_(&line), reach_(reach) {
    const int p = parameter_axis(line), q = 1 - p;
    const double inverse = -1 / line.normal[q];
    base[p] = 0;
    direction[p] = 1;
    magnitude[p] = reach;
    base[q] = line.offset * inverse;
    direction[q] = line.normal[p] * inverse;
    // As in `reach_across`.
    const double terms =
        (std::fabs(line.normal[p]) + kTiny) * reach + std::fabs(line.offset) + kTiny;
    magnitude[q] = std::fabs(line.normal[q]) >= 0x1p-900 ? terms * std::fabs(inverse) * kUp + kTiny
                                                         : std::numeric_limits<double>::infinity();
  }
  Path(const Point<2>& from, const Point<2>& to) : from_(&from), to_(&to), reach_(1) {
    for (int i = 0; i < 2; ++i) {
      base[i] = from[i];
      direction[i] = to[i] - from[i];
      magnitude[i] = (std::fabs(from[i]) + std::fabs(direction[i])) * kUp;
    }
  }

  Point<2> base, direction;
  /// At least the sum of absolute values of the terms that make up a coordinate.
  Point<2> magnitude;

  Point<2> at(double t) const { return {base[0] + direction[0] * t, base[1] + direction[1] * t}; }
  RationalPoint<2> exactly_at(const Rational& t) const {
    if (line_) return point_on_line(*line_, t);
    RationalPoint<2> point;
    for (int i = 0; i < 2; ++i)
      point[i] = Rational((*from_)[i]) + (Rational((*to_)[i]) - Rational((*from_)[i])) * t;
    return point;
  }
  double reach() const { return reach_; }

 private:
  const Line* line_ = nullptr;
  const Point<2>* from_ = nullptr;
  const Point<2>* to_ = nullptr;
  double reach_;
};

/// A part [lo, hi] of a path within one tile, and what is known there of f as a function of u in
/// [0, 1], where t = lo + (hi - lo) u: a polynomial g in Bernstein form, and bounds on what is
/// neglected.
struct Piece {
  const Tile* tile = nullptr;
  const BernsteinTables* tables = nullptr;
  double lo = 0, hi = 0;
  Point<2> origin, direction;  ///< in the tile's coordinates, for u = 1/2 and half the way
  double shift = 0;            ///< bounds the error of a point's coordinates in the tile
  double error = 0;            ///< |f - g|
  double slope_error = 0;      ///< |f' - g'|, with respect to u
  double largest = 0;          ///< at least the largest Bernstein coefficient of g
  bool local = false;          ///< the tile was made for this piece

  int degree() const { return tables->degree; }
  double parameter(double u) const {
    if (u <= 0) return lo;
    if (u >= 1) return hi;
    return std::clamp(lo + (hi - lo) * u, lo, hi);
  }
};

/// A part [lo, hi] of a piece's [0, 1], with the net there.
struct Part {
  LineNet net;
  double lo = 0, hi = 1;
  double rounding = 0;  ///< of every coefficient
};

/// The parts that wait; nested searches go on above those of the outer ones.
constinit thread_local std::array<Part, kMaxWaiting> waiting_parts{};

enum class Outcome { Settled, Cut, Hidden };

bool known(const SignBits& bits, int j) { return ((bits.positive | bits.negative) >> j) & 1; }
bool positive(const SignBits& bits, int j) { return (bits.positive >> j) & 1; }

/// Positive signs, at most one that is not known, negative signs, or the other way round; those of
/// the ends are known.
bool one_variation(const SignBits& bits, std::uint32_t all) {
  const bool falls = bits.positive & 1;
  const std::uint32_t first = falls ? bits.positive : bits.negative,
                      last = falls ? bits.negative : bits.positive, not_last = all & ~last,
                      unknown = not_last & ~first;
  return last != 0 && (first & (first + 1)) == 0 && (not_last & (not_last + 1)) == 0 &&
         (unknown & (unknown - 1)) == 0;
}

double largest_difference(const LineNet& net, int degree) {
  double largest = 0;
  for (int j = 0; j < degree; ++j) largest = std::max(largest, std::fabs(net.b[j + 1] - net.b[j]));
  return largest;
}

/// Looks for the roots on a path. Where it is not given a list for them it fails at the first.
class PathSearch {
 public:
  PathSearch(TiledFunction& f, const Path& path, int max_nodes, Kernel& kernel,
             std::vector<LineRoot>* roots)
      : f_(f), path_(path), kernel_(kernel), roots_(roots), nodes_left_(max_nodes) {}

  bool run(double lo, double hi) {
    double from = lo;
    if (kernel_.start_bits <= Kernel::kDoubleBits)
      for (int tiles = 0; from < hi && tiles < kMaxTiles; ++tiles) {
        const std::optional<double> to = cover_by_tile(from, hi);
        if (!to) return false;
        if (*to == from) break;
        from = *to;
      }
    return from == hi || cover_locally(from, hi, hi - from, kernel_.start_bits, 1);
  }

 private:
  /// Settles a beginning of the path from `from` to `hi` by a tile of the tree; where that ends (at
  /// `from` if the tree has none that serves), or nothing if it failed.
  std::optional<double> cover_by_tile(double from, double hi) {
    const Tile& tile = f_.at(path_.at(from));
    Piece piece;
    piece.tile = &tile;
    piece.lo = from;
    piece.hi = hi;
    if (place(&piece)) {
      restrict_by_values(&piece);
      return settle(piece, 0) ? std::optional(hi) : std::nullopt;
    }
    // The value at a cut is to be proved not to be zero: else the cut is moved.
    for (const double overlap : {0x1p-11, 0x1p-12, 0x1.8p-11, 0x1p-13}) {
      piece.hi = leave(tile, hi, 1 + overlap);
      if (!(piece.lo < piece.hi) || !place(&piece)) return from;
      const Part& whole = restrict_by_values(&piece);
      if (piece.hi < hi && !known(whole.net.signs, piece.degree())) continue;
      return settle(piece, 0) ? std::optional(piece.hi) : std::nullopt;
    }
    return from;
  }

  /// The parameter, up to `end`, where the path leaves a tile's rectangle enlarged by a factor.
  /// Approximate: `place` checks.
  double leave(const Tile& tile, double end, double factor) const {
    double first = end, slack = 0;
    for (int i = 0; i < 2; ++i) {
      const double d = path_.direction[i];
      if (d == 0) continue;
      const double reach = d > 0 ? tile.half[i] : -tile.half[i];
      const double t = (tile.center[i] + factor * reach - path_.base[i]) / d;
      if (t < first) {
        first = t;
        slack = 0x1p-12 * reach / d;
      }
    }
    return first + slack >= end ? end : first;
  }

  /// Where the piece lies in its tile; false if beyond the tile's reach.
  bool place(Piece* piece) const {
    const Tile& tile = *piece->tile;
    const double middle = 0.5 * (piece->lo + piece->hi), half = 0.5 * (piece->hi - piece->lo);
    double shift = 0;
    for (int i = 0; i < 2; ++i) {
      const double scale = 1 / tile.half[i];
      piece->origin[i] = ((path_.base[i] + path_.direction[i] * middle) - tile.center[i]) * scale;
      piece->direction[i] = path_.direction[i] * half * scale;
      shift = std::max(shift, (path_.magnitude[i] + std::fabs(tile.center[i])) * scale);
    }
    piece->shift = roundings(32) * shift + roundings(8);
    return bound_errors(piece);
  }

  /// The same exactly, up to the rounding of the results.
  bool place_exactly(Piece* piece) const {
    const Tile& tile = *piece->tile;
    const RationalPoint<2> from = path_.exactly_at(Rational(piece->lo)),
                           to = path_.exactly_at(Rational(piece->hi));
    for (int i = 0; i < 2; ++i) {
      const Rational c(tile.center[i]), h(tile.half[i]);
      piece->origin[i] = Rational(((from[i] + to[i]) / 2 - c) / h).get_d();
      piece->direction[i] = Rational((to[i] - from[i]) / 2 / h).get_d();
    }
    piece->shift = roundings(8);
    return bound_errors(piece);
  }

  bool bound_errors(Piece* piece) const {
    const Tile& tile = *piece->tile;
    for (int i = 0; i < 2; ++i) {
      const double extent =
          (std::fabs(piece->origin[i]) + std::fabs(piece->direction[i])) * kUp + piece->shift;
      if (!(tile.half[i] >= 0x1p-400) || !(extent <= Tile::kReach)) return false;
    }
    const double way = 2 * (std::fabs(piece->direction[0]) + std::fabs(piece->direction[1]));
    piece->tables = &bernstein_tables(std::max(2, tile.degree));
    piece->error = (tile.error + piece->shift * tile.slope) * kUp + kUnderflow;
    piece->slope_error =
        way * (tile.slope_error + tile.degree * piece->shift * tile.slope) * kUp + kUnderflow;
    return true;
  }

  const Part& restrict_by_values(Piece* piece) {
    ++kernel_.restrictions;
    const Tile& tile = *piece->tile;
    Part& whole = first_part();
    Point<2> reach;
    for (int i = 0; i < 2; ++i)
      reach[i] = (std::fabs(piece->origin[i]) + std::fabs(piece->direction[i])) * kUp;
    const double sum = largest_value(tile, reach);
    // The nodes' images are rounded: twice, each to at most the reach.
    const double at_nodes =
        roundings(interpolation_roundings(piece->degree()) + 3 * tile.degree) * sum;
    whole.rounding = piece->tables->values_norm * at_nodes * kUp + kUnderflow;
    interpolate(tile, piece->origin, piece->direction, *piece->tables,
                (whole.rounding + piece->error) * kUp, &whole.net);
    // The coefficients are means of values of products of factors up to the reach.
    piece->largest = sum + whole.rounding;
    return whole;
  }

  const Part& restrict_by_powers(Piece* piece) {
    ++kernel_.restrictions;
    const Tile& tile = *piece->tile;
    const int n = piece->degree();
    Part& whole = first_part();
    whole.rounding = roundings(substitution_roundings(n)) * tile.sum * kUp + kUnderflow;
    substitute(tile, piece->origin, piece->direction, *piece->tables, &whole.net);
    piece->largest = largest_coefficient(whole.net);
    if (piece->local) {
      // What the rounding of a parameter moves, along the path.
      const double most_slope =
          n * (largest_difference(whole.net, n) + 2 * whole.rounding) + piece->slope_error;
      piece->error += roundings(10) * path_.reach() / (piece->hi - piece->lo) * most_slope * kUp;
    }
    whole.net.signs = signs(whole.net, n, (whole.rounding + piece->error) * kUp);
    return whole;
  }

  Part& first_part() {
    Part& whole = waiting_[top_];
    whole.lo = 0;
    whole.hi = 1;
    return whole;
  }

  /// Settles all parts of a piece, the first of which is on the stack.
  bool settle(const Piece& piece, int level) {
    const int bottom = top_++;
    bool proved = true;
    while (proved && top_ > bottom) {
      Part& part = waiting_[top_ - 1];
      Outcome outcome = --nodes_left_ >= 0 ? examine(piece, part, level) : Outcome::Hidden;
      if (outcome == Outcome::Hidden && gains_by_cutting(piece, part)) outcome = Outcome::Cut;
      if (outcome == Outcome::Cut && cut_in_two(piece)) continue;
      proved = outcome == Outcome::Settled || look_closer(piece, part, level);
      --top_;
    }
    top_ = bottom;
    return proved;
  }

  Outcome settled(const Piece& piece) {
    kernel_.count(piece.tile->bits);
    return Outcome::Settled;
  }

  Outcome examine(const Piece& piece, Part& part, int level) {
    const int n = piece.degree();
    const std::uint32_t all = (2u << n) - 1;
    if (part.net.signs.positive == all || part.net.signs.negative == all) return settled(piece);
    const bool ends_known = known(part.net.signs, 0) && known(part.net.signs, n);
    if (ends_known && one_variation(part.net.signs, all)) return enclose_root(piece, part);
    const double threshold =
        (2 * part.rounding + piece.slope_error * (part.hi - part.lo) / n) * (1 + 0x1p-30);
    const SignBits slopes = rises(part.net, n, threshold);
    if (slopes.positive == all >> 1 || slopes.negative == all >> 1) {
      if (!ends_known && (level == 0 || !prove_ends(piece, &part))) return Outcome::Hidden;
      if (positive(part.net.signs, 0) != positive(part.net.signs, n))
        return enclose_root(piece, part);
      return settled(piece);
    }
    const bool drowned = part.net.signs.positive == 0 || part.net.signs.negative == 0;
    return ends_known && !drowned ? Outcome::Cut : Outcome::Hidden;
  }

  /// Proves the signs at the ends of a part that are also ends of the piece, exactly.
  bool prove_ends(const Piece& piece, Part* part) {
    const int n = piece.degree();
    for (const int j : {0, n}) {
      if (known(part->net.signs, j)) continue;
      if (j == 0 ? part->lo != 0 : part->hi != 1) return false;
      const Rational t(j == 0 ? piece.lo : piece.hi);
      const Sign sign = f_.polynomial().sign_at(path_.exactly_at(t), kernel_);
      if (sign == Sign::Zero) return false;
      (sign == Sign::Positive ? part->net.signs.positive : part->net.signs.negative) |= 1u << j;
    }
    return true;
  }

  /// The part has one sign change of g, and known signs at its ends: f has no root away from it.
  /// Encloses it where f is proved to be monotone.
  Outcome enclose_root(const Piece& piece, const Part& part) {
    const int n = piece.degree();
    const NetErrors errors{(part.rounding + piece.error) * kUp,
                           (2 * n * part.rounding + piece.slope_error * (part.hi - part.lo)) * kUp,
                           4 * n * (n - 1) * part.rounding * kUp};
    const SignChange change = find_sign_change(part.net, *piece.tables, positive(part.net.signs, n),
                                               piece.largest, errors);
    if (change.verdict == SignChange::Verdict::Found)
      return add_root(piece, part, change.lo, change.hi, change.at);
    // Smaller parts have less bend each; but all have the errors of the piece.
    const bool cuts_help =
        change.verdict == SignChange::Verdict::TooMuchBend || part.hi - part.lo > kLeastCutPart;
    return cuts_help ? Outcome::Cut : Outcome::Hidden;
  }

  Outcome add_root(const Piece& piece, const Part& part, double lo, double hi, double at) {
    if (!roots_) return Outcome::Hidden;
    const auto parameter = [&](double v) {
      const double u = v <= 0 ? part.lo : v >= 1 ? part.hi : part.lo + (part.hi - part.lo) * v;
      return piece.parameter(u);
    };
    const LineRoot root{parameter(lo), parameter(hi), parameter(at)};
    roots_->push_back({root.lo, root.hi, std::clamp(root.at, root.lo, root.hi)});
    return settled(piece);
  }

  /// Whether a part whose signs are hidden by the rounding errors of its own tile is still to be
  /// cut.
  static bool gains_by_cutting(const Piece& piece, const Part& part) {
    return piece.local && part.hi - part.lo > 0.125 &&
           piece.tile->error < 0.5 * (part.rounding + piece.error);
  }

  /// Replaces the part on top of the stack by two, the lower one on top; false if f may be zero
  /// wherever it might be cut, or it is too small.
  bool cut_in_two(const Piece& piece) {
    if (top_ + 1 >= kMaxWaiting) return false;
    Part &upper = waiting_[top_ - 1], &lower = waiting_[top_];
    const double width = upper.hi - upper.lo;
    if (!(width >= kLeastPart)) return false;
    const int n = piece.degree();
    const LineNet net = upper.net;
    const double rounding =
        (upper.rounding + roundings(cutting_roundings(n)) * piece.largest) * kUp;
    const double threshold = (rounding + piece.error) * kUp;
    for (const double fraction : {0.5, 0.4375, 0.5625, 0.375, 0.625}) {
      if (fraction == 0.5)
        halve(net, *piece.tables, threshold, &lower.net, &upper.net);
      else
        cut(net, *piece.tables, fraction, threshold, &lower.net, &upper.net);
      if (!known(upper.net.signs, 0) || !known(lower.net.signs, n)) continue;
      lower.lo = upper.lo;
      lower.hi = upper.lo = upper.lo + fraction * width;
      lower.rounding = upper.rounding = rounding;
      ++top_;
      return true;
    }
    upper.net = net;
    return false;
  }

  /// Settles a part whose signs are hidden by errors, from more precise coefficients.
  bool look_closer(const Piece& piece, const Part& part, int level) {
    const double lo = piece.parameter(part.lo), hi = piece.parameter(part.hi);
    if (nodes_left_ < 0 || !(lo < hi)) return false;
    if (level == 0 && part.rounding > piece.error) {
      Piece same = piece;
      same.lo = lo;
      same.hi = hi;
      if (!place(&same)) return false;
      restrict_by_powers(&same);
      return settle(same, 1);
    }
    double step = hi - lo;
    int bits = kernel_.start_bits;
    if (piece.local) {
      bits = piece.tile->bits;
      if (part.hi - part.lo > 0.125) {
        // The same once more would not help: shorter pieces where terms are missing, or more bits
        // (doubles stand for sums of two there).
        if (!f_.fits_tiles() && piece.tile->error > kExpansionError * piece.tile->sum)
          step *= 0.25;
        else
          bits = kernel_.next(std::max(bits, 2 * Kernel::kDoubleBits));
      }
    }
    return bits > 0 && cover_locally(lo, hi, step, bits, level + 1);
  }

  /// Settles a part of the path with tiles made for it.
  bool cover_locally(double lo, double hi, double step, int bits, int level) {
    if (level > kMaxLevel || top_ + 1 >= kMaxWaiting) return false;
    Tile tile;
    double from = lo;
    const double tolerated = f_.polynomial().is_inclusion() ? kLocalErrorOfSquares : kLocalError;
    while (from < hi) {
      if (--nodes_left_ < 0) return false;
      Piece piece;
      piece.tile = &tile;
      piece.local = true;
      piece.lo = from;
      piece.hi = from + step * 1.01 < hi ? from + step : hi;
      if (!(piece.lo < piece.hi)) return false;
      f_.expand(box_around(piece.lo, piece.hi), bits, &tile);
      const bool serves = tile.error <= tolerated * tile.sum || step < 0x1p-10 * (hi - lo);
      if (!place_exactly(&piece)) return false;
      const Part& whole = restrict_by_powers(&piece);
      if (!serves || (piece.hi < hi && !known(whole.net.signs, piece.degree()))) {
        step *= serves ? 0.875 : 0.5;
        continue;
      }
      if (!settle(piece, level)) return false;
      from = piece.hi;
      // Beyond a place that is hard for an expression.
      if (!f_.polynomial().is_polynomial()) step *= 2;
    }
    return true;
  }

  /// A square around a part of the path, with some room for the rounding of its corners.
  Box<2> box_around(double lo, double hi) const {
    const double direction = std::max(std::fabs(path_.direction[0]), std::fabs(path_.direction[1]));
    const Point<2> center = path_.at(0.5 * (lo + hi));
    Box<2> box;
    for (int i = 0; i < 2; ++i) {
      const double half = 0.5 * (hi - lo) * direction * 1.001 + 0x1p-46 * path_.magnitude[i];
      box.lo[i] = center[i] - half;
      box.hi[i] = center[i] + half;
    }
    return box;
  }

  TiledFunction& f_;
  const Path& path_;
  Kernel& kernel_;
  std::vector<LineRoot>* roots_;
  int nodes_left_;
  Part* const waiting_ = waiting_parts.data();
  int top_ = 0;  ///< of the stack of parts
};

/// The parts of [lo, hi] in which a line does not meet boxes, but for what is nearly nothing.
std::vector<std::array<double, 2>> parts_outside(const std::vector<Box<2>>& boxes, const Path& path,
                                                 double lo, double hi) {
  std::vector<std::array<double, 2>> inside, outside;
  for (const Box<2>& gap : boxes) {
    const Box<2> box = left_out_at(gap);
    double from = lo, to = hi;
    for (int i = 0; i < 2; ++i) {
      if (path.direction[i] == 0) {
        if (!(box.lo[i] <= path.base[i] && path.base[i] <= box.hi[i])) to = -HUGE_VAL;
        continue;
      }
      double a = (box.lo[i] - path.base[i]) / path.direction[i],
             b = (box.hi[i] - path.base[i]) / path.direction[i];
      if (b < a) std::swap(a, b);
      from = std::max(from, a);
      to = std::min(to, b);
    }
    if (from < to) inside.push_back({from, to});
  }
  std::sort(inside.begin(), inside.end());
  double last = lo;
  for (const auto& [from, to] : inside) {
    if (last < from) outside.push_back({last, from});
    last = std::max(last, to);
  }
  if (last < hi) outside.push_back({last, hi});
  return outside;
}

bool finite_interval(double lo, double hi) {
  return std::isfinite(lo) && std::isfinite(hi) && lo < hi;
}

}  // namespace

bool isolate_on_line(TiledFunction& f, const Line& line, double lo, double hi, int max_nodes,
                     Kernel& kernel, std::vector<LineRoot>* roots) {
  if (!finite_interval(lo, hi)) return false;
  const std::size_t before = roots->size();
  const Path path(line, std::max(std::fabs(lo), std::fabs(hi)));
  PathSearch search(f, path, max_nodes, kernel, roots);
  bool proved = true;
  if (f.gaps().empty())
    proved = search.run(lo, hi);
  else
    for (const auto& [from, to] : parts_outside(f.gaps(), path, lo, hi))
      proved = proved && search.run(from, to);
  if (!proved) roots->resize(before);
  return proved;
}

bool no_root_on_line(TiledFunction& f, const Line& line, double lo, double hi, Kernel& kernel) {
  if (lo == hi) return sign_on_line(f, line, lo, kernel) != Sign::Zero;
  if (!finite_interval(lo, hi)) return false;
  const Path path(line, std::max(std::fabs(lo), std::fabs(hi)));
  return PathSearch(f, path, kMaxNodesWithoutRoot, kernel, nullptr).run(lo, hi);
}

bool no_root_on_segment(TiledFunction& f, const Point<2>& from, const Point<2>& to,
                        Kernel& kernel) {
  for (int i = 0; i < 2; ++i)
    if (!std::isfinite(from[i]) || !std::isfinite(to[i])) return false;
  return PathSearch(f, Path(from, to), kMaxNodesWithoutRoot, kernel, nullptr).run(0, 1);
}

namespace {

/// A value and a bound on its error.
struct Value {
  double value = 0;
  double error = std::numeric_limits<double>::infinity();
};

/// The value of f on a line, from its tile.
Value value_on_line(TiledFunction& f, const Line& line, double parameter) {
  const Path path(line, std::fabs(parameter));
  const Point<2> point = path.at(parameter);
  const Tile& tile = f.at(point);
  Point<2> s;
  double shift = 0;
  for (int i = 0; i < 2; ++i) {
    const double scale = 1 / tile.half[i];
    s[i] = (point[i] - tile.center[i]) * scale;
    shift = std::max(shift, (path.magnitude[i] + std::fabs(tile.center[i])) * scale);
    if (!(std::fabs(s[i]) <= 1 + 0x1p-11) || !(tile.half[i] >= 0x1p-400)) return {};
  }
  shift = roundings(12) * shift;
  if (!(shift <= 0x1p-12)) return {};
  const double error =
      tile.error + shift * tile.slope + roundings(value_roundings(tile.degree)) * tile.sum;
  return {value_at(tile, s), error * kUp + kUnderflow};
}

}  // namespace

Sign sign_on_line(TiledFunction& f, const Line& line, double parameter, Kernel& kernel) {
  if (kernel.start_bits <= Kernel::kDoubleBits) {
    const Value v = value_on_line(f, line, parameter);
    if (std::fabs(v.value) > v.error) {
      ++kernel.decisions.by_double;
      return v.value > 0 ? Sign::Positive : Sign::Negative;
    }
  }
  return sign_on_line(f.polynomial(), line, parameter, kernel);
}

bool narrow_on_line(TiledFunction& f, const Line& line, double at, LineRoot* root, Kernel& kernel) {
  if (!(root->lo < at && at < root->hi)) return true;
  const Sign here = sign_on_line(f, line, at, kernel);
  if (here == Sign::Zero) return false;
  const Sign low = sign_on_line(f, line, root->lo, kernel);
  if (low == Sign::Zero) return false;
  (here == low ? root->lo : root->hi) = at;
  root->at = std::clamp(root->at, root->lo, root->hi);
  return true;
}

bool refine_on_line(TiledFunction& f, const Line& line, LineRoot* root, Kernel& kernel) {
  const double width = root->hi - root->lo;
  const double middle = root->lo + 0.5 * width;
  if (!(root->lo < middle && middle < root->hi)) return false;
  const Sign low = sign_on_line(f, line, root->lo, kernel);
  if (low == Sign::Zero) return false;
  const auto try_between = [&](double guess, double margin) {
    for (const double at : {guess - margin, guess + margin}) {
      if (!(root->lo < at && at < root->hi)) continue;
      const Sign sign = sign_on_line(f, line, at, kernel);
      if (sign == low)
        root->lo = at;
      else if (sign == -low)
        root->hi = at;
    }
    root->at = std::clamp(root->at, root->lo, root->hi);
    return root->hi - root->lo <= 0.5 * width;
  };
  if (try_between(root->at, width / 64)) return true;
  // A secant step, then the middle.
  const double at_lo = value_on_line(f, line, root->lo).value,
               at_hi = value_on_line(f, line, root->hi).value;
  root->at = root->lo - at_lo * (root->hi - root->lo) / (at_hi - at_lo);
  if (!(root->lo < root->at && root->at < root->hi))
    root->at = root->lo + 0.5 * (root->hi - root->lo);
  return try_between(root->at, width / 32) ||
         try_between(root->lo + 0.5 * (root->hi - root->lo), 0) ||
         try_between(root->lo + 0.4375 * (root->hi - root->lo), 0);
}

}  // namespace encase
