// SPDX-License-Identifier: MIT
#include "common/patch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/cubic_source.hpp"
#include "common/interval.hpp"
#include "encase/number.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/patch.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_PATCH_SHARED
#define ENCASE_PATCH_SHARED
namespace encase {

/// The least and greatest numbers among the coefficients of a net.
struct Extremes {
  double lo, hi;
};

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

/// The least and greatest of several rows.
struct Extent {
  Row lo, hi;
  HWY_INLINE explicit Extent(const Row& first) : lo(first), hi(first) {}
  HWY_INLINE Extent(const Row& low, const Row& high) : lo(low), hi(high) {}
  HWY_INLINE void add(const Row& row) {
    lo = least(lo, row);
    hi = greatest(hi, row);
  }
  /// Forgets all but the first lanes.
  HWY_INLINE void keep_lanes(int count) {
    lo = first_lanes(lo, Row::all(HUGE_VAL), count);
    hi = first_lanes(hi, Row::all(-HUGE_VAL), count);
  }
  HWY_INLINE Extremes extremes() const { return {least_lane(lo), greatest_lane(hi)}; }
};

using Net = std::array<std::array<double, 8>, 8>;

/// Stores the transpose of an N x N net; lanes from N on repeat the last one.
template <int N>
HWY_INLINE void store_transposed(Row* rows, Net* to) {
  for (int i = N; i < 8; ++i) rows[i] = rows[N - 1];
  transpose(rows);
  for (int j = 0; j < N; ++j) rows[j].store((*to)[j].data());
}

/// Chebyshev coefficients across rows, turned into Bernstein ones: even polynomials have symmetric
/// ones.
template <int N>
HWY_INLINE void to_bernstein(const ChebyshevTable& table, Row* c) {
  Row result[N];
  for (int j = 0; 2 * j < N; ++j) {
    Row even = c[0], odd = c[1] * Row::all(table.matrix[j][1]);
    for (int k = 2; k < N; k += 2) even = even + c[k] * Row::all(table.matrix[j][k]);
    for (int k = 3; k < N; k += 2) odd = odd + c[k] * Row::all(table.matrix[j][k]);
    result[j] = even + odd;
    result[N - 1 - j] = even - odd;
  }
  for (int j = 0; j < N; ++j) c[j] = result[j];
}

/// The Bernstein net of a Chebyshev net, transposed. Returns its extremes.
template <int N>
HWY_INLINE Extremes bernstein_net(const double* from, const ChebyshevTable& table, Net* net) {
  Row rows[8];
  for (int i = 0; i < N; ++i) rows[i] = Row::load(from + 8 * i);
  to_bernstein<N>(table, rows);
  for (int i = N; i < 8; ++i) rows[i] = rows[N - 1];
  transpose(rows);
  to_bernstein<N>(table, rows);
  Extent extent(rows[0]);
  for (int j = 0; j < N; ++j) {
    rows[j].store((*net)[j].data());
    extent.add(rows[j]);
  }
  return extent.extremes();
}

/// De Casteljau's algorithm at 1/2 across the rows: sums of two, scaled at the end (powers of two
/// change no rounding).
template <int N>
HWY_INLINE void halve_rows(Row* t, Row* lower, Row* upper, Extremes* extremes) {
  Extent low(t[0]), high(t[N - 1]);
  lower[0] = t[0];
  upper[N - 1] = t[N - 1];
  double scale = 1;
  for (int r = 1; r < N; ++r) {
    for (int j = 0; j < N - r; ++j) t[j] = t[j] + t[j + 1];
    scale *= 0.5;
    const Row s = Row::all(scale);
    lower[r] = t[0] * s;
    upper[N - 1 - r] = t[N - 1 - r] * s;
    low.add(lower[r]);
    high.add(upper[N - 1 - r]);
  }
  extremes[0] = low.extremes();
  extremes[1] = high.extremes();
}

/// The partial derivatives at the corners of the box, without the factor degree / 2: across rows
/// and across lanes. They are coefficients of the derivatives' nets in any degree.
struct CornerSlopes {
  std::array<double, 4> rows, lanes;
};
template <int N>
HWY_INLINE CornerSlopes corner_slopes(const Net& net) {
  constexpr int n = N - 1;
  const auto &first = net[0], &second = net[1], &last_but_one = net[n - 1], &last = net[n];
  return {{second[0] - first[0], second[n] - first[n], last[0] - last_but_one[0],
           last[n] - last_but_one[n]},
          {first[1] - first[0], first[n] - first[n - 1], last[1] - last[0], last[n] - last[n - 1]}};
}

/// Whether no two have different signs.
HWY_INLINE bool agree(const std::array<double, 4>& x) {
  const double lo = std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
  const double hi = std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
  return lo > 0 || hi < 0;
}

HWY_INLINE double largest(const std::array<double, 4>& x) {
  const auto size = [](double a) { return a < 0 ? -a : a; };
  return std::max(std::max(size(x[0]), size(x[1])), std::max(size(x[2]), size(x[3])));
}

HWY_INLINE bool beyond(const Extremes& e, double radius) { return e.lo > radius || e.hi < -radius; }

/// A net between zeros: the rows, and for every row the neighbours of its lanes.
template <int N>
class Neighbours {
 public:
  HWY_INLINE explicit Neighbours(const Net& net) {
    Row::all(0).store(memory_);
    for (int i = 0; i < N; ++i) Row::load(net[i].data()).store(memory_ + 8 * (i + 1));
    Row::all(0).store(memory_ + 8 * (N + 1));
  }
  HWY_INLINE Row here(int i) const { return Row::load(memory_ + 8 * (i + 1)); }
  HWY_INLINE Row next(int i) const { return Row::load_unaligned(memory_ + 8 * (i + 1) + 1); }
  HWY_INLINE Row previous(int i) const { return Row::load_unaligned(memory_ + 8 * (i + 1) - 1); }

 private:
  HWY_ALIGN double memory_[8 * (N + 2)];
};

/// The extremes of alpha times the derivative across rows and beta times that across lanes, both
/// raised to the degree of the net: a coefficient k is made of the net's k - 1, k and k + 1 with
/// the weights -k/n, 2k/n - 1 and 1 - k/n.
template <int N>
HWY_INLINE Extremes combine_slopes(const Neighbours<N>& net, double alpha, double beta) {
  constexpr double n = N - 1;
  HWY_ALIGN double weight[2][8];
  for (int j = 0; j < 8; ++j) {
    weight[0][j] = j < N ? -j / n : -1;
    weight[1][j] = j < N ? 1 - j / n : 0;
  }
  const Row before = Row::load(weight[0]), after = Row::load(weight[1]);
  const Row here = Row::all(0) - (before + after);
  const Row of_rows = Row::all(alpha), of_lanes = Row::all(beta);
  Extent extent(Row::all(HUGE_VAL), Row::all(-HUGE_VAL));
  for (int i = 0; i < N; ++i) {
    const Row lanes = net.previous(i) * before + net.here(i) * here + net.next(i) * after;
    Row rows = net.here(i) * Row::all(2 * i / n - 1);
    if (i > 0) rows = rows + net.here(i - 1) * Row::all(-i / n);
    if (i < N - 1) rows = rows + net.here(i + 1) * Row::all(1 - i / n);
    extent.add(rows * of_rows + lanes * of_lanes);
  }
  extent.keep_lanes(N);
  return extent.extremes();
}

/// Whether one of the derivatives keeps a sign, or one of the two combinations of them that the
/// mean Hessian's adjugate suggests, as far as its signs at the corners leave it possible.
/// `radius`: of the differences, across rows and lanes, rounding included. `variation`: how much
/// they change.
template <int N>
HWY_INLINE bool excludes(const Net& net, double magnitude, const double* radius,
                         double* variation) {
  const CornerSlopes slopes = corner_slopes<N>(net);
  const auto &r = slopes.rows, &l = slopes.lanes;
  if (agree(r)) {
    Extent extent(Row::load(net[1].data()) - Row::load(net[0].data()));
    for (int i = 1; i + 1 < N; ++i)
      extent.add(Row::load(net[i + 1].data()) - Row::load(net[i].data()));
    if (beyond(extent.extremes(), radius[0])) return true;
  }
  // Means of second derivatives, about.
  const double rows_twice = (r[2] - r[0]) + (r[3] - r[1]),
               lanes_twice = (l[1] - l[0]) + (l[3] - l[2]);
  const double mixed =
      (2.0 / (N - 1)) * ((net[N - 1][N - 1] - net[N - 1][0]) - (net[0][N - 1] - net[0][0]));
  const double y[2][2] = {{lanes_twice, -mixed}, {-mixed, rows_twice}};
  std::array<double, 4> corners[2];
  for (int k = 0; k < 2; ++k)
    for (int c = 0; c < 4; ++c) corners[k][c] = y[k][0] * r[c] + y[k][1] * l[c];
  const bool some[3] = {agree(l), agree(corners[0]), agree(corners[1])};
  if (some[0] || some[1] || some[2]) {
    const Neighbours<N> neighbours(net);
    if (some[0]) {
      Extent extent(neighbours.next(0) - neighbours.here(0));
      for (int i = 1; i < N; ++i) extent.add(neighbours.next(i) - neighbours.here(i));
      extent.keep_lanes(N - 1);
      if (beyond(extent.extremes(), radius[1])) return true;
    }
    for (int k = 0; k < 2; ++k) {
      if (!some[1 + k]) continue;
      const Extremes e = combine_slopes(neighbours, y[k][0], y[k][1]);
      const double alpha = y[k][0] < 0 ? -y[k][0] : y[k][0],
                   beta = y[k][1] < 0 ? -y[k][1] : y[k][1];
      // Weights, products and sums round; derivatives are at most 2 M. (Infinite where one of the
      // coefficients overflows.)
      const double rounding = (4 * magnitude * (alpha + beta)) * (8 * 0x1p-53);
      if (beyond(e, (alpha * radius[0] + beta * radius[1] + rounding) * (1 + 0x1p-40) + 0x1p-1000))
        return true;
    }
  }
  variation[0] = largest(r);
  variation[1] = largest(l);
  return false;
}

/// The extremes of second differences: twice across rows, twice across lanes, mixed.
template <int N>
HWY_INLINE void second_differences(const Net& net, Extremes* result) {
  HWY_ALIGN double memory[8 * N + 16];
  Row rows[N];
  for (int i = 0; i < N; ++i) {
    rows[i] = Row::load(net[i].data());
    rows[i].store(memory + 8 * i);
  }
  Row::all(0).store(memory + 8 * N);
  Extent twice_rows((rows[2] - rows[1]) - (rows[1] - rows[0]));
  for (int i = 1; i + 2 < N; ++i)
    twice_rows.add((rows[i + 2] - rows[i + 1]) - (rows[i + 1] - rows[i]));
  result[0] = twice_rows.extremes();
  Row slope[N];
  Extent twice_lanes(Row::all(HUGE_VAL), Row::all(-HUGE_VAL));
  for (int i = 0; i < N; ++i) {
    const Row next = Row::load_unaligned(memory + 8 * i + 1);
    slope[i] = next - rows[i];
    twice_lanes.add((Row::load_unaligned(memory + 8 * i + 2) - next) - slope[i]);
  }
  twice_lanes.keep_lanes(N - 2);
  result[1] = twice_lanes.extremes();
  Extent mixed(slope[1] - slope[0]);
  for (int i = 1; i + 1 < N; ++i) mixed.add(slope[i + 1] - slope[i]);
  mixed.keep_lanes(N - 1);
  result[2] = mixed.extremes();
}

// One function for every size of net.

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

Extremes bernstein_patch(const double* from, const ChebyshevTable& table, Net* net) {
  Extremes result{};
  with_count(table.count, [&]<int N>() HWY_ATTR { result = bernstein_net<N>(from, table, net); });
  return result;
}

void halve_patch(const Net& net, int count, bool along_lanes, double radius, Net* lower, Net* upper,
                 Extremes* extremes) {
  with_count(count, [&]<int N>() HWY_ATTR {
    Row rows[8], low[8], high[8];
    for (int i = 0; i < N; ++i) rows[i] = Row::load(net[i].data());
    if (along_lanes) {
      for (int i = N; i < 8; ++i) rows[i] = rows[N - 1];
      transpose(rows);
    }
    halve_rows<N>(rows, low, high, extremes);
    if (!(extremes[0].lo > radius || extremes[0].hi < -radius)) store_transposed<N>(low, lower);
    if (!(extremes[1].lo > radius || extremes[1].hi < -radius)) store_transposed<N>(high, upper);
  });
}

bool test_gradient(const Net& net, int count, double magnitude, const double* radius,
                   double* variation) {
  bool result = false;
  with_count(count,
             [&]<int N>() HWY_ATTR { result = excludes<N>(net, magnitude, radius, variation); });
  return result;
}

void second_derivatives(const Net& net, int count, Extremes* result) {
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

std::optional<Sign> sign_of_extremes(const Extremes& e, double radius) {
  if (e.lo > radius) return Sign::Positive;
  if (e.hi < -radius) return Sign::Negative;
  return std::nullopt;
}

/// factor * extremes, widened by `radius` and the roundings.
Extremes widened(const Extremes& e, double factor, double radius) {
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
  CubicSource source;
  expand(tile, box, &source);
  const ChebyshevTable& table = chebyshev_table(count);
  const Extremes extremes =
      HWY_DYNAMIC_DISPATCH(bernstein_patch)(source.c[0].data(), table, &patch->b);
  patch->count = count;
  patch->rows_axis = 1 - source.rows_axis;
  patch->lo = extremes.lo;
  patch->hi = extremes.hi;
  patch->radius = source.radius;
  patch->left_out = source.left_out;
  // T_k'' is at most (k^2 - 1)/3 times as large as T_k' may be, k <= 15; and of two variables one
  // has a degree of at most 7.
  constexpr double kBend = (15 * 15 - 1) / 3.0, kMixed = 7 * 7;
  const Point<2>& slope = source.slope_radius;
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
               1.01 * kUnit * 12 * table.largest * table.largest * source.size * kUp + kTiny);
}

void halve(const Patch& patch, int axis, bool whole, Patch* lower, Patch* upper) {
  Extremes extremes[2];
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
  Extremes second[3];
  HWY_DYNAMIC_DISPATCH(second_derivatives)(patch.b, patch.count, second);
  const double n = patch.count - 1, twice = 0.25 * n * (n - 1), mixed = 0.25 * n * n;
  const double rounding = 3 * kUnit * 4 * patch.magnitude();
  const Extremes rr = widened(second[0], twice, patch.bend_radius[0] + twice * rounding);
  const Extremes ll = widened(second[1], twice, patch.bend_radius[1] + twice * rounding);
  const Extremes rl = widened(second[2], mixed, patch.bend_radius[2] + mixed * rounding);
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
