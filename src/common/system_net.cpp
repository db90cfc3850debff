// SPDX-License-Identifier: MIT
#include "common/system_net.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/system_net.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_SYSTEM_NET_SHARED
#define ENCASE_SYSTEM_NET_SHARED
namespace encase {

using NetRows = std::array<std::array<double, 8>, 8>;

/// The least and greatest coefficients of a net.
struct NetExtremes {
  double lo, hi;
};

/// Two nets, combined with the rows of a matrix Y.
struct Preconditioned {
  Matrix<2> y;    ///< the inverse of the mean Jacobian, or its adjugate
  bool regular;   ///< the inverse exists
  bool excluded;  ///< one of the combinations keeps a sign
  bool linear;    ///< there are slopes: the combinations are not too far from the coordinates
  std::array<double, 2> rounding;  ///< of the combinations' coefficients
  std::array<double, 2> radius;    ///< of the combinations, rounding included
  /// If regular and not excluded: the extremes of combination c less the coordinate c.
  std::array<NetExtremes, 2> rest;
  /// If linear: the extremes of the combinations' differences across rows and across lanes.
  std::array<std::array<NetExtremes, 2>, 2> slope;
};

}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// The least and greatest of several rows.
struct RowExtent {
  Row lo, hi;
  HWY_INLINE RowExtent() {}
  HWY_INLINE explicit RowExtent(const Row& first) : lo(first), hi(first) {}
  HWY_INLINE void add(const Row& row) {
    lo = least(lo, row);
    hi = greatest(hi, row);
  }
  HWY_INLINE NetExtremes extremes() const { return {least_lane(lo), greatest_lane(hi)}; }
};

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
  RowExtent extent(rows[0]);
  for (int i = 0; i < N; ++i) {
    rows[i].store((*to)[i].data());
    extent.add(rows[i]);
  }
  return extent.extremes();
}

/// Both halves of a net across its rows, by de Casteljau's algorithm: sums of two, scaled at the end
/// (powers of two change no rounding).
template <int N>
HWY_INLINE void halve_rows(const Row* from, Row* lower, Row* upper, RowExtent* low,
                           RowExtent* high) {
  for (int p = 0; p < kParts; ++p) {
    Vector t[N];
    for (int i = 0; i < N; ++i) t[i] = from[i].part[p];
    Vector low_least = t[0], low_most = t[0], high_least = t[N - 1], high_most = t[N - 1];
    lower[0].part[p] = t[0];
    upper[N - 1].part[p] = t[N - 1];
    double scale = 1;
#pragma GCC unroll 8
    for (int r = 1; r < N; ++r) {
#pragma GCC unroll 8
      for (int j = 0; j < N - r; ++j) t[j] = hn::Add(t[j], t[j + 1]);
      scale *= 0.5;
      const Vector s = hn::Set(Lanes(), scale);
      const Vector a = hn::Mul(t[0], s), b = hn::Mul(t[N - 1 - r], s);
      lower[r].part[p] = a;
      upper[N - 1 - r].part[p] = b;
      low_least = hn::Min(low_least, a);
      low_most = hn::Max(low_most, a);
      high_least = hn::Min(high_least, b);
      high_most = hn::Max(high_most, b);
    }
    low->lo.part[p] = low_least;
    low->hi.part[p] = low_most;
    high->lo.part[p] = high_least;
    high->hi.part[p] = high_most;
  }
}

HWY_INLINE bool beyond(const NetExtremes& e, double radius) {
  return e.lo > radius || e.hi < -radius;
}

/// The quarters of a net, transposed, but of those in halves across its rows that are `empty`; of
/// a half in which it keeps a sign beyond radius[0] it is set. Quarter k + 2 m: half k of the rows,
/// half m of the lanes.
template <int N>
HWY_INLINE void quarter_net(const NetRows& from, double radius, bool* empty, NetRows* const* to,
                            NetExtremes* extremes) {
  Row rows[8], halves[2][8];
  for (int i = 0; i < N; ++i) rows[i] = Row::load(from[i].data());
  RowExtent extent[2];
  halve_rows<N>(rows, halves[0], halves[1], &extent[0], &extent[1]);
  for (int k = 0; k < 2; ++k) {
    if (empty[k]) continue;
    empty[k] = beyond(extent[k].extremes(), radius);
    if (empty[k]) continue;
    for (int i = N; i < 8; ++i) halves[k][i] = halves[k][N - 1];
    transpose(halves[k]);
    Row quarters[2][8];
    RowExtent of_quarter[2];
    halve_rows<N>(halves[k], quarters[0], quarters[1], &of_quarter[0], &of_quarter[1]);
    for (int m = 0; m < 2; ++m) {
      for (int i = 0; i < N; ++i) quarters[m][i].store((*to[k + 2 * m])[i].data());
      extremes[k + 2 * m] = of_quarter[m].extremes();
    }
  }
}

/// Whether no two have different signs.
HWY_INLINE bool agree(double a, double b, double c, double d) {
  return (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
}

/// The inverse of the mean Jacobian, as the corners show it, or its adjugate. Whether one of the
/// combinations may keep a sign.
template <int N>
HWY_INLINE void choose_combinations(const NetRows& f, const NetRows& g, Preconditioned* result,
                                    bool* some) {
  constexpr int n = N - 1;
  const double corner[2][4] = {{f[0][0], f[0][n], f[n][0], f[n][n]},
                               {g[0][0], g[0][n], g[n][0], g[n][n]}};
  Matrix<2> j;
  for (int k = 0; k < 2; ++k) {
    const double* c = corner[k];
    j[k] = {0.25 * ((c[2] - c[0]) + (c[3] - c[1])), 0.25 * ((c[1] - c[0]) + (c[3] - c[2]))};
  }
  const double scale = 1 / (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  result->regular = scale > -1e300 && scale < 1e300;
  const double s = result->regular ? scale : 1;
  Matrix<2>& y = result->y;
  y = {{{j[1][1] * s, -j[0][1] * s}, {-j[1][0] * s, j[0][0] * s}}};
  for (int k = 0; k < 2; ++k) {
    double c[4];
    for (int m = 0; m < 4; ++m) c[m] = y[k][0] * corner[0][m] + y[k][1] * corner[1][m];
    some[k] = agree(c[0], c[1], c[2], c[3]);
  }
}

/// The extremes of the combinations less the coordinates.
template <int N>
HWY_INLINE void bound_rests(const NetRows& f, const NetRows& g, const Matrix<2>& y,
                            NetExtremes* rest) {
  constexpr double n = N - 1;
  HWY_ALIGN double along[8];
  for (int i = 0; i < 8; ++i) along[i] = 2 / n * (i < N ? i : N - 1) - 1;
  RowExtent all[2];
  const Vector y00 = hn::Set(Lanes(), y[0][0]), y01 = hn::Set(Lanes(), y[0][1]),
               y10 = hn::Set(Lanes(), y[1][0]), y11 = hn::Set(Lanes(), y[1][1]);
  for (int p = 0; p < kParts; ++p) {
    const Vector lanes = hn::Load(Lanes(), along + p * kLanes);
    Vector lo[2], hi[2];
    for (int i = 0; i < N; ++i) {
      const Vector a = hn::Load(Lanes(), f[i].data() + p * kLanes),
                   b = hn::Load(Lanes(), g[i].data() + p * kLanes);
      const Vector r0 = hn::Sub(hn::Add(hn::Mul(y00, a), hn::Mul(y01, b)),
                                hn::Set(Lanes(), along[i])),
                   r1 = hn::Sub(hn::Add(hn::Mul(y10, a), hn::Mul(y11, b)), lanes);
      lo[0] = i == 0 ? r0 : hn::Min(lo[0], r0);
      hi[0] = i == 0 ? r0 : hn::Max(hi[0], r0);
      lo[1] = i == 0 ? r1 : hn::Min(lo[1], r1);
      hi[1] = i == 0 ? r1 : hn::Max(hi[1], r1);
    }
    for (int k = 0; k < 2; ++k) {
      all[k].lo.part[p] = lo[k];
      all[k].hi.part[p] = hi[k];
    }
  }
  for (int k = 0; k < 2; ++k) rest[k] = all[k].extremes();
}

/// The extremes of one combination.
template <int N>
HWY_INLINE NetExtremes bound_combination(const NetRows& f, const NetRows& g,
                                         const std::array<double, 2>& y) {
  const Row of_f = Row::all(y[0]), of_g = Row::all(y[1]);
  RowExtent extent(of_f * Row::load(f[0].data()) + of_g * Row::load(g[0].data()));
  for (int i = 1; i < N; ++i)
    extent.add(of_f * Row::load(f[i].data()) + of_g * Row::load(g[i].data()));
  return extent.extremes();
}

/// The rows of a net and their neighbours across lanes, of which the last one has none.
template <int N>
class RowNeighbours {
 public:
  HWY_INLINE explicit RowNeighbours(const NetRows& net) : net_(net[0].data()) {
    Row::load(net[N - 1].data()).store(last_);
    Row::all(0).store(last_ + 8);
  }
  HWY_INLINE Row change(int i) const {
    const double* row = i == N - 1 ? last_ : net_ + 8 * i;
    return Row::load_unaligned(row + 1) - Row::load(row);
  }

 private:
  const double* net_;
  HWY_ALIGN double last_[16];
};

/// The extremes of the combinations' differences across rows and across lanes.
template <int N>
HWY_INLINE void bound_slopes(const NetRows& f, const NetRows& g, const Matrix<2>& y,
                             std::array<std::array<NetExtremes, 2>, 2>* slope) {
  const RowNeighbours<N> of_f(f), of_g(g);
  const Row y00 = Row::all(y[0][0]), y01 = Row::all(y[0][1]), y10 = Row::all(y[1][0]),
            y11 = Row::all(y[1][1]);
  RowExtent extent[2];
  for (int i = 0; i + 1 < N; ++i) {
    const Row a = Row::load(f[i + 1].data()) - Row::load(f[i].data()),
              b = Row::load(g[i + 1].data()) - Row::load(g[i].data());
    const Row d0 = y00 * a + y01 * b, d1 = y10 * a + y11 * b;
    if (i == 0) {
      extent[0] = RowExtent(d0);
      extent[1] = RowExtent(d1);
    } else {
      extent[0].add(d0);
      extent[1].add(d1);
    }
  }
  for (int k = 0; k < 2; ++k) (*slope)[0][k] = extent[k].extremes();
  for (int i = 0; i < N; ++i) {
    const Row a = of_f.change(i), b = of_g.change(i);
    const Row d0 = y00 * a + y01 * b, d1 = y10 * a + y11 * b;
    if (i == 0) {
      extent[0] = RowExtent(d0);
      extent[1] = RowExtent(d1);
    } else {
      extent[0].add(d0);
      extent[1].add(d1);
    }
  }
  for (int k = 0; k < 2; ++k) {
    extent[k].lo = first_lanes(extent[k].lo, Row::all(1e300), N - 1);
    extent[k].hi = first_lanes(extent[k].hi, Row::all(-1e300), N - 1);
    (*slope)[1][k] = extent[k].extremes();
  }
}

template <int N>
HWY_INLINE void precondition_net(const NetRows& f, const NetRows& g, const double* magnitude,
                                 const double* radius, Preconditioned* result) {
  bool some[2];
  choose_combinations<N>(f, g, result, some);
  const Matrix<2>& y = result->y;
  result->excluded = false;
  for (int k = 0; k < 2; ++k) {
    // Two products and a sum round.
    const double first = y[k][0] < 0 ? -y[k][0] : y[k][0];
    const double second = y[k][1] < 0 ? -y[k][1] : y[k][1];
    result->rounding[k] =
        3 * 0x1p-53 * (first * magnitude[0] + second * magnitude[1]) * (1 + 0x1p-40) + 0x1p-1000;
    result->radius[k] =
        (first * radius[0] + second * radius[1] + result->rounding[k]) * (1 + 0x1p-40);
    if (!some[k]) continue;
    result->excluded = beyond(bound_combination<N>(f, g, y[k]), result->radius[k]);
    if (result->excluded) return;
  }
  if (!result->regular) return;
  bound_rests<N>(f, g, y, result->rest.data());
  // Slopes close to those of the coordinates would keep the rests small.
  constexpr double kMost = 2.5;
  result->linear = result->rest[0].hi - result->rest[0].lo < kMost &&
                   result->rest[1].hi - result->rest[1].lo < kMost;
  if (result->linear) bound_slopes<N>(f, g, y, &result->slope);
}

/// The largest differences of neighbours, across rows and across lanes.
template <int N>
HWY_INLINE void variations_of(const NetRows& net, double* result) {
  double d[2] = {0, 0};
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      const auto size = [](double x) { return x < 0 ? -x : x; };
      if (i + 1 < N) d[0] = std::max(d[0], size(net[i + 1][j] - net[i][j]));
      if (j + 1 < N) d[1] = std::max(d[1], size(net[i][j + 1] - net[i][j]));
    }
  result[0] = d[0];
  result[1] = d[1];
}

template <class Run>
HWY_INLINE void with_count(int count, Run run) {
  switch (count) {
    case 3:
      return run.template operator()<3>();
    case 4:
      return run.template operator()<4>();
    case 5:
      return run.template operator()<5>();
    case 6:
      return run.template operator()<6>();
    case 7:
      return run.template operator()<7>();
    default:
      return run.template operator()<8>();
  }
}

void restrict_nets(int count, const NetRows* const* from, const double (*cut)[2], NetRows* const* to,
                   NetExtremes* extremes) {
  with_count(count, [&]<int N>() HWY_ATTR {
    for (int k = 0; k < 2; ++k) extremes[k] = restrict_net<N>(*from[k], cut, to[k]);
  });
}

void quarter_nets(int count, const NetRows& from, double radius, bool* empty, NetRows* const* to,
                  NetExtremes* extremes) {
  with_count(count,
             [&]<int N>() HWY_ATTR { quarter_net<N>(from, radius, empty, to, extremes); });
}

void precondition(int count, const NetRows& f, const NetRows& g, const double* magnitude,
                  const double* radius, Preconditioned* result) {
  with_count(count, [&]<int N>() HWY_ATTR {
    precondition_net<N>(f, g, magnitude, radius, result);
  });
}

void variations(int count, const NetRows& net, double* result) {
  with_count(count, [&]<int N>() HWY_ATTR { variations_of<N>(net, result); });
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(restrict_nets);
HWY_EXPORT(quarter_nets);
HWY_EXPORT(precondition);
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

void restrict_to(const SystemNet& from, const Part& part, SystemNet* to) {
  const int rows_axis = from.of[0].rows_axis;
  double cut[2][2];
  for (int i = 0; i < 2; ++i) {
    const int axis = i == 0 ? rows_axis : 1 - rows_axis;
    const double lo = 0.5 * (1 + (part.origin[axis] - part.half[axis]));
    const double hi = 0.5 * (1 + (part.origin[axis] + part.half[axis]));
    cut[i][0] = lo / hi;
    cut[i][1] = hi;
  }
  const NetRows* nets[2] = {&from.of[0].b, &from.of[1].b};
  NetRows* results[2] = {&to->of[0].b, &to->of[1].b};
  NetExtremes extremes[2];
  HWY_DYNAMIC_DISPATCH(restrict_nets)(from.of[0].count, nets, cut, results, extremes);
  for (int k = 0; k < 2; ++k) {
    const Patch& of = from.of[k];
    Patch& patch = to->of[k];
    patch.count = of.count;
    patch.rows_axis = 1 - rows_axis;
    patch.lo = extremes[k].lo;
    patch.hi = extremes[k].hi;
    // TODO bound
    const double change = 128 * kUnit * of.magnitude() + kTiny, n = of.count - 1;
    patch.radius = (of.radius + change) * kUp;
    for (int i = 0; i < 2; ++i)
      patch.slope_radius[i] =
          (of.slope_radius[1 - i] * part.half[i == 0 ? 1 - rows_axis : rows_axis] + n * change) * kUp;
    patch.left_out = of.left_out;
  }
}

void quarter(const SystemNet& from, std::array<bool, 2>* empty, SystemNet* const* quarters,
             bool* excluded) {
  std::fill_n(excluded, 4, false);
  for (int k = 0; k < 2; ++k) {
    const Patch& of = from.of[k];
    // Each of count - 1 averages rounds once, relative to the largest coefficient, twice.
    const double change = 1.01 * of.count * kUnit * of.magnitude() + kTiny;
    const double n = of.count - 1;
    const double radius = (of.radius + change) * kUp, last_radius = (radius + change) * kUp;
    NetRows* to[4];
    for (int q = 0; q < 4; ++q) to[q] = &quarters[q]->of[k].b;
    NetExtremes extremes[4];
    HWY_DYNAMIC_DISPATCH(quarter_nets)
    (of.count, of.b, radius, empty->data(), to, extremes);
    for (int q = 0; q < 4; ++q) {
      if ((*empty)[q % 2]) continue;
      Patch& patch = quarters[q]->of[k];
      patch.count = of.count;
      patch.rows_axis = 1 - of.rows_axis;
      patch.lo = extremes[q].lo;
      patch.hi = extremes[q].hi;
      patch.radius = last_radius;
      for (int i = 0; i < 2; ++i)
        patch.slope_radius[i] = (0.5 * of.slope_radius[1 - i] + 2 * n * change) * kUp;
      excluded[q] = excluded[q] || patch.sign();
    }
    if (((*empty)[0] || (excluded[0] && excluded[2])) && ((*empty)[1] || (excluded[1] && excluded[3])))
      break;
  }
}

namespace {

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

void test_system(const SystemNet& net, double quality, SystemVerdict* verdict) {
  Preconditioned p;
  const Patch &f = net.of[0], &g = net.of[1];
  const double magnitude[2] = {f.magnitude(), g.magnitude()}, radii[2] = {f.radius, g.radius};
  HWY_DYNAMIC_DISPATCH(precondition)(f.count, f.b, g.b, magnitude, radii, &p);
  verdict->excluded = p.excluded;
  verdict->contracts = false;
  verdict->zeros = Box<2>{{-1, -1}, {1, 1}};
  if (p.excluded || !p.regular) return;
  // The coordinates that belong to rows and lanes, and to the combinations.
  const std::array<int, 2> axis{f.rows_axis, 1 - f.rows_axis};
  for (int c = 0; c < 2; ++c) {
    // A zero has s + rest = 0.
    const double lo = p.rest[c].lo, hi = p.rest[c].hi;
    const double slack = (p.radius[c] + 8 * kUnit * (2 + std::fabs(lo) + std::fabs(hi))) * kUp;
    verdict->zeros.lo[axis[c]] = -hi - slack;
    verdict->zeros.hi[axis[c]] = -lo + slack;
    if (-hi - slack > 1 || -lo + slack < -1) verdict->excluded = true;
  }
  if (verdict->excluded || !p.linear) return;
  Contraction<2>& contraction = verdict->contraction;
  const double factor = 0.5 * (f.count - 1);  // of differences
  for (int c = 0; c < 2; ++c) {
    contraction.preconditioner[axis[c]] = p.y[c];
    const double alpha = std::fabs(p.y[c][0]), beta = std::fabs(p.y[c][1]);
    for (int i = 0; i < 2; ++i) {
      const double lo = factor * p.slope[i][c].lo, hi = factor * p.slope[i][c].hi;
      const double center = i == c ? 1.0 : 0.0;
      const double deviation = std::max(hi - center, center - lo);
      const double radius = alpha * f.slope_radius[i] + beta * g.slope_radius[i];
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

std::array<double, 2> relative_variation(const SystemNet& net) {
  std::array<double, 2> result{0, 0};
  for (const Patch& patch : net.of) {
    double d[2];
    HWY_DYNAMIC_DISPATCH(variations)(patch.count, patch.b, d);
    for (int i = 0; i < 2; ++i)
      result[i == 0 ? patch.rows_axis : 1 - patch.rows_axis] +=
          d[i] / (patch.magnitude() + 1e-300);
  }
  return result;
}

}  // namespace encase
#endif
