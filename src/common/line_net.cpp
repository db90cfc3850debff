// SPDX-License-Identifier: MIT
#include "common/line_net.hpp"

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

void interpolate(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                 const BernsteinTables& tables, LineNet* net) {
  const int n = tile.degree;
  HWY_ALIGN double w[BernsteinTables::kSize];
  for (int k = 0; k <= n; k += 8) {
    const Row node = Row::load(&tables.nodes[k]);
    const Row s = Row::all(origin[0]) + Row::all(direction[0]) * node;
    const Row t = Row::all(origin[1]) + Row::all(direction[1]) * node;
    values(tile.a[0].data(), n, s, t).store(w + k);
  }
  for (int j = 0; j < BernsteinTables::kSize; j += 8) {
    if (j > n) {
      Row::all(0).store(&net->b[j]);
      break;
    }
    Row even = Row::all(0), odd = Row::all(0);
    for (int k = 0; k <= n; k += 2) {
      even = even + Row::all(w[k]) * Row::load(&tables.from_values[k][j]);
      if (k + 1 <= n) odd = odd + Row::all(w[k + 1]) * Row::load(&tables.from_values[k + 1][j]);
    }
    (even + odd).store(&net->b[j]);
  }
}

void halve(const LineNet& net, const BernsteinTables& tables, LineNet* lower, LineNet* upper) {
  const int n = tables.degree;
  if (n < 8) {
    Row low = Row::all(0), up = Row::all(0);
    for (int k = 0; k <= n; ++k) {
      const Row b = Row::all(net.b[k]);
      low = low + b * Row::load(&tables.lower[k][0]);
      up = up + b * Row::load(&tables.upper[k][0]);
    }
    low.store(&lower->b[0]);
    up.store(&upper->b[0]);
    Row::all(0).store(&lower->b[8]);
    Row::all(0).store(&upper->b[8]);
    return;
  }
  Row low0 = Row::all(0), low1 = Row::all(0), up0 = Row::all(0), up1 = Row::all(0);
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
  low0.store(&lower->b[0]);
  low1.store(&lower->b[8]);
  up0.store(&upper->b[0]);
  up1.store(&upper->b[8]);
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

HWY_INLINE void add_signs(const Row& x, double threshold, int first, SignBits* bits) {
  bits->positive |= greater(x, Row::all(threshold)) << first;
  bits->negative |= greater(Row::all(-threshold), x) << first;
}

void signs(const LineNet& net, int degree, double threshold, SignBits* bits) {
  *bits = {};
  for (int j = 0; j <= degree; j += 8) add_signs(Row::load(&net.b[j]), threshold, j, bits);
  const std::uint32_t all = (1u << (degree + 1)) - 1;
  bits->positive &= all;
  bits->negative &= all;
}

void rises(const LineNet& net, int degree, double threshold, SignBits* bits) {
  *bits = {};
  HWY_ALIGN double next[BernsteinTables::kSize];
  for (int j = 0; j + 1 < BernsteinTables::kSize; ++j) next[j] = net.b[j + 1];
  next[BernsteinTables::kSize - 1] = 0;
  for (int j = 0; j < degree; j += 8)
    add_signs(Row::load(next + j) - Row::load(&net.b[j]), threshold, j, bits);
  const std::uint32_t all = (1u << degree) - 1;
  bits->positive &= all;
  bits->negative &= all;
}

void value_at(const Tile& tile, double s, double t, double* result) {
  const int n = tile.degree;
  // t^0, ..., t^7
  const double t2 = t * t, t4 = t2 * t2;
  HWY_ALIGN const double powers[8] = {1, t, t2, t2 * t, t4, t4 * t, t4 * t2, t4 * (t2 * t)};
  const Row at = Row::all(s), power = Row::load(powers);
  double sum = 0;
  for (int j = n / 8 * 8; j >= 0; j -= 8) {
    const double* a = tile.a[0].data() + j;
    Row r = Row::load(a + (n - j) * Tile::kRow);
    for (int i = n - j - 1; i >= 0; --i) r = r * at + Row::load(a + i * Tile::kRow);
    sum = sum_of_lanes(r * power) + sum * (t4 * t4);
  }
  *result = sum;
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
HWY_EXPORT(value_at);

}  // namespace

void interpolate(const Tile& tile, const Point<2>& origin, const Point<2>& direction,
                 const BernsteinTables& tables, LineNet* net) {
  HWY_DYNAMIC_DISPATCH(interpolate)(tile, origin, direction, tables, net);
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
    for (int j = 0; j <= n; ++j) net->b[j] += total[k] * tables.from_powers[k][j];
}

void halve(const LineNet& net, const BernsteinTables& tables, LineNet* lower, LineNet* upper) {
  HWY_DYNAMIC_DISPATCH(halve)(net, tables, lower, upper);
}

void cut(const LineNet& net, int degree, double fraction, LineNet* lower, LineNet* upper) {
  LineNet b = net;  // de Casteljau's algorithm
  for (int k = 0; k <= degree; ++k) {
    lower->b[k] = b.b[0];
    upper->b[degree - k] = b.b[degree - k];
    for (int j = 0; j < degree - k; ++j) b.b[j] = b.b[j] * (1 - fraction) + b.b[j + 1] * fraction;
  }
  for (int k = degree + 1; k < BernsteinTables::kSize; ++k) lower->b[k] = upper->b[k] = 0;
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

double value_at(const Tile& tile, const Point<2>& s) {
  double result;
  HWY_DYNAMIC_DISPATCH(value_at)(tile, s[0], s[1], &result);
  return result;
}

}  // namespace encase
#endif
