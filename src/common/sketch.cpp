// SPDX-License-Identifier: MIT
#include "common/sketch.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sketch.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Bit k: lane k is positive.
HWY_INLINE std::uint32_t positive_lanes(const Row& row) {
  std::uint32_t result = 0;
  for (int k = 0; k < kParts; ++k) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Lanes(), hn::Gt(row.part[k], hn::Zero(Lanes())), bits);
    result |= static_cast<std::uint32_t>(bits[0]) << (k * kLanes);
  }
  return result;
}

/// How often the signs of the values at the 16 points s + k ds, t + k dt change.
int sign_changes_along(const Sketch& f, double s, double ds, double t, double dt) {
  HWY_ALIGN static constexpr double kNumbers[16] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                    8, 9, 10, 11, 12, 13, 14, 15};
  const Row low = Row::load(kNumbers), high = Row::load(kNumbers + 8);
  const Row s0 = Row::all(s) + low * Row::all(ds), s1 = Row::all(s) + high * Row::all(ds);
  const Row t0 = Row::all(t) + low * Row::all(dt), t1 = Row::all(t) + high * Row::all(dt);
  const int n = f.degree;
  Row sum0 = Row::all(f.a[n][0]), sum1 = sum0;
  for (int j = n - 1; j >= 0; --j) {
    const double* row = f.a[j].data();
    Row inner0 = Row::all(row[n - j]), inner1 = inner0;
    for (int i = n - j - 1; i >= 0; --i) {
      const Row a = Row::all(row[i]);
      inner0 = inner0 * s0 + a;
      inner1 = inner1 * s1 + a;
    }
    sum0 = sum0 * t0 + inner0;
    sum1 = sum1 * t1 + inner1;
  }
  const std::uint32_t positive = positive_lanes(sum0) | positive_lanes(sum1) << 8;
  return std::popcount((positive ^ (positive >> 1)) & ((1u << (Sketch::kLanes - 1)) - 1));
}

HWY_INLINE void slopes_of_row(const Sketch& f, const double* s, const double* t, double* values,
                              double* slopes_s, double* slopes_t) {
  const Row at_s = Row::load(s), at_t = Row::load(t), zero = Row::all(0);
  const int n = f.degree;
  Row value = zero, along_s = zero, along_t = zero;
  for (int j = n; j >= 0; --j) {
    const double* row = f.a[j].data();
    Row inner = Row::all(row[n - j]), slope = zero;
    for (int i = n - j - 1; i >= 0; --i) {
      slope = slope * at_s + inner;
      inner = inner * at_s + Row::all(row[i]);
    }
    along_t = along_t * at_t + value;
    value = value * at_t + inner;
    along_s = along_s * at_t + slope;
  }
  value.store(values);
  along_s.store(slopes_s);
  along_t.store(slopes_t);
}

void slopes_at(const Sketch& f, const double* s, const double* t, SketchSlopes* result) {
  for (int k = 0; k < Sketch::kLanes; k += 8)
    slopes_of_row(f, s + k, t + k, &result->value[k], &result->s[k], &result->t[k]);
}

/// Rows of 16 coefficients, in powers of one variable, for each power of the other.
using Rows = std::array<std::array<double, Tile::kRow>, Tile::kRow>;

/// p(s) -> p(origin + half s), where row i holds the coefficients of s^i, n - i + 1 of them and
/// zeros. If `is_short`, n < 8.
template <bool is_short>
HWY_INLINE void shift(Rows& a, int n, double origin, double half) {
  const Row by = Row::all(origin);
  // Synthetic division, by the antidiagonals of its table: the steps of one do not wait for each
  // other.
  for (int level = 0; level < n; ++level)
    for (int i = n - 1 - level; i < n; ++i)
      for (int k = 0; k < (is_short ? 8 : n - i); k += 8)
        (Row::load(&a[i][k]) + by * Row::load(&a[i + 1][k])).store(&a[i][k]);
  double power = 1;
  for (int i = 1; i <= n; ++i) {
    power *= half;
    const Row factor = Row::all(power);
    for (int k = 0; k <= (is_short ? 7 : n - i); k += 8)
      (Row::load(&a[i][k]) * factor).store(&a[i][k]);
  }
}

/// Transposes; the entries beyond the degree are zero.
HWY_INLINE void transpose_rows(Rows& a, int n) {
  Row block[8], other[8];
  for (int i = 0; i < 8; ++i) block[i] = Row::load(&a[i][0]);
  transpose(block);
  for (int i = 0; i < 8; ++i) block[i].store(&a[i][0]);
  if (n < 8) return;
  for (int i = 0; i < 8; ++i) {
    block[i] = Row::load(&a[i][8]);
    other[i] = Row::load(&a[i + 8][0]);
  }
  transpose(block);
  transpose(other);
  for (int i = 0; i < 8; ++i) {
    block[i].store(&a[i + 8][0]);
    other[i].store(&a[i][8]);
  }
}

void fill_sketch(const Tile& tile, const double* origin, const double* half, Sketch* sketch) {
  constexpr double kNeglected = 0x1p-12;  // of the sum of all coefficients
  const int n = tile.degree;
  alignas(64) Rows a;
  const int size = n < 8 ? 8 : Tile::kRow;
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < size; k += 8) Row::load(&tile.a[i][k]).store(&a[i][k]);
  if (n < 8) {
    shift<true>(a, n, origin[0], half[0]);
    transpose_rows(a, n);
    shift<true>(a, n, origin[1], half[1]);
  } else {
    shift<false>(a, n, origin[0], half[0]);
    transpose_rows(a, n);
    shift<false>(a, n, origin[1], half[1]);
  }
  // The sizes of the terms of each degree.
  HWY_ALIGN double sizes[32] = {};
  for (int j = 0; j <= n; ++j)
    for (int k = 0; k <= n - j; k += 8)
      (Row::load_unaligned(sizes + j + k) + absolute(Row::load(&a[j][k])))
          .store_unaligned(sizes + j + k);
  double total = 0;
  for (int k = 0; k <= n; ++k) total += sizes[k];
  double rest = sizes[n];
  int degree = n;
  while (degree > 0 && rest <= kNeglected * total) rest += sizes[--degree];
  sketch->degree = degree;
  const Row scale = Row::all(total > 0 ? 1 / total : 1);
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i <= degree - j; i += 8) (Row::load(&a[j][i]) * scale).store(&sketch->a[j][i]);
}

void divide_points(const PointGroups& points, const double* line, int near, double* heights,
                   int* positive, double* least) {
  const Row a = Row::all(line[0]), b = Row::all(line[1]), c = Row::all(line[2]);
  Row lowest = Row::all(HUGE_VAL);
  for (int g = 0; g < points.groups; ++g) positive[g] = 0;
  const int size = points.size();
  const PointGroups::Bits* member = points.member.data();
  for (int word = 0; word < size; word += 64) {
    PointGroups::Bits above = 0;
    const int end = std::min(word + 64, size);
    for (int k = word; k < end; k += 8) {
      const Row height =
          (a * Row::load_unaligned(&points.x[k]) + b * Row::load_unaligned(&points.y[k])) + c;
      if (k < near) {
        lowest = encase::HWY_NAMESPACE::least(lowest, absolute(height));
        height.store_unaligned(heights + k);
      }
      above |= static_cast<PointGroups::Bits>(positive_lanes(height)) << (k - word);
    }
    for (int g = 0; g < points.groups; ++g) positive[g] += std::popcount(above & *member++);
  }
  *least = least_lane(lowest);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(sign_changes_along);
HWY_EXPORT(slopes_at);
HWY_EXPORT(fill_sketch);
HWY_EXPORT(divide_points);

constexpr double kFarthest = 2.5;  // from a tile's centre, for its halves, that it is used

}  // namespace

bool make_sketch(TiledFunction& f, const Box<2>& box, Sketch* sketch) {
  const Point<2> center = box.center();
  const Tile& tile = f.at(center);
  Point<2> origin, half;
  for (int i = 0; i < 2; ++i) {
    const double width = 0.5 * box.width(i), scale = 1 / tile.half[i];
    origin[i] = (center[i] - tile.center[i]) * scale;
    half[i] = width * scale;
    if (!(half[i] >= 0x1p-40) || !(std::fabs(origin[i]) + half[i] <= kFarthest)) return false;
    sketch->center[i] = center[i];
    sketch->scale[i] = 1 / width;
  }
  HWY_DYNAMIC_DISPATCH(fill_sketch)(tile, origin.data(), half.data(), sketch);
  return true;
}

int count_sign_changes(const Sketch& f, const Point<2>& from, const Point<2>& to) {
  constexpr int kSamples = Sketch::kLanes;
  Point<2> first, step;
  for (int i = 0; i < 2; ++i) {
    const double d = (to[i] - from[i]) * (1.0 / kSamples);
    first[i] = (from[i] - f.center[i] + 0.5 * d) * f.scale[i];
    step[i] = d * f.scale[i];
  }
  return HWY_DYNAMIC_DISPATCH(sign_changes_along)(f, first[0], step[0], first[1], step[1]);
}

void slopes(const Sketch& f, const Sketch::Lanes& s, const Sketch::Lanes& t, SketchSlopes* result) {
  HWY_DYNAMIC_DISPATCH(slopes_at)(f, s.data(), t.data(), result);
}

void PointGroups::reset(int group_count, int point_count, const Point<2>& point) {
  const auto whole_rows = static_cast<std::size_t>((point_count + 7) / 8 * 8);
  groups = group_count;
  x.assign(whole_rows, point[0]);
  y.assign(whole_rows, point[1]);
  member.assign((whole_rows + 63) / 64 * static_cast<std::size_t>(groups), 0);
}

double divide(const PointGroups& points, const Line& line, int near, double* heights,
              int* positive) {
  const double coefficients[3] = {line.normal[0], line.normal[1], line.offset};
  double least;
  HWY_DYNAMIC_DISPATCH(divide_points)(points, coefficients, near, heights, positive, &least);
  return least;
}

}  // namespace encase
#endif
