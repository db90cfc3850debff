// SPDX-License-Identifier: MIT
#include "common/coefficient_rows.hpp"

#include <cstdint>
#include <cstring>

#include "common/vectorized.hpp"
#include "encase/polynomial.hpp"

namespace encase {
namespace {

// Eight doubles that the compiler maps to what registers there are. All clones of a function do the
// same operations in the same order.
using Lanes = double __attribute__((vector_size(64)));
using LaneBits = std::int64_t __attribute__((vector_size(64)));
using Quarter = double __attribute__((vector_size(16)));
#define ENCASE_INLINE inline __attribute__((always_inline))

ENCASE_INLINE void load(const double* lane, Lanes& lanes) {
  __builtin_memcpy(&lanes, lane, sizeof lanes);
}

/// y^0, ..., y^7: at most j - 1 roundings in y^j.
ENCASE_INLINE void set_powers(double y, Lanes& powers) {
  const double y2 = y * y, y4 = y2 * y2;
  const Lanes one = {1, y, 1, y, 1, y, 1, y}, two = {1, 1, y2, y2, 1, 1, y2, y2},
              four = {1, 1, 1, 1, y4, y4, y4, y4};
  powers = one * two * four;
}

/// first = 0, a_0, ..., a_6.
ENCASE_INLINE void move_up(const Lanes& a, Lanes& moved) {
  moved = __builtin_shufflevector(a, Lanes{}, 8, 0, 1, 2, 3, 4, 5, 6);
}

/// sums[0], sums[1] = the sum of the lanes of a and of b; three additions each.
ENCASE_INLINE void add_lanes(const Lanes& a, const Lanes& b, double* sums) {
  const Lanes pairs = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
                      __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Quarter low =
      __builtin_shufflevector(pairs, pairs, 0, 1) + __builtin_shufflevector(pairs, pairs, 4, 5);
  const Quarter high =
      __builtin_shufflevector(pairs, pairs, 2, 3) + __builtin_shufflevector(pairs, pairs, 6, 7);
  const Quarter total = low + high;
  __builtin_memcpy(sums, &total, sizeof total);
}

/// The derivatives up to `order` at (x, y): value; x, y; xx, xy, yy. Block after block of columns
/// (powers of y) the rows are summed with the powers of x, and those sums with the powers of y.
///
/// Roundings of c x^i y^j, i + j <= n: i - 1 in the power and 1 in the product, at most n + 1 - i
/// sums over the rows, j - 1 in the power of y, 1 in the product, n / 8 + 1 sums over the blocks, 3
/// over the lanes. The powers of y in a block are those of the block before times y^8.
template <int order, bool absolute>
ENCASE_INLINE void evaluate(const CoefficientRows::Block* blocks, int degree, const Point<2>& at,
                            double* result) {
  const int rows = degree + 1, width = rows / 8 + (rows % 8 != 0);
  const double x = at[0], y = at[1];
  double power[3][kMaxDegree + 1];  // of x, and its derivatives
  power[0][0] = 1;
  power[1][0] = power[2][0] = 0;
  double number = 1;
  for (int i = 1; i < rows; ++i, number += 1) {
    power[0][i] = power[0][i - 1] * x;
    if (order >= 1) power[1][i] = number * power[0][i - 1];
    if (order >= 2) power[2][i] = number * power[1][i - 1];
  }
  Lanes exponent = {0, 1, 2, 3, 4, 5, 6, 7};
  Lanes y_power, y_first = {}, y_second = {};
  set_powers(y, y_power);
  if (order >= 1) {
    move_up(y_power, y_first);
    y_first *= exponent;
  }
  if (order >= 2) {
    move_up(y_first, y_second);
    y_second *= exponent;
  }
  const double y2 = y * y, y4 = y2 * y2, y6 = y4 * y2, y7 = y6 * y, y8 = y4 * y4;
  Lanes value = {}, dx = {}, dy = {}, dxx = {}, dxy = {}, dyy = {};
  for (int column = 0; column < width; ++column) {
    Lanes sum = {}, sum_x = {}, sum_xx = {};
    const CoefficientRows::Block* block = blocks + column;
    for (int i = 0; i < rows - 8 * column; ++i, block += width) {
      Lanes c;
      load(block->lane, c);
      if (absolute) c = (Lanes)((LaneBits)c & INT64_MAX);
      sum += c * power[0][i];
      if (order >= 1) sum_x += c * power[1][i];
      if (order >= 2) sum_xx += c * power[2][i];
    }
    value += sum * y_power;
    if (order >= 1) {
      dx += sum_x * y_power;
      dy += sum * y_first;
    }
    if (order >= 2) {
      dxx += sum_xx * y_power;
      dxy += sum_x * y_first;
      dyy += sum * y_second;
    }
    exponent += 8.0;
    if (order >= 1) y_first = exponent * (y_power * y7);
    if (order >= 2) y_second = exponent * (exponent - 1.0) * (y_power * y6);
    y_power *= y8;
  }
  add_lanes(value, dx, result);
  if (order >= 1) add_lanes(dy, dxx, result + 2);
  if (order >= 2) add_lanes(dxy, dyy, result + 4);
}

ENCASE_VECTORIZED void find_value(const CoefficientRows::Block* blocks, int degree,
                                  const Point<2>& at, double* result) {
  evaluate<0, false>(blocks, degree, at, result);
}
ENCASE_VECTORIZED void find_absolute(const CoefficientRows::Block* blocks, int degree,
                                     const Point<2>& at, double* result) {
  evaluate<0, true>(blocks, degree, at, result);
}
ENCASE_VECTORIZED void find_gradient(const CoefficientRows::Block* blocks, int degree,
                                     const Point<2>& at, double* result) {
  evaluate<1, false>(blocks, degree, at, result);
}
ENCASE_VECTORIZED void find_jet(const CoefficientRows::Block* blocks, int degree,
                                const Point<2>& at, double* result) {
  evaluate<2, false>(blocks, degree, at, result);
}

}  // namespace

CoefficientRows::CoefficientRows(const std::vector<double>& dense, int degree) : degree_(degree) {
  const std::size_t rows = static_cast<std::size_t>(degree) + 1, width = (rows + 7) / 8;
  blocks_.resize(rows * width);  // zeros
  for (std::size_t i = 0; i < rows; ++i)
    std::memcpy(&blocks_[i * width], &dense[i * rows], (rows - i) * sizeof(double));
}

double CoefficientRows::value(const Point<2>& at) const {
  double result[2];
  find_value(blocks_.data(), degree_, at, result);
  return result[0];
}

double CoefficientRows::absolute(const Point<2>& at) const {
  double result[2];
  find_absolute(blocks_.data(), degree_, at, result);
  return result[0];
}

Jet CoefficientRows::value_and_gradient(const Point<2>& at) const {
  double result[4];
  find_gradient(blocks_.data(), degree_, at, result);
  return {result[0], {result[1], result[2]}, 0, 0, 0};
}

Jet CoefficientRows::jet(const Point<2>& at) const {
  double result[6];
  find_jet(blocks_.data(), degree_, at, result);
  return {result[0], {result[1], result[2]}, result[3], result[4], result[5]};
}

}  // namespace encase
