// SPDX-License-Identifier: MIT
// What nets of patches have in common, for every instruction set (included once for each, as
// simd_rows-inl.hpp).
#ifndef ENCASE_NET_ROWS
#define ENCASE_NET_ROWS
#include <array>

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
