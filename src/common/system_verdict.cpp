// SPDX-License-Identifier: MIT
#include "common/system_net.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/system_verdict.cpp"
#include <hwy/foreach_target.h>

#include "common/net_rows-inl.hpp"

#ifndef ENCASE_SYSTEM_VERDICT_SHARED
#define ENCASE_SYSTEM_VERDICT_SHARED
namespace encase {

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

/// The inverse of the mean Jacobian, as the corners show it, or its adjugate; `some`: the
/// combinations with these rows that have one sign at the corners.
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
  const Matrix<2> adjugate{{{j[1][1], -j[0][1]}, {-j[1][0], j[0][0]}}};
  for (int k = 0; k < 2; ++k) {
    std::array<double, 4> c;
    for (std::size_t m = 0; m < 4; ++m)
      c[m] = adjugate[k][0] * corner[0][m] + adjugate[k][1] * corner[1][m];
    some[k] = agree(c);
  }
  const double scale = 1 / (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  result->regular = scale > -1e300 && scale < 1e300;
  const double s = result->regular ? scale : 1;
  for (int k = 0; k < 2; ++k) result->y[k] = {adjugate[k][0] * s, adjugate[k][1] * s};
}

/// Minus the coordinates of the coefficients along an axis; lanes from N on repeat the last one.
template <int N>
struct MinusAlong {
  alignas(64) double x[8];
  constexpr MinusAlong() : x{} {
    for (int i = 0; i < 8; ++i) x[i] = 1 - 2.0 / (N - 1) * (i < N ? i : N - 1);
  }
};

/// The extremes of the combinations less the coordinates.
template <int N>
HWY_INLINE void bound_rests(const NetRows& f, const NetRows& g, const Matrix<2>& y,
                            NetExtremes* rest) {
  static constexpr MinusAlong<N> kMinusAlong;
  PartExtent all[2];
  const Vector y00 = hn::Set(Lanes(), y[0][0]), y01 = hn::Set(Lanes(), y[0][1]),
               y10 = hn::Set(Lanes(), y[1][0]), y11 = hn::Set(Lanes(), y[1][1]);
  for (int k = 0; k < kUsedParts<N>; ++k) {
    const Vector lanes = hn::Load(Lanes(), kMinusAlong.x + k * kLanes);
    for (int i = 0; i < N; ++i) {
      const Vector a = hn::Load(Lanes(), f[i].data() + k * kLanes),
                   b = hn::Load(Lanes(), g[i].data() + k * kLanes);
      const Vector rows = hn::Set(Lanes(), kMinusAlong.x[i]);
      all[0].add(multiply_add(y00, a, multiply_add(y01, b, rows)));
      all[1].add(multiply_add(y10, a, multiply_add(y11, b, lanes)));
    }
  }
  for (int k = 0; k < 2; ++k) rest[k] = all[k].extremes();
}

/// The extremes of one combination.
template <int N>
HWY_INLINE NetExtremes bound_combination(const NetRows& f, const NetRows& g,
                                         const std::array<double, 2>& y) {
  const Row of_f = Row::all(y[0]), of_g = Row::all(y[1]);
  RowExtent extent;
  for (int i = 0; i < N; ++i)
    extent.add(multiply_add(of_f, Row::load(f[i].data()), of_g * Row::load(g[i].data())));
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
    const Row d0 = multiply_add(y00, a, y01 * b), d1 = multiply_add(y10, a, y11 * b);
    extent[0].add(d0);
    extent[1].add(d1);
  }
  for (int k = 0; k < 2; ++k) {
    (*slope)[0][k] = extent[k].extremes();
    extent[k] = RowExtent();
  }
  for (int i = 0; i < N; ++i) {
    const Row a = of_f.change(i), b = of_g.change(i);
    const Row d0 = multiply_add(y00, a, y01 * b), d1 = multiply_add(y10, a, y11 * b);
    extent[0].add(d0);
    extent[1].add(d1);
  }
  for (int k = 0; k < 2; ++k) {
    extent[k].keep_lanes(N - 1);
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
  constexpr double kMost = 1;
  result->linear = result->rest[0].hi - result->rest[0].lo < kMost &&
                   result->rest[1].hi - result->rest[1].lo < kMost;
  if (result->linear) bound_slopes<N>(f, g, y, &result->slope);
}

void precondition(int count, const NetRows& f, const NetRows& g, const double* magnitude,
                  const double* radius, Preconditioned* result) {
  with_count(count,
             [&]<int N>() HWY_ATTR { precondition_net<N>(f, g, magnitude, radius, result); });
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

}  // namespace encase
#endif
