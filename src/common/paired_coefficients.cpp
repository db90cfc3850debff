// SPDX-License-Identifier: MIT
#include "common/paired_coefficients.hpp"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/paired_coefficients.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_PAIRED_COEFFICIENTS_ONCE
#define ENCASE_PAIRED_COEFFICIENTS_ONCE
namespace encase {
namespace {

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

/// Row i has degree + 1 - i entries (the rest are zero).
void shift_and_scale_rows(double* high, double* low, int degree, int stride, double origin,
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

/// Whole blocks of eight, those with coefficients up to the total degree.
void turn_blocks(const double* high, const double* low, int degree, int stride, double* to_high,
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

double normalize_rows(double* high, double* low, int degree, int stride) {
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
void slice_rows(const double* high, const double* low, int degree, int stride, bool turned,
                double unit, double finer, double* slices) {
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
    sum[0] = multiply_add(factor, row[0], sum[0]);
    sum[1] = multiply_add(factor, row[1], sum[1]);
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

/// Both halves of all rows of doubles, in doubles, as above. `turned`: rows become columns first.
void halve_row_sums(const double* from, int degree, int stride, bool turned, double* lower,
                    double* upper) {
  static_assert(kMaxHalved < 32);
  HWY_ALIGN double rows[8 * 32];
  const int last = degree / 8;
  for (int column = 0; column <= last; ++column) {
    for (int block = 0; block + column <= last; ++block) {
      const int i = turned ? column : block, j = turned ? block : column;
      Row c[8];
      for (int r = 0; r < 8; ++r)
        c[r] = Row::load(from + (static_cast<std::size_t>(8 * i + r) * stride + 8 * j));
      if (turned) transpose(c);
      double scale = 1.0 / (1ll << (8 * block));
      for (int r = 0; r < 8; ++r, scale *= 0.5)
        (c[r] * Row::all(scale)).store(rows + 8 * (8 * block + r));
    }
    const int top = degree - 8 * column;
    for (int k = 0; k <= top; k += 2) {
      const double *binomial = kBinomials.over[k], *binomial_next = kBinomials.over[k + 1];
      Row even = Row::all(0), odd = even, next_even = even, next_odd = even;
      int i = k;
      for (; i < top; i += 2) {
        const Row row = Row::load(rows + 8 * i), other = Row::load(rows + 8 * i + 8);
        even = even + row * Row::all(binomial[i]);
        next_odd = next_odd + row * Row::all(binomial_next[i]);
        odd = odd + other * Row::all(binomial[i + 1]);
        next_even = next_even + other * Row::all(binomial_next[i + 1]);
      }
      if (i == top) {
        const Row row = Row::load(rows + 8 * i);
        even = even + row * Row::all(binomial[i]);
        next_odd = next_odd + row * Row::all(binomial_next[i]);
      }
      const std::size_t to = static_cast<std::size_t>(k) * stride + 8 * column;
      (even - odd).store(lower + to);
      (even + odd).store(upper + to);
      if (k == top) continue;
      (next_even - next_odd).store(lower + to + stride);
      (next_even + next_odd).store(upper + to + stride);
    }
  }
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

/// sum * at + next, with short ways from the sum's parts to those of the result.
HWY_INLINE Pair horner_step(const Pair& sum, const Row& at, const Pair& next) {
  Row product_error, sum_error;
  const Row product = exact_product(sum.high, at, &product_error);
  Pair r;
  r.high = exact_sum(product, next.high, &sum_error);
  r.low = sum.low * at + ((product_error + sum_error) + next.low);
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
double value_of_rows(const double* high, const double* low, int degree, int stride, double x,
                     double y) {
  const Row zero = Row::all(0), at = Row::all(x);
  Pair eighth, of_y = powers(y, &eighth), total{zero, zero};
  for (int j = 0; j <= degree; j += 8) {
    Pair sum{zero, zero};
    for (int i = degree - j; i >= 0; --i) {
      const std::size_t from = static_cast<std::size_t>(i) * stride + j;
      sum = horner_step(sum, at, Pair::load(high + from, low + from));
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
void values_of_rows(const double* high, const double* low, int degree, int stride, const double* x,
                    const double* y, double* result) {
  const Row at_x = Row::load(x), at_y = Row::load(y);
  Pair total{};
  for (int i = degree; i >= 0; --i) {
    const std::size_t row = static_cast<std::size_t>(i) * stride;
    int j = degree - i;
    Pair sum{Row::all(high[row + j]), Row::all(low[row + j])};
    while (--j >= 0)
      sum = horner_step(sum, at_y, {Row::all(high[row + j]), Row::all(low[row + j])});
    total = i == degree ? sum : horner_step(total, at_x, sum);
  }
  (total.high + total.low).store(result);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(shift_and_scale_rows);
HWY_EXPORT(turn_blocks);
HWY_EXPORT(normalize_rows);
HWY_EXPORT(slice_rows);
HWY_EXPORT(halve_slices);
HWY_EXPORT(halve_row_sums);
HWY_EXPORT(value_of_rows);
HWY_EXPORT(values_of_rows);

/// A power of two greater than x > 0.
double power_above(double x) {
  int exponent;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, exponent);
}

}  // namespace

void shift_and_scale(const PairedCoefficients& p, int degree, double origin, double half) {
  HWY_DYNAMIC_DISPATCH(shift_and_scale_rows)(p.high(), p.low(), degree, p.stride, origin, half);
}

void turn(const PairedCoefficients& from, int degree, const PairedCoefficients& to) {
  HWY_DYNAMIC_DISPATCH(turn_blocks)
  (from.high(), from.low(), degree, from.stride, to.high(), to.low());
}

double normalize(const PairedCoefficients& p, int degree) {
  return HWY_DYNAMIC_DISPATCH(normalize_rows)(p.high(), p.low(), degree, p.stride);
}

bool halve_rows(const PairedCoefficients& from, bool turned, double largest, int degree,
                double* slices, const PairedCoefficients& lower, const PairedCoefficients& upper,
                double* largest_of_both) {
  if (!(0x1p-700 < largest && largest < 0x1p900)) return false;
  const double unit = 0x1p-48 * power_above(largest), finer = std::ldexp(unit, degree - 52);
  HWY_DYNAMIC_DISPATCH(slice_rows)
  (from.high(), from.low(), degree, from.stride, turned, unit, finer, slices);
  double* const high[2] = {lower.high(), upper.high()};
  double* const low[2] = {lower.low(), upper.low()};
  HWY_DYNAMIC_DISPATCH(halve_slices)(slices, degree, from.stride, high, low, largest_of_both);
  return true;
}

void halve_rows_in_doubles(const PairedCoefficients& from, bool turned, int degree,
                           const PairedCoefficients& lower, const PairedCoefficients& upper) {
  HWY_DYNAMIC_DISPATCH(halve_row_sums)
  (from.high(), degree, from.stride, turned, lower.high(), upper.high());
}

double halving_loss_in_doubles(int degree, double sum) {
  return 0x1.04p-53 * (0.5 * degree + 3) * sum;
}

double halving_loss(int degree, double largest, double sum) {
  const double n = degree, rest = std::ldexp(power_above(largest), 2 * degree - 99);
  return 0x1.2p-53 * ((0.5 * n + 6) * rest + (0.5 * n + 9) * 0x1p-53 * sum);
}

double unheld_roundings(int degree) {
  const int n = degree;
  return (2 * n + n / 8 + 6) * (4 * n + 66) + 3 * n * n + 2 * n + 4;
}

double precise_value(const PairedCoefficients& p, int degree, double x, double y) {
  return HWY_DYNAMIC_DISPATCH(value_of_rows)(p.high(), p.low(), degree, p.stride, x, y);
}

void precise_values(const PairedCoefficients& p, int degree, const double* x, const double* y,
                    double* result) {
  HWY_DYNAMIC_DISPATCH(values_of_rows)(p.high(), p.low(), degree, p.stride, x, y, result);
}

}  // namespace encase
#endif
