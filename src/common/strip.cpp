// SPDX-License-Identifier: MIT
#include "common/strip.hpp"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/strip.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_STRIP_SHARED
#define ENCASE_STRIP_SHARED
namespace encase {

/// A net as a linear function, in the coordinates across rows and across lanes, and a rest.
struct Linearized {
  double slope[2];
  double lo, hi;  ///< of the rest's coefficients
};

}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// `at`: the coordinates that belong to the coefficients, the last one repeated.
void linearize(const double* net, int count, const double* at, Linearized* result) {
  Row total = Row::load(net);
  for (int i = 1; i < count; ++i) total = total + Row::load(net + 8 * i);
  HWY_ALIGN double of_lanes[8];
  total.store(of_lanes);
  const Row first = Row::load(net), last = Row::load(net + 8 * (count - 1));
  const double mean = 0.5 / count;
  const double rows = mean * sum_of_lanes(first_lanes(last - first, Row::all(0), count));
  const double lanes = mean * (of_lanes[count - 1] - of_lanes[0]);
  const Row across_lanes = Row::load(at) * Row::all(lanes);
  Row lo = (first - across_lanes) + Row::all(rows), hi = lo;
  for (int i = 1; i < count; ++i) {
    const Row rest = (Row::load(net + 8 * i) - across_lanes) - Row::all(rows * at[i]);
    lo = least(lo, rest);
    hi = greatest(hi, rest);
  }
  *result = {{rows, lanes}, least_lane(lo), greatest_lane(hi)};
}

/// Whether y[0] f + y[1] g lies beyond +-radius[0] everywhere, or y[2] f + y[3] g beyond
/// +-radius[1].
bool keeps_sign(const double* f, const double* g, int count, const double* y,
                const double* radius) {
  for (int k = 0; k < 2; ++k) {
    const Row u = Row::all(y[2 * k]), v = Row::all(y[2 * k + 1]);
    Row lo = u * Row::load(f) + v * Row::load(g), hi = lo;
    for (int i = 1; i < count; ++i) {
      const Row here = u * Row::load(f + 8 * i) + v * Row::load(g + 8 * i);
      lo = least(lo, here);
      hi = greatest(hi, here);
    }
    if (least_lane(lo) > radius[k] || greatest_lane(hi) < -radius[k]) return true;
  }
  return false;
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(linearize);
HWY_EXPORT(keeps_sign);

constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

struct alignas(64) Coordinates {
  double at[8];
};
/// By the number of coefficients.
constexpr auto kCoordinates = [] {
  std::array<Coordinates, Patch::kMaxCount + 1> all{};
  for (int count = 2; count <= Patch::kMaxCount; ++count)
    for (int j = 0; j < 8; ++j) all[count].at[j] = 2.0 * std::min(j, count - 1) / (count - 1) - 1;
  return all;
}();

/// Of u * a - v * b with a in [a.lo, a.hi] and b in [b.lo, b.hi], roundings included, whether its
/// absolute value is beyond `size` everywhere.
bool lies_beyond(double size, double u, const Strip& a, double v, const Strip& b) {
  const double p = u * a.lo, q = u * a.hi, r = v * b.lo, s = v * b.hi;
  const double lo = std::min(p, q) - std::max(r, s), hi = std::max(p, q) - std::min(r, s);
  // Infinite, or no number, where one of them is.
  const double slack =
      0x1p-50 * (std::fabs(p) + std::fabs(q) + std::fabs(r) + std::fabs(s)) + kTiny;
  return lo > (size + slack) * kUp || hi < -(size + slack) * kUp;
}

}  // namespace

Strip strip_of(const Patch& patch) {
  Linearized net;
  HWY_DYNAMIC_DISPATCH(linearize)
  (patch.b[0].data(), patch.count, kCoordinates[patch.count].at, &net);
  // The coordinates, two products and two differences round.
  const double size = std::fabs(net.slope[0]) + std::fabs(net.slope[1]) + patch.magnitude();
  const double radius = (patch.radius + 0x1p-49 * size) * kUp + kTiny;
  Strip strip;
  strip.slope[patch.rows_axis] = net.slope[0];
  strip.slope[1 - patch.rows_axis] = net.slope[1];
  strip.lo = -net.hi - radius;
  strip.hi = -net.lo + radius;
  return strip;
}

bool apart(const Strip& a, const Strip& b) {
  const double p = a.slope[0] * b.slope[1], q = a.slope[1] * b.slope[0];
  const double determinant = std::fabs(p - q) + 0x1p-51 * (std::fabs(p) + std::fabs(q)) + kTiny;
  // Cramer's rule: determinant * x and determinant * y.
  return lies_beyond(determinant, b.slope[1], a, a.slope[1], b) ||
         lies_beyond(determinant, b.slope[0], a, a.slope[0], b);
}

bool apart(const Patch& f, const Strip& a, const Patch& g, const Strip& b) {
  if (apart(a, b)) return true;
  if (f.count != g.count || f.rows_axis != g.rows_axis) return false;
  const double y[4] = {b.slope[1], -a.slope[1], -b.slope[0], a.slope[0]};
  double radius[2];
  for (int k = 0; k < 2; ++k) {
    const double u = std::fabs(y[2 * k]), v = std::fabs(y[2 * k + 1]);
    // Two products and a sum round. (Infinite, or no number, where one of them may overflow.)
    const double rounding = 0x1p-51 * (u * f.magnitude() + v * g.magnitude());
    radius[k] = (u * f.radius + v * g.radius + rounding) * kUp + kTiny;
  }
  return HWY_DYNAMIC_DISPATCH(keeps_sign)(f.b[0].data(), g.b[0].data(), f.count, y, radius);
}

}  // namespace encase
#endif
