// SPDX-License-Identifier: MIT
#include "common/cubic_system.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/cubic_system.cpp"
#include <hwy/foreach_target.h>

#include "common/row_ranges-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Sums of four rows with the coefficients of a matrix, whose rows are 8 doubles apart.
HWY_INLINE void multiply(const double* matrix, const Row* rows, Row* result) {
  for (int i = 0; i < 4; ++i) {
    Row sum = rows[0] * Row::all(matrix[8 * i]);
    for (int k = 1; k < 4; ++k) sum = sum + rows[k] * Row::all(matrix[8 * i + k]);
    result[i] = sum;
  }
}

/// Cubic nets on a part of their box.
void restrict_cubic(const double* b, const double* nodes, const double* matrix, double* to,
                    PairedExtremes* extremes) {
  HWY_ALIGN double weights[4][8];
  const Row half = Row::all(0.5), s = Row::load(nodes) * half, three = Row::all(3);
  const Row u = half + s, v = half - s, uu = u * u, vv = v * v;
  (vv * v).store(weights[0]);
  (vv * u * three).store(weights[1]);
  (uu * v * three).store(weights[2]);
  (uu * u).store(weights[3]);
  Row rows[4], value[4];
  for (int i = 0; i < 4; ++i) rows[i] = Row::load(b + 8 * i);
  for (int k = 0; k < 4; ++k) {
    value[k] = rows[0] * Row::all(weights[0][k]);
    for (int i = 1; i < 4; ++i) value[k] = value[k] + rows[i] * Row::all(weights[i][k]);
  }
  transpose_halves(value);
  for (int k = 0; k < 4; ++k) {
    rows[k] = value[0] * Row::all(weights[0][4 + k]);
    for (int i = 1; i < 4; ++i) rows[k] = rows[k] + value[i] * Row::all(weights[i][4 + k]);
  }
  multiply(matrix, rows, value);
  transpose_halves(value);
  multiply(matrix, value, rows);
  for (int i = 0; i < 4; ++i) rows[i].store(to + 8 * i);
  *extremes = range_of_rows(rows).extremes();
}

/// De Casteljau's algorithm at 1/2: sums of two, scaled at the end. A half in which one polynomial
/// keeps a sign is not stored.
void halve_nets(const double* b, bool along_lanes, const double* radius, double* lower,
                double* upper, PairedExtremes* extremes, bool* excluded) {
  Row t[4];
  for (int i = 0; i < 4; ++i) t[i] = Row::load(b + 8 * i);
  if (along_lanes) transpose_halves(t);
  const Row half = Row::all(0.5), quarter = Row::all(0.25), eighth = Row::all(0.125);
  const Row s01 = t[0] + t[1], s12 = t[1] + t[2], s23 = t[2] + t[3];
  const Row q0 = s01 + s12, q1 = s12 + s23, middle = (q0 + q1) * eighth;
  Row halves[2][4] = {{t[0], s01 * half, q0 * quarter, middle},
                      {middle, q1 * quarter, s23 * half, t[3]}};
  const Row r = by_halves(radius[0], radius[1]);
  for (int k = 0; k < 2; ++k) {
    const RowRange range = range_of_rows(halves[k]);
    excluded[k] = range.signs_beyond(r);
    if (excluded[k]) continue;
    extremes[k] = range.extremes();
    transpose_halves(halves[k]);
    for (int i = 0; i < 4; ++i) halves[k][i].store((k == 0 ? lower : upper) + 8 * i);
  }
}

/// The largest differences of neighbours, up and down the rows, in the net and its transpose.
void variations(const double* b, PairedExtremes* result) {
  Row rows[4];
  for (int i = 0; i < 4; ++i) rows[i] = Row::load(b + 8 * i);
  for (int k = 0; k < 2; ++k) {
    RowRange d(rows[1] - rows[0]);
    d.add(rows[2] - rows[1]);
    d.add(rows[3] - rows[2]);
    result[k] = d.extremes();
    transpose_halves(rows);
  }
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(restrict_cubic);
HWY_EXPORT(halve_nets);
HWY_EXPORT(variations);

constexpr double kUnit = 0x1p-53;
constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

}  // namespace

Part part_of(const Chart& chart, const Box<2>& box) {
  const Chart inner = chart_of(box);
  Part part;
  for (int i = 0; i < 2; ++i) {
    part.origin[i] = (inner[i].center - chart[i].center) / chart[i].half;
    part.half[i] = inner[i].half / chart[i].half;
  }
  return part;
}

void restrict_to(const CubicSystem& from, const Part& part, CubicSystem* system) {
  const Interpolation& table = cubic_interpolation();
  alignas(64) std::array<double, 8> nodes;
  const std::array<int, 2> axis{from.rows_axis, 1 - from.rows_axis};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 4; ++k)
      nodes[4 * i + k] = part.origin[axis[i]] + part.half[axis[i]] * table.node[k];
  PairedExtremes extremes;
  HWY_DYNAMIC_DISPATCH(restrict_cubic)
  (from.b[0].data(), nodes.data(), table.matrix[0].data(), system->b[0].data(), &extremes);
  system->rows_axis = axis[0];
  system->lo = extremes.lo;
  system->hi = extremes.hi;
  for (int k = 0; k < 2; ++k) {
    const double rounding = table.norm * table.norm * from.magnitude(k) * 0x1p-44 + kTiny;
    system->radius[k] = (from.radius[k] + rounding) * kUp;
    for (int i = 0; i < 2; ++i)
      system->slope_radius[k][i] =
          (from.slope_radius[k][i] * part.half[axis[i]] + 3 * rounding) * kUp;
  }
}

std::array<bool, 2> halve(const CubicSystem& system, int axis, CubicSystem* lower,
                          CubicSystem* upper) {
  const bool along_lanes = system.rows_axis != axis;
  // Across the halves' rows and lanes: those of the axis that stays, then the halved one.
  const int stays = along_lanes ? 0 : 1;
  std::array<double, 2> radius;
  std::array<std::array<double, 2>, 2> slope;
  for (int k = 0; k < 2; ++k) {
    // Each of three sums rounds once, relative to the largest coefficient.
    const double change = 1.01 * 4 * kUnit * system.magnitude(k) + kTiny;
    radius[k] = (system.radius[k] + change) * kUp;
    slope[k] = {(system.slope_radius[k][stays] + 3 * change) * kUp,
                (0.5 * system.slope_radius[k][1 - stays] + 3 * change) * kUp};
  }
  PairedExtremes extremes[2];
  std::array<bool, 2> excluded;
  HWY_DYNAMIC_DISPATCH(halve_nets)
  (system.b[0].data(), along_lanes, radius.data(), lower->b[0].data(), upper->b[0].data(), extremes,
   excluded.data());
  for (int k = 0; k < 2; ++k) {
    if (excluded[k]) continue;
    CubicSystem* half = k == 0 ? lower : upper;
    half->rows_axis = 1 - axis;
    half->lo = extremes[k].lo;
    half->hi = extremes[k].hi;
    half->radius = radius;
    half->slope_radius = slope;
  }
  return excluded;
}

std::array<double, 2> relative_variation(const CubicSystem& system) {
  PairedExtremes d[2];
  HWY_DYNAMIC_DISPATCH(variations)(system.b[0].data(), d);
  std::array<double, 2> result{0, 0};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
      result[i == 0 ? system.rows_axis : 1 - system.rows_axis] +=
          std::max(-d[i].lo[k], d[i].hi[k]) / (system.magnitude(k) + 1e-300);
  return result;
}

}  // namespace encase
#endif
