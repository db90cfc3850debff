// SPDX-License-Identifier: MIT
#include "common/tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/patch.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/tile.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// row += x * next, of numbers high + low: the rounding errors of the high parts go to the low ones.
HWY_INLINE void add_multiple(double* high, double* low, double x, const double* next_high,
                             const double* next_low, int count) {
  const Row factor = Row::all(x);
  for (int j = 0; j < count; j += 8) {
    Row product_error, sum_error;
    const Row product = exact_product(Row::load(next_high + j), factor, &product_error);
    const Row sum = exact_sum(Row::load(high + j), product, &sum_error);
    const Row rest = Row::load(low + j) + factor * Row::load(next_low + j);
    sum.store(high + j);
    (rest + (product_error + sum_error)).store(low + j);
  }
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

/// Row i, of numbers high + low, holds the coefficients of s^i: p(s) -> p(origin + half s). Rows are
/// `stride` apart, and row i has degree + 1 - i entries (the rest are zero).
void shift_and_scale(double* high, double* low, int degree, int stride, double origin, double half) {
  if (origin != 0) {
    // Synthetic division, by the antidiagonals of its table: the steps of one do not wait for each
    // other.
    for (int level = 0; level < degree; ++level)
      for (int i = 0; i <= level; ++i) {
        const int k = degree - 1 - level + i;
        const std::size_t row = static_cast<std::size_t>(k) * stride, next = row + stride;
        add_multiple(high + row, low + row, origin, high + next, low + next, degree - k);
      }
  }
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

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(shift_and_scale);

constexpr double kUp = 1 + 0x1p-40;  // outweighs the roundings of the sums it multiplies
constexpr int kMaxDepth = 8;         // of the quadtree of tiles

/// The coefficients of a polynomial as sums high + low of doubles: row i (of degree + 1) holds those
/// of one power of one variable, `stride` apart.
struct Coefficients {
  hwy::AlignedVector<double> high, low;
};

int stride_of(int degree) { return (degree + 8) / 8 * 8; }

}  // namespace

/// What the expansions of one polynomial share.
struct TiledPolynomial::Workspace {
  Coefficients original;   // rows by powers of x
  Coefficients in_x;       // shifted in x, then rows by powers of y
  Coefficients in_y;
  struct Column {
    double center, half;
    Coefficients shifted;
  };
  std::vector<Column> columns;  // of tiles with one centre in x
};
#endif
