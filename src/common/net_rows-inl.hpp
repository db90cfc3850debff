// SPDX-License-Identifier: MIT
// What nets of patches have in common, for every instruction set (included once for each, as
// simd_rows-inl.hpp).
#ifndef ENCASE_NET_ROWS
#define ENCASE_NET_ROWS
#include <algorithm>
#include <array>
#include <cmath>

namespace encase {

using NetRows = std::array<std::array<double, 8>, 8>;

/// The least and greatest coefficients of a net.
struct NetExtremes {
  double lo, hi;
};

}  // namespace encase
#endif

#if defined(ENCASE_NET_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ENCASE_NET_ROWS_INL
#undef ENCASE_NET_ROWS_INL
#else
#define ENCASE_NET_ROWS_INL
#endif

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// The least and greatest of several rows.
struct RowExtent {
  Row lo, hi;
  /// Of none.
  HWY_INLINE RowExtent() : lo(Row::all(HUGE_VAL)), hi(Row::all(-HUGE_VAL)) {}
  HWY_INLINE explicit RowExtent(const Row& first) : lo(first), hi(first) {}
  HWY_INLINE void add(const Row& row) {
    lo = least(lo, row);
    hi = greatest(hi, row);
  }
  /// Forgets all but the first lanes.
  HWY_INLINE void keep_lanes(int count) {
    lo = first_lanes(lo, Row::all(HUGE_VAL), count);
    hi = first_lanes(hi, Row::all(-HUGE_VAL), count);
  }
  HWY_INLINE NetExtremes extremes() const { return {least_lane(lo), greatest_lane(hi)}; }
};

HWY_INLINE bool beyond(const NetExtremes& e, double radius) {
  return e.lo > radius || e.hi < -radius;
}

/// Whether all have one sign.
HWY_INLINE bool agree(const std::array<double, 4>& x) {
  const double lo = std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
  const double hi = std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
  return lo > 0 || hi < 0;
}

// Of the rows of a net only some parts are needed; all others repeat its last lane.

template <int N>
constexpr int kUsedParts = (N + kLanes - 1) / kLanes;

/// The extremes of one part of several rows.
struct PartExtent {
  Vector lo, hi;
  /// Of none.
  HWY_INLINE PartExtent() : lo(hn::Set(Lanes(), HUGE_VAL)), hi(hn::Set(Lanes(), -HUGE_VAL)) {}
  HWY_INLINE void add(Vector v) {
    lo = hn::Min(lo, v);
    hi = hn::Max(hi, v);
  }
  HWY_INLINE NetExtremes extremes() const {
    return {hn::GetLane(hn::MinOfLanes(Lanes(), lo)), hn::GetLane(hn::MaxOfLanes(Lanes(), hi))};
  }
};

/// De Casteljau's algorithm at 1/2 across the rows, for one part of them, which fits into
/// registers: sums of two, scaled at the end (powers of two change no rounding).
template <int N>
HWY_INLINE void halve_part(Vector* t, Vector* lower, Vector* upper, PartExtent* of_lower,
                           PartExtent* of_upper) {
  lower[0] = t[0];
  upper[N - 1] = t[N - 1];
  of_lower->add(lower[0]);
  of_upper->add(upper[N - 1]);
  double scale = 1;
  for (int r = 1; r < N; ++r) {
    for (int j = 0; j < N - r; ++j) t[j] = hn::Add(t[j], t[j + 1]);
    scale *= 0.5;
    const Vector s = hn::Set(Lanes(), scale);
    lower[r] = hn::Mul(t[0], s);
    upper[N - 1 - r] = hn::Mul(t[N - 1 - r], s);
    of_lower->add(lower[r]);
    of_upper->add(upper[N - 1 - r]);
  }
}

/// Transposes a square of kLanes vectors.
HWY_INLINE void transpose_square(const Vector* from, Vector* to) {
#if HWY_MAX_BYTES == 64
  Row rows[8];
  for (int i = 0; i < 8; ++i) rows[i].part[0] = from[i];
  transpose(rows);
  for (int i = 0; i < 8; ++i) to[i] = rows[i].part[0];
#elif HWY_MAX_BYTES == 32
  const Lanes d;
  const Vector even[2] = {hn::InterleaveLower(d, from[0], from[1]),
                          hn::InterleaveLower(d, from[2], from[3])};
  const Vector odd[2] = {hn::InterleaveUpper(d, from[0], from[1]),
                         hn::InterleaveUpper(d, from[2], from[3])};
  to[0] = hn::ConcatLowerLower(d, even[1], even[0]);
  to[1] = hn::ConcatLowerLower(d, odd[1], odd[0]);
  to[2] = hn::ConcatUpperUpper(d, even[1], even[0]);
  to[3] = hn::ConcatUpperUpper(d, odd[1], odd[0]);
#elif HWY_TARGET == HWY_SCALAR
  to[0] = from[0];
#else
  const Vector upper = hn::InterleaveUpper(Lanes(), from[0], from[1]);
  to[0] = hn::InterleaveLower(Lanes(), from[0], from[1]);
  to[1] = upper;
#endif
}

/// Part k of the rows of a net, or of its transpose.
template <int N>
HWY_INLINE void load_part(const NetRows& net, int k, bool transposed, Vector* part) {
  if (!transposed) {
    for (int i = 0; i < N; ++i) part[i] = hn::Load(Lanes(), net[i].data() + k * kLanes);
    return;
  }
  for (int i = 0; i < 8; i += kLanes) {
    Vector square[kLanes];
    for (int j = 0; j < kLanes; ++j)
      square[j] = hn::Load(Lanes(), net[std::min(k * kLanes + j, N - 1)].data() + i);
    transpose_square(square, part + i);
  }
}

/// Stores part k of N rows in that many rows of their transpose; lanes from N on repeat the last
/// one.
template <int N>
HWY_INLINE void store_part_transposed(Vector* part, int k, NetRows* to) {
  for (int i = N; i < 8; ++i) part[i] = part[N - 1];
  for (int i = 0; i < 8; i += kLanes) {
    Vector square[kLanes];
    transpose_square(part + i, square);
    for (int j = 0; j < kLanes && k * kLanes + j < N; ++j)
      hn::Store(square[j], Lanes(), (*to)[k * kLanes + j].data() + i);
  }
}

/// Both halves of a net across its rows, or across its lanes, as nets whose rows run along the
/// other axis; only the extremes of one that keeps a sign beyond the radius.
template <int N>
HWY_INLINE void halve_net(const NetRows& net, bool along_lanes, double radius, NetRows* lower,
                          NetRows* upper, NetExtremes* extremes) {
  Vector low[kUsedParts<N>][8], high[kUsedParts<N>][8];
  PartExtent of_low, of_high;
  for (int k = 0; k < kUsedParts<N>; ++k) {
    Vector part[8];
    load_part<N>(net, k, along_lanes, part);
    halve_part<N>(part, low[k], high[k], &of_low, &of_high);
  }
  extremes[0] = of_low.extremes();
  extremes[1] = of_high.extremes();
  if (!beyond(extremes[0], radius))
    for (int k = 0; k < kUsedParts<N>; ++k) store_part_transposed<N>(low[k], k, lower);
  if (!beyond(extremes[1], radius))
    for (int k = 0; k < kUsedParts<N>; ++k) store_part_transposed<N>(high[k], k, upper);
}

/// Calls what is compiled for every size of net.
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

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
