// SPDX-License-Identifier: MIT
#include "common/cubic_source.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/cubic_source.cpp"
#include <hwy/foreach_target.h>

#include "common/row_ranges-inl.hpp"

#ifndef ENCASE_CUBIC_SOURCE_SHARED
#define ENCASE_CUBIC_SOURCE_SHARED
namespace encase {

/// Sums over the coefficients of either Chebyshev net, in halves of eight: of all absolute values;
/// of those that cubics leave out; and of these times the squares of the rows' and lanes' indices.
struct NetSums {
  alignas(64) double of[2][4];
};

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

/// T_i(origin + half s), i < 8: row i has its coefficients in T_0(s), ..., T_7(s).
struct alignas(64) Substitution {
  double m[8][8];
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

/// Chebyshev coefficients of degree 3 across rows, turned into Bernstein ones.
HWY_INLINE void to_bernstein(Row* c) {
  const Row third = Row::all(1.0 / 3), five_thirds = Row::all(5.0 / 3), five = Row::all(5);
  const Row even = c[0] + c[2], odd = c[1] + c[3];
  const Row inner_even = c[0] - c[2] * five_thirds, inner_odd = c[3] * five - c[1] * third;
  c[0] = even - odd;
  c[1] = inner_even + inner_odd;
  c[2] = inner_even - inner_odd;
  c[3] = even + odd;
}

/// a's lanes 0 to 3, then b's.
HWY_INLINE Row lower_halves(const Row& a, const Row& b) {
  Row r;
#if HWY_MAX_BYTES == 64
  r.part[0] = hn::ConcatLowerLower(Lanes(), b.part[0], a.part[0]);
#else
  for (int k = 0; k < kParts / 2; ++k) {
    r.part[k] = a.part[k];
    r.part[kParts / 2 + k] = b.part[k];
  }
#endif
  return r;
}

/// Of the absolute values of a Chebyshev net's coefficients, by lanes: all; those with an index
/// above 3; and these times the squares of the rows' and of the lanes' indices.
HWY_INLINE void add_up(const Row* c, Row* result) {
  const Row a1 = absolute(c[1]), a2 = absolute(c[2]), a3 = absolute(c[3]);
  const Row a4 = absolute(c[4]), a5 = absolute(c[5]), a6 = absolute(c[6]), a7 = absolute(c[7]);
  const Row low = (absolute(c[0]) + a1) + (a2 + a3), high = (a4 + a5) + (a6 + a7);
  const Row none = Row::all(0);
  const Row dropped = high + first_lanes(none, low, 4);
  const Row low_squares = a1 + (a2 * Row::all(4) + a3 * Row::all(9));
  const Row high_squares =
      (a4 * Row::all(16) + a5 * Row::all(25)) + (a6 * Row::all(36) + a7 * Row::all(49));
  result[0] = low + high;
  result[1] = dropped;
  result[2] = high_squares + first_lanes(none, low_squares, 4);
  result[3] = dropped * Row::load(kSquares.lane);
}

/// The cubic parts of two Chebyshev nets as Bernstein nets, their rows along the nets' lanes.
HWY_INLINE void cut_off_rows(const Row* f, const Row* g, double* to, PairedExtremes* extremes,
                             NetSums* sums) {
  Row s[8], rows[4];
  add_up(f, s);
  add_up(g, s + 4);
  transpose(s);
  (((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]))).store(sums->of[0]);
  for (int i = 0; i < 4; ++i) rows[i] = lower_halves(f[i], g[i]);
  to_bernstein(rows);
  transpose_halves(rows);
  to_bernstein(rows);
  for (int i = 0; i < 4; ++i) rows[i].store(to + 8 * i);
  *extremes = range_of_rows(rows).extremes();
}

void cut_off_nets(const double* f, const double* g, double* to, PairedExtremes* extremes,
                  NetSums* sums) {
  Row nets[2][8];
  for (int i = 0; i < 8; ++i) {
    nets[0][i] = Row::load(f + 8 * i);
    nets[1][i] = Row::load(g + 8 * i);
  }
  cut_off_rows(nets[0], nets[1], to, extremes, sums);
}

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
      for (int k = 0; k < kColumns; ++k) sum[k] = sum[k] + row * Row::all(factors[k]);
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

/// A Chebyshev net of N rows on a part along their axis: T_i there is the sum over k of m[i][k]
/// T_k.
template <int N>
HWY_INLINE void substitute_rows(const double* m, Row* c) {
#pragma GCC unroll 8
  for (int k = 0; k < N; ++k) {
    Row sum = c[k] * Row::all(m[8 * k + k]);
#pragma GCC unroll 8
    for (int i = k + 1; i < N; ++i) sum = sum + c[i] * Row::all(m[8 * i + k]);
    c[k] = sum;
  }
}

/// Two Chebyshev nets on a part of their box, transposed, and their cubic parts as above. A matrix
/// belongs to each axis, or none where the part is as wide as the box.
template <int N>
void restrict_nets_of(const double* f, const double* g, const double* of_rows,
                      const double* of_lanes, double* to_f, double* to_g, double* to,
                      PairedExtremes* extremes, NetSums* sums) {
  Row nets[2][8];
  for (int k = 0; k < 2; ++k) {
    Row* net = nets[k];
    for (int i = 0; i < 8; ++i) net[i] = Row::load((k == 0 ? f : g) + 8 * i);
    if (of_rows) substitute_rows<N>(of_rows, net);
    transpose(net);
    if (of_lanes) substitute_rows<N>(of_lanes, net);
    for (int i = 0; i < 8; ++i) net[i].store((k == 0 ? to_f : to_g) + 8 * i);
  }
  cut_off_rows(nets[0], nets[1], to, extremes, sums);
}

void restrict_nets(int count, const double* f, const double* g, const double* of_rows,
                   const double* of_lanes, double* to_f, double* to_g, double* to,
                   PairedExtremes* extremes, NetSums* sums) {
  const auto run = count <= 5   ? restrict_nets_of<5>
                   : count == 6 ? restrict_nets_of<6>
                   : count == 7 ? restrict_nets_of<7>
                                : restrict_nets_of<8>;
  run(f, g, of_rows, of_lanes, to_f, to_g, to, extremes, sums);
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(cut_off_nets);
HWY_EXPORT(restrict_nets);
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

void expand(const Tile& tile, const Box<2>& box, CubicSource* source) {
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
  (tile.a[0].data(), tile.degree, m[0], m[1], source->c[0].data(), &sums);
  // All coefficients together are off by less than 110 u tile.sum.
  const double rounding = tile.sum * 0x1p-45 + kTiny;
  source->rows_axis = 1;
  source->count = std::clamp(tile.degree + 1, 1, 8);
  source->size = sums.size * kUp;
  source->left_out = sums.left_out * kUp;
  source->radius = (source->left_out + tile.error + rounding) * kUp;
  source->slope_radius = {(sums.lane_squares + tile.slope_error * part[0] + 225 * rounding) * kUp,
                          (sums.row_squares + tile.slope_error * part[1] + 225 * rounding) * kUp};
}

bool CubicSource::has_sign() const {
  const double mean = std::fabs(c[0][0]), rest = (size - mean) * kUp + 0x1p-50 * mean;
  return mean - rest > radius;
}

namespace {

void substitute(double origin, double half, Substitution* result) {
  auto& m = result->m;
  *result = {};
  m[0][0] = 1;
  m[1][0] = origin;
  m[1][1] = half;
  for (int i = 2; i < 8; ++i) {
    // 2 s T_k = T_(k-1) + T_(k+1), but 2 s T_0 = 2 T_1.
    const double* last = m[i - 1];
    for (int k = 0; k <= i; ++k) {
      const double below = k == 0 ? 0 : k == 1 ? 2 * last[0] : last[k - 1];
      const double above = k < 7 ? last[k + 1] : 0;
      m[i][k] = (2 * origin * last[k] + half * (below + above)) - m[i - 2][k];
    }
  }
}

/// That of a part below kUsualParts.
const Substitution& usual_substitution(int number) {
  static const auto usual = [] {
    std::vector<Substitution> table(kUsualParts);
    for (int count = 1; count < kUsualParts; count *= 2)
      for (int index = 0; index < count; ++index)
        substitute((2.0 * index + 1) / count - 1, 1.0 / count,
                   &table[static_cast<std::size_t>(count + index)]);
    return table;
  }();
  return usual[static_cast<std::size_t>(number)];
}

const Substitution& substitution(double origin, double half, Substitution* scratch) {
  if (const int number = number_of_part(origin, half)) return usual_substitution(number);
  substitute(origin, half, scratch);
  return *scratch;
}
double half_of_part(std::int64_t number) {
  return 1 / static_cast<double>(std::bit_floor(static_cast<std::uint64_t>(number)));
}

const Substitution& substitution(std::int64_t number, Substitution* scratch) {
  if (number < kUsualParts) return usual_substitution(static_cast<int>(number));
  const double half = half_of_part(number);
  substitute(static_cast<double>(2 * number + 1) * half - 3, half, scratch);
  return *scratch;
}

/// What is said of cubic nets that are cut off from sources.
void describe(const std::array<CubicSource, 2>& sources, const PairedExtremes& extremes,
              const NetSums& sums, CubicSystem* system) {
  system->rows_axis = 1 - sources[0].rows_axis;
  system->lo = extremes.lo;
  system->hi = extremes.hi;
  for (int k = 0; k < 2; ++k) {
    const CubicSource& source = sources[k];
    const double* sum = sums.of[k];
    const double rounding = sum[0] * 0x1p-44 + kTiny;
    system->radius[k] = (source.radius + sum[1] + rounding) * kUp;
    // The system's rows run along the source's lanes.
    system->slope_radius[k] = {
        (source.slope_radius[system->rows_axis] + sum[3] + 3 * rounding) * kUp,
        (source.slope_radius[1 - system->rows_axis] + sum[2] + 3 * rounding) * kUp};
  }
}

}  // namespace

void cut_off(const std::array<CubicSource, 2>& sources, CubicSystem* system) {
  PairedExtremes extremes;
  NetSums sums;
  HWY_DYNAMIC_DISPATCH(cut_off_nets)
  (sources[0].c[0].data(), sources[1].c[0].data(), system->b[0].data(), &extremes, &sums);
  describe(sources, extremes, sums, system);
}

namespace {

/// The sources on a part, given by the matrices along x and y; none where it is as wide as the box.
void restrict_to(const std::array<CubicSource, 2>& from, const std::array<const double*, 2>& matrix,
                 const Point<2>& half, std::array<CubicSource, 2>* to, CubicSystem* system) {
  const int rows = from[0].rows_axis, lanes = 1 - rows;
  PairedExtremes extremes;
  NetSums sums;
  CubicSource *f = &(*to)[0], *g = &(*to)[1];
  HWY_DYNAMIC_DISPATCH(restrict_nets)
  (std::max(from[0].count, from[1].count), from[0].c[0].data(), from[1].c[0].data(), matrix[rows],
   matrix[lanes], f->c[0].data(), g->c[0].data(), system->b[0].data(), &extremes, &sums);
  for (int k = 0; k < 2; ++k) {
    CubicSource& source = (*to)[k];
    const double rounding = from[k].size * 0x1p-41 + kTiny;
    source.rows_axis = lanes;
    source.count = from[k].count;
    source.size = sums.of[k][0] * kUp;
    source.left_out = from[k].left_out;
    source.radius = (from[k].radius + rounding) * kUp;
    for (int i = 0; i < 2; ++i)
      source.slope_radius[i] = (from[k].slope_radius[i] * half[i] + 49 * rounding) * kUp;
  }
  describe(*to, extremes, sums, system);
}

}  // namespace

void restrict_to(const std::array<CubicSource, 2>& from, const Part& part,
                 std::array<CubicSource, 2>* to, CubicSystem* system) {
  Substitution scratch[2];
  std::array<const double*, 2> matrix;
  for (int i = 0; i < 2; ++i)
    matrix[i] = part.half[i] == 1 && part.origin[i] == 0
                    ? nullptr
                    : substitution(part.origin[i], part.half[i], &scratch[i]).m[0];
  restrict_to(from, matrix, part.half, to, system);
}

void restrict_to(const std::array<CubicSource, 2>& from, const std::array<std::int64_t, 2>& number,
                 std::array<CubicSource, 2>* to, CubicSystem* system) {
  Substitution scratch[2];
  std::array<const double*, 2> matrix;
  for (int i = 0; i < 2; ++i)
    matrix[i] = number[i] == 1 ? nullptr : substitution(number[i], &scratch[i]).m[0];
  restrict_to(from, matrix, {half_of_part(number[0]), half_of_part(number[1])}, to, system);
}

}  // namespace encase
#endif
