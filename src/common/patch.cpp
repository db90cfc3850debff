// SPDX-License-Identifier: MIT
#include "common/patch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/chebyshev_net.hpp"
#include "common/interval.hpp"
#include "encase/number.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/patch.cpp"
#include <hwy/foreach_target.h>

#include "common/net_rows-inl.hpp"

#ifndef ENCASE_PATCH_SHARED
#define ENCASE_PATCH_SHARED
namespace encase {

/// The Bernstein coefficients in degree count - 1 of Chebyshev's polynomials: column k has those of
/// T_k.
struct ChebyshevTable {
  int count = 0;
  std::array<std::array<double, 8>, 8> matrix{};
  double largest = 0;  ///< at least all absolute values
};

}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// Chebyshev coefficients across rows, turned into Bernstein ones: even polynomials have symmetric
/// ones.
template <int N>
HWY_INLINE void to_bernstein(const ChebyshevTable& table, Row* c) {
  Row result[N];
  for (int j = 0; 2 * j < N; ++j) {
    Row even = c[0], odd = c[1] * Row::all(table.matrix[j][1]);
    for (int k = 2; k < N; k += 2) even = multiply_add(c[k], Row::all(table.matrix[j][k]), even);
    for (int k = 3; k < N; k += 2) odd = multiply_add(c[k], Row::all(table.matrix[j][k]), odd);
    result[j] = even + odd;
    result[N - 1 - j] = even - odd;
  }
  for (int j = 0; j < N; ++j) c[j] = result[j];
}

/// The Bernstein net of a Chebyshev net, transposed. Returns its extremes.
template <int N>
HWY_INLINE NetExtremes bernstein_net(const double* from, const ChebyshevTable& table,
                                     NetRows* net) {
  Row rows[8];
  for (int i = 0; i < N; ++i) rows[i] = Row::load(from + 8 * i);
  to_bernstein<N>(table, rows);
  for (int i = N; i < 8; ++i) rows[i] = rows[N - 1];
  transpose(rows);
  to_bernstein<N>(table, rows);
  RowExtent extent(rows[0]);
  for (int j = 0; j < N; ++j) {
    rows[j].store((*net)[j].data());
    extent.add(rows[j]);
  }
  return extent.extremes();
}

/// The partial derivatives at the corners of the box, without the factor degree / 2: across rows
/// and across lanes. They are coefficients of the derivatives' nets in any degree.
struct CornerSlopes {
  std::array<double, 4> rows, lanes;
};
template <int N>
HWY_INLINE CornerSlopes corner_slopes(const NetRows& net) {
  constexpr int n = N - 1;
  const auto &first = net[0], &second = net[1], &last_but_one = net[n - 1], &last = net[n];
  return {{second[0] - first[0], second[n] - first[n], last[0] - last_but_one[0],
           last[n] - last_but_one[n]},
          {first[1] - first[0], first[n] - first[n - 1], last[1] - last[0], last[n] - last[n - 1]}};
}

HWY_INLINE double size(double a) { return a < 0 ? -a : a; }

HWY_INLINE double largest(const std::array<double, 4>& x) {
  return std::max(std::max(size(x[0]), size(x[1])), std::max(size(x[2]), size(x[3])));
}

/// A direction along which f ascends at all four corners, as much as possible where it does least:
/// the point that is closest to zero between the outermost of the gradients. False if there is
/// none.
HWY_INLINE bool common_ascent(const CornerSlopes& slopes, double* direction) {
  const auto &r = slopes.rows, &l = slopes.lanes;
  double ar = r[0], al = l[0], br = ar, bl = al;  // no gradient lies to the right of a, left of b
  for (int c = 1; c < 4; ++c) {
    const bool right_of_a = ar * l[c]<al * r[c], left_of_b = br * l[c]> bl * r[c];
    ar = right_of_a ? r[c] : ar;
    al = right_of_a ? l[c] : al;
    br = left_of_b ? r[c] : br;
    bl = left_of_b ? l[c] : bl;
  }
  const double dr = br - ar, dl = bl - al;
  const bool a_is_closest = ar * dr + al * dl >= 0, b_is_closest = br * dr + bl * dl <= 0;
  direction[0] = a_is_closest ? ar : b_is_closest ? br : dl;
  direction[1] = a_is_closest ? al : b_is_closest ? bl : -dr;
  double least_rise = HUGE_VAL;
  for (int c = 0; c < 4; ++c)
    least_rise = std::min(least_rise, direction[0] * r[c] + direction[1] * l[c]);
  return least_rise > 0;
}

/// The weights k/n and 1 - k/n with which differences of the neighbours of coefficient k make that
/// of a derivative, raised to the degree of the net.
template <int N>
struct RaisingWeights {
  alignas(64) double before[8], after[8];
  constexpr RaisingWeights() : before{}, after{} {
    for (int k = 0; k < 8; ++k) {
      before[k] = k < N ? static_cast<double>(k) / (N - 1) : 1;
      after[k] = 1 - before[k];
    }
  }
};

/// The least coefficient of alpha times the derivative across rows and beta times that across
/// lanes, without the factor degree / 2, both raised to the degree of the net.
template <int N>
HWY_INLINE double least_combined_slope(const NetRows& net, double alpha, double beta) {
  static constexpr RaisingWeights<N> weights;
  const double* const memory = net[0].data();
  HWY_ALIGN double first[16], last[16];  // the rows that have no neighbour in memory on one side
  Row::all(0).store(first);
  Row::load(memory).store(first + 8);
  Row::load(memory + 8 * (N - 1)).store(last);
  Row::all(0).store(last + 8);
  const Row of_lanes = Row::all(beta);
  const Row before = of_lanes * Row::load(weights.before),
            after = of_lanes * Row::load(weights.after);
  Row least_yet = Row::all(HUGE_VAL), rise = Row::all(0);
  for (int i = 0; i < N; ++i) {
    const Row here = Row::load(memory + 8 * i);
    const Row previous = Row::load_unaligned((i == 0 ? first + 8 : memory + 8 * i) - 1);
    const Row next = Row::load_unaligned((i == N - 1 ? last : memory + 8 * i) + 1);
    const Row lanes = multiply_add(here - previous, before, (next - here) * after);
    Row rows = rise * Row::all(alpha * weights.before[i]);
    if (i < N - 1) {
      rise = Row::load(memory + 8 * (i + 1)) - here;
      rows = multiply_add(rise, Row::all(alpha * weights.after[i]), rows);
    }
    least_yet = least(least_yet, rows + lanes);
  }
  return least_lane(first_lanes(least_yet, Row::all(HUGE_VAL), N));
}

/// Whether f ascends everywhere along some direction: first across rows, which takes less, then as
/// its gradients at the corners suggest. `radius`: of the differences, across rows and lanes,
/// rounding included. `variation`: how much they change, if not.
template <int N>
HWY_INLINE bool excludes(const NetRows& net, double magnitude, const double* radius,
                         double* variation) {
  const CornerSlopes slopes = corner_slopes<N>(net);
  const double* const memory = net[0].data();
  if (agree(slopes.rows)) {
    RowExtent extent(Row::load(memory + 8) - Row::load(memory));
    for (int i = 1; i + 1 < N; ++i)
      extent.add(Row::load(memory + 8 * (i + 1)) - Row::load(memory + 8 * i));
    if (beyond(extent.extremes(), radius[0])) return true;
  }
  double y[2];
  if (common_ascent(slopes, y)) {
    const double alpha = size(y[0]), beta = size(y[1]);
    // Weights, differences, products and sums round; differences are at most 2 M. (Infinite where
    // one of the coefficients overflows.)
    const double rounding = (4 * magnitude * (alpha + beta)) * (8 * 0x1p-53);
    const double least_slope = least_combined_slope<N>(net, y[0], y[1]);
    if (least_slope > (alpha * radius[0] + beta * radius[1] + rounding) * (1 + 0x1p-40) + 0x1p-1000)
      return true;
  }
  variation[0] = largest(slopes.rows);
  variation[1] = largest(slopes.lanes);
  return false;
}

/// The extremes of second differences: twice across rows, twice across lanes, mixed.
template <int N>
HWY_INLINE void second_differences(const NetRows& net, NetExtremes* result) {
  HWY_ALIGN double memory[8 * N + 16];
  Row rows[N];
  for (int i = 0; i < N; ++i) {
    rows[i] = Row::load(net[i].data());
    rows[i].store(memory + 8 * i);
  }
  Row::all(0).store(memory + 8 * N);
  RowExtent twice_rows((rows[2] - rows[1]) - (rows[1] - rows[0]));
  for (int i = 1; i + 2 < N; ++i)
    twice_rows.add((rows[i + 2] - rows[i + 1]) - (rows[i + 1] - rows[i]));
  result[0] = twice_rows.extremes();
  Row slope[N];
  RowExtent twice_lanes;
  for (int i = 0; i < N; ++i) {
    const Row next = Row::load_unaligned(memory + 8 * i + 1);
    slope[i] = next - rows[i];
    twice_lanes.add((Row::load_unaligned(memory + 8 * i + 2) - next) - slope[i]);
  }
  twice_lanes.keep_lanes(N - 2);
  result[1] = twice_lanes.extremes();
  RowExtent mixed(slope[1] - slope[0]);
  for (int i = 1; i + 1 < N; ++i) mixed.add(slope[i + 1] - slope[i]);
  mixed.keep_lanes(N - 1);
  result[2] = mixed.extremes();
}

NetExtremes bernstein_patch(const double* from, const ChebyshevTable& table, NetRows* net) {
  NetExtremes result{};
  with_count(table.count, [&]<int N>() HWY_ATTR { result = bernstein_net<N>(from, table, net); });
  return result;
}

void halve_patch(const NetRows& net, int count, bool along_lanes, double radius, NetRows* lower,
                 NetRows* upper, NetExtremes* extremes) {
  with_count(count, [&]<int N>() HWY_ATTR {
    halve_net<N>(net, along_lanes, radius, lower, upper, extremes);
  });
}

bool test_gradient(const NetRows& net, int count, double magnitude, const double* radius,
                   double* variation) {
  bool result = false;
  with_count(count,
             [&]<int N>() HWY_ATTR { result = excludes<N>(net, magnitude, radius, variation); });
  return result;
}

void second_derivatives(const NetRows& net, int count, NetExtremes* result) {
  with_count(count, [&]<int N>() HWY_ATTR { second_differences<N>(net, result); });
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(bernstein_patch);
HWY_EXPORT(halve_patch);
HWY_EXPORT(test_gradient);
HWY_EXPORT(second_derivatives);

constexpr double kUnit = 0x1p-53;
constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

/// The product of a polynomial in Bernstein form, its coefficients scaled by binomials, and the
/// linear function with the values `minus` and `plus` at the ends of [-1,1].
std::vector<Rational> product(const std::vector<Rational>& p, const Rational& minus,
                              const Rational& plus) {
  std::vector<Rational> result(p.size() + 1, Rational(0));
  for (std::size_t j = 0; j < p.size(); ++j) {
    result[j] += p[j] * minus;
    result[j + 1] += p[j] * plus;
  }
  return result;
}

/// By T_(k+1) = 2 s T_k - T_(k-1), in rational arithmetic.
ChebyshevTable make_chebyshev_table(int count) {
  ChebyshevTable table;
  table.count = count;
  std::vector<std::vector<Rational>> t{{1}, {-1, 1}};
  const auto raised = [](const std::vector<Rational>& p) { return product(p, 1, 1); };
  while (static_cast<int>(t.size()) < count) {
    const std::vector<Rational> before = raised(raised(t[t.size() - 2]));
    std::vector<Rational> next = product(t.back(), -2, 2);
    for (std::size_t j = 0; j < next.size(); ++j) next[j] -= before[j];
    t.push_back(std::move(next));
  }
  for (int k = 0; k < count; ++k) {
    std::vector<Rational> column = t[k];
    while (static_cast<int>(column.size()) < count) column = raised(column);
    Integer choose = 1;
    for (int j = 0; j < count; ++j) {
      table.matrix[j][k] = nearest_double(column[j] / Rational(choose));
      table.largest = std::max(table.largest, std::fabs(table.matrix[j][k]) * kUp);
      choose = choose * (count - 1 - j) / (j + 1);
    }
  }
  return table;
}

/// Every coefficient of a net may be off by `change`.
void add_rounding(Patch* patch, double change) {
  const double n = patch->count - 1;
  patch->radius = (patch->radius + change) * kUp;
  for (double& r : patch->slope_radius) r = (r + n * change) * kUp;
  for (double& r : patch->bend_radius) r = (r + n * n * change) * kUp;
}

std::optional<Sign> sign_of_extremes(const NetExtremes& e, double radius) {
  if (e.lo > radius) return Sign::Positive;
  if (e.hi < -radius) return Sign::Negative;
  return std::nullopt;
}

/// factor * extremes, widened by `radius` and the roundings.
NetExtremes widened(const NetExtremes& e, double factor, double radius) {
  const double lo = e.lo * factor, hi = e.hi * factor;
  const double slack = radius * kUp + 0x1p-50 * std::max(std::fabs(lo), std::fabs(hi)) + kTiny;
  return {lo - slack, hi + slack};
}

}  // namespace

namespace {

/// Tables are made when they are first asked for: rational arithmetic takes its time.
const ChebyshevTable& chebyshev_table(int count) {
  static const std::vector<ChebyshevTable> tables = [] {
    std::vector<ChebyshevTable> all(Patch::kMaxCount + 1);
    for (int n = 2; n <= Patch::kMaxCount; ++n) all[n] = make_chebyshev_table(n);
    return all;
  }();
  return tables[count];
}

}  // namespace

int patch_count(int degree) { return std::clamp(degree + 1, 3, Patch::kMaxCount); }

void expand(const Tile& tile, const Box<2>& box, int count, Patch* patch) {
  ChebyshevNet chebyshev;
  expand(tile, box, &chebyshev);
  const ChebyshevTable& table = chebyshev_table(count);
  const NetExtremes extremes =
      HWY_DYNAMIC_DISPATCH(bernstein_patch)(chebyshev.c[0].data(), table, &patch->b);
  patch->count = count;
  patch->rows_axis = 1 - chebyshev.rows_axis;
  patch->lo = extremes.lo;
  patch->hi = extremes.hi;
  patch->radius = chebyshev.radius;
  patch->left_out = chebyshev.left_out;
  // T_k'' is at most (k^2 - 1)/3 times as large as T_k' may be, k <= 15; and of two variables one
  // has a degree of at most 7.
  constexpr double kBend = (15 * 15 - 1) / 3.0, kMixed = 7 * 7;
  const Point<2>& slope = chebyshev.slope_radius;
  const double rounding = 15 * 15 * kBend * (tile.sum * 0x1p-45 + kTiny);
  Point<2> part;
  for (int i = 0; i < 2; ++i) part[i] = centered(box.lo[i], box.hi[i]).half / tile.half[i] * kUp;
  for (int i = 0; i < 2; ++i) {
    const int axis = i == 0 ? patch->rows_axis : 1 - patch->rows_axis;
    patch->slope_radius[i] = slope[axis];
    patch->bend_radius[i] =
        (kBend * slope[axis] + tile.bend_error * part[axis] * part[axis] + rounding) * kUp;
  }
  patch->bend_radius[2] =
      (kMixed * (slope[0] + slope[1]) + tile.bend_error * part[0] * part[1] + rounding) * kUp;
  // An entry, a product and at most four sums round, in either variable.
  add_rounding(patch,
               1.01 * kUnit * 12 * table.largest * table.largest * chebyshev.size * kUp + kTiny);
}

void halve(const Patch& patch, int axis, bool whole, Patch* lower, Patch* upper) {
  NetExtremes extremes[2];
  // Each of count - 1 averages rounds once, relative to the largest coefficient.
  const double change = 1.01 * patch.count * kUnit * patch.magnitude() + kTiny;
  const double n = patch.count - 1, radius = (patch.radius + change) * kUp;
  const bool along_lanes = patch.rows_axis != axis;
  // Across the halves' rows and lanes: those of the axis that stays, then the halved one.
  const int stays = along_lanes ? 0 : 1;
  const std::array<double, 2> slope{(patch.slope_radius[stays] + n * change) * kUp,
                                    (0.5 * patch.slope_radius[1 - stays] + n * change) * kUp};
  const std::array<double, 3> bend{(patch.bend_radius[stays] + n * n * change) * kUp,
                                   (0.25 * patch.bend_radius[1 - stays] + n * n * change) * kUp,
                                   (0.5 * patch.bend_radius[2] + n * n * change) * kUp};
  const int count = patch.count;
  HWY_DYNAMIC_DISPATCH(halve_patch)
  (patch.b, count, along_lanes, whole ? HUGE_VAL : radius, &lower->b, &upper->b, extremes);
  int k = 0;
  for (Patch* child : {lower, upper}) {
    child->count = count;
    child->rows_axis = 1 - axis;
    child->lo = extremes[k].lo;
    child->hi = extremes[k].hi;
    child->radius = radius;
    child->slope_radius = slope;
    child->bend_radius = bend;
    ++k;
  }
}

namespace {

/// f keeps a sign and no point is a local maximum of |f|.
bool no_extremum(const Patch& patch, Sign sign) {
  NetExtremes second[3];
  HWY_DYNAMIC_DISPATCH(second_derivatives)(patch.b, patch.count, second);
  const double n = patch.count - 1, twice = 0.25 * n * (n - 1), mixed = 0.25 * n * n;
  const double rounding = 3 * kUnit * 4 * patch.magnitude();
  const NetExtremes rr = widened(second[0], twice, patch.bend_radius[0] + twice * rounding);
  const NetExtremes ll = widened(second[1], twice, patch.bend_radius[1] + twice * rounding);
  const NetExtremes rl = widened(second[2], mixed, patch.bend_radius[2] + mixed * rounding);
  if (sign_of_extremes(rr, 0) == sign || sign_of_extremes(ll, 0) == sign) return true;
  const double product =
      std::max(std::max(rr.lo * ll.lo, rr.lo * ll.hi), std::max(rr.hi * ll.lo, rr.hi * ll.hi));
  const double least_mixed = rl.lo > 0 ? rl.lo : rl.hi < 0 ? -rl.hi : 0.0;
  const double square = least_mixed * least_mixed * (1 - 0x1p-40);
  return product <= 0 ? square > 0x1p-900 || product * (1 - 0x1p-40) < -0x1p-900
                      : product * kUp + 0x1p-900 < square;
}

}  // namespace

CriticalVerdict test_critical(const Patch& patch) {
  CriticalVerdict verdict;
  // Differences, without the factor degree / 2; they round.
  const double factor = 0.5 * (patch.count - 1);
  std::array<double, 2> radius;
  for (int i = 0; i < 2; ++i)
    radius[i] = (patch.slope_radius[i] / factor + 4 * kUnit * patch.magnitude()) * kUp + kTiny;
  double variation[2];
  verdict.excluded = HWY_DYNAMIC_DISPATCH(test_gradient)(patch.b, patch.count, patch.magnitude(),
                                                         radius.data(), variation);
  if (verdict.excluded) return verdict;
  for (int i = 0; i < 2; ++i)
    verdict.variation[i == 0 ? patch.rows_axis : 1 - patch.rows_axis] = variation[i];
  const auto sign = patch.sign();
  verdict.excluded = sign && no_extremum(patch, *sign);
  return verdict;
}

}  // namespace encase
#endif
