// SPDX-License-Identifier: MIT
#include "common/line_net.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/line_net.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Horner's rule for the coefficients a[0], ..., a[last] (in t).
HWY_INLINE Row horner(const double* a, int last, const Row& t) {
  Row r = Row::all(a[last]);
  for (int j = last - 1; j >= 0; --j) r = r * t + Row::all(a[j]);
  return r;
}

/// The polynomial at eight points (s, t), by Horner's rule in t, then in s; four powers of s at a
/// time, so that four sums proceed side by side.
HWY_INLINE Row values(const double* a, int degree, const Row& s, const Row& t) {
  constexpr int kRow = Tile::kRow;
  int i = degree;
  Row total = Row::all(a[i * kRow]);
  for (; i % 4 != 0; --i) total = total * s + horner(a + (i - 1) * kRow, degree - i + 1, t);
  for (; i > 0; i -= 4) {
    // Rows i - 1, ..., i - 4; the shortest ends at t^last.
    const double *a0 = a + (i - 1) * kRow, *a1 = a0 - kRow, *a2 = a1 - kRow, *a3 = a2 - kRow;
    const int last = degree - i + 1;
    Row r3 = Row::all(a3[last + 3]);
    r3 = r3 * t + Row::all(a3[last + 2]);
    Row r2 = Row::all(a2[last + 2]);
    r3 = r3 * t + Row::all(a3[last + 1]);
    r2 = r2 * t + Row::all(a2[last + 1]);
    Row r1 = Row::all(a1[last + 1]);
    r3 = r3 * t + Row::all(a3[last]);
    r2 = r2 * t + Row::all(a2[last]);
    r1 = r1 * t + Row::all(a1[last]);
    Row r0 = Row::all(a0[last]);
    for (int j = last - 1; j >= 0; --j) {
      r0 = r0 * t + Row::all(a0[j]);
      r1 = r1 * t + Row::all(a1[j]);
      r2 = r2 * t + Row::all(a2[j]);
      r3 = r3 * t + Row::all(a3[j]);
    }
    total = total * s + r0;
    total = total * s + r1;
    total = total * s + r2;
    total = total * s + r3;
  }
  return total;
}

/// Bit j: a_j > b_j.
HWY_INLINE std::uint32_t greater(const Row& a, const Row& b) {
  std::uint32_t result = 0;
  for (int k = 0; k < kParts; ++k) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Lanes(), hn::Gt(a.part[k], b.part[k]), bits);
    result |= static_cast<std::uint32_t>(bits[0]) << (k * kLanes);
  }
  return result;
}

/// The signs of `count` values in one or two rows that exceed a threshold.
HWY_INLINE SignBits sign_bits(const Row& first, const Row& second, int count, double threshold) {
  const Row over = Row::all(threshold), under = Row::all(-threshold);
  SignBits bits{greater(first, over), greater(under, first)};
  if (count > 8) {
    bits.positive |= greater(second, over) << 8;
    bits.negative |= greater(under, second) << 8;
  }
  const std::uint32_t all = (1u << count) - 1;
  return {bits.positive & all, bits.negative & all};
}

HWY_INLINE void store_net(const Row& first, const Row& second, int degree, double threshold,
                          LineNet* net) {
  first.store(&net->b[0]);
  second.store(&net->b[8]);
  net->signs = sign_bits(first, second, degree + 1, threshold);
}

void interpolate(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                 const BernsteinTables& tables, double threshold, LineNet* net) {
  const int n = tables.degree;
  HWY_ALIGN double w[BernsteinTables::kSize];
  for (int k = 0; k <= n; k += 8) {
    const Row node = Row::load(&tables.nodes[k]);
    const Row s = Row::all(origin[0]) + Row::all(direction[0]) * node;
    const Row t = Row::all(origin[1]) + Row::all(direction[1]) * node;
    values(tile.a[0].data(), tile.degree, s, t).store(w + k);
  }
  const BernsteinTables::Matrix& matrix = tables.from_values;
  Row even0 = Row::all(0), odd0 = Row::all(0), even1 = Row::all(0), odd1 = Row::all(0);
  if (n < 8) {
    for (int k = 0; k < 8; k += 2) {
      even0 = even0 + Row::all(w[k]) * Row::load(&matrix[k][0]);
      odd0 = odd0 + Row::all(w[k + 1]) * Row::load(&matrix[k + 1][0]);
    }
  } else {
    for (int k = 0; k <= n; k += 2) {
      even0 = even0 + Row::all(w[k]) * Row::load(&matrix[k][0]);
      even1 = even1 + Row::all(w[k]) * Row::load(&matrix[k][8]);
      odd0 = odd0 + Row::all(w[k + 1]) * Row::load(&matrix[k + 1][0]);
      odd1 = odd1 + Row::all(w[k + 1]) * Row::load(&matrix[k + 1][8]);
    }
  }
  store_net(even0 + odd0, even1 + odd1, n, threshold, net);
}

void halve(const LineNet& net, const BernsteinTables& tables, double threshold, LineNet* lower,
           LineNet* upper) {
  const int n = tables.degree;
  Row low0 = Row::all(0), low1 = Row::all(0), up0 = Row::all(0), up1 = Row::all(0);
  if (n < 8) {
    for (int k = 0; k <= n; ++k) {
      const Row b = Row::all(net.b[k]);
      low0 = low0 + b * Row::load(&tables.lower[k][0]);
      up0 = up0 + b * Row::load(&tables.upper[k][0]);
    }
  } else {
    for (int k = 0; k < 8; ++k) {
      const Row b = Row::all(net.b[k]);
      low0 = low0 + b * Row::load(&tables.lower[k][0]);
      low1 = low1 + b * Row::load(&tables.lower[k][8]);
      up0 = up0 + b * Row::load(&tables.upper[k][0]);
    }
    for (int k = 8; k <= n; ++k) {
      const Row b = Row::all(net.b[k]);
      low1 = low1 + b * Row::load(&tables.lower[k][8]);
      up0 = up0 + b * Row::load(&tables.upper[k][0]);
      up1 = up1 + b * Row::load(&tables.upper[k][8]);
    }
  }
  store_net(low0, low1, n, threshold, lower);
  store_net(up0, up1, n, threshold, upper);
}

void signs(const LineNet& net, int degree, double threshold, SignBits* bits) {
  *bits = sign_bits(Row::load(&net.b[0]), Row::load(&net.b[8]), degree + 1, threshold);
}

void rises(const LineNet& net, int degree, double threshold, SignBits* bits) {
  const Row first = Row::load_unaligned(&net.b[1]) - Row::load(&net.b[0]);
  const Row second = Row::load_unaligned(&net.b[9]) - Row::load(&net.b[8]);
  *bits = sign_bits(first, second, degree, threshold);
}

/// Where bits are 1: x, else 1.
HWY_INLINE Row power_factor(const double* bits, double x) {
  const Row one = Row::all(1), factor = Row::all(x), bit = Row::load(bits);
  Row r;
  for (int k = 0; k < kParts; ++k)
    r.part[k] = hn::IfThenElse(hn::Eq(bit.part[k], one.part[k]), factor.part[k], one.part[k]);
  return r;
}

/// The value of a net and its derivatives.
struct Jet {
  double value, slope, bend;
};

/// At v in [0, 1]: means of three neighbours b_j, b_j+1, b_j+2 each, weighted by the Bernstein
/// polynomials of degree n - 2, make the value and both derivatives.
HWY_INLINE Jet jet_at(const LineNet& net, const BernsteinTables& tables, double v) {
  const int n = tables.degree;
  const double w = 1 - v, v2 = v * v, w2 = w * w, v4 = v2 * v2, w4 = w2 * w2;
  Row sum[3] = {Row::all(0), Row::all(0), Row::all(0)};
  for (int j = 0; j + 2 <= n; j += 8) {
    Row weight =
        (power_factor(&tables.up_bits[0][j], v) * power_factor(&tables.up_bits[1][j], v2)) *
        power_factor(&tables.up_bits[2][j], v4);
    Row down =
        (power_factor(&tables.down_bits[0][j], w) * power_factor(&tables.down_bits[1][j], w2)) *
        power_factor(&tables.down_bits[2][j], w4);
    if (n > 9) {
      if (j > 0) weight = weight * Row::all(v4 * v4);
      down = down * power_factor(&tables.down_bits[3][j], w4 * w4);
    }
    weight = (weight * down) * Row::load(&tables.weights[j]);
    for (int d = 0; d < 3; ++d) sum[d] = sum[d] + weight * Row::load_unaligned(&net.b[j + d]);
  }
  double mean[3];
  for (int d = 0; d < 3; ++d) mean[d] = sum_of_lanes(sum[d]);
  const double first = mean[1] - mean[0], second = mean[2] - mean[1];
  return {(w2 * mean[0] + 2 * v * w * mean[1]) + v2 * mean[2], n * (w * first + v * second),
          n * (n - 1) * (second - first)};
}

constexpr int kJetRoundings = 3 * BernsteinTables::kMaxDegree;

HWY_INLINE double largest_second_difference(const LineNet& net, const BernsteinTables& tables) {
  Row largest = Row::all(0);
  for (int j = 0; j + 2 <= tables.degree; j += 8) {
    const Row here = Row::load_unaligned(&net.b[j + 1]);
    const Row difference =
        absolute((Row::load_unaligned(&net.b[j + 2]) - here) - (here - Row::load(&net.b[j])));
    largest = greatest(largest, first_lanes(difference, Row::all(0), tables.degree - 1 - j));
  }
  return greatest_lane(largest);
}

/// About where a net changes sign: by interpolation between values.
HWY_INLINE double guess_sign_change(const LineNet& net, const BernsteinTables& tables, bool rises) {
  const int n = tables.degree;
  Row even = Row::all(0), odd = Row::all(0);
  for (int k = 0; k <= n; k += 2) {
    even = even + Row::all(net.b[k]) * Row::load(tables.samples[k].data());
    odd = odd + Row::all(net.b[k + 1]) * Row::load(tables.samples[k + 1].data());
  }
  const Row inside = even + odd;
  HWY_ALIGN double values[24];
  inside.store(values + 8);
  double* at = values + 7;  // at[0], ..., at[9]: at 0, 1/9, ..., 1
  at[0] = net.b[0];
  at[9] = net.b[n];
  const std::uint32_t positive = greater(inside, Row::all(0)), all = 255;
  const std::uint32_t others = (rises ? positive : ~positive) & all;
  const int k = others == 0 ? 8 : static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(others));
  const double rise = at[k + 1] - at[k];
  const double bend = k > 0 ? rise - (at[k] - at[k - 1]) : (at[2] - at[1]) - rise;
  const double scale = 1 / rise, line = -at[k] * scale;
  double t = line + 0.5 * line * (1 - line) * bend * scale;
  t = line + 0.5 * t * (1 - t) * bend * scale;
  if (!(t > 0)) t = 0;
  if (!(t < 1)) t = 1;
  return (k + t) * (1.0 / 9);
}

void find_sign_change(const LineNet& net, const BernsteinTables& tables, bool rises, double largest,
                      const NetErrors& errors, SignChange* change) {
  constexpr double kHalfWidth = 0x1p-9;
  constexpr double kLeastHalfWidth = 0x1p-40;  // far above the rounding of its ends
  const double rounding = 1.01 * kJetRoundings * 0x1p-53 * largest;
  const double value_error = errors.value + rounding;
  const double slope_error = errors.slope + 2 * tables.degree * rounding;
  const double most_bend = tables.degree * (tables.degree - 1) * 1.0000001 *
                               (largest_second_difference(net, tables) + rounding) +
                           errors.bend;
  double lo = 0, hi = 1, v = guess_sign_change(net, tables, rises);
  for (int step = 0; step < 6; ++step) {
    const Jet jet = jet_at(net, tables, v);
    const double slope = (rises ? jet.slope : -jet.slope) - slope_error;
    const double value = (jet.value > 0 ? jet.value : -jet.value) + value_error;
    ((jet.value > 0) == rises ? hi : lo) = v;
    // Halley's step.
    const double divisor = jet.slope * jet.slope - 0.5 * jet.value * jet.bend;
    const double next = v - jet.value * jet.slope / divisor;
    if (slope > 0) {
      // The slope keeps half its size as far as `most` from v; the value has its sign from `least`
      // on.
      const auto found = [&](double width) {
        change->verdict = SignChange::Verdict::Found;
        change->lo = std::max(0.0, v - width);
        change->hi = std::min(1.0, v + width);
        change->at = std::min(change->hi, std::max(change->lo, next));
      };
      if (2.02 * value <= kHalfWidth * slope && kHalfWidth * most_bend <= 0.49 * slope)
        return found(kHalfWidth);
      const double least = 2.02 * value / slope, most = 0.49 * slope / most_bend;
      if (least <= most && most >= kLeastHalfWidth &&
          (least <= kHalfWidth || value < 2 * value_error || step >= 3))
        return found(std::min(most, std::max(least, kHalfWidth)));
      if (4 * value_error / slope > most) {
        change->verdict = SignChange::Verdict::TooMuchError;
        return;
      }
    }
    v = next > lo && next < hi ? next : 0.5 * (lo + hi);
  }
  change->verdict = SignChange::Verdict::TooMuchBend;
}

/// The tile's polynomial at a point, in Horner's rule for eight powers of t at a time; or the sum
/// of the absolute values of its terms, for s, t >= 0.
template <bool absolute_values>
HWY_INLINE double sum_of_terms(const Tile& tile, double s, double t) {
  const int n = tile.degree;
  // t^0, ..., t^7
  const double t2 = t * t, t4 = t2 * t2;
  HWY_ALIGN const double powers[8] = {1, t, t2, t2 * t, t4, t4 * t, t4 * t2, t4 * (t2 * t)};
  const Row at = Row::all(s), power = Row::load(powers);
  double sum = 0;
  for (int j = n / 8 * 8; j >= 0; j -= 8) {
    const auto row = [&](int i) HWY_ATTR {
      const Row a = Row::load(tile.a[0].data() + j + i * Tile::kRow);
      return absolute_values ? absolute(a) : a;
    };
    Row r = row(n - j);
    for (int i = n - j - 1; i >= 0; --i) r = r * at + row(i);
    sum = sum_of_lanes(r * power) + sum * (t4 * t4);
  }
  return sum;
}

void value_at(const Tile& tile, double s, double t, double* result) {
  *result = sum_of_terms<false>(tile, s, t);
}

void largest_value(const Tile& tile, double s, double t, double* result) {
  *result = sum_of_terms<true>(tile, s, t) * (1 + 0x1p-45);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(interpolate);
HWY_EXPORT(halve);
HWY_EXPORT(signs);
HWY_EXPORT(rises);
HWY_EXPORT(find_sign_change);
HWY_EXPORT(value_at);
HWY_EXPORT(largest_value);

}  // namespace

void interpolate(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                 const BernsteinTables& tables, double threshold, LineNet* net) {
  HWY_DYNAMIC_DISPATCH(interpolate)(tile, origin, direction, tables, threshold, net);
}

void substitute(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                const BernsteinTables& tables, LineNet* net) {
  // Horner's rule over polynomials in s: times (origin + direction s), plus the next one.
  const int n = tile.degree;
  const auto step = [](double* p, int degree, double at, double along) {
    for (int k = degree; k > 0; --k) p[k] = p[k] * at + p[k - 1] * along;
    p[0] = p[0] * at;
  };
  BernsteinTables::Row total{};
  for (int i = n; i >= 0; --i) {
    step(total.data(), n - i, origin[0], direction[0]);
    BernsteinTables::Row row{};
    for (int j = n - i; j >= 0; --j) {
      step(row.data(), n - i - j, origin[1], direction[1]);
      row[0] += tile.a[i][j];
    }
    for (int k = 0; k <= n - i; ++k) total[k] += row[k];
  }
  net->b.fill(0.0);
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= tables.degree; ++j) net->b[j] += total[k] * tables.from_powers[k][j];
}

void halve(const LineNet& net, const BernsteinTables& tables, double threshold, LineNet* lower,
           LineNet* upper) {
  HWY_DYNAMIC_DISPATCH(halve)(net, tables, threshold, lower, upper);
}

void cut(const LineNet& net, const BernsteinTables& tables, double fraction, double threshold,
         LineNet* lower, LineNet* upper) {
  const int n = tables.degree;
  LineNet b = net;  // de Casteljau's algorithm
  lower->b.fill(0.0);
  upper->b.fill(0.0);
  for (int k = 0; k <= n; ++k) {
    lower->b[k] = b.b[0];
    upper->b[n - k] = b.b[n - k];
    for (int j = 0; j < n - k; ++j) b.b[j] = b.b[j] * (1 - fraction) + b.b[j + 1] * fraction;
  }
  for (LineNet* part : {lower, upper}) part->signs = signs(*part, n, threshold);
}

SignBits signs(const LineNet& net, int degree, double threshold) {
  SignBits bits;
  HWY_DYNAMIC_DISPATCH(signs)(net, degree, threshold, &bits);
  return bits;
}

SignBits rises(const LineNet& net, int degree, double threshold) {
  SignBits bits;
  HWY_DYNAMIC_DISPATCH(rises)(net, degree, threshold, &bits);
  return bits;
}

double largest_coefficient(const LineNet& net) {
  double largest = 0;
  for (const double b : net.b) largest = std::max(largest, std::fabs(b));
  return largest;
}

SignChange find_sign_change(const LineNet& net, const BernsteinTables& tables, bool rises,
                            double largest, const NetErrors& errors) {
  SignChange change{};
  HWY_DYNAMIC_DISPATCH(find_sign_change)(net, tables, rises, largest, errors, &change);
  return change;
}

double value_at(const Tile& tile, const Point<2>& s) {
  double result;
  HWY_DYNAMIC_DISPATCH(value_at)(tile, s[0], s[1], &result);
  return result;
}

double largest_value(const Tile& tile, const Point<2>& reach) {
  double result;
  HWY_DYNAMIC_DISPATCH(largest_value)(tile, reach[0], reach[1], &result);
  return result;
}

}  // namespace encase
#endif
