// SPDX-License-Identifier: MIT
#include "common/bernstein.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

/// The net as an array [outer][degree + 1][inner] around one axis.
struct Stride {
  int outer = 1;
  int count = 1;
  int inner = 1;
};

template <int K>
Stride stride_of(const std::array<int, K>& degree, int axis) {
  Stride s;
  for (int i = 0; i < axis; ++i) s.outer *= degree[i] + 1;
  s.count = degree[axis] + 1;
  for (int i = axis + 1; i < K; ++i) s.inner *= degree[i] + 1;
  return s;
}

constexpr double kUnit = 0x1p-53;
constexpr double kTiny = 0x1p-1060;  // more than what gradual underflow can lose in a net operation
constexpr double kUp = 1 + 0x1p-50;  // outweighs the roundings of the sum it multiplies

// The inner loops, over contiguous doubles.

// (Extremes are taken in eight independent lanes: one chain of comparisons cannot be vectorised.)

double largest(const double* b, int count) {
  double lane[8] = {};
  int i = 0;
  for (; i + 8 <= count; i += 8)
    for (int k = 0; k < 8; ++k) {
      const double x = std::fabs(b[i + k]);
      lane[k] = lane[k] < x ? x : lane[k];
    }
  for (; i < count; ++i) lane[0] = std::max(lane[0], std::fabs(b[i]));
  return *std::max_element(lane, lane + 8);
}

void extremes(const double* b, int count, double* lowest, double* highest) {
  double lo[8], hi[8];
  for (int k = 0; k < 8; ++k) lo[k] = hi[k] = b[0];
  int i = 0;
  for (; i + 8 <= count; i += 8)
    for (int k = 0; k < 8; ++k) {
      lo[k] = b[i + k] < lo[k] ? b[i + k] : lo[k];
      hi[k] = b[i + k] > hi[k] ? b[i + k] : hi[k];
    }
  for (; i < count; ++i) {
    lo[0] = std::min(lo[0], b[i]);
    hi[0] = std::max(hi[0], b[i]);
  }
  *lowest = *std::min_element(lo, lo + 8);
  *highest = *std::max_element(hi, hi + 8);
}

/// One block of de Casteljau's algorithm at 1/2: t, of n + 1 rows of `inner`, becomes the upper
/// half, l the lower. After step r, row j of t holds the j-th point of the r-th generation, and the
/// last rows hold the upper half's points already.
void halve_block(double* t, double* l, int n, int inner) {
  for (int i = 0; i < inner; ++i) l[i] = t[i];
  for (int r = 1; r <= n; ++r) {
    const int end = (n - r + 1) * inner;
    for (int j = 0; j < end; ++j) t[j] = 0.5 * (t[j] + t[j + inner]);
    for (int i = 0; i < inner; ++i) l[r * inner + i] = t[i];
  }
}

void differences(const double* from, double* to, int count, int step, double factor) {
  for (int j = 0; j < count; ++j) to[j] = factor * (from[j + step] - from[j]);
}

void weighted_sum(double alpha, const double* f, double beta, const double* g, double* to,
                  int count) {
  for (int i = 0; i < count; ++i) to[i] = alpha * f[i] + beta * g[i];
}

double largest(const std::vector<double>& b) {
  return largest(b.data(), static_cast<int>(b.size()));
}

}  // namespace

template <int K>
std::optional<Sign> sign_on_cube(const Bernstein<K>& net) {
  double lo, hi;
  extremes(net.b.data(), static_cast<int>(net.b.size()), &lo, &hi);
  // The comparisons are exact, and false for a NaN radius; a NaN coefficient only comes with one.
  if (lo > net.radius) return Sign::Positive;
  if (hi < -net.radius) return Sign::Negative;
  return std::nullopt;
}

template <int K>
bool drowned(const Bernstein<K>& net) {
  double lo, hi;
  extremes(net.b.data(), static_cast<int>(net.b.size()), &lo, &hi);
  return !(lo < -net.radius && hi > net.radius) && !(lo > net.radius) && !(hi < -net.radius);
}

template <int K>
double largest_coefficient(const Bernstein<K>& net) {
  return largest(net.b);
}

template <int K>
void halve(const Bernstein<K>& net, int axis, Bernstein<K>* lower, Bernstein<K>* upper) {
  const Stride s = stride_of<K>(net.degree, axis);
  const int n = s.count - 1;
  lower->degree = upper->degree = net.degree;
  lower->b.resize(net.b.size());
  upper->b = net.b;
  const std::size_t block = static_cast<std::size_t>(s.count) * s.inner;
  for (int o = 0; o < s.outer; ++o) {
    halve_block(upper->b.data() + o * block, lower->b.data() + o * block, n, s.inner);
  }
  // Each of at most n averages rounds once, relative to the largest coefficient; averages of exact
  // coefficients do not enlarge the radius.
  const double radius = (net.radius + 1.01 * (n + 1) * kUnit * largest(net.b) + kTiny) * kUp;
  lower->radius = upper->radius = radius;
}

template <int K>
void differentiate(const Bernstein<K>& net, int axis, Bernstein<K>* out) {
  const Stride s = stride_of<K>(net.degree, axis);
  const int n = s.count - 1;
  out->degree = net.degree;
  if (n == 0) {
    out->b.assign(net.b.size(), 0.0);
    out->radius = 0;
    return;
  }
  out->degree[axis] = n - 1;
  out->b.resize(static_cast<std::size_t>(s.outer) * n * s.inner);
  // d/ds on [-1,1] is half of d/du on [0,1].
  const double factor = 0.5 * n;
  for (int o = 0; o < s.outer; ++o) {
    const double* from = net.b.data() + static_cast<std::size_t>(o) * s.count * s.inner;
    double* to = out->b.data() + static_cast<std::size_t>(o) * n * s.inner;
    differences(from, to, n * s.inner, s.inner, factor);
  }
  const double m = largest(out->b);
  // The difference of two coefficients errs by 2 radius, and two operations round.
  out->radius = 1.0000001 * (2 * factor * net.radius + 3 * kUnit * m) + kTiny;
}

namespace {

/// The product with the linear polynomial whose coefficients along one axis are (first, 1), where
/// first is 1 (the constant one: a raised degree) or -1 (the coordinate).
template <int K>
void multiply_by_linear(const Bernstein<K>& net, int axis, double first, Bernstein<K>* out) {
  const Stride s = stride_of<K>(net.degree, axis);
  const int n = s.count - 1;
  out->degree = net.degree;
  out->degree[axis] = n + 1;
  out->b.resize(static_cast<std::size_t>(s.outer) * (n + 2) * s.inner);
  for (int o = 0; o < s.outer; ++o) {
    const double* from = net.b.data() + static_cast<std::size_t>(o) * s.count * s.inner;
    double* to = out->b.data() + static_cast<std::size_t>(o) * (n + 2) * s.inner;
    for (int j = 0; j <= n + 1; ++j) {
      const double w = static_cast<double>(j) / (n + 1), rest = first * (1 - w);
      for (int i = 0; i < s.inner; ++i) {
        const double below = j > 0 ? from[(j - 1) * s.inner + i] : 0.0;
        const double above = j <= n ? from[j * s.inner + i] : 0.0;
        to[j * s.inner + i] = w * below + rest * above;
      }
    }
  }
  // The weights' absolute values add up to one: the radius stays; weights, products and the sum
  // round.
  out->radius = (net.radius + 6 * kUnit * largest(net.b) + kTiny) * kUp;
}

}  // namespace

template <int K>
void elevate(const Bernstein<K>& net, int axis, Bernstein<K>* out) {
  multiply_by_linear<K>(net, axis, 1.0, out);
}

template <int K>
void multiply_by_coordinate(const Bernstein<K>& net, int axis, Bernstein<K>* out) {
  multiply_by_linear<K>(net, axis, -1.0, out);
}

template <int K>
void combine(double alpha, const Bernstein<K>& f, double beta, const Bernstein<K>& g,
             Bernstein<K>* out) {
  out->degree = f.degree;
  out->b.resize(f.b.size());
  const double magnitude = std::fabs(alpha) * largest(f.b) + std::fabs(beta) * largest(g.b);
  weighted_sum(alpha, f.b.data(), beta, g.b.data(), out->b.data(), static_cast<int>(f.b.size()));
  out->radius = 1.0000001 * (std::fabs(alpha) * f.radius + std::fabs(beta) * g.radius +
                             3 * kUnit * magnitude) +
                kTiny;
}

template <int K>
double variation(const Bernstein<K>& net, int axis) {
  const Stride s = stride_of<K>(net.degree, axis);
  double m = 0;
  for (int o = 0; o < s.outer; ++o) {
    const double* from = net.b.data() + static_cast<std::size_t>(o) * s.count * s.inner;
    for (int j = 0; j < (s.count - 1) * s.inner; ++j)
      m = std::max(m, std::fabs(from[j + s.inner] - from[j]));
  }
  return m;
}

#define ENCASE_INSTANTIATE(K)                                                                     \
  template std::optional<Sign> sign_on_cube<K>(const Bernstein<K>&);                              \
  template bool drowned(const Bernstein<K>&);                                                     \
  template double largest_coefficient(const Bernstein<K>&);                                       \
  template void halve(const Bernstein<K>&, int, Bernstein<K>*, Bernstein<K>*);                    \
  template void differentiate(const Bernstein<K>&, int, Bernstein<K>*);                           \
  template void elevate(const Bernstein<K>&, int, Bernstein<K>*);                                 \
  template void multiply_by_coordinate(const Bernstein<K>&, int, Bernstein<K>*);                  \
  template void combine(double, const Bernstein<K>&, double, const Bernstein<K>&, Bernstein<K>*); \
  template double variation(const Bernstein<K>&, int);
ENCASE_INSTANTIATE(1)
ENCASE_INSTANTIATE(2)
ENCASE_INSTANTIATE(3)
#undef ENCASE_INSTANTIATE

}  // namespace encase
