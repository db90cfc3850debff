// SPDX-License-Identifier: MIT
#include "common/system_net.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/system_net.cpp"
#include <hwy/foreach_target.h>

#include "common/net_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// De Casteljau's algorithm across rows at two points: what lies between them. The first one is
/// given as a share of the way to the second one.
template <int N>
HWY_INLINE void cut_rows(double from, double to, Row* rows) {
  for (int p = 0; p < kParts; ++p) {
    Vector c[N];
    for (int i = 0; i < N; ++i) c[i] = rows[i].part[p];
    const Vector t = hn::Set(Lanes(), to), s = hn::Set(Lanes(), 1 - to);
#pragma GCC unroll 8
    for (int r = 1; r < N; ++r)
#pragma GCC unroll 8
      for (int j = N - 1; j >= r; --j) c[j] = hn::Add(hn::Mul(c[j - 1], s), hn::Mul(c[j], t));
    const Vector u = hn::Set(Lanes(), from), v = hn::Set(Lanes(), 1 - from);
#pragma GCC unroll 8
    for (int r = 1; r < N; ++r)
#pragma GCC unroll 8
      for (int j = 0; j < N - r; ++j) c[j] = hn::Add(hn::Mul(c[j], v), hn::Mul(c[j + 1], u));
    for (int i = 0; i < N; ++i) rows[i].part[p] = c[i];
  }
}

/// A net on a part of its box, transposed; `cut` holds where it begins and ends for the rows, then
/// the lanes.
template <int N>
HWY_INLINE NetExtremes restrict_net(const NetRows& from, const double (*cut)[2], NetRows* to) {
  Row rows[8];
  for (int i = 0; i < N; ++i) rows[i] = Row::load(from[i].data());
  cut_rows<N>(cut[0][0], cut[0][1], rows);
  for (int i = N; i < 8; ++i) rows[i] = rows[N - 1];
  transpose(rows);
  cut_rows<N>(cut[1][0], cut[1][1], rows);
  RowExtent extent;
  for (int i = 0; i < N; ++i) {
    rows[i].store((*to)[i].data());
    extent.add(rows[i]);
  }
  return extent.extremes();
}

/// The quarters of a net, transposed, but of those in halves across its rows that are `empty`; of
/// a half on which it keeps a sign beyond the radius it is set. Quarter k + 2 m: half k of the
/// rows, half m of the lanes.
template <int N>
HWY_INLINE void quarter_net(const NetRows& from, double radius, bool* empty, NetRows* const* to,
                            NetExtremes* extremes) {
  alignas(64) NetRows halves[2];
  NetExtremes of_halves[2];
  halve_net<N>(from, false, radius, &halves[0], &halves[1], of_halves);
  for (int k = 0; k < 2; ++k) {
    empty[k] = empty[k] || beyond(of_halves[k], radius);
    if (empty[k]) continue;
    NetRows &lower = *to[k], &upper = *to[k + 2];
    PartExtent of_lower, of_upper;
    for (int p = 0; p < 8; p += kLanes) {
      Vector part[8], low[8], high[8];
      for (int i = 0; i < N; ++i) part[i] = hn::Load(Lanes(), halves[k][i].data() + p);
      halve_part<N>(part, low, high, &of_lower, &of_upper);
      for (int i = 0; i < N; ++i) {
        hn::Store(low[i], Lanes(), lower[i].data() + p);
        hn::Store(high[i], Lanes(), upper[i].data() + p);
      }
    }
    extremes[k] = of_lower.extremes();
    extremes[k + 2] = of_upper.extremes();
  }
}

void restrict_nets(int count, const NetRows* const* from, const double (*cut)[2],
                   NetRows* const* to, NetExtremes* extremes) {
  with_count(count, [&]<int N>() HWY_ATTR {
    for (int k = 0; k < 2; ++k) extremes[k] = restrict_net<N>(*from[k], cut, to[k]);
  });
}

void quarter_nets(int count, const NetRows& from, double radius, bool* empty, NetRows* const* to,
                  NetExtremes* extremes) {
  with_count(count, [&]<int N>() HWY_ATTR { quarter_net<N>(from, radius, empty, to, extremes); });
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(restrict_nets);
HWY_EXPORT(quarter_nets);

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

void restrict_to(const SystemNet& from, const Part& part, SystemNet* to) {
  const std::array<int, 2> axis{from.of[0].rows_axis, 1 - from.of[0].rows_axis};
  double cut[2][2];
  for (int i = 0; i < 2; ++i) {
    const double lo = 0.5 * (1 + (part.origin[axis[i]] - part.half[axis[i]]));
    const double hi = 0.5 * (1 + (part.origin[axis[i]] + part.half[axis[i]]));
    cut[i][0] = lo / hi;
    cut[i][1] = hi;
  }
  const bool is_part = cut[0][1] > 0 && cut[1][1] > 0;
  const NetRows* const nets[2] = {&from.of[0].b, &from.of[1].b};
  NetRows* const results[2] = {&to->of[0].b, &to->of[1].b};
  NetExtremes extremes[2];
  HWY_DYNAMIC_DISPATCH(restrict_nets)(from.of[0].count, nets, cut, results, extremes);
  for (int k = 0; k < 2; ++k) {
    const Patch& of = from.of[k];
    Patch& patch = to->of[k];
    // (Nothing is known on a part too narrow to have a place of its own.)
    const double change = is_part ? 0x1p-45 * of.magnitude() + kTiny : HUGE_VAL, n = of.count - 1;
    patch.count = of.count;
    patch.rows_axis = axis[1];
    patch.lo = extremes[k].lo;
    patch.hi = extremes[k].hi;
    patch.radius = (of.radius + change) * kUp;
    for (int i = 0; i < 2; ++i)
      patch.slope_radius[i] = (of.slope_radius[1 - i] * part.half[axis[1 - i]] + n * change) * kUp;
  }
}

std::array<bool, 4> quarter(const SystemNet& from, std::array<bool, 2>* empty,
                            SystemNet* quarters) {
  std::array<bool, 4> excluded{};
  for (int k = 0; k < 2; ++k) {
    const Patch& of = from.of[k];
    // Each of count - 1 averages rounds once, relative to the largest coefficient.
    const double change = 1.01 * of.count * kUnit * of.magnitude() + kTiny, n = of.count - 1;
    const double radius_of_halves = (of.radius + change) * kUp;
    std::array<double, 2> slope;
    for (int i = 0; i < 2; ++i) slope[i] = (0.5 * of.slope_radius[1 - i] + 2 * n * change) * kUp;
    NetRows* to[4];
    for (int q = 0; q < 4; ++q) to[q] = &quarters[q].of[k].b;
    NetExtremes extremes[4];
    HWY_DYNAMIC_DISPATCH(quarter_nets)
    (of.count, of.b, radius_of_halves, empty->data(), to, extremes);
    bool all = true;
    for (int q = 0; q < 4; ++q) {
      if ((*empty)[q % 2]) continue;
      Patch& patch = quarters[q].of[k];
      patch.count = of.count;
      patch.rows_axis = 1 - of.rows_axis;
      patch.lo = extremes[q].lo;
      patch.hi = extremes[q].hi;
      patch.radius = (radius_of_halves + change) * kUp;
      patch.slope_radius = slope;
      excluded[q] = excluded[q] || patch.sign();
      all = all && excluded[q];
    }
    if (all) break;
  }
  return excluded;
}

std::array<double, 2> relative_variation(const SystemNet& net) {
  std::array<double, 2> result{0, 0};
  for (const Patch& patch : net.of) {
    double rows = 0, lanes = 0;
    for (int i = 0; i < patch.count; ++i)
      for (int j = 1; j < patch.count; ++j) {
        rows = std::max(rows, std::fabs(patch.b[j][i] - patch.b[j - 1][i]));
        lanes = std::max(lanes, std::fabs(patch.b[i][j] - patch.b[i][j - 1]));
      }
    const double size = patch.magnitude() + 1e-300;
    result[patch.rows_axis] += rows / size;
    result[1 - patch.rows_axis] += lanes / size;
  }
  return result;
}

}  // namespace encase
#endif
