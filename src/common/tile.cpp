// SPDX-License-Identifier: MIT
#include "common/tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/tile.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_TILE_ONCE
#define ENCASE_TILE_ONCE
namespace encase {
namespace {

/// Binomial coefficients: those of 8 to 15 over 8 to 15, by the upper number.
struct alignas(64) HighBinomials {
  double of[8][8];
};
constexpr HighBinomials make_high_binomials() {
  HighBinomials b{};
  for (int i = 0; i < 8; ++i) {
    // 8 + i over 8 + k, by the quotient of neighbours.
    b.of[i][i] = 1;
    for (int k = i - 1; k >= 0; --k) b.of[i][k] = b.of[i][k + 1] * (9 + k) / (i - k);
  }
  return b;
}
constexpr HighBinomials kHighBinomials = make_high_binomials();

/// Masks for the lanes below some number up to 8: from entry 8 less that number on.
constexpr double kLanesBelow[16] = {1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};

/// Sums over the absolute values of coefficients, and of them times their degree and its square: of
/// those that a tile holds and of those that it has no room for; and Tile::high_terms but for their
/// roundings.
struct TileSums {
  double kept[3], dropped[3], high_terms[8];
};

}  // namespace
}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Sums over the rows of eight columns, from the last one down: of sizes; and, if m rows come after
/// that of a size, of it times m and m (m - 1) / 2.
struct ColumnSums {
  Row sum, first, second;
  HWY_INLINE void clear() { sum = first = second = Row::all(0); }
  HWY_INLINE void add(const Row& size) {
    second = second + first;
    first = first + sum;
    sum = sum + size;
  }
};

/// Sums of sizes, and of them times their degree and its square.
struct Totals {
  Row sum[3];
  HWY_INLINE void clear() { sum[0] = sum[1] = sum[2] = Row::all(0); }
  /// `degree`: that of lane 0 in the row added last.
  HWY_INLINE void add(const ColumnSums& c, double degree) {
    HWY_ALIGN static constexpr double kLane[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const Row least = Row::load(kLane) + Row::all(degree), of_least = least * c.sum;
    sum[0] = sum[0] + c.sum;
    sum[1] = sum[1] + (c.first + of_least);
    sum[2] = sum[2] + ((c.second + c.second) + c.first + least * (c.first + c.first + of_least));
  }
};

/// Taylor's shift to 1 of the terms with exponents from 8 on.
HWY_INLINE void shift_high_powers(const Row& powers, int degree, double* high_terms) {
  HWY_ALIGN double of_power[8];
  powers.store(of_power);
  Row shifted = Row::all(0);
  for (int i = std::min(degree, Tile::kMaxDegree); i >= 8; --i)
    shifted = shifted + Row::all(of_power[i - 8]) * Row::load(kHighBinomials.of[i - 8]);
  HWY_ALIGN double result[8];
  shifted.store(result);
  std::copy(result, result + 8, high_terms);
}

/// The coefficients of a tile, from numbers high + low, or high if there is no low (`turned`: rows
/// are those of the second variable), and their sums.
void fill_tile(const double* high, const double* low, int degree, int stride, bool turned,
               double* a, TileSums* sums) {
  const Row zero = Row::all(0);
  Totals kept, dropped;
  kept.clear();
  dropped.clear();
  Row powers = zero;  // entry k: the terms with exponent 8 + k of either variable
  for (int i = 0; i < 8; ++i) {
    zero.store(a + (8 + i) * Tile::kRow + 8);
    if (degree >= 8) continue;
    zero.store(a + i * Tile::kRow + 8);
    zero.store(a + (8 + i) * Tile::kRow);
  }
  const int last = degree / 8;
  for (int j = 0; j <= last; ++j) {
    ColumnSums inner, outer;
    inner.clear();
    outer.clear();
    for (int i = last - j; i >= 0; --i) {
      const std::size_t from = (static_cast<std::size_t>(i) * stride + j) * 8;
      Row c[8];
      for (int r = 0; r < 8; ++r) c[r] = Row::load(high + from + r * stride);
      if (low)
        for (int r = 0; r < 8; ++r) c[r] = c[r] + Row::load(low + from + r * stride);
      if (i + j >= 2) {
        for (int r = 7; r >= 0; --r) outer.add(absolute(c[r]));
        continue;
      }
      // (The degrees in a square are symmetric: its sums may be those of columns.)
      if (turned) transpose(c);
      double* to = a + 8 * ((turned ? j : i) * Tile::kRow + (turned ? i : j));
      if (i + j == 0) {
        for (int r = 7; r >= 0; --r) {
          c[r].store(to + r * Tile::kRow);
          inner.add(absolute(c[r]));
        }
        continue;
      }
      Row size[8];
      for (int r = 7; r >= 0; --r) {
        const Row inside = c[r] * Row::load_unaligned(kLanesBelow + r);
        inside.store(to + r * Tile::kRow);
        size[r] = absolute(inside);
        inner.add(size[r]);
        outer.add(absolute(c[r] - inside));
      }
      // Columns of the block with s_1^8 and so on, rows of that with s_0^8.
      if ((i == 1) != turned) transpose(size);
      powers = powers + (((size[0] + size[1]) + (size[2] + size[3])) +
                         ((size[4] + size[5]) + (size[6] + size[7])));
    }
    kept.add(inner, 8 * j);
    // The first block of all has no part in these.
    dropped.add(outer, j == 0 ? 8 : 8 * j);
  }
  for (int p = 0; p < 3; ++p) {
    sums->kept[p] = sum_of_lanes(kept.sum[p]);
    sums->dropped[p] = sum_of_lanes(dropped.sum[p]);
  }
  shift_high_powers(powers, degree, sums->high_terms);
}

/// Which of t, t^2 and t^4 the power t^k of a lane consists of.
struct LanePowers {
  alignas(64) double has[3][8], lacks[3][8];
};
constexpr LanePowers lane_powers(int first) {
  LanePowers p{};
  for (int bit = 0; bit < 3; ++bit)
    for (int lane = 0; lane < 8; ++lane) {
      const bool has = lane + first > 0 && (lane + first) >> bit & 1;
      p.has[bit][lane] = has ? 1 : 0;
      p.lacks[bit][lane] = has ? 0 : 1;
    }
  return p;
}
HWY_INLINE Row powers(const LanePowers& of, const Row& first, const Row& second,
                      const Row& fourth) {
  const auto factor = [&](int bit, const Row& power) HWY_ATTR {
    return power * Row::load(of.has[bit]) + Row::load(of.lacks[bit]);
  };
  return factor(0, first) * factor(1, second) * factor(2, fourth);
}

/// Sums over i of a[i][j] s^i in each lane j, and their derivatives.
HWY_INLINE void sum_rows(const double* a, int degree, const Row& s, Row* value, Row* slope) {
  Row v = Row::all(0), d = v;
  for (int i = degree; i >= 0; --i) {
    d = d * s + v;
    v = v * s + Row::load(a + i * Tile::kRow);
  }
  *value = v;
  *slope = d;
}

/// The value of sum a[i][j] s^i t^j, i + j <= degree, and its derivatives.
HWY_INLINE void evaluate_at(const double* a, int degree, const Point<2>& at, double* result) {
  static constexpr LanePowers kPowers = lane_powers(0), kPowersBefore = lane_powers(-1);
  HWY_ALIGN static constexpr double kExponents[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const Row s = Row::all(at[0]), t = Row::all(at[1]), second = t * t, fourth = second * second;
  Row v, d;
  sum_rows(a, degree, s, &v, &d);
  // Then the sums over the lanes, times powers of t.
  const Row power = powers(kPowers, t, second, fourth),
            slope = powers(kPowersBefore, t, second, fourth) * Row::load(kExponents);
  Row of_t = v * slope;
  if (degree >= 8) {
    Row v8, d8;
    sum_rows(a + 8, degree - 8, s, &v8, &d8);
    const Row seventh = t * second * fourth, eighth = fourth * fourth;
    of_t = of_t + v8 * (slope * eighth + power * (Row::all(8) * seventh));
    v = v + v8 * eighth;
    d = d + d8 * eighth;
  }
  result[0] = sum_of_lanes(v * power);
  result[1] = sum_of_lanes(d * power);
  result[2] = sum_of_lanes(of_t);
}

void evaluate(const double* a, int degree, const Point<2>& at, double* result) {
  evaluate_at(a, degree, at, result);
}

/// The same of two polynomials, each at a point of its own.
void evaluate_both(const double* const* a, const int* degree, const Point<2>* at, double* result) {
  for (int k = 0; k < 2; ++k) evaluate_at(a[k], degree[k], at[k], result + 3 * k);
}

/// The values and derivatives of sum a[i][j] s^i t^j at eight points: result[0] to result[7] are
/// the values, then come the derivatives with respect to s and t.
void evaluate_eight(const double* a, int degree, const double* s, const double* t, double* result) {
  const Row zero = Row::all(0), at_s = Row::load(s), at_t = Row::load(t);
  Row value = zero, ds = zero, dt = zero;
  const auto add_row = [&](const Row& sum, const Row& slope) {
    ds = ds * at_s + value;
    value = value * at_s + sum;
    dt = dt * at_s + slope;
  };
  // Two rows at a time: their sums do not wait for each other.
  int i = degree;
  for (; i > 0; i -= 2) {
    const double *row = a + i * Tile::kRow, *next = row - Tile::kRow;
    int j = degree - i;
    Row sum = Row::all(row[j]), slope = zero;
    Row next_slope = Row::all(next[j + 1]), next_sum = next_slope * at_t + Row::all(next[j]);
    while (--j >= 0) {
      slope = slope * at_t + sum;
      sum = sum * at_t + Row::all(row[j]);
      next_slope = next_slope * at_t + next_sum;
      next_sum = next_sum * at_t + Row::all(next[j]);
    }
    add_row(sum, slope);
    add_row(next_sum, next_slope);
  }
  if (i == 0) {
    Row sum = Row::all(a[degree]), slope = zero;
    for (int j = degree - 1; j >= 0; --j) {
      slope = slope * at_t + sum;
      sum = sum * at_t + Row::all(a[j]);
    }
    add_row(sum, slope);
  }
  value.store(result);
  ds.store(result + 8);
  dt.store(result + 16);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(fill_tile);
HWY_EXPORT(evaluate);
HWY_EXPORT(evaluate_both);
HWY_EXPORT(evaluate_eight);

constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies

}  // namespace

void claim_nothing(Tile* tile) {
  for (auto& row : tile->a) row.fill(0.0);
  tile->high_terms.fill(0.0);
  tile->sum = tile->slope = tile->bend = 0;
  tile->error = tile->slope_error = tile->bend_error = tile->value_error =
      std::numeric_limits<double>::infinity();
}

CoefficientSums fill(Tile* tile, int n, const PairedCoefficients& coefficients, bool paired,
                     bool turned, double error, double relative) {
  tile->degree = std::min(n, Tile::kMaxDegree);
  tile->undefined = false;
  TileSums sums;
  HWY_DYNAMIC_DISPATCH(fill_tile)
  (coefficients.high(), paired ? coefficients.low() : nullptr, n, coefficients.stride, turned,
   tile->a[0].data(), &sums);
  // The coefficients' powers of kReach are at most those of the highest degrees.
  const double kept_reach = Tile::reach_power(tile->degree) * kUp,
               dropped_reach = Tile::reach_power(n) * kUp;
  for (double& sum : sums.kept) sum *= kept_reach;
  for (double& sum : sums.dropped) sum *= dropped_reach;
  tile->sum = sums.kept[0] * kUp;
  tile->slope = sums.kept[1] * kUp;
  tile->bend = sums.kept[2] * kUp;
  tile->error = (sums.dropped[0] * kUp + error + relative * tile->sum) * kUp;
  tile->slope_error = (sums.dropped[1] * kUp + n * error + relative * tile->slope) * kUp;
  tile->bend_error = (sums.dropped[2] * kUp + n * n * error + relative * tile->bend) * kUp;
  // (1.0001 outweighs the roundings.)
  for (std::size_t k = 0; k < 8; ++k) tile->high_terms[k] = sums.high_terms[k] * 1.0001;
  if (!(tile->sum < 0x1p900) || !std::isfinite(tile->error + tile->bend_error)) claim_nothing(tile);
  return {sums.kept[0], sums.dropped[0]};
}

std::array<double, 3> value_and_gradient(const Tile& tile, const Point<2>& s) {
  std::array<double, 3> result;
  HWY_DYNAMIC_DISPATCH(evaluate)(tile.a[0].data(), tile.degree, s, result.data());
  return result;
}

std::array<std::array<double, 3>, 2> values_and_gradients(const std::array<const Tile*, 2>& tiles,
                                                          const std::array<Point<2>, 2>& s) {
  std::array<std::array<double, 3>, 2> result;
  const double* const a[2] = {tiles[0]->a[0].data(), tiles[1]->a[0].data()};
  const int degree[2] = {tiles[0]->degree, tiles[1]->degree};
  HWY_DYNAMIC_DISPATCH(evaluate_both)(a, degree, s.data(), result[0].data());
  return result;
}

void values_and_gradients(const Tile& tile, const Point<2>* s, int count, double* value, double* ds,
                          double* dt) {
  alignas(64) double x[8] = {}, y[8] = {}, all[24];
  for (int k = 0; k < count; ++k) {
    x[k] = s[k][0];
    y[k] = s[k][1];
  }
  HWY_DYNAMIC_DISPATCH(evaluate_eight)(tile.a[0].data(), tile.degree, x, y, all);
  std::copy_n(all, count, value);
  std::copy_n(all + 8, count, ds);
  std::copy_n(all + 16, count, dt);
}

}  // namespace encase
#endif