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

/// Bit k: the value at (s[k], t[k]) is positive, for two rows of points.
std::uint32_t positive_at(const Tile& tile, const double* s, const double* t) {
  const Row zero = Row::all(0);
  const Row s0 = Row::load(s), s1 = Row::load(s + 8), t0 = Row::load(t), t1 = Row::load(t + 8);
  Row sum0 = zero, sum1 = zero;
  for (int i = tile.degree; i >= 0; --i) {
    const double* row = tile.a[i].data();
    Row inner0 = Row::all(row[tile.degree - i]), inner1 = inner0;
    for (int j = tile.degree - i - 1; j >= 0; --j) {
      const Row a = Row::all(row[j]);
      inner0 = inner0 * t0 + a;
      inner1 = inner1 * t1 + a;
    }
    sum0 = sum0 * s0 + inner0;
    sum1 = sum1 * s1 + inner1;
  }
  HWY_ALIGN double values[16];
  sum0.store(values);
  sum1.store(values + 8);
  std::uint32_t bits = 0;
  for (int k = 0; k < 16; k += kLanes) {
    const auto above = hn::Gt(hn::Load(Lanes(), values + k), hn::Zero(Lanes()));
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(Lanes(), above, part);
    bits |= static_cast<std::uint32_t>(part[0]) << k;
  }
  return bits;
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

}  // namespace

int count_sign_changes(TiledPolynomial& f, const Point<2>& from, const Point<2>& to) {
  const Point<2> step{(to[0] - from[0]) / kSamples, (to[1] - from[1]) / kSamples};
  const Point<2> first{from[0] + 0.5 * step[0], from[1] + 0.5 * step[1]};
  std::uint32_t positive = 0;
  alignas(64) double s[kSamples], t[kSamples];
  for (int done = 0; done < kSamples;) {
    const Tile& tile = f.at({first[0] + done * step[0], first[1] + done * step[1]});
    const double x = 1 / tile.half[0], y = 1 / tile.half[1];
    int end = done;
    bool within = true;
    for (int k = 0; k < kSamples; ++k) {
      s[k] = (first[0] + k * step[0] - tile.center[0]) * x;
      t[k] = (first[1] + k * step[1] - tile.center[1]) * y;
      within = within && (k < done || std::max(std::fabs(s[k]), std::fabs(t[k])) <= Tile::kReach);
      end += within && k >= done;
    }
    end = std::max(end, done + 1);
    const std::uint32_t here = HWY_DYNAMIC_DISPATCH(positive_at)(tile, s, t);
    positive |= here & ((1u << end) - (1u << done));
    done = end;
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
