// SPDX-License-Identifier: MIT
// Rows of eight doubles, for every instruction set that Highway compiles for (included once for
// each, therefore the unusual guard). Only the operations that IEEE 754 fixes are used, in a fixed
// order, so that all instruction sets give the same bits; but for multiply_add.
#if defined(ENCASE_SIMD_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef ENCASE_SIMD_ROWS_INL
#undef ENCASE_SIMD_ROWS_INL
#else
#define ENCASE_SIMD_ROWS_INL
#endif

#include <hwy/highway.h>

#include <utility>

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Lanes>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Lanes()));
constexpr int kParts = 8 / kLanes;

/// Eight doubles.
struct Row {
  Vector part[kParts];

  static HWY_INLINE Row load(const double* from) {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::Load(Lanes(), from + k * kLanes);
    return r;
  }
  static HWY_INLINE Row load_unaligned(const double* from) {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::LoadU(Lanes(), from + k * kLanes);
    return r;
  }
  static HWY_INLINE Row all(double x) {
    Row r;
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::Set(Lanes(), x);
    return r;
  }
  HWY_INLINE void store(double* to) const {
    for (int k = 0; k < kParts; ++k) hn::Store(part[k], Lanes(), to + k * kLanes);
  }
  HWY_INLINE void store_unaligned(double* to) const {
    for (int k = 0; k < kParts; ++k) hn::StoreU(part[k], Lanes(), to + k * kLanes);
  }
};

#define ENCASE_ROW_OPERATION(name, operation)                                         \
  HWY_INLINE Row name(const Row& a, const Row& b) {                                   \
    Row r;                                                                            \
    for (int k = 0; k < kParts; ++k) r.part[k] = hn::operation(a.part[k], b.part[k]); \
    return r;                                                                         \
  }
ENCASE_ROW_OPERATION(operator+, Add)
ENCASE_ROW_OPERATION(operator-, Sub)
ENCASE_ROW_OPERATION(operator*, Mul)
ENCASE_ROW_OPERATION(least, Min)
ENCASE_ROW_OPERATION(greatest, Max)
#undef ENCASE_ROW_OPERATION

/// a * b + c, rounded once where the processor can do that, else twice: they agree where the
/// product is a double.
HWY_INLINE Vector multiply_add(Vector a, Vector b, Vector c) { return hn::MulAdd(a, b, c); }
HWY_INLINE Row multiply_add(const Row& a, const Row& b, const Row& c) {
  Row r;
  for (int k = 0; k < kParts; ++k) r.part[k] = multiply_add(a.part[k], b.part[k], c.part[k]);
  return r;
}
HWY_INLINE Row absolute(const Row& a) {
  Row r;
  for (int k = 0; k < kParts; ++k) r.part[k] = hn::Abs(a.part[k]);
  return r;
}
/// a where lane < count, else b.
HWY_INLINE Row first_lanes(const Row& a, const Row& b, int count) {
  Row r;
  for (int k = 0; k < kParts; ++k) {
    const int here = count - k * kLanes;
    r.part[k] = hn::IfThenElse(hn::FirstN(Lanes(), static_cast<size_t>(here < 0 ? 0 : here)),
                               a.part[k], b.part[k]);
  }
  return r;
}
HWY_INLINE double least_lane(const Row& a) {
  Vector v = a.part[0];
  for (int k = 1; k < kParts; ++k) v = hn::Min(v, a.part[k]);
  return hn::GetLane(hn::MinOfLanes(Lanes(), v));
}
HWY_INLINE double greatest_lane(const Row& a) {
  Vector v = a.part[0];
  for (int k = 1; k < kParts; ++k) v = hn::Max(v, a.part[k]);
  return hn::GetLane(hn::MaxOfLanes(Lanes(), v));
}
/// The sum of the lanes, in one order for all instruction sets: lanes 4 apart, then 2, then 1.
HWY_INLINE double sum_of_lanes(const Row& a) {
#if HWY_TARGET == HWY_SCALAR
  const auto x = [&](int lane) { return hn::GetLane(a.part[lane]); };
  return ((x(0) + x(4)) + (x(2) + x(6))) + ((x(1) + x(5)) + (x(3) + x(7)));
#else
  const hn::FixedTag<double, 2> two;
#if HWY_MAX_BYTES >= 32
  const hn::FixedTag<double, 4> four;
#if HWY_MAX_BYTES >= 64
  const auto half = hn::Add(hn::LowerHalf(four, a.part[0]), hn::UpperHalf(four, a.part[0]));
#else
  const auto half = hn::Add(a.part[0], a.part[1]);
#endif
  const auto pair = hn::Add(hn::LowerHalf(two, half), hn::UpperHalf(two, half));
#else
  const auto pair = hn::Add(hn::Add(a.part[0], a.part[2]), hn::Add(a.part[1], a.part[3]));
#endif
  return hn::GetLane(pair) + hn::GetLane(hn::Reverse(two, pair));
#endif
}

/// Transposes a square of eight rows.
HWY_INLINE void transpose(Row* r) {
#if HWY_TARGET == HWY_SCALAR
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < i; ++j) std::swap(r[i].part[j], r[j].part[i]);
#else
  const Lanes d;
  // Pairs of rows: lanes of even and of odd columns side by side.
  Row even[4], odd[4];
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < kParts; ++k) {
      even[i].part[k] = hn::InterleaveLower(d, r[2 * i].part[k], r[2 * i + 1].part[k]);
      odd[i].part[k] = hn::InterleaveUpper(d, r[2 * i].part[k], r[2 * i + 1].part[k]);
    }
#if HWY_MAX_BYTES == 64
  // Four blocks of two lanes in every row: their square is transposed likewise.
  for (int c = 0; c < 2; ++c) {
    const Row* from = c == 0 ? even : odd;
    const Vector a = from[0].part[0], b = from[1].part[0], e = from[2].part[0], f = from[3].part[0];
    const Vector ab_even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(b), a),
                 ab_odd = hn::OddEvenBlocks(b, hn::SwapAdjacentBlocks(a)),
                 ef_even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(f), e),
                 ef_odd = hn::OddEvenBlocks(f, hn::SwapAdjacentBlocks(e));
    r[c].part[0] = hn::ConcatLowerLower(d, ef_even, ab_even);
    r[2 + c].part[0] = hn::ConcatLowerLower(d, ef_odd, ab_odd);
    r[4 + c].part[0] = hn::ConcatUpperUpper(d, ef_even, ab_even);
    r[6 + c].part[0] = hn::ConcatUpperUpper(d, ef_odd, ab_odd);
  }
#elif HWY_MAX_BYTES == 32
  for (int c = 0; c < 2; ++c) {
    const Row* from = c == 0 ? even : odd;
    for (int k = 0; k < 2; ++k)      // columns 4 k to 4 k + 3
      for (int h = 0; h < 2; ++h) {  // rows 4 h to 4 h + 3
        const Vector a = from[2 * h].part[k], b = from[2 * h + 1].part[k];
        r[4 * k + c].part[h] = hn::ConcatLowerLower(d, b, a);
        r[4 * k + 2 + c].part[h] = hn::ConcatUpperUpper(d, b, a);
      }
  }
#else
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 4; ++k) {
      r[2 * k].part[i] = even[i].part[k];
      r[2 * k + 1].part[i] = odd[i].part[k];
    }
#endif
#endif
}

/// x * y = product + error exactly, where nothing underflows or overflows.
HWY_INLINE Row exact_product(const Row& x, const Row& y, Row* error) {
  const Row product = x * y;
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  for (int k = 0; k < kParts; ++k)
    error->part[k] = hn::MulSub(x.part[k], y.part[k], product.part[k]);
#else
  // Dekker, with Veltkamp's splitting.
  const Row splitter = Row::all(0x1p27 + 1);
  const Row a = splitter * x, b = splitter * y;
  const Row x1 = a - (a - x), y1 = b - (b - y);
  const Row x2 = x - x1, y2 = y - y1;
  *error = ((x1 * y1 - product) + x1 * y2 + x2 * y1) + x2 * y2;
#endif
  return product;
}
/// x - y, where it can be chosen in the units that multiply: most have as many of these as of those
/// that only add, which sums of two doubles keep busier.
HWY_INLINE Row minus(const Row& x, const Row& y) {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  Row r;
  for (int k = 0; k < kParts; ++k)
    r.part[k] = hn::MulSub(x.part[k], hn::Set(Lanes(), 1.0), y.part[k]);
  return r;
#else
  return x - y;
#endif
}
/// x + y = sum + error exactly (Knuth).
HWY_INLINE Row exact_sum(const Row& x, const Row& y, Row* error) {
  const Row sum = x + y;
  const Row y1 = minus(sum, x);
  *error = (x - minus(sum, y1)) + minus(y, y1);
  return sum;
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
