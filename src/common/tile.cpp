// SPDX-License-Identifier: MIT
#include "common/tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/patch.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/tile.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_TILE_ONCE
#define ENCASE_TILE_ONCE
namespace encase {
namespace {

/// Expansions of polynomials up to this degree are halved: docs/error-bounds.md.
constexpr int kMaxHalved = 30;

/// At least kReach^k, for k up to 60.
constexpr double reach_power(int k) { return 1 + 0x1.1p-10 * k; }

/// Binomial coefficients: those over k in row k, by the upper number.
struct Binomials {
  double over[kMaxHalved + 2][kMaxHalved + 1];
};
constexpr Binomials make_binomials() {
  Binomials b{};
  for (int i = 0; i <= kMaxHalved; ++i) {
    b.over[0][i] = 1;
    for (int k = 1; k <= i; ++k)
      b.over[k][i] = b.over[k - 1][i - 1] + (k < i ? b.over[k][i - 1] : 0);
  }
  return b;
}
constexpr Binomials kBinomials = make_binomials();

/// Those of 8 to 15 over 8 to 15, by the upper number.
struct alignas(64) HighBinomials {
  double of[8][8];
};
constexpr HighBinomials make_high_binomials() {
  HighBinomials b{};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k <= i; ++k) b.of[i][k] = kBinomials.over[8 + k][8 + i];
  return b;
}
constexpr HighBinomials kHighBinomials = make_high_binomials();

/// By the degree k: kReach^k, k and k^2 times that, rounded up or by little.
struct Weights {
  double of[3][kMaxDegree + 16];
};
constexpr Weights make_weights() {
  Weights t{};
  for (int k = 0; k < kMaxDegree + 16; ++k) {
    t.of[0][k] = reach_power(k);
    t.of[1][k] = k * t.of[0][k];
    t.of[2][k] = k * t.of[1][k];
  }
  return t;
}
constexpr Weights kWeights = make_weights();

/// Sums over the absolute values of coefficients with the weights above: of those that a tile holds
/// and of those that it has no room for; and Tile::high_terms but for their roundings.
struct TileSums {
  double kept[3], dropped[3], high_terms[8];
};

}  // namespace
}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// A vector of numbers high + low.
struct Pair {
  Row high, low;
  static HWY_INLINE Pair load(const double* high, const double* low) {
    return {Row::load(high), Row::load(low)};
  }
  HWY_INLINE void store(double* to_high, double* to_low) const {
    high.store(to_high);
    low.store(to_low);
  }
};

/// sum + x * next: the rounding errors of the high parts go to the low ones.
HWY_INLINE Pair add_multiple(const Pair& sum, const Row& x, const Pair& next) {
  Row product_error, sum_error;
  const Row product = exact_product(next.high, x, &product_error);
  Pair r;
  r.high = exact_sum(sum.high, product, &sum_error);
  r.low = (sum.low + x * next.low) + (product_error + sum_error);
  return r;
}

/// row *= factor + factor_rest, likewise.
HWY_INLINE void multiply(double* high, double* low, double factor, double factor_rest, int count) {
  const Row f = Row::all(factor), g = Row::all(factor_rest);
  for (int j = 0; j < count; j += 8) {
    Row error;
    const Row a = Row::load(high + j), b = Row::load(low + j);
    const Row product = exact_product(a, f, &error);
    product.store(high + j);
    (error + (a * g + b * f)).store(low + j);
  }
}

/// Row i, of numbers high + low, holds the coefficients of s^i: p(s) -> p(origin + half s). Rows
/// are `stride` apart, and row i has degree + 1 - i entries (the rest are zero).
void shift_and_scale(double* high, double* low, int degree, int stride, double origin,
                     double half) {
  if (origin != 0) {
    // Synthetic division, two levels at a time: eight columns by themselves, which end at row top.
    const Row x = Row::all(origin);
    for (int column = 0; column < degree; column += 8) {
      const int top = degree - column;
      const auto at = [&](int k) { return static_cast<std::size_t>(k) * stride + column; };
      for (int level = 0; level < top; level += 2) {
        const Pair last = Pair::load(high + at(top), low + at(top));
        Pair first = last, second = last;
        for (int k = top - 1; k > level; --k) {
          first = add_multiple(Pair::load(high + at(k), low + at(k)), x, first);
          second = add_multiple(first, x, second);
          second.store(high + at(k), low + at(k));
        }
        first = add_multiple(Pair::load(high + at(level), low + at(level)), x, first);
        first.store(high + at(level), low + at(level));
      }
    }
  }
  if (half == 1) return;
  double power = 1, power_rest = 0;
  for (int i = 1; i <= degree; ++i) {
    // power *= half
    const double product = power * half;
    power_rest = std::fma(power, half, -product) + power_rest * half;
    power = product;
    const std::size_t row = static_cast<std::size_t>(i) * stride;
    multiply(high + row, low + row, power, power_rest, degree + 1 - i);
  }
}

/// Rows become columns: whole blocks of eight, those with coefficients up to the total degree.
void turn(const double* high, const double* low, int degree, int stride, double* to_high,
          double* to_low) {
  const int last = degree / 8;
  for (int i = 0; i <= last; ++i)
    for (int j = 0; i + j <= last; ++j) {
      const std::size_t from = (static_cast<std::size_t>(i) * stride + j) * 8,
                        to = (static_cast<std::size_t>(j) * stride + i) * 8;
      Row h[8], l[8];
      for (int r = 0; r < 8; ++r) {
        h[r] = Row::load(high + from + r * stride);
        l[r] = Row::load(low + from + r * stride);
      }
      transpose(h);
      transpose(l);
      for (int r = 0; r < 8; ++r) {
        h[r].store(to_high + to + r * stride);
        l[r].store(to_low + to + r * stride);
      }
    }
}

/// Makes `low` what `high` lacks of the rounded sum of both. Returns the largest |high|.
double normalize(double* high, double* low, int degree, int stride) {
  Row largest = Row::all(0);
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; j += 8) {
      const std::size_t at = static_cast<std::size_t>(i) * stride + j;
      Row rest;
      const Row sum = exact_sum(Row::load(high + at), Row::load(low + at), &rest);
      sum.store(high + at);
      rest.store(low + at);
      largest = greatest(largest, absolute(sum));
    }
  return greatest_lane(largest);
}

/// Writes every number high + low times 2^-i, i its row, as a sum of three: a multiple of the unit
/// U, one of the finer unit V, and the rest; for each block of eight columns the rows, three by
/// three. `turned`: rows become columns first.
void split(const double* high, const double* low, int degree, int stride, bool turned, double unit,
           double finer, double* slices) {
  // Adding and subtracting these rounds to multiples of the units.
  const Row coarse = Row::all(0x1.8p52 * unit), fine = Row::all(0x1.8p52 * finer);
  const int last = degree / 8;
  for (int i = 0; i <= last; ++i)
    for (int j = 0; i + j <= last; ++j) {
      const std::size_t from = (static_cast<std::size_t>(i) * stride + j) * 8;
      Row h[8], l[8];
      for (int r = 0; r < 8; ++r) {
        h[r] = Row::load(high + from + r * stride);
        l[r] = Row::load(low + from + r * stride);
      }
      if (turned) {
        transpose(h);
        transpose(l);
      }
      const int row = 8 * (turned ? j : i), column = turned ? i : j;
      double* to = slices + 24 * (static_cast<std::size_t>(column) * stride + row);
      double scale = 1.0 / (1ll << row);
      for (int r = 0; r < 8; ++r, scale *= 0.5) {
        const Row x = h[r] * Row::all(scale), first = (x + coarse) - coarse, rest = x - first,
                  second = (rest + fine) - fine;
        first.store(to + 24 * r);
        second.store(to + 24 * r + 8);
        ((rest - second) + l[r] * Row::all(scale)).store(to + 24 * r + 16);
      }
    }
}

/// Coefficient k of p((t - 1) / 2) and of p((t + 1) / 2): the terms with even and with odd powers
/// of the shift are added up apart, those of the first two slices without rounding.
struct HalvedRow {
  Row even[3], odd[3];
  HWY_INLINE void clear() {
    for (int s = 0; s < 3; ++s) even[s] = odd[s] = Row::all(0);
  }
  static HWY_INLINE void add(Row* sum, double binomial, const Row* row) {
    const Row factor = Row::all(binomial);
    sum[0] = exact_multiply_add(factor, row[0], sum[0]);
    sum[1] = exact_multiply_add(factor, row[1], sum[1]);
    sum[2] = sum[2] + factor * row[2];
  }
  HWY_INLINE void store(std::size_t to, double* const* high, double* const* low, Row* most) const {
    for (int half = 0; half < 2; ++half) {
      Row sum[3], error;
      for (int s = 0; s < 3; ++s) sum[s] = half == 0 ? even[s] - odd[s] : even[s] + odd[s];
      const Row whole = exact_sum(sum[0], sum[1], &error), rest = error + sum[2];
      // Dekker's sum: good enough where the first summand is the smaller one.
      const Row rounded = whole + rest;
      rounded.store(high[half] + to);
      (rest - (rounded - whole)).store(low[half] + to);
      most[half] = greatest(most[half], absolute(rounded));
    }
  }
};

/// Both halves of all rows, two at a time. Returns their largest coefficients.
void halve_slices(const double* slices, int degree, int stride, double* const* high,
                  double* const* low, double* largest) {
  Row most[2] = {Row::all(0), Row::all(0)};
  for (int column = 0; 8 * column <= degree; ++column) {
    const double* rows = slices + 24 * static_cast<std::size_t>(column) * stride;
    const int top = degree - 8 * column;
    for (int k = 0; k <= top; k += 2) {
      HalvedRow one, next;
      one.clear();
      next.clear();
      const double *binomial = kBinomials.over[k], *binomial_next = kBinomials.over[k + 1];
      Row row[3];
      const auto load = [&](int i) {
        for (int s = 0; s < 3; ++s) row[s] = Row::load(rows + 24 * i + 8 * s);
      };
      int i = k;
      for (; i < top; i += 2) {
        load(i);
        HalvedRow::add(one.even, binomial[i], row);
        HalvedRow::add(next.odd, binomial_next[i], row);
        load(i + 1);
        HalvedRow::add(one.odd, binomial[i + 1], row);
        HalvedRow::add(next.even, binomial_next[i + 1], row);
      }
      if (i == top) {
        load(i);
        HalvedRow::add(one.even, binomial[i], row);
        HalvedRow::add(next.odd, binomial_next[i], row);
      }
      const std::size_t to = static_cast<std::size_t>(k) * stride + 8 * column;
      one.store(to, high, low, most);
      if (k < top) next.store(to + stride, high, low, most);
    }
  }
  for (int half = 0; half < 2; ++half) largest[half] = greatest_lane(most[half]);
}

/// Sums with the weights of degrees.
struct Totals {
  Row sum[3];
  HWY_INLINE void clear() { sum[0] = sum[1] = sum[2] = Row::all(0); }
  HWY_INLINE void add(const Row& size, int first) {
    for (int p = 0; p < 3; ++p)
      sum[p] = sum[p] + size * Row::load_unaligned(kWeights.of[p] + first);
  }
};

/// The coefficients of a tile, from numbers high + low (`turned`: rows are those of the second
/// variable), and their sums.
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
  for (int i = 0; i <= last; ++i)
    for (int j = 0; i + j <= last; ++j) {
      const std::size_t from = (static_cast<std::size_t>(i) * stride + j) * 8;
      Row c[8];
      for (int r = 0; r < 8; ++r)
        c[r] = Row::load(high + from + r * stride) + Row::load(low + from + r * stride);
      if (i + j >= 2) {
        for (int r = 0; r < 8; ++r) dropped.add(absolute(c[r]), 8 * (i + j) + r);
        continue;
      }
      if (turned) transpose(c);
      double* to = a + 8 * ((turned ? j : i) * Tile::kRow + (turned ? i : j));
      if (i + j == 0) {
        for (int r = 0; r < 8; ++r) {
          c[r].store(to + r * Tile::kRow);
          kept.add(absolute(c[r]), r);
        }
        continue;
      }
      Row size[8];
      for (int r = 0; r < 8; ++r) {
        const Row inside = first_lanes(c[r], zero, 8 - r);
        inside.store(to + r * Tile::kRow);
        size[r] = absolute(inside);
        kept.add(size[r], 8 + r);
        dropped.add(absolute(c[r] - inside), 8 + r);
      }
      // Columns of the block with s_1^8 and so on, rows of that with s_0^8.
      if ((i == 1) != turned) transpose(size);
      powers = powers + (((size[0] + size[1]) + (size[2] + size[3])) +
                         ((size[4] + size[5]) + (size[6] + size[7])));
    }
  for (int p = 0; p < 3; ++p) {
    sums->kept[p] = sum_of_lanes(kept.sum[p]);
    sums->dropped[p] = sum_of_lanes(dropped.sum[p]);
  }
  // Taylor's shift to 1.
  HWY_ALIGN double of_power[8];
  powers.store(of_power);
  Row shifted = zero;
  for (int i = std::min(degree, Tile::kMaxDegree); i >= 8; --i)
    shifted = shifted + Row::all(of_power[i - 8]) * Row::load(kHighBinomials.of[i - 8]);
  HWY_ALIGN double result[8];
  shifted.store(result);
  std::copy(result, result + 8, sums->high_terms);
}

/// The value of sum a[i][j] s^i t^j and its derivatives.
void evaluate(const double* a, int degree, double s, double t, double* result) {
  // In each lane j: sum over i of a[i][j] s^i, and its derivative; then the sum over the lanes.
  const Row at = Row::all(s);
  double value = 0, slope_s = 0, slope_t = 0;
  for (int part = degree / 8; part >= 0; --part) {
    const double* from = a + 8 * part;
    Row v = Row::all(0), d = Row::all(0);
    for (int i = degree - 8 * part; i >= 0; --i) {
      d = d * at + v;
      v = v * at + Row::load(from + i * Tile::kRow);
    }
    HWY_ALIGN double x[8], y[8];
    v.store(x);
    d.store(y);
    for (int j = std::min(7, degree - 8 * part); j >= 0; --j) {
      slope_t = slope_t * t + value;
      value = value * t + x[j];
      slope_s = slope_s * t + y[j];
    }
  }
  result[0] = value;
  result[1] = slope_s;
  result[2] = slope_t;
}

HWY_INLINE Pair multiply(const Pair& a, const Pair& b) {
  Pair r;
  r.high = exact_product(a.high, b.high, &r.low);
  r.low = r.low + (a.high * b.low + a.low * b.high);
  return r;
}
HWY_INLINE Pair add(const Pair& a, const Pair& b) {
  Pair r;
  r.high = exact_sum(a.high, b.high, &r.low);
  r.low = r.low + (a.low + b.low);
  return r;
}

/// The powers y^0 to y^7 in the lanes, and y^8.
HWY_INLINE Pair powers(double y, Pair* eighth) {
  const Row zero = Row::all(0), one = Row::all(1);
  Pair power{Row::all(y), zero}, lanes{one, zero};
  HWY_ALIGN static constexpr double kBits[3][8] = {
      {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};
  for (const auto& bits : kBits) {
    // Lanes with the bit are multiplied, the others by one.
    const Row bit = Row::load(bits), rest = one - bit;
    lanes = multiply(lanes, Pair{power.high * bit + rest, power.low * bit});
    power = multiply(power, power);
  }
  *eighth = power;
  return lanes;
}

/// The sum of coefficients times x^i y^j: Horner's rule over the rows, all powers of y at once.
double precise_value(const double* high, const double* low, int degree, int stride, double x,
                     double y) {
  const Row zero = Row::all(0);
  const Pair at{Row::all(x), zero};
  Pair eighth, of_y = powers(y, &eighth), total{zero, zero};
  for (int j = 0; j <= degree; j += 8) {
    Pair sum{zero, zero};
    for (int i = degree - j; i >= 0; --i) {
      const std::size_t from = static_cast<std::size_t>(i) * stride + j;
      sum = add(multiply(sum, at), Pair{Row::load(high + from), Row::load(low + from)});
    }
    total = add(total, multiply(sum, of_y));
    of_y = multiply(of_y, eighth);
  }
  // Pairwise over the lanes.
  HWY_ALIGN double h[8], l[8];
  total.high.store(h);
  total.low.store(l);
  for (int width = 4; width >= 1; width /= 2)
    for (int k = 0; k < width; ++k) {
      const double a = h[k], b = h[k + width], s = a + b, b1 = s - a;
      l[k] = (l[k] + l[k + width]) + ((a - (s - b1)) + (b - b1));
      h[k] = s;
    }
  return h[0] + l[0];
}

/// The sums at eight points, one in each lane: Horner's rule in y, then in x.
void precise_values(const double* high, const double* low, int degree, int stride, const double* x,
                    const double* y, double* result) {
  const Row at_x = Row::load(x), at_y = Row::load(y);
  const auto step = [](const Pair& sum, const Row& at, const Pair& next) {
    Row product_error, sum_error;
    const Row product = exact_product(sum.high, at, &product_error);
    Pair r;
    r.high = exact_sum(product, next.high, &sum_error);
    r.low = sum.low * at + ((product_error + sum_error) + next.low);
    return r;
  };
  Pair total{};
  for (int i = degree; i >= 0; --i) {
    const std::size_t row = static_cast<std::size_t>(i) * stride;
    int j = degree - i;
    Pair sum{Row::all(high[row + j]), Row::all(low[row + j])};
    while (--j >= 0) sum = step(sum, at_y, {Row::all(high[row + j]), Row::all(low[row + j])});
    total = i == degree ? sum : step(total, at_x, sum);
  }
  (total.high + total.low).store(result);
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

HWY_EXPORT(shift_and_scale);
HWY_EXPORT(turn);
HWY_EXPORT(normalize);
HWY_EXPORT(split);
HWY_EXPORT(halve_slices);
HWY_EXPORT(fill_tile);
HWY_EXPORT(evaluate);
HWY_EXPORT(evaluate_eight);
HWY_EXPORT(precise_value);
HWY_EXPORT(precise_values);

constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies
constexpr int kMaxDepth = 8;         // of the quadtree of tiles
// The error that a tile of the tree may have from halving, beside the sum of its coefficients.
constexpr double kHalvingError = 0x1p-57;
constexpr double kRounded = 0x1.01p-53;  // relative: of a sum of two doubles that becomes one

struct alignas(64) Eight {
  double x[8];
};

/// Numbers high + low, aligned: rows of coefficients, `stride` apart and as many (up to 7 more than
/// there are). Zero beyond the total degree, within blocks of eight rows and columns.
struct Coefficients {
  Eight* memory = nullptr;
  int stride = 0;

  static int stride_for(int n) { return (n / 8 + 1) * 8; }
  /// In eights.
  static std::size_t size_for(int n) {
    const auto stride = static_cast<std::size_t>(stride_for(n));
    return stride * stride / 4;
  }
  double* high() { return memory->x; }
  double* low() { return high() + static_cast<std::size_t>(stride) * stride; }
};

/// (1 + x + y)^n, rounded up.
double growth(const Point<2>& reach, int n) {
  double result = 1, power = (1 + reach[0] + reach[1]) * kUp;
  for (int rest = n; rest > 0; rest /= 2, power *= power * kUp)
    if (rest % 2) result *= power * kUp;
  return result;
}

Point<2> reach_of(const Tile& tile) {
  Point<2> reach;
  for (int i = 0; i < 2; ++i)
    reach[i] = (std::fabs(tile.center[i]) + tile.half[i] * Tile::kReach) * kUp;
  return reach;
}

/// Nothing is known of a tile where numbers overflow.
void claim_nothing(Tile* tile) {
  for (auto& row : tile->a) row.fill(0.0);
  tile->high_terms.fill(0.0);
  tile->sum = tile->slope = tile->bend = 0;
  tile->error = tile->slope_error = tile->bend_error = tile->value_error =
      std::numeric_limits<double>::infinity();
}

/// Sums of absolute values of coefficients, times kReach^degree.
struct Sums {
  double kept = 0, dropped = 0;
};

/// Makes a tile of Taylor coefficients of a polynomial of degree n, the errors of which add up to
/// at most `error`; each is rounded to a relative `relative`. `turned`: their rows are those of the
/// second variable. Returns the sums of those that the tile has and that it has no room for.
Sums fill(Tile* tile, int n, Coefficients& coefficients, bool turned, double error,
          double relative) {
  tile->degree = std::min(n, Tile::kMaxDegree);
  TileSums sums;
  HWY_DYNAMIC_DISPATCH(fill_tile)
  (coefficients.high(), coefficients.low(), n, coefficients.stride, turned, tile->a[0].data(),
   &sums);
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

/// A power of two greater than x > 0.
double power_above(double x) {
  int exponent;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, exponent);
}

void place(Tile* tile, const Box<2>& box) {
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    tile->center[i] = chart.center;
    tile->half[i] = chart.half;
  }
}

/// Whether the coordinates of a box are exactly those of a quarter of a rectangle, the upper one
/// along the axes that have their bit in `upper`.
bool is_quarter(const Box<2>& box, int upper, const Point<2>& center, const Point<2>& half) {
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    const double step = (upper >> i) % 2 ? chart.half : -chart.half;
    if (chart.half != 0.5 * half[i] || chart.center - center[i] != step ||
        !exact_difference(chart.center, center[i]))
      return false;
  }
  return true;
}

/// Halves a rectangle along the variable of the rows (`turned`: of the columns, which become rows).
/// `largest`: |high| of `from`, then of both halves. False if numbers are too large or small.
bool halve_rows(Coefficients& from, bool turned, double largest, int n, double* slices,
                Coefficients* lower, Coefficients* upper, double* largest_of_both) {
  if (!(0x1p-700 < largest && largest < 0x1p900)) return false;
  const double unit = 0x1p-48 * power_above(largest), finer = std::ldexp(unit, n - 52);
  HWY_DYNAMIC_DISPATCH(split)
  (from.high(), from.low(), n, from.stride, turned, unit, finer, slices);
  double* const high[2] = {lower->high(), upper->high()};
  double* const low[2] = {lower->low(), upper->low()};
  HWY_DYNAMIC_DISPATCH(halve_slices)
  (slices, n, from.stride, high, low, largest_of_both);
  return true;
}

/// What that loses at most, if the coefficients' absolute values add up to `sum`:
/// docs/error-bounds.md.
double halving_loss(int n, double largest, double sum) {
  const double rest = std::ldexp(power_above(largest), 2 * n - 99);
  return 0x1.2p-53 * ((0.5 * n + 6) * rest + (0.5 * n + 9) * 0x1p-53 * sum);
}

/// Whether the tile serves for the whole rectangle: its terms of higher degree do not matter, and
/// patches some times smaller than the rectangle keep close to it.
bool tile_serves(const Tile& tile, double dropped) {
  static const auto weights = [] {
    std::array<double, 8> w;
    for (int k = 0; k < 8; ++k) w[k] = std::ldexp(interpolation_loss(8 + k).value, -2 * (8 + k));
    return w;
  }();
  double size = 0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) size += std::fabs(tile.a[i][j]);
  double loss = 0;
  for (int k = 0; k < 8; ++k) loss += weights[k] * tile.high_terms[k];
  return dropped <= 0x1p-14 * size && loss <= 0x1p-5 * size;
}

/// What sums of two doubles do not hold of the roundings of a shift or a value, relative to the sum
/// of absolute values, in units of the square of the unit roundoff: docs/error-bounds.md.
double unheld_roundings(int n) {
  return (2 * n + n / 8 + 6) * (4 * n + 66) + 3 * n * n + 2 * n + 4;
}

}  // namespace

/// A polynomial in the coordinates of a node of the tree.
struct TiledPolynomial::Expansion {
  Coefficients coefficients;
  Point<2> center{}, half{};
  int rows_axis = 0;    ///< 0: the coefficients of a power of x are a row; 1: of y
  bool halved = false;  ///< comes from halving: low is what high lacks
  double largest = 0;   ///< |high|, if `halved`
  double sum = 0;       ///< at least the coefficients' absolute values, times kReach^degree
  // What bounds their errors, added up likewise:
  Point<2> origin{};        ///< the centre of the expansion made directly that this comes from
  double halving_loss = 0;  ///< of the halvings since, and what underflows
};

/// What the expansions of one polynomial share, and the memory of its tiles.
struct TiledPolynomial::Workspace {
  struct Column {
    double center, half;
    Coefficients shifted;  // row j: the coefficients of y^j
  };

  explicit Workspace(int n) : degree(n) {
    // (Zeros are needed in the first one only.)
    const std::size_t size = Coefficients::size_for(n);
    Eight* memory = allocate(3 * size);
    std::fill_n(memory->x, 8 * size, 0.0);
    for (Coefficients* c : {&original, &scratch, &local.coefficients}) {
      *c = {memory, Coefficients::stride_for(n)};
      memory += size;
    }
  }

  Eight* allocate(std::size_t size) {
    blocks.push_back(std::make_unique_for_overwrite<Eight[]>(size));
    return blocks.back().get();
  }

  /// Memory for coefficients that are to be written below the total degree only.
  Coefficients coefficients() {
    const std::size_t size = Coefficients::size_for(degree);
    Eight* memory = allocate(size);
    std::fill_n(memory->x, 8 * size, 0.0);
    return {memory, Coefficients::stride_for(degree)};
  }

  /// The next tile to be made; used when `keep` is called.
  Tile* tile() {
    if (used == room) {
      room = std::min(32, 4 * room);
      used = 0;
      chunks.push_back(std::make_unique_for_overwrite<Tile[]>(static_cast<std::size_t>(room)));
      next_tile = chunks.back().get();
    }
    return next_tile;
  }
  void keep() {
    ++used;
    ++next_tile;
  }

  Expansion* take() {
    if (idle.empty()) {
      expansions.push_back(std::make_unique<Expansion>(Expansion{coefficients()}));
      return expansions.back().get();
    }
    Expansion* last = idle.back();
    idle.pop_back();
    return last;
  }
  void give_back(Expansion* expansion) { idle.push_back(expansion); }

  void prepare_halving() {
    if (slices) return;
    slices = allocate(Coefficients::size_for(degree) / 2 * 3)->x;
    for (Coefficients& half : halves) half = coefficients();
  }

  int degree;
  std::vector<std::unique_ptr<Eight[]>> blocks;
  Coefficients original, scratch;  ///< row i: the coefficients of x^i
  Expansion local;                 ///< the last one that was made directly
  std::vector<Column> columns;     ///< shifted in x, for the tiles that stand in one column
  double* slices = nullptr;
  std::array<Coefficients, 2> halves;
  std::vector<std::unique_ptr<Expansion>> expansions;  ///< of nodes without a tile or children
  std::vector<Expansion*> idle;

  Tile first_tile;
  std::vector<std::unique_ptr<Tile[]>> chunks;
  Tile* next_tile = &first_tile;
  int used = 0, room = 1;  ///< of the last chunk
};

TiledPolynomial::TiledPolynomial(const FilteredPolynomial<2>& f, const Box<2>& box, Kernel& kernel)
    : f_(&f),
      kernel_(&kernel),
      root_(box),
      nodes_(1),
      workspace_(std::make_unique<Workspace>(f.degree())) {
  const std::size_t n = static_cast<std::size_t>(f.degree());
  Coefficients& original = workspace_->original;
  const std::size_t stride = static_cast<std::size_t>(original.stride);
  const double *high = f.coefficients().data(), *low = f.low_coefficients().data();
  for (std::size_t i = 0; i <= n; ++i) {
    std::copy_n(high + i * (n + 1), n + 1 - i, original.high() + i * stride);
    std::copy_n(low + i * (n + 1), n + 1 - i, original.low() + i * stride);
  }
  nodes_[0].box = box;
  nodes_[0].center = box.center();
}

TiledPolynomial::TiledPolynomial(TiledPolynomial&&) noexcept = default;
TiledPolynomial::~TiledPolynomial() = default;

const Tile& TiledPolynomial::at(const Point<2>& point) {
  int node = 0;
  while (!nodes_[node].tile) {
    if (nodes_[node].first_child < 0) {
      develop(node);
      continue;
    }
    const Point<2>& center = nodes_[node].center;
    node = nodes_[node].first_child + (point[0] > center[0]) + 2 * (point[1] > center[1]);
  }
  return *nodes_[node].tile;
}

void TiledPolynomial::expand(const Box<2>& box, int bits, Tile* tile) {
  make(box, bits, false, tile, &workspace_->local);
}

/// Gives a node a tile, or children.
void TiledPolynomial::develop(int index) {
  Workspace& w = *workspace_;
  Expansion* expansion = std::exchange(nodes_[index].expansion, nullptr);
  if (!expansion) {
    Node& node = nodes_[index];
    Tile* tile = w.tile();
    const double dropped = make(node.box, kernel_->start_bits, node.depth > 0, tile, &w.local);
    if (serves(node, *tile, dropped)) return;
  }
  const int first = static_cast<int>(nodes_.size());
  nodes_[index].first_child = first;
  nodes_.resize(nodes_.size() + 4);
  const Node& node = nodes_[index];
  for (int k = 0; k < 4; ++k) {
    Node& child = nodes_[first + k];
    child.depth = node.depth + 1;
    child.box = node.box;
    for (int i = 0; i < 2; ++i) ((k >> i) % 2 ? child.box.lo : child.box.hi)[i] = node.center[i];
    child.center = child.box.center();
  }
  if (f_->degree() <= kMaxHalved && kernel_->start_bits <= Kernel::kDoubleBits &&
      std::isfinite((expansion ? expansion : &w.local)->sum))
    halve(expansion ? *expansion : w.local, first);
  if (expansion) w.give_back(expansion);
}

/// Whether the tile just made serves for the node: then it is kept.
bool TiledPolynomial::serves(Node& node, Tile& tile, double dropped) {
  if (node.depth < kMaxDepth && !tile_serves(tile, dropped)) return false;
  node.tile = &tile;
  workspace_->keep();
  return true;
}

/// Halves an expansion along both axes, for the four children of its node, if their coordinates are
/// exactly those of quarters. A child that would lose too much gets nothing: it is made from the
/// coefficients of f if it is asked for.
void TiledPolynomial::halve(Expansion& parent, int first_child) {
  for (int k = 0; k < 4; ++k)
    if (!is_quarter(nodes_[first_child + k].box, k, parent.center, parent.half)) return;
  const int n = f_->degree();
  Workspace& w = *workspace_;
  Coefficients& c = parent.coefficients;
  if (!parent.halved)
    parent.largest = HWY_DYNAMIC_DISPATCH(normalize)(c.high(), c.low(), n, c.stride);
  w.prepare_halving();
  const double most = parent.largest, underflow = 0x1p-900;
  double largest[2];
  if (!halve_rows(c, false, most, n, w.slices, &w.halves[0], &w.halves[1], largest)) return;
  const double loss = parent.halving_loss + halving_loss(n, most, parent.sum) + underflow;
  for (int first = 0; first < 2; ++first) {
    Expansion* child[2] = {w.take(), w.take()};
    double largest_of[2];
    const bool done = halve_rows(w.halves[first], true, largest[first], n, w.slices,
                                 &child[0]->coefficients, &child[1]->coefficients, largest_of);
    const double losses = (loss + halving_loss(n, largest[first], parent.sum)) * kUp;
    for (int second = 0; second < 2; ++second) {
      const int upper = parent.rows_axis == 0 ? first + 2 * second : 2 * first + second;
      Node& node = nodes_[first_child + upper];
      Expansion& e = *child[second];
      if (!done) {
        w.give_back(&e);
        continue;
      }
      ++kernel_->expansions;
      Tile* tile = w.tile();
      place(tile, node.box);
      tile->bits = Kernel::kDoubleBits;
      tile->value_error = precise_error(reach_of(*tile));
      e.rows_axis = 1 - parent.rows_axis;
      e.halved = true;
      e.largest = largest_of[second];
      e.center = tile->center;
      e.half = tile->half;
      e.origin = parent.origin;
      e.halving_loss = losses;
      // What the direct expansion lacks, as far as here.
      Point<2> reach;
      for (int i = 0; i < 2; ++i) {
        const double way = std::fabs(tile->center[i] - e.origin[i]);
        reach[i] = (std::fabs(e.origin[i]) + way + tile->half[i] * Tile::kReach) * kUp;
      }
      const double error = precise_error(reach) + losses;
      const Sums sums = fill(tile, n, e.coefficients, e.rows_axis == 1, error, kRounded);
      e.sum = (sums.kept + sums.dropped) * kUp;
      if (error <= kHalvingError * tile->sum && !serves(node, *tile, sums.dropped))
        node.expansion = &e;
      else
        w.give_back(&e);
    }
  }
}

/// Makes a tile from the polynomial's coefficients, and the expansion that it comes from (in MPFR
/// only the coefficients of that). Returns the sum of those that the tile has no room for.
double TiledPolynomial::make(const Box<2>& box, int bits, bool in_tree, Tile* tile,
                             Expansion* expansion) {
  const int n = f_->degree();
  place(tile, box);
  tile->bits = bits;
  const Point<2> reach = reach_of(*tile);
  tile->value_error = precise_error(reach);
  Coefficients& c = expansion->coefficients;
  if (bits > Kernel::kDoubleBits) {
    const FilteredPolynomial<2>::Taylor taylor = f_->taylor(box, bits, *kernel_);
    std::fill_n(c.memory->x, 8 * Coefficients::size_for(n), 0.0);
    for (std::size_t i = 0, rows = static_cast<std::size_t>(n) + 1; i < rows; ++i)
      std::copy_n(&taylor.coefficients[i * rows], rows - i, c.high() + i * c.stride);
    return fill(tile, n, c, false, taylor.error * reach_power(n), 0).dropped;
  }
  ++kernel_->expansions;
  expand_directly(*tile, in_tree, expansion);
  // What the shifts lose: docs/error-bounds.md.
  const Sums sums = fill(tile, n, c, true, tile->value_error, kRounded);
  expansion->center = expansion->origin = tile->center;
  expansion->half = tile->half;
  expansion->rows_axis = 1;
  expansion->halved = false;
  expansion->sum = (sums.kept + sums.dropped) * kUp;
  expansion->halving_loss = 0x1p-900 * growth(reach, n);
  return sums.dropped;
}

/// The coefficients of y^j in row j, shifted and scaled to the coordinates of a tile.
void TiledPolynomial::expand_directly(const Tile& tile, bool in_tree, Expansion* expansion) {
  const int n = f_->degree();
  Workspace& w = *workspace_;
  Coefficients c = expansion->coefficients;
  const std::size_t size = Coefficients::size_for(n);
  const auto shift_in_x = [&](Coefficients shifted) {
    std::copy_n(w.original.memory, size, w.scratch.memory);
    HWY_DYNAMIC_DISPATCH(shift_and_scale)
    (w.scratch.high(), w.scratch.low(), n, c.stride, tile.center[0], tile.half[0]);
    HWY_DYNAMIC_DISPATCH(turn)
    (w.scratch.high(), w.scratch.low(), n, c.stride, shifted.high(), shifted.low());
  };
  if (in_tree) {
    // Such tiles stand in columns.
    const auto same = [&](const Workspace::Column& column) {
      return column.center == tile.center[0] && column.half == tile.half[0];
    };
    auto column = std::find_if(w.columns.begin(), w.columns.end(), same);
    if (column == w.columns.end()) {
      w.columns.push_back({tile.center[0], tile.half[0], w.coefficients()});
      column = w.columns.end() - 1;
      shift_in_x(column->shifted);
    }
    std::copy_n(column->shifted.memory, size, c.memory);
  } else {
    shift_in_x(c);
  }
  HWY_DYNAMIC_DISPATCH(shift_and_scale)
  (c.high(), c.low(), n, c.stride, tile.center[1], tile.half[1]);
}

double TiledPolynomial::precise_error(const Point<2>& reach) const {
  return 0x1.04p-106 * unheld_roundings(f_->degree()) * f_->absolute(reach) +
         0x1p-900 * growth(reach, f_->degree());
}

double TiledPolynomial::value(const Point<2>& point) const {
  Coefficients& c = workspace_->original;
  return HWY_DYNAMIC_DISPATCH(precise_value)(c.high(), c.low(), f_->degree(), c.stride, point[0],
                                             point[1]);
}

void TiledPolynomial::values(const Point<2>* points, int count, double* result) const {
  Coefficients& c = workspace_->original;
  alignas(64) double x[8] = {}, y[8] = {}, all[8];
  for (int k = 0; k < count; ++k) {
    x[k] = points[k][0];
    y[k] = points[k][1];
  }
  HWY_DYNAMIC_DISPATCH(precise_values)(c.high(), c.low(), f_->degree(), c.stride, x, y, all);
  std::copy_n(all, count, result);
}

std::array<double, 3> value_and_gradient(const Tile& tile, const Point<2>& s) {
  std::array<double, 3> result;
  HWY_DYNAMIC_DISPATCH(evaluate)(tile.a[0].data(), tile.degree, s[0], s[1], result.data());
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
