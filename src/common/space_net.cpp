// SPDX-License-Identifier: MIT
#include "common/space_net.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/space_net.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef ENCASE_SPACE_NET_SHARED
#define ENCASE_SPACE_NET_SHARED
namespace encase {

/// The least and greatest numbers of several.
struct Bounds {
  double lo, hi;
};

/// Three combinations of up to three nets of one count.
struct Combinations {
  int count = 0;
  int nets = 0;
  std::array<const double*, 3> rows;
  Matrix<3> weight;             ///< [combination][net]
  Matrix<3> slope;              ///< [combination][planes, lines, lanes]: of a linear function
  double* result = nullptr;     ///< the combinations' rows, one after the other
  std::array<Bounds, 3> value;  ///< of their coefficients
  std::array<Bounds, 3> rest;   ///< of these less those of the linear function
  /// Of differences of neighbouring coefficients: [combination][planes, lines, lanes].
  std::array<std::array<Bounds, 3>, 3> difference;
};

}  // namespace encase
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

/// The least and greatest of several rows.
struct Extent {
  Row lo, hi;
  HWY_INLINE Extent() : lo(Row::all(HUGE_VAL)), hi(Row::all(-HUGE_VAL)) {}
  HWY_INLINE void add(const Row& row) {
    lo = least(lo, row);
    hi = greatest(hi, row);
  }
  /// Of the first lanes.
  HWY_INLINE Bounds bounds(int lanes) const {
    return {least_lane(first_lanes(lo, Row::all(HUGE_VAL), lanes)),
            greatest_lane(first_lanes(hi, Row::all(-HUGE_VAL), lanes))};
  }
};

/// A count that is known when this is compiled.
template <int N>
struct Fixed {
  static constexpr int kMost = N;    ///< room for
  static constexpr int kBlocks = 1;  ///< of eight lanes
  HWY_INLINE constexpr operator int() const { return N; }
};
/// One from 9 to 16.
struct Varying {
  static constexpr int kMost = SpaceNet::kMaxCount;
  static constexpr int kBlocks = 2;
  int value;
  HWY_INLINE operator int() const { return value; }
};

/// De Casteljau's algorithm at 1/2 across n rows: sums of two, scaled at the end (powers of two
/// change no rounding).
template <class Count>
HWY_INLINE void halve_rows(Count n, Row* t, Row* lower, Row* upper, Extent* extents) {
  lower[0] = t[0];
  upper[n - 1] = t[n - 1];
  extents[0].add(lower[0]);
  extents[1].add(upper[n - 1]);
  double scale = 1;
  for (int r = 1; r < n; ++r) {
    for (int j = 0; j < n - r; ++j) t[j] = t[j] + t[j + 1];
    scale *= 0.5;
    const Row s = Row::all(scale);
    lower[r] = t[0] * s;
    upper[n - 1 - r] = t[n - 1 - r] * s;
    extents[0].add(lower[r]);
    extents[1].add(upper[n - 1 - r]);
  }
}

/// Across n rows that are `step` doubles apart.
template <class Count>
HWY_INLINE void halve_across(Count n, const double* from, int step, double* lower, double* upper,
                             Extent* extents) {
  Row t[Count::kMost], low[Count::kMost], high[Count::kMost];
  t[0] = Row::load(from);
  for (int j = 1; j < n; ++j) t[j] = Row::load(from + j * step);
  halve_rows(n, t, low, high, extents);
  for (int j = 0; j < n; ++j) {
    low[j].store(lower + j * step);
    high[j].store(upper + j * step);
  }
}

/// Across the lanes of a plane; lines and lanes of the halves are exchanged.
template <class Count>
HWY_INLINE void halve_lanes(Count n, const double* from, double* lower, double* upper,
                            Extent* extents) {
  constexpr int B = Count::kBlocks, line = 8 * B;
  for (int of_lines = 0; of_lines < B; ++of_lines) {
    Row t[8 * B], low[8 * B], high[8 * B];
    for (int of_lanes = 0; of_lanes < B; ++of_lanes) {
      Row* block = t + 8 * of_lanes;
      for (int j = 0; j < 8; ++j) {
        const int q = 8 * of_lines + j;
        block[j] = Row::load(from + (q < n ? q : n - 1) * line + 8 * of_lanes);
      }
      transpose(block);
    }
    halve_rows(n, t, low, high, extents);
    for (int j = 0; j < n; ++j) {
      low[j].store(lower + j * line + 8 * of_lines);
      high[j].store(upper + j * line + 8 * of_lines);
    }
  }
}

template <class Count>
HWY_INLINE void halve_net(Count n, const double* from, int position, double* lower, double* upper,
                          Bounds* bounds) {
  constexpr int line = 8 * Count::kBlocks;
  const int plane = line * n;
  Extent extents[2];
  if (position == 0) {
    for (int at = 0; at < plane; at += 8)
      halve_across(n, from + at, plane, lower + at, upper + at, extents);
  } else {
    for (int p = 0; p < n; ++p, from += plane, lower += plane, upper += plane) {
      if (position == 2) {
        halve_lanes(n, from, lower, upper, extents);
        continue;
      }
      for (int at = 0; at < line; at += 8)
        halve_across(n, from + at, line, lower + at, upper + at, extents);
    }
  }
  bounds[0] = extents[0].bounds(8);
  bounds[1] = extents[1].bounds(8);
}

/// How many of the lanes of a block are among the first `count`.
HWY_INLINE int lanes_of_block(int count, int block) {
  const int left = count - 8 * block;
  return left < 0 ? 0 : left < 8 ? left : 8;
}

/// The means of half the differences of the last and the first coefficients, along each axis: mean
/// slopes on [-1,1]^3.
template <class Count>
HWY_INLINE void means_of_slopes(Count n, const double* rows, double* slope) {
  constexpr int B = Count::kBlocks, line = 8 * B;
  const int plane = line * n;
  double of_planes = 0, of_lines = 0;
  HWY_ALIGN double of_lanes[line];
  for (int b = 0; b < B; ++b) {
    const double* block = rows + 8 * b;
    Row planes = Row::all(0), lines = Row::all(0), all = Row::all(0);
    for (int i = 0; i < n; ++i) {
      planes =
          planes + (Row::load(block + (n - 1) * plane + i * line) - Row::load(block + i * line));
      lines =
          lines + (Row::load(block + i * plane + (n - 1) * line) - Row::load(block + i * plane));
      for (int j = 0; j < n; ++j) all = all + Row::load(block + i * plane + j * line);
    }
    all.store(of_lanes + 8 * b);
    const int lanes = lanes_of_block(n, b);
    of_planes += sum_of_lanes(first_lanes(planes, Row::all(0), lanes));
    of_lines += sum_of_lanes(first_lanes(lines, Row::all(0), lanes));
  }
  const double scale = 0.5 / (n * n);
  slope[0] = scale * of_planes;
  slope[1] = scale * of_lines;
  slope[2] = scale * (of_lanes[n - 1] - of_lanes[0]);
}

/// The combinations of K nets, their bounds, and those without their linear functions.
template <int K, class Count>
HWY_INLINE void combine_nets(Count n, Combinations* c) {
  constexpr int B = Count::kBlocks, line = 8 * B;
  HWY_ALIGN double coordinate[line];
  for (int j = 0; j < line; ++j) coordinate[j] = j < n ? 2.0 * j / (n - 1) - 1 : 1.0;
  for (int target = 0; target < 3; ++target) {
    Row weight[K];
    for (int k = 0; k < K; ++k) weight[k] = Row::all(c->weight[target][k]);
    const std::array<double, 3>& slope = c->slope[target];
    Row along[B];
    for (int b = 0; b < B; ++b) along[b] = Row::load(coordinate + 8 * b) * Row::all(slope[2]);
    double* to = c->result + target * line * n * n;
    Extent value, rest;
    int at = 0;
    for (int p = 0; p < n; ++p)
      for (int q = 0; q < n; ++q) {
        const Row across = Row::all(slope[0] * coordinate[p] + slope[1] * coordinate[q]);
        for (int b = 0; b < B; ++b, at += 8) {
          Row sum = weight[0] * Row::load(c->rows[0] + at);
          for (int k = 1; k < K; ++k) sum = sum + weight[k] * Row::load(c->rows[k] + at);
          sum.store(to + at);
          value.add(sum);
          rest.add(sum - (along[b] + across));
        }
      }
    c->value[target] = value.bounds(8);
    c->rest[target] = rest.bounds(8);
  }
}

/// The bounds of the combinations' differences.
template <class Count>
HWY_INLINE void differences(Count n, Combinations* c) {
  constexpr int B = Count::kBlocks, line = 8 * B;
  const int plane = line * n;
  for (int target = 0; target < 3; ++target) {
    const double* first = c->result + target * plane * n;
    Extent planes, lines;
    Bounds lanes{HUGE_VAL, -HUGE_VAL};
    for (int b = 0; b < B; ++b) {
      Extent of_block;
      for (int p = 0; p < n; ++p)
        for (int q = 0; q < n; ++q) {
          const double* at = first + p * plane + q * line + 8 * b;
          const Row row = Row::load(at);
          if (p + 1 < n) planes.add(Row::load(at + plane) - row);
          if (q + 1 < n) lines.add(Row::load(at + line) - row);
          of_block.add(Row::load_unaligned(at + 1) - row);
        }
      const Bounds bounds = of_block.bounds(lanes_of_block(n - 1, b));
      if (bounds.lo < lanes.lo) lanes.lo = bounds.lo;
      if (bounds.hi > lanes.hi) lanes.hi = bounds.hi;
    }
    c->difference[target] = {planes.bounds(8), lines.bounds(8), lanes};
  }
}

// One function for every size of net.

template <class Run>
HWY_INLINE void with_count(int count, Run run) {
  switch (count) {
    case 2:
      return run(Fixed<2>());
    case 3:
      return run(Fixed<3>());
    case 4:
      return run(Fixed<4>());
    case 5:
      return run(Fixed<5>());
    case 6:
      return run(Fixed<6>());
    case 7:
      return run(Fixed<7>());
    case 8:
      return run(Fixed<8>());
    default:
      return run(Varying{count});
  }
}

void halve_space_net(const double* from, int count, int position, double* lower, double* upper,
                     Bounds* bounds) {
  with_count(count, [&](auto n) HWY_ATTR { halve_net(n, from, position, lower, upper, bounds); });
}

void space_slopes(const double* rows, int count, double* slope) {
  with_count(count, [&](auto n) HWY_ATTR { means_of_slopes(n, rows, slope); });
}

void combine_space_nets(Combinations* c) {
  with_count(c->count, [&](auto n) HWY_ATTR {
    if (c->nets == 1)
      combine_nets<1>(n, c);
    else if (c->nets == 2)
      combine_nets<2>(n, c);
    else
      combine_nets<3>(n, c);
  });
}

void space_differences(Combinations* c) {
  with_count(c->count, [&](auto n) HWY_ATTR { differences(n, c); });
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(halve_space_net);
HWY_EXPORT(space_slopes);
HWY_EXPORT(combine_space_nets);
HWY_EXPORT(space_differences);

constexpr double kUnit = 0x1p-53;
constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kTiny = 0x1p-1000;  // more than what gradual underflow can lose

double largest(const Bounds& b) { return std::max(std::fabs(b.lo), std::fabs(b.hi)); }

void add(Bounds* sum, const Bounds& b) {
  sum->lo += b.lo;
  sum->hi += b.hi;
}

}  // namespace

void copy(const Bernstein<3>& from, const std::array<int, 3>& order, SpaceNet* to) {
  const int n = from.degree[0] + 1;
  to->count = n;
  to->radius = from.radius;
  const auto [lo, hi] = std::minmax_element(from.b.begin(), from.b.end());
  to->lo = *lo;
  to->hi = *hi;
  const std::array<int, 3> stride{n * n, n, 1};  // of the variables
  const int lanes = SpaceNet::lanes(n);
  double* row = to->rows;
  for (int p = 0; p < n; ++p)
    for (int q = 0; q < n; ++q, row += lanes)
      for (int l = 0; l < lanes; ++l)
        row[l] = from.b[static_cast<std::size_t>(p * stride[order[0]] + q * stride[order[1]] +
                                                 std::min(l, n - 1) * stride[order[2]])];
}

std::array<int, 3> order_of_halves(const std::array<int, 3>& order, int position) {
  return position < 2 ? order : std::array<int, 3>{order[0], order[2], order[1]};
}

void halve(const SpaceNet& net, int position, SpaceNet* lower, SpaceNet* upper) {
  Bounds bounds[2];
  HWY_DYNAMIC_DISPATCH(halve_space_net)
  (net.rows, net.count, position, lower->rows, upper->rows, bounds);
  // Each of count - 1 averages rounds once, relative to the largest coefficient.
  const double radius = (net.radius + 1.01 * net.count * kUnit * net.magnitude() + kTiny) * kUp;
  int k = 0;
  for (SpaceNet* half : {lower, upper}) {
    half->count = net.count;
    half->lo = bounds[k].lo;
    half->hi = bounds[k].hi;
    half->radius = radius;
    ++k;
  }
}

namespace {

/// Combinations of the nets of a system with the rows of Y as weights.
class Preconditioned {
 public:
  /// `slopes`: the nets' mean slopes in the order of planes, lines and lanes; `identity`: 1 if Y is
  /// about the inverse of theirs, else 0.
  Preconditioned(const SpaceSystem& system, const Matrix<3>& slopes, const Matrix<3>& y,
                 double identity)
      : system_(system), identity_(identity) {
    thread_local Buffer buffer;
    double* rows = buffer.rows.data();
    std::array<bool, 3> taken{};
    for (int k = 0; k < 3; ++k) {
      if (taken[k]) continue;
      Combinations& group = groups_[group_count_++];
      group.count = system.nets[k].count;
      group.result = rows;
      rows += 3 * SpaceNet::size(group.count);
      for (int m = k; m < 3; ++m) {
        if (system.nets[m].count != group.count) continue;
        taken[m] = true;
        group.rows[group.nets] = system.nets[m].rows;
        for (int i = 0; i < 3; ++i) {
          group.weight[i][group.nets] = y[i][m];
          for (int j = 0; j < 3; ++j)
            group.slope[i][j] = (group.nets > 0 ? group.slope[i][j] : 0) + y[i][m] * slopes[m][j];
        }
        ++group.nets;
      }
    }
    for (int i = 0; i < 3; ++i) {
      rounding_[i] = 0;
      for (int k = 0; k < 3; ++k)
        rounding_[i] += std::fabs(y[i][k]) *
                        (system.nets[k].radius + 3.03 * kUnit * system.nets[k].magnitude());
      rounding_[i] = rounding_[i] * kUp + kTiny;
    }
    if (group_count_ == 1)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) groups_[0].slope[i][j] = system.order[j] == i ? identity : 0.0;
  }

  /// Whether there is no common zero; if there may be one, narrows `zeros` to where.
  bool excludes(Box<3>* zeros) {
    std::array<Bounds, 3> rest{};
    std::array<double, 3> slack{};
    for (int g = 0; g < group_count_; ++g) {
      Combinations& group = groups_[g];
      HWY_DYNAMIC_DISPATCH(combine_space_nets)(&group);
      for (int i = 0; i < 3; ++i) {
        add(&rest[i], group.rest[i]);
        slack[i] += largest(group.rest[i]);
        for (double s : group.slope[i]) slack[i] += std::fabs(s);
        if (group_count_ == 1 &&
            (group.value[i].lo > rounding_[i] || group.value[i].hi < -rounding_[i]))
          return true;
      }
    }
    for (const Bounds& b : rest) widest_ = std::max(widest_, b.hi - b.lo);
    // At a zero the linear function, which is `identity` times coordinate i, is what is left with
    // the opposite sign.
    for (int i = 0; i < 3; ++i) {
      const double r = rounding_[i] + 0x1p-48 * slack[i];
      const double lo = -(rest[i].hi + r) - 0x1p-50 * std::fabs(rest[i].hi + r),
                   hi = -(rest[i].lo - r) + 0x1p-50 * std::fabs(rest[i].lo - r);
      if (lo > identity_ || hi < -identity_) return true;
      if (identity_ == 0) continue;
      zeros->lo[i] = std::max(zeros->lo[i], lo);
      zeros->hi[i] = std::min(zeros->hi[i], hi);
      if (zeros->lo[i] > zeros->hi[i]) return true;
    }
    return false;
  }

  /// The widest range of what is left of a combination without its linear function: twice the
  /// greatest sum of a row of `deviations` at most.
  double widest() const { return widest_; }

  /// Bounds on the distances of the Jacobian of the combinations from `identity` times the identity
  /// matrix, after `excludes`.
  Matrix<3> deviations() {
    std::array<std::array<Bounds, 3>, 3> slope{};  // by variables
    Matrix<3> slack{};
    for (int g = 0; g < group_count_; ++g) {
      Combinations& group = groups_[g];
      HWY_DYNAMIC_DISPATCH(space_differences)(&group);
      const double half = 0.5 * (group.count - 1);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const Bounds& d = group.difference[i][j];
          const int variable = system_.order[j];
          add(&slope[i][variable], {half * d.lo, half * d.hi});
          slack[i][variable] += half * largest(d);
        }
    }
    int largest_count = 0;
    for (const SpaceNet& net : system_.nets) largest_count = std::max(largest_count, net.count);
    Matrix<3> result;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const double center = i == j ? identity_ : 0.0;
        // A derivative's coefficient is half the degree times a difference of two.
        result[i][j] = (std::max(slope[i][j].hi - center, center - slope[i][j].lo) +
                        (largest_count - 1) * rounding_[i] + 0x1p-49 * (slack[i][j] + center)) *
                           kUp +
                       kTiny;
      }
    return result;
  }

 private:
  struct alignas(64) Buffer {
    // Three combinations of three groups, and room for a neighbour of the last lane.
    std::array<double, 9 * SpaceNet::kMaxCount * SpaceNet::kMaxCount * SpaceNet::kMaxCount + 8>
        rows{};
  };

  const SpaceSystem& system_;
  double identity_;
  std::array<double, 3> rounding_{};  ///< of the combinations' coefficients, with the nets' radii
  std::array<Combinations, 3> groups_;
  int group_count_ = 0;
  double widest_ = 0;
};

/// Rows that cancel what can be cancelled of a singular matrix, too.
Matrix<3> adjugate(const Matrix<3>& m) {
  Matrix<3> a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      a[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
    }
  return a;
}

}  // namespace

void test_system(const SpaceSystem& system, double quality, SpaceVerdict* verdict) {
  verdict->excluded = verdict->contracts = false;
  verdict->zeros = {{-1, -1, -1}, {1, 1, 1}};
  Matrix<3> slopes, jacobian;  // of planes, lines and lanes; of the variables
  for (int k = 0; k < 3; ++k) {
    const SpaceNet& net = system.nets[k];
    if (net.sign()) {
      verdict->excluded = true;
      return;
    }
    HWY_DYNAMIC_DISPATCH(space_slopes)(net.rows, net.count, slopes[k].data());
    for (int j = 0; j < 3; ++j) jacobian[k][system.order[j]] = slopes[k][j];
  }
  Matrix<3> y = adjugate(jacobian);
  const double determinant =
      jacobian[0][0] * y[0][0] + jacobian[0][1] * y[1][0] + jacobian[0][2] * y[2][0];
  const double inverse = 1 / determinant;
  const bool regular = std::isfinite(inverse) && inverse != 0;
  if (regular)
    for (auto& row : y)
      for (double& entry : row) entry *= inverse;
  Preconditioned combinations(system, slopes, y, regular ? 1.0 : 0.0);
  verdict->excluded = combinations.excludes(&verdict->zeros);
  verdict->bend = {};
  // Far from a contraction, where it does not pay to look closer.
  constexpr double kFar = 8;
  if (verdict->excluded || combinations.widest() > kFar) return;
  const Matrix<3> deviation = combinations.deviations();
  for (int j = 0; j < 3; ++j) {
    const double column = deviation[0][j] + deviation[1][j] + deviation[2][j];
    verdict->bend[j] = std::isfinite(column) ? column : 0;
  }
  if (!regular) return;
  for (int i = 0; i < 3; ++i)
    if (!(deviation[i][i] < quality)) return;
  if (const auto weights = contracting_weights<3>(deviation, quality)) {
    verdict->contracts = true;
    verdict->contraction = {y, deviation, *weights};
  }
}

}  // namespace encase
#endif
