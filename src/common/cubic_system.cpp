// SPDX-License-Identifier: MIT
#include "common/cubic_system.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/cubic_system.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_CUBIC_SYSTEM_SHARED
#define ENCASE_CUBIC_SYSTEM_SHARED
namespace encase {

/// The least and greatest numbers among the coefficients of either polynomial.
struct PairedExtremes {
  std::array<double, 2> lo, hi;
};

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

/// A system, combined with the rows of a matrix Y.
struct Preconditioned {
  Matrix<2> y;    ///< the inverse of the mean Jacobian, or its adjugate
  bool regular;   ///< the inverse exists
  bool excluded;  ///< one of the combinations keeps a sign
  bool linear;    ///< there are slopes: the combinations are not too far from the coordinates
  std::array<double, 2> rounding;  ///< of the combinations' coefficients
  std::array<double, 2> radius;    ///< of the combinations, rounding included
  /// If regular and not excluded: the extremes of combination c less the coordinate c.
  PairedExtremes rest;
  /// If linear: the extremes of the combinations' differences across rows and across lanes.
  std::array<PairedExtremes, 2> slope;
};

namespace {

/// The rows of the coordinates: that across rows in the first half, that across lanes in the other.
struct alignas(64) Coordinates {
  double row[4][8];
};
constexpr Coordinates make_coordinates() {
  Coordinates c{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 8; ++j) c.row[i][j] = 2.0 / 3 * (j < 4 ? i : j - 4) - 1;
  return c;
}
constexpr Coordinates kCoordinates = make_coordinates();

struct alignas(64) Squares {
  double lane[16];
};
constexpr Squares kSquares{{0, 1, 4, 9, 16, 25, 36, 49, 64, 81, 100, 121, 144, 169, 196, 225}};

}  // namespace
}  // namespace encase
#endif

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

/// Sums of four rows with the coefficients of a matrix, whose rows are 8 doubles apart.
HWY_INLINE void multiply(const double* matrix, const Row* rows, Row* result) {
  for (int i = 0; i < 4; ++i) {
    Row sum = rows[0] * Row::all(matrix[8 * i]);
    for (int k = 1; k < 4; ++k) sum = sum + rows[k] * Row::all(matrix[8 * i + k]);
    result[i] = sum;
  }
}

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

/// Sums of the rows up to `last` with eight columns of a matrix.
HWY_INLINE void combine_rows(const Row* rows, int last, const double* matrix, Row* result) {
  Row sum[8];
  for (int k = 0; k < 8; ++k) sum[k] = Row::all(0);
  for (int i = 0; i <= last; ++i) {
    const Row row = rows[i];
    for (int k = 0; k < 8; ++k) sum[k] = sum[k] + row * Row::all(matrix[Powers::kRow * i + k]);
  }
  for (int k = 0; k < 8; ++k) result[k] = sum[k];
}

/// A polynomial of a total degree up to 15, in powers, as a Chebyshev net on a box: what belongs to
/// degrees up to 7, transposed, and sums over the rest.
void expand_powers(const double* a, int degree, const double* of_x, const double* of_y, double* net,
                   HighSums* sums) {
  constexpr int kHigh = 8 * Powers::kRow + 8;
  const int above = degree - 8;  // the degree left where one variable has eight
  Row rows[16], low[16], high[8];
  for (int i = 0; i <= degree; ++i) rows[i] = Row::load(a + Tile::kRow * i);
  combine_rows(rows, degree, of_x, low);
  transpose(low);
  if (above >= 0) {
    combine_rows(rows + 8, above, of_x + kHigh, high);
    for (int i = 0; i <= above; ++i) rows[i] = Row::load(a + Tile::kRow * i + 8);
    combine_rows(rows, above, of_x, low + 8);
    transpose(low + 8);
    transpose(high);
  }
  combine_rows(low, degree, of_y, rows);
  Row size = Row::all(0), left_out = size, row_squares = size, lane_squares = size;
  for (int i = 0; i < 8; ++i) {
    rows[i].store(net + 8 * i);
    size = size + absolute(rows[i]);
  }
  if (above >= 0) {
    const Row squares = Row::load(kSquares.lane), high_squares = Row::load(kSquares.lane + 8);
    combine_rows(low + 8, above, of_y + kHigh, rows);
    for (int i = 0; i <= above; ++i) {
      const Row term = absolute(rows[i]);
      left_out = left_out + term;
      row_squares = row_squares + term * Row::all(kSquares.lane[8 + i]);
      lane_squares = lane_squares + term * squares;
    }
    combine_rows(high, above, of_y, rows);
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
  for (int k = 0; k < N; ++k) {
    Row sum = c[k] * Row::all(m[8 * k + k]);
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

/// Cubic nets on a part of their box.
void restrict_cubic(const double* b, const double* nodes, const double* matrix, double* to,
                    PairedExtremes* extremes) {
  HWY_ALIGN double weights[4][8];
  const Row half = Row::all(0.5), s = Row::load(nodes) * half, three = Row::all(3);
  const Row u = half + s, v = half - s, uu = u * u, vv = v * v;
  (vv * v).store(weights[0]);
  (vv * u * three).store(weights[1]);
  (uu * v * three).store(weights[2]);
  (uu * u).store(weights[3]);
  Row rows[4], value[4];
  for (int i = 0; i < 4; ++i) rows[i] = Row::load(b + 8 * i);
  for (int k = 0; k < 4; ++k) {
    value[k] = rows[0] * Row::all(weights[0][k]);
    for (int i = 1; i < 4; ++i) value[k] = value[k] + rows[i] * Row::all(weights[i][k]);
  }
  transpose_halves(value);
  for (int k = 0; k < 4; ++k) {
    rows[k] = value[0] * Row::all(weights[0][4 + k]);
    for (int i = 1; i < 4; ++i) rows[k] = rows[k] + value[i] * Row::all(weights[i][4 + k]);
  }
  multiply(matrix, rows, value);
  transpose_halves(value);
  multiply(matrix, value, rows);
  for (int i = 0; i < 4; ++i) rows[i].store(to + 8 * i);
  *extremes = range_of_rows(rows).extremes();
}

HWY_INLINE Row by_halves(double first, double second) {
  return first_lanes(Row::all(first), Row::all(second), 4);
}

/// De Casteljau's algorithm at 1/2: sums of two, scaled at the end. A half in which one polynomial
/// keeps a sign is not stored.
void halve_nets(const double* b, bool along_lanes, const double* radius, double* lower,
                double* upper, PairedExtremes* extremes, bool* excluded) {
  Row t[4];
  for (int i = 0; i < 4; ++i) t[i] = Row::load(b + 8 * i);
  if (along_lanes) transpose_halves(t);
  const Row half = Row::all(0.5), quarter = Row::all(0.25), eighth = Row::all(0.125);
  const Row s01 = t[0] + t[1], s12 = t[1] + t[2], s23 = t[2] + t[3];
  const Row q0 = s01 + s12, q1 = s12 + s23, middle = (q0 + q1) * eighth;
  Row halves[2][4] = {{t[0], s01 * half, q0 * quarter, middle},
                      {middle, q1 * quarter, s23 * half, t[3]}};
  const Row r = by_halves(radius[0], radius[1]);
  for (int k = 0; k < 2; ++k) {
    const RowRange range = range_of_rows(halves[k]);
    excluded[k] = range.signs_beyond(r);
    if (excluded[k]) continue;
    extremes[k] = range.extremes();
    transpose_halves(halves[k]);
    for (int i = 0; i < 4; ++i) halves[k][i].store((k == 0 ? lower : upper) + 8 * i);
  }
}

/// The mean Jacobian, its rows those of the polynomials: across rows, across lanes.
HWY_INLINE Matrix<2> mean_slopes(const Row* rows) {
  HWY_ALIGN double across[8], lanes[8];
  sum_of_halves(rows[3] - rows[0]).store(across);
  ((rows[0] + rows[1]) + (rows[2] + rows[3])).store(lanes);
  return {{{0.125 * across[0], 0.125 * (lanes[3] - lanes[0])},
           {0.125 * across[4], 0.125 * (lanes[7] - lanes[4])}}};
}

void precondition(const double* b, const double* magnitude, const double* radius,
                  Preconditioned* result) {
  Row rows[4], c[4];
  for (int i = 0; i < 4; ++i) rows[i] = Row::load(b + 8 * i);
  const Matrix<2> j = mean_slopes(rows);
  const double scale = 1 / (j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  result->regular = scale > -1e300 && scale < 1e300;
  const double s = result->regular ? scale : 1;
  Matrix<2>& y = result->y;
  y = {{{j[1][1] * s, -j[0][1] * s}, {-j[1][0] * s, j[0][0] * s}}};
  for (int k = 0; k < 2; ++k) {
    // Two products and a sum round.
    const double first = y[k][0] < 0 ? -y[k][0] : y[k][0];
    const double second = y[k][1] < 0 ? -y[k][1] : y[k][1];
    result->rounding[k] =
        3 * 0x1p-53 * (first * magnitude[0] + second * magnitude[1]) * (1 + 0x1p-40) + 0x1p-1000;
    result->radius[k] =
        (first * radius[0] + second * radius[1] + result->rounding[k]) * (1 + 0x1p-40);
  }
  const Row own = by_halves(y[0][0], y[1][1]), other = by_halves(y[0][1], y[1][0]);
  for (int i = 0; i < 4; ++i) c[i] = own * rows[i] + other * swap_halves(rows[i]);
  result->excluded = range_of_rows(c).signs_beyond(by_halves(result->radius[0], result->radius[1]));
  if (result->excluded || !result->regular) return;
  for (int i = 0; i < 4; ++i) rows[i] = c[i] - Row::load(kCoordinates.row[i]);
  result->rest = range_of_rows(rows).extremes();
  // Slopes close to those of the coordinates would keep the rests small.
  constexpr double kMost = 2.5;
  result->linear = result->rest.hi[0] - result->rest.lo[0] < kMost &&
                   result->rest.hi[1] - result->rest.lo[1] < kMost;
  if (!result->linear) return;
  for (int k = 0; k < 2; ++k) {
    RowRange d(c[1] - c[0]);
    d.add(c[2] - c[1]);
    d.add(c[3] - c[2]);
    result->slope[k] = d.extremes();
    transpose_halves(c);
  }
}

/// The largest differences of neighbours, up and down the rows, in the net and its transpose.
void variations(const double* b, PairedExtremes* result) {
  Row rows[4];
  for (int i = 0; i < 4; ++i) rows[i] = Row::load(b + 8 * i);
  for (int k = 0; k < 2; ++k) {
    RowRange d(rows[1] - rows[0]);
    d.add(rows[2] - rows[1]);
    d.add(rows[3] - rows[2]);
    result[k] = d.extremes();
    transpose_halves(rows);
  }
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(cut_off_nets);
HWY_EXPORT(restrict_nets);
HWY_EXPORT(restrict_cubic);
HWY_EXPORT(halve_nets);
HWY_EXPORT(precondition);
HWY_EXPORT(variations);
HWY_EXPORT(expand_powers);

constexpr double kUnit = 0x1p-53;
constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

/// A positive v with E v < quality v, if there is one: with it (quality I - E) v is a multiple of
/// (1, 1).
bool find_weights(const Matrix<2>& e, double quality, std::array<double, 2>* v) {
  const double a = quality - e[0][0], b = quality - e[1][1];
  if (!(a > 0 && b > 0 && a * b > e[0][1] * e[1][0])) return false;
  const double largest = std::max(b + e[0][1], a + e[1][0]);
  *v = {(b + e[0][1]) / largest, (a + e[1][0]) / largest};
  for (int k = 0; k < 2; ++k)
    if (!((e[k][0] * (*v)[0] + e[k][1] * (*v)[1]) * kUp < quality * (*v)[k])) return false;
  return true;
}

}  // namespace

namespace {

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

/// The number of a part that halvings lead to: those of one size count on from 1, 2, 4, 8; 0 if it
/// is another or smaller.
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

Part part_of(const Chart& chart, const Box<2>& box) {
  const Chart inner = chart_of(box);
  Part part;
  for (int i = 0; i < 2; ++i) {
    part.origin[i] = (inner[i].center - chart[i].center) / chart[i].half;
    part.half[i] = inner[i].half / chart[i].half;
  }
  return part;
}

namespace {

/// Row i: the coefficients of T_i(origin + half s) in T_0(s), ..., T_7(s), by Chebyshev's
/// recurrence.
struct alignas(64) Substitution {
  double m[8][8];
};
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

/// The matrix for one axis: none where the part is the whole.
const double* substitution(double origin, double half, Substitution* scratch) {
  static const auto usual = [] {
    std::vector<Substitution> table(16);
    for (int count = 1; count <= 8; count *= 2)
      for (int index = 0; index < count; ++index)
        substitute((2.0 * index + 1) / count - 1, 1.0 / count,
                   &table[static_cast<std::size_t>(count + index)]);
    return table;
  }();
  const int number = number_of_part(origin, half);
  if (number == 1) return nullptr;
  if (number > 1) return usual[static_cast<std::size_t>(number)].m[0];
  substitute(origin, half, scratch);
  return scratch->m[0];
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

void restrict_to(const std::array<CubicSource, 2>& from, const Part& part,
                 std::array<CubicSource, 2>* to, CubicSystem* system) {
  const int rows = from[0].rows_axis, lanes = 1 - rows;
  Substitution of_rows, of_lanes;
  PairedExtremes extremes;
  NetSums sums;
  CubicSource *f = &(*to)[0], *g = &(*to)[1];
  HWY_DYNAMIC_DISPATCH(restrict_nets)
  (std::max(from[0].count, from[1].count), from[0].c[0].data(), from[1].c[0].data(),
   substitution(part.origin[rows], part.half[rows], &of_rows),
   substitution(part.origin[lanes], part.half[lanes], &of_lanes), f->c[0].data(), g->c[0].data(),
   system->b[0].data(), &extremes, &sums);
  for (int k = 0; k < 2; ++k) {
    CubicSource& source = (*to)[k];
    const double rounding = from[k].size * 0x1p-41 + kTiny;
    source.rows_axis = lanes;
    source.count = from[k].count;
    source.size = sums.of[k][0] * kUp;
    source.left_out = from[k].left_out;
    source.radius = (from[k].radius + rounding) * kUp;
    for (int i = 0; i < 2; ++i)
      source.slope_radius[i] = (from[k].slope_radius[i] * part.half[i] + 49 * rounding) * kUp;
  }
  describe(*to, extremes, sums, system);
}

void restrict_to(const CubicSystem& from, const Part& part, CubicSystem* system) {
  const Interpolation& table = cubic_interpolation();
  alignas(64) std::array<double, 8> nodes;
  const std::array<int, 2> axis{from.rows_axis, 1 - from.rows_axis};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 4; ++k)
      nodes[4 * i + k] = part.origin[axis[i]] + part.half[axis[i]] * table.node[k];
  PairedExtremes extremes;
  HWY_DYNAMIC_DISPATCH(restrict_cubic)
  (from.b[0].data(), nodes.data(), table.matrix[0].data(), system->b[0].data(), &extremes);
  system->rows_axis = axis[0];
  system->lo = extremes.lo;
  system->hi = extremes.hi;
  for (int k = 0; k < 2; ++k) {
    const double rounding = table.norm * table.norm * from.magnitude(k) * 0x1p-44 + kTiny;
    system->radius[k] = (from.radius[k] + rounding) * kUp;
    for (int i = 0; i < 2; ++i)
      system->slope_radius[k][i] =
          (from.slope_radius[k][i] * part.half[axis[i]] + 3 * rounding) * kUp;
  }
}

std::array<bool, 2> halve(const CubicSystem& system, int axis, CubicSystem* lower,
                          CubicSystem* upper) {
  const bool along_lanes = system.rows_axis != axis;
  // Across the halves' rows and lanes: those of the axis that stays, then the halved one.
  const int stays = along_lanes ? 0 : 1;
  std::array<double, 2> radius;
  std::array<std::array<double, 2>, 2> slope;
  for (int k = 0; k < 2; ++k) {
    // Each of three sums rounds once, relative to the largest coefficient.
    const double change = 1.01 * 4 * kUnit * system.magnitude(k) + kTiny;
    radius[k] = (system.radius[k] + change) * kUp;
    slope[k] = {(system.slope_radius[k][stays] + 3 * change) * kUp,
                (0.5 * system.slope_radius[k][1 - stays] + 3 * change) * kUp};
  }
  PairedExtremes extremes[2];
  std::array<bool, 2> excluded;
  HWY_DYNAMIC_DISPATCH(halve_nets)
  (system.b[0].data(), along_lanes, radius.data(), lower->b[0].data(), upper->b[0].data(), extremes,
   excluded.data());
  for (int k = 0; k < 2; ++k) {
    if (excluded[k]) continue;
    CubicSystem* half = k == 0 ? lower : upper;
    half->rows_axis = 1 - axis;
    half->lo = extremes[k].lo;
    half->hi = extremes[k].hi;
    half->radius = radius;
    half->slope_radius = slope;
  }
  return excluded;
}

void test_system(const CubicSystem& system, double quality, SystemVerdict* verdict) {
  Preconditioned p;
  const double magnitude[2] = {system.magnitude(0), system.magnitude(1)};
  HWY_DYNAMIC_DISPATCH(precondition)
  (system.b[0].data(), magnitude, system.radius.data(), &p);
  verdict->excluded = p.excluded;
  verdict->contracts = false;
  verdict->zeros = Box<2>{{-1, -1}, {1, 1}};
  if (p.excluded || !p.regular) return;
  // The coordinates that belong to rows and lanes, and to the combinations.
  const std::array<int, 2> axis{system.rows_axis, 1 - system.rows_axis};
  for (int c = 0; c < 2; ++c) {
    // A zero has s + rest = 0.
    const double lo = p.rest.lo[c], hi = p.rest.hi[c];
    const double slack = (p.radius[c] + 8 * kUnit * (2 + std::fabs(lo) + std::fabs(hi))) * kUp;
    verdict->zeros.lo[axis[c]] = -hi - slack;
    verdict->zeros.hi[axis[c]] = -lo + slack;
    if (-hi - slack > 1 || -lo + slack < -1) verdict->excluded = true;
  }
  if (verdict->excluded || !p.linear) return;
  Contraction<2>& contraction = verdict->contraction;
  constexpr double factor = 1.5;  // of differences: half the degree
  for (int c = 0; c < 2; ++c) {
    contraction.preconditioner[axis[c]] = p.y[c];
    const double alpha = std::fabs(p.y[c][0]), beta = std::fabs(p.y[c][1]);
    for (int i = 0; i < 2; ++i) {
      const double lo = factor * p.slope[i].lo[c], hi = factor * p.slope[i].hi[c];
      const double center = i == c ? 1.0 : 0.0;
      const double deviation = std::max(hi - center, center - lo);
      const double radius = alpha * system.slope_radius[0][i] + beta * system.slope_radius[1][i];
      // Differences and products round; the deviation is rounded up.
      contraction.bound[axis[c]][axis[i]] =
          (std::max(deviation, 0.0) + radius + 2 * factor * p.rounding[c] +
           4 * kUnit * (std::fabs(lo) + std::fabs(hi) + 1)) *
              kUp +
          kTiny;
    }
  }
  verdict->contracts = find_weights(contraction.bound, quality, &contraction.weights);
}

std::array<double, 2> relative_variation(const CubicSystem& system) {
  PairedExtremes d[2];
  HWY_DYNAMIC_DISPATCH(variations)(system.b[0].data(), d);
  std::array<double, 2> result{0, 0};
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
      result[i == 0 ? system.rows_axis : 1 - system.rows_axis] +=
          std::max(-d[i].lo[k], d[i].hi[k]) / (system.magnitude(k) + 1e-300);
  return result;
}

}  // namespace encase
#endif
