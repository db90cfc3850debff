// SPDX-License-Identifier: MIT
// Ranges of rows of eight doubles, and of the nets of two polynomials side by side (included once
// for each instruction set, as simd_rows-inl.hpp).
#ifndef ENCASE_PAIRED_EXTREMES
#define ENCASE_PAIRED_EXTREMES
#include <array>

namespace encase {

/// The least and greatest numbers among the coefficients of either polynomial.
struct PairedExtremes {
  std::array<double, 2> lo, hi;
};

}  // namespace encase
#endif

#if defined(ENCASE_ROW_RANGES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ENCASE_ROW_RANGES_INL
#undef ENCASE_ROW_RANGES_INL
#else
#define ENCASE_ROW_RANGES_INL
#endif

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// The least and greatest of several rows.
struct RowRange {
  Row lo, hi;
  HWY_INLINE explicit RowRange(const Row& first) : lo(first), hi(first) {}
  HWY_INLINE void add(const Row& row) {
    lo = least(lo, row);
    hi = greatest(hi, row);
  }
  HWY_INLINE void add(const RowRange& other) {
    lo = least(lo, other.lo);
    hi = greatest(hi, other.hi);
  }
  HWY_INLINE PairedExtremes extremes() const {
    HWY_ALIGN double l[8], h[8];
    least_of_halves(lo).store(l);
    greatest_of_halves(hi).store(h);
    return {{l[0], l[4]}, {h[0], h[4]}};
  }
  /// Whether one half of the lanes keeps a sign beyond +-radius.
  HWY_INLINE bool signs_beyond(const Row& radius) const {
    return some_half_above(lo, radius) || some_half_above(Row::all(0) - radius, hi);
  }
};

HWY_INLINE RowRange range_of_rows(const Row* rows) {
  RowRange range(rows[0]), other(rows[2]);
  range.add(rows[1]);
  other.add(rows[3]);
  range.add(other);
  return range;
}

/// `first` in the lanes 0 to 3, `second` in the others.
HWY_INLINE Row by_halves(double first, double second) {
  return first_lanes(Row::all(first), Row::all(second), 4);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
