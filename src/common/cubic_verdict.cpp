// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "common/cubic_system.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/cubic_verdict.cpp"
#include <hwy/foreach_target.h>

#include "common/row_ranges-inl.hpp"

#ifndef ENCASE_CUBIC_VERDICT_SHARED
#define ENCASE_CUBIC_VERDICT_SHARED
namespace encase {

/// A system, combined with the rows of a matrix Y.
struct Preconditioned {
  Matrix<2> y;    ///< the inverse of the mean Jacobian, or its adjugate
  bool regular;   ///< the inverse exists
  bool excluded;  ///< one of the combinations keeps a sign
  bool linear;    ///< there are slopes: the combinations are not too far from the coordinates
  std::array<double, 2> rounding;  ///< of the combinations' coefficients
  std::array<double, 2> radius;    ///< of the combinations, rounding included
  /// If regular and not excluded: the extremes of combination c less the coordinate c.
  PairedExtremes rest;
  /// If linear: the extremes of the combinations' differences across rows and across lanes.
  std::array<PairedExtremes, 2> slope;
};

namespace {

/// The rows of the coordinates: that across rows in the first half, that across lanes in the other.
struct alignas(64) Coordinates {
  double row[4][8];
};
constexpr Coordinates make_coordinates() {
  Coordinates c{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 8; ++j) c.row[i][j] = 2.0 / 3 * (j < 4 ? i : j - 4) - 1;
  return c;
}
constexpr Coordinates kCoordinates = make_coordinates();

}  // namespace
}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// The mean Jacobian, its rows those of the polynomials: across rows, across lanes.
HWY_INLINE Matrix<2> mean_slopes(const Row* rows) {
  HWY_ALIGN double across[8], lanes[8];
  sum_of_halves(rows[3] - rows[0]).store(across);
  ((rows[0] + rows[1]) + (rows[2] + rows[3])).store(lanes);
  return {{{0.125 * across[0], 0.125 * (lanes[3] - lanes[0])},
           {0.125 * across[4], 0.125 * (lanes[7] - lanes[4])}}};
}

void precondition(const double* b, const double* magnitude, const double* radius,
                  Preconditioned* result) {
  Row rows[4], c[4];
  for (int i = 0; i < 4; ++i) rows[i] = Row::load(b + 8 * i);
  const Matrix<2> j = mean_slopes(rows);
  const double scale = 1 / (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  result->regular = scale > -1e300 && scale < 1e300;
  const double s = result->regular ? scale : 1;
  Matrix<2>& y = result->y;
  y = {{{j[1][1] * s, -j[0][1] * s}, {-j[1][0] * s, j[0][0] * s}}};
  for (int k = 0; k < 2; ++k) {
    // Two products and a sum round.
    const double first = y[k][0] < 0 ? -y[k][0] : y[k][0];
    const double second = y[k][1] < 0 ? -y[k][1] : y[k][1];
    result->rounding[k] =
        3 * 0x1p-53 * (first * magnitude[0] + second * magnitude[1]) * (1 + 0x1p-40) + 0x1p-1000;
    result->radius[k] =
        (first * radius[0] + second * radius[1] + result->rounding[k]) * (1 + 0x1p-40);
  }
  const Row own = by_halves(y[0][0], y[1][1]), other = by_halves(y[0][1], y[1][0]);
  for (int i = 0; i < 4; ++i) c[i] = own * rows[i] + other * swap_halves(rows[i]);
  result->excluded = range_of_rows(c).signs_beyond(by_halves(result->radius[0], result->radius[1]));
  if (result->excluded || !result->regular) return;
  for (int i = 0; i < 4; ++i) rows[i] = c[i] - Row::load(kCoordinates.row[i]);
  result->rest = range_of_rows(rows).extremes();
  // Slopes close to those of the coordinates would keep the rests small.
  constexpr double kMost = 2.5;
  result->linear = result->rest.hi[0] - result->rest.lo[0] < kMost &&
                   result->rest.hi[1] - result->rest.lo[1] < kMost;
  if (!result->linear) return;
  for (int k = 0; k < 2; ++k) {
    RowRange d(c[1] - c[0]);
    d.add(c[2] - c[1]);
    d.add(c[3] - c[2]);
    result->slope[k] = d.extremes();
    transpose_halves(c);
  }
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(precondition);

constexpr double kUnit = 0x1p-53;
constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

/// A positive v with E v < quality v, if there is one: with it (quality I - E) v is a multiple of
/// (1, 1).
bool find_weights(const Matrix<2>& e, double quality, std::array<double, 2>* v) {
  const double a = quality - e[0][0], b = quality - e[1][1];
  if (!(a > 0 && b > 0 && a * b > e[0][1] * e[1][0])) return false;
  const double largest = std::max(b + e[0][1], a + e[1][0]);
  *v = {(b + e[0][1]) / largest, (a + e[1][0]) / largest};
  for (int k = 0; k < 2; ++k)
    if (!((e[k][0] * (*v)[0] + e[k][1] * (*v)[1]) * kUp < quality * (*v)[k])) return false;
  return true;
}

}  // namespace

void test_system(const CubicSystem& system, double quality, SystemVerdict* verdict) {
  Preconditioned p;
  const double magnitude[2] = {system.magnitude(0), system.magnitude(1)};
  HWY_DYNAMIC_DISPATCH(precondition)
  (system.b[0].data(), magnitude, system.radius.data(), &p);
  verdict->excluded = p.excluded;
  verdict->contracts = false;
  verdict->zeros = Box<2>{{-1, -1}, {1, 1}};
  if (p.excluded || !p.regular) return;
  // The coordinates that belong to rows and lanes, and to the combinations.
  const std::array<int, 2> axis{system.rows_axis, 1 - system.rows_axis};
  for (int c = 0; c < 2; ++c) {
    // A zero has s + rest = 0.
    const double lo = p.rest.lo[c], hi = p.rest.hi[c];
    const double slack = (p.radius[c] + 8 * kUnit * (2 + std::fabs(lo) + std::fabs(hi))) * kUp;
    verdict->zeros.lo[axis[c]] = -hi - slack;
    verdict->zeros.hi[axis[c]] = -lo + slack;
    if (-hi - slack > 1 || -lo + slack < -1) verdict->excluded = true;
  }
  if (verdict->excluded || !p.linear) return;
  Contraction<2>& contraction = verdict->contraction;
  constexpr double factor = 1.5;  // of differences: half the degree
  for (int c = 0; c < 2; ++c) {
    contraction.preconditioner[axis[c]] = p.y[c];
    const double alpha = std::fabs(p.y[c][0]), beta = std::fabs(p.y[c][1]);
    for (int i = 0; i < 2; ++i) {
      const double lo = factor * p.slope[i].lo[c], hi = factor * p.slope[i].hi[c];
      const double center = i == c ? 1.0 : 0.0;
      const double deviation = std::max(hi - center, center - lo);
      const double radius = alpha * system.slope_radius[0][i] + beta * system.slope_radius[1][i];
      // Differences and products round; the deviation is rounded up.
      contraction.bound[axis[c]][axis[i]] =
          (std::max(deviation, 0.0) + radius + 2 * factor * p.rounding[c] +
           4 * kUnit * (std::fabs(lo) + std::fabs(hi) + 1)) *
              kUp +
          kTiny;
    }
  }
  verdict->contracts = find_weights(contraction.bound, quality, &contraction.weights);
}

}  // namespace encase
#endif
