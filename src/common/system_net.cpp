// SPDX-License-Identifier: MIT
#include "common/system_net.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/system_net.cpp"
#include <hwy/foreach_target.h>

#include "common/net_rows-inl.hpp"

#ifndef ENCASE_SYSTEM_NET_SHARED
#define ENCASE_SYSTEM_NET_SHARED
namespace encase {

/// Where a part of [0,1] begins and ends, for de Casteljau's algorithm at the end and then, in
/// [0,end], at the beginning. Averages w_1 a + w_2 b are made as a w_1 / w_2 + b, the weights w_2
/// of all stages at last.
struct Cut {
  double at_end, at_beginning;                       ///< the weights' quotients
  std::array<double, 8> end_scale, beginning_scale;  ///< powers of the weights w_2
};

}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// De Casteljau's algorithm across rows at two points: what lies between them.
template <int N>
HWY_INLINE void cut_rows(const Cut& cut, Row* rows) {
  const Vector at_end = hn::Set(Lanes(), cut.at_end),
               at_beginning = hn::Set(Lanes(), cut.at_beginning);
  for (int p = 0; p < kParts; ++p) {
    Vector c[N];
    for (int i = 0; i < N; ++i) c[i] = rows[i].part[p];
#pragma GCC unroll 8
    for (int r = 1; r < N; ++r)
#pragma GCC unroll 8
      for (int j = N - 1; j >= r; --j) c[j] = multiply_add(c[j - 1], at_end, c[j]);
#pragma GCC unroll 8
    for (int r = 1; r < N; ++r) c[r] = hn::Mul(c[r], hn::Set(Lanes(), cut.end_scale[r]));
#pragma GCC unroll 8
    for (int r = 1; r < N; ++r)
#pragma GCC unroll 8
      for (int j = 0; j < N - r; ++j) c[j] = multiply_add(c[j + 1], at_beginning, c[j]);
    for (int i = 0; i < N; ++i)
      rows[i].part[p] = hn::Mul(c[i], hn::Set(Lanes(), cut.beginning_scale[N - 1 - i]));
  }
}

/// A net on a part of its box, transposed; the cuts are those across the rows, then the lanes.
template <int N>
HWY_INLINE NetExtremes restrict_net(const NetRows& from, const Cut* cut, NetRows* to) {
  Row rows[8];
  for (int i = 0; i < N; ++i) rows[i] = Row::load(from[i].data());
  cut_rows<N>(cut[0], rows);
  for (int i = N; i < 8; ++i) rows[i] = rows[N - 1];
  transpose(rows);
  cut_rows<N>(cut[1], rows);
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

void restrict_nets(int count, const NetRows* const* from, const Cut* cut, NetRows* const* to,
                   NetExtremes* extremes) {
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
// Of parts; and the largest coefficients of which seven stages at such an end do not overflow.
constexpr double kNarrowest = 0x1p-40, kLargest = 0x1p600;

/// How to cut out the part origin +- half of [-1,1]; false if it is too narrow for that.
bool find_cut(double origin, double half, Cut* cut) {
  const double end = 0.5 * (1 + (origin + half)), beginning = 0.5 * (1 + (origin - half)) / end,
               rest = 1 - beginning;
  cut->at_end = (1 - end) / end;
  cut->at_beginning = beginning / rest;
  cut->end_scale[0] = cut->beginning_scale[0] = 1;
  for (std::size_t r = 1; r < 8; ++r) {
    cut->end_scale[r] = cut->end_scale[r - 1] * end;
    cut->beginning_scale[r] = cut->beginning_scale[r - 1] * rest;
  }
  return end > kNarrowest && rest > kNarrowest;
}

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
  Cut cut[2];
  bool is_part = true;
  for (int i = 0; i < 2; ++i)
    is_part = find_cut(part.origin[axis[i]], part.half[axis[i]], &cut[i]) && is_part;
  const NetRows* const nets[2] = {&from.of[0].b, &from.of[1].b};
  NetRows* const results[2] = {&to->of[0].b, &to->of[1].b};
  NetExtremes extremes[2];
  HWY_DYNAMIC_DISPATCH(restrict_nets)(from.of[0].count, nets, cut, results, extremes);
  for (int k = 0; k < 2; ++k) {
    const Patch& of = from.of[k];
    Patch& patch = to->of[k];
    // (Nothing is known on a part that is too narrow.)
    const double change = is_part && of.magnitude() < kLargest ? 0x1p-45 * of.magnitude() + kTiny
                                                               : HUGE_VAL,
                 n = of.count - 1;
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
