// SPDX-License-Identifier: MIT
#include "common/tile_samples.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/tile_samples.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

HWY_INLINE std::uint32_t positive_lanes(const Row& row) {
  std::uint32_t bits = 0;
  for (int k = 0; k < kParts; ++k) {
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(Lanes(), hn::Gt(row.part[k], hn::Zero(Lanes())), part);
    bits |= static_cast<std::uint32_t>(part[0]) << (k * kLanes);
  }
  return bits;
}

/// Bit k: the value at the point s + k ds, t + k dt is positive. For k < 8.
std::uint32_t positive_at(const Tile& tile, double s, double ds, double t, double dt) {
  HWY_ALIGN static constexpr double kNumbers[8] = {0, 1, 2, 3, 4, 5, 6, 7};
  const Row number = Row::load(kNumbers);
  const Row at_s = Row::all(s) + number * Row::all(ds);
  const Row at_t = Row::all(t) + number * Row::all(dt);
  Row sum = Row::all(0);
  for (int i = tile.degree; i >= 0; --i) {
    const double* row = tile.a[i].data();
    Row inner = Row::all(row[tile.degree - i]);
    for (int j = tile.degree - i - 1; j >= 0; --j) inner = inner * at_t + Row::all(row[j]);
    sum = sum * at_s + inner;
  }
  return positive_lanes(sum);
}

/// The value and the derivatives up to the second order, by Horner's rule in either variable.
void jets_at(const Tile& tile, const double* s, const double* t, TileJets* jets) {
  const Row zero = Row::all(0), at_s = Row::load(s), at_t = Row::load(t), two = Row::all(2);
  Row value = zero, ds = zero, dss = zero, dt = zero, dst = zero, dtt = zero;
  for (int i = tile.degree; i >= 0; --i) {
    const double* row = tile.a[i].data();
    Row inner = zero, slope = zero, bend = zero;
    for (int j = tile.degree - i; j >= 0; --j) {
      bend = bend * at_t + slope;
      slope = slope * at_t + inner;
      inner = inner * at_t + Row::all(row[j]);
    }
    dss = dss * at_s + ds;
    ds = ds * at_s + value;
    value = value * at_s + inner;
    dst = dst * at_s + dt;
    dt = dt * at_s + slope;
    dtt = dtt * at_s + bend;
  }
  value.store(jets->value.data());
  ds.store(jets->s.data());
  dt.store(jets->t.data());
  (two * dss).store(jets->ss.data());
  dst.store(jets->st.data());
  (two * dtt).store(jets->tt.data());
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(positive_at);
HWY_EXPORT(jets_at);

constexpr int kSamples = 16;
constexpr double kReach = 2;  // a tile is good enough for a look a little beyond its rectangle

}  // namespace

int count_sign_changes(TiledFunction& f, const Point<2>& from, const Point<2>& to) {
  const Point<2> step{(to[0] - from[0]) / kSamples, (to[1] - from[1]) / kSamples};
  const Point<2> first{from[0] + 0.5 * step[0], from[1] + 0.5 * step[1]};
  std::uint32_t positive = 0;
  for (int done = 0; done < kSamples;) {
    const Point<2> at{first[0] + done * step[0], first[1] + done * step[1]};
    const Tile& tile = f.at(at);
    Point<2> start, stride;
    int count = std::min(8, kSamples - done);
    for (int i = 0; i < 2; ++i) {
      const double scale = 1 / tile.half[i];
      start[i] = (at[i] - tile.center[i]) * scale;
      stride[i] = step[i] * scale;
      if (std::fabs(start[i] + (count - 1) * stride[i]) > kReach)
        count = static_cast<int>((std::copysign(kReach, stride[i]) - start[i]) / stride[i]) + 1;
    }
    count = std::max(count, 1);
    const std::uint32_t here =
        HWY_DYNAMIC_DISPATCH(positive_at)(tile, start[0], stride[0], start[1], stride[1]);
    positive |= (here & ((1u << count) - 1)) << done;
    done += count;
  }
  return std::popcount((positive ^ (positive >> 1)) & ((1u << (kSamples - 1)) - 1));
}

void jets(const Tile& tile, const std::array<Point<2>, 8>& points, TileJets* jets) {
  alignas(64) double s[8], t[8];
  for (int k = 0; k < 8; ++k) {
    s[k] = points[k][0];
    t[k] = points[k][1];
  }
  HWY_DYNAMIC_DISPATCH(jets_at)(tile, s, t, jets);
}

}  // namespace encase
#endif
