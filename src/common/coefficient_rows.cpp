// SPDX-License-Identifier: MIT
#include "common/coefficient_rows.hpp"

#include <cstring>

#include "encase/polynomial.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/coefficient_rows.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Lane by lane: x where bit is 1, else 1.
HWY_INLINE Row where(const double* bits, double x) {
  const Row factor = Row::all(x), one = Row::all(1), bit = Row::load(bits);
  Row r;
  for (int k = 0; k < kParts; ++k)
    r.part[k] = hn::IfThenElse(hn::Eq(bit.part[k], one.part[k]), factor.part[k], one.part[k]);
  return r;
}

/// y^(j - less) in lane j (1 where that is negative): at most j - 1 roundings.
template <int less>
HWY_INLINE Row powers(double y, double y2, double y4) {
  // The binary digits of j - less.
  HWY_ALIGN static constexpr double kBits[3][3][8] = {
      {{0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}},
      {{0, 0, 1, 0, 1, 0, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1}, {0, 0, 0, 0, 0, 1, 1, 1}},
      {{0, 0, 0, 1, 0, 1, 0, 1}, {0, 0, 0, 0, 1, 1, 0, 0}, {0, 0, 0, 0, 0, 0, 1, 1}}};
  return where(kBits[less][0], y) * where(kBits[less][1], y2) * where(kBits[less][2], y4);
}

/// The derivatives up to `order` at (x, y): value; x, y; xx, xy, yy. Block after block of columns
/// (powers of y) the rows are summed with the powers of x, and those sums with the powers of y.
///
/// Roundings of c x^i y^j, i + j <= n: i - 1 in the power and 1 in the product, at most n + 1 - i
/// sums over the rows, j - 1 in the power of y, 1 in the product, n / 8 + 1 sums over the blocks, 3
/// over the lanes. The powers of y in a block are those of the block before times y^8.
template <int order, bool absolute_values>
HWY_INLINE void evaluate(const double* blocks, int degree, double x, double y, double* result) {
  const int rows = degree + 1, width = rows / 8 + (rows % 8 != 0);
  double power[3][kMaxDegree + 1];  // of x, and its derivatives
  power[0][0] = 1;
  power[1][0] = power[2][0] = 0;
  double number = 1;
  for (int i = 1; i < rows; ++i, number += 1) {
    power[0][i] = power[0][i - 1] * x;
    if constexpr (order >= 1) power[1][i] = number * power[0][i - 1];
    if constexpr (order >= 2) power[2][i] = number * power[1][i - 1];
  }
  HWY_ALIGN static constexpr double kLane[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const double y2 = y * y, y4 = y2 * y2, y6 = y4 * y2, y7 = y6 * y, y8 = y4 * y4;
  const Row zero = Row::all(0), one = Row::all(1);
  Row exponent = Row::load(kLane);
  Row y_power = powers<0>(y, y2, y4), y_first = zero, y_second = zero;
  if constexpr (order >= 1) y_first = exponent * powers<1>(y, y2, y4);
  if constexpr (order >= 2) y_second = exponent * (exponent - one) * powers<2>(y, y2, y4);
  Row value = zero, dx = zero, dy = zero, dxx = zero, dxy = zero, dyy = zero;
  for (int column = 0; column < width; ++column) {
    const double* block = blocks + 8 * column;
    Row sum = zero, sum_x = zero, sum_xx = zero;
    for (int i = 0; i < rows - 8 * column; ++i, block += 8 * width) {
      Row c = Row::load(block);
      if constexpr (absolute_values) c = absolute(c);
      sum = sum + c * Row::all(power[0][i]);
      if constexpr (order >= 1) sum_x = sum_x + c * Row::all(power[1][i]);
      if constexpr (order >= 2) sum_xx = sum_xx + c * Row::all(power[2][i]);
    }
    value = value + sum * y_power;
    if constexpr (order >= 1) {
      dx = dx + sum_x * y_power;
      dy = dy + sum * y_first;
    }
    if constexpr (order >= 2) {
      dxx = dxx + sum_xx * y_power;
      dxy = dxy + sum_x * y_first;
      dyy = dyy + sum * y_second;
    }
    if (column + 1 == width) break;
    exponent = exponent + Row::all(8);
    if constexpr (order >= 1) y_first = exponent * (y_power * Row::all(y7));
    if constexpr (order >= 2) y_second = exponent * (exponent - one) * (y_power * Row::all(y6));
    y_power = y_power * Row::all(y8);
  }
  result[0] = sum_of_lanes(value);
  if constexpr (order >= 1) {
    result[1] = sum_of_lanes(dx);
    result[2] = sum_of_lanes(dy);
  }
  if constexpr (order >= 2) {
    result[3] = sum_of_lanes(dxx);
    result[4] = sum_of_lanes(dxy);
    result[5] = sum_of_lanes(dyy);
  }
}

void find_value(const double* blocks, int degree, double x, double y, double* result) {
  evaluate<0, false>(blocks, degree, x, y, result);
}
void find_absolute(const double* blocks, int degree, double x, double y, double* result) {
  evaluate<0, true>(blocks, degree, x, y, result);
}
void find_gradient(const double* blocks, int degree, double x, double y, double* result) {
  evaluate<1, false>(blocks, degree, x, y, result);
}
void find_jet(const double* blocks, int degree, double x, double y, double* result) {
  evaluate<2, false>(blocks, degree, x, y, result);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(find_value);
HWY_EXPORT(find_absolute);
HWY_EXPORT(find_gradient);
HWY_EXPORT(find_jet);

}  // namespace

CoefficientRows::CoefficientRows(const std::vector<double>& dense, int degree) : degree_(degree) {
  const std::size_t rows = static_cast<std::size_t>(degree) + 1, width = (rows + 7) / 8;
  blocks_.resize(rows * width);  // zeros
  for (std::size_t i = 0; i < rows; ++i)
    std::memcpy(&blocks_[i * width], &dense[i * rows], (rows - i) * sizeof(double));
}

double CoefficientRows::value(const Point<2>& at) const {
  double result;
  HWY_DYNAMIC_DISPATCH(find_value)(blocks_[0].lane, degree_, at[0], at[1], &result);
  return result;
}

double CoefficientRows::absolute(const Point<2>& at) const {
  double result;
  HWY_DYNAMIC_DISPATCH(find_absolute)(blocks_[0].lane, degree_, at[0], at[1], &result);
  return result;
}

Jet CoefficientRows::value_and_gradient(const Point<2>& at) const {
  double result[3];
  HWY_DYNAMIC_DISPATCH(find_gradient)(blocks_[0].lane, degree_, at[0], at[1], result);
  return {result[0], {result[1], result[2]}, 0, 0, 0};
}

Jet CoefficientRows::jet(const Point<2>& at) const {
  double result[6];
  HWY_DYNAMIC_DISPATCH(find_jet)(blocks_[0].lane, degree_, at[0], at[1], result);
  return {result[0], {result[1], result[2]}, result[3], result[4], result[5]};
}

}  // namespace encase
#endif
