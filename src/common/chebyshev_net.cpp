// SPDX-License-Identifier: MIT
#include "common/chebyshev_net.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/chebyshev_net.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_CHEBYSHEV_NET_SHARED
#define ENCASE_CHEBYSHEV_NET_SHARED
namespace encase {

/// Sums over a Chebyshev net: of the absolute values of the coefficients of degrees up to 7; of the
/// others; and of these times the squares of the rows' and lanes' indices.
struct HighSums {
  double size, left_out, row_squares, lane_squares;
};

/// Powers of origin + half s on [-1,1]: row i has the Chebyshev coefficients of the i-th one.
struct alignas(64) Powers {
  static constexpr int kRow = Tile::kRow;
  double m[kRow][kRow];
};

namespace {

struct alignas(64) Squares {
  double lane[16];
};
constexpr Squares kSquares{{0, 1, 4, 9, 16, 25, 36, 49, 64, 81, 100, 121, 144, 169, 196, 225}};

}  // namespace
}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Sums of the rows up to `last` with eight columns of a matrix that is zero above its diagonal. As
/// many columns at a time as registers hold the sums of.
HWY_INLINE void combine_rows(const double* rows, int stride, int last, const double* matrix,
                             Row* result) {
  constexpr int kColumns = kParts == 1 ? 8 : kParts == 2 ? 4 : 2;
  for (int first = 0; first < 8; first += kColumns) {
    Row sum[kColumns];
    for (int k = 0; k < kColumns; ++k) sum[k] = Row::all(0);
    for (int i = first; i <= last; ++i) {
      const Row row = Row::load(rows + stride * i);
      const double* factors = matrix + Powers::kRow * i + first;
      for (int k = 0; k < kColumns; ++k) sum[k] = multiply_add(row, Row::all(factors[k]), sum[k]);
    }
    for (int k = 0; k < kColumns; ++k) result[first + k] = sum[k];
  }
}

/// The same, transposed.
HWY_INLINE void combine_rows_across(const double* rows, int stride, int last, const double* matrix,
                                    double* result) {
  Row square[8];
  combine_rows(rows, stride, last, matrix, square);
  transpose(square);
  for (int k = 0; k < 8; ++k) square[k].store(result + 8 * k);
}

/// A polynomial of a total degree up to 15, in powers, as a Chebyshev net on a box: what belongs to
/// degrees up to 7, transposed, and sums over the rest.
void expand_powers(const double* a, int degree, const double* of_x, const double* of_y, double* net,
                   HighSums* sums) {
  constexpr int kHigh = 8 * Powers::kRow + 8;
  const int above = degree - 8;  // the degree left where one variable has eight
  HWY_ALIGN double low[16 * 8], high[8 * 8];
  combine_rows_across(a, Tile::kRow, degree, of_x, low);
  if (above >= 0) {
    combine_rows_across(a + 8 * Tile::kRow, Tile::kRow, above, of_x + kHigh, high);
    combine_rows_across(a + 8, Tile::kRow, above, of_x, low + 64);
  }
  Row rows[8];
  combine_rows(low, 8, degree, of_y, rows);
  Row size = Row::all(0), left_out = size, row_squares = size, lane_squares = size;
  for (int i = 0; i < 8; ++i) {
    rows[i].store(net + 8 * i);
    size = size + absolute(rows[i]);
  }
  if (above >= 0) {
    const Row squares = Row::load(kSquares.lane), high_squares = Row::load(kSquares.lane + 8);
    combine_rows(low + 64, 8, above, of_y + kHigh, rows);
    for (int i = 0; i <= above; ++i) {
      const Row term = absolute(rows[i]);
      left_out = left_out + term;
      row_squares = row_squares + term * Row::all(kSquares.lane[8 + i]);
      lane_squares = lane_squares + term * squares;
    }
    combine_rows(high, 8, above, of_y, rows);
    for (int i = 0; i <= above; ++i) {
      const Row term = absolute(rows[i]);
      left_out = left_out + term;
      row_squares = row_squares + term * Row::all(kSquares.lane[i]);
      lane_squares = lane_squares + term * high_squares;
    }
  }
  *sums = {sum_of_lanes(size), sum_of_lanes(left_out), sum_of_lanes(row_squares),
           sum_of_lanes(lane_squares)};
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(expand_powers);

constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

void make_powers(double origin, double half, int degree, Powers* result) {
  auto& m = result->m;
  std::fill_n(m[0], Powers::kRow, 0.0);
  m[0][0] = 1;
  for (int i = 1; i <= degree; ++i) {
    // s T_k = (T_(k-1) + T_(k+1)) / 2, but s T_0 = T_1.
    const double* last = m[i - 1];
    std::fill_n(m[i], Powers::kRow, 0.0);
    for (int k = 0; k <= i; ++k) {
      const double below = k == 0 ? 0 : k == 1 ? 2 * last[0] : last[k - 1];
      const double above = k + 1 < Powers::kRow ? last[k + 1] : 0;
      m[i][k] = origin * last[k] + 0.5 * half * (below + above);
    }
  }
}

constexpr int kUsualParts = 32;

/// The number of a part that halvings lead to; 0 if it is another, or not below kUsualParts.
int number_of_part(double origin, double half) {
  if (!(half >= 0.125 && half <= 1)) return 0;
  const int count = static_cast<int>(1 / half),
            index = static_cast<int>(0.5 * (origin + 1) * count);
  const bool usual = half * count == 1 && (count & (count - 1)) == 0 && index >= 0 &&
                     index < count && origin == (2 * index + 1) * half - 1;
  return usual ? count + index : 0;
}

const Powers& powers(double origin, double half, int degree, Powers* scratch) {
  static const auto usual = [] {
    std::vector<Powers> table(16);
    for (int count = 1; count <= 8; count *= 2)
      for (int index = 0; index < count; ++index)
        make_powers((2.0 * index + 1) / count - 1, 1.0 / count, Tile::kMaxDegree,
                    &table[static_cast<std::size_t>(count + index)]);
    return table;
  }();
  if (const int number = number_of_part(origin, half))
    return usual[static_cast<std::size_t>(number)];
  make_powers(origin, half, degree, scratch);
  return *scratch;
}

}  // namespace

void expand(const Tile& tile, const Box<2>& box, ChebyshevNet* net) {
  Point<2> part;
  const double* m[2];
  Powers scratch[2];
  for (int i = 0; i < 2; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    part[i] = chart.half / tile.half[i];
    m[i] = powers((chart.center - tile.center[i]) / tile.half[i], part[i], tile.degree, &scratch[i])
               .m[0];
  }
  HighSums sums;
  HWY_DYNAMIC_DISPATCH(expand_powers)
  (tile.a[0].data(), tile.degree, m[0], m[1], net->c[0].data(), &sums);
  // All coefficients together are off by less than 110 u tile.sum.
  const double rounding = tile.sum * 0x1p-45 + kTiny;
  net->rows_axis = 1;
  net->size = sums.size * kUp;
  net->left_out = sums.left_out * kUp;
  net->radius = (net->left_out + tile.error + rounding) * kUp;
  net->slope_radius = {(sums.lane_squares + tile.slope_error * part[0] + 225 * rounding) * kUp,
                       (sums.row_squares + tile.slope_error * part[1] + 225 * rounding) * kUp};
}

}  // namespace encase
#endif
