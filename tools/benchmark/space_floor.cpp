// SPDX-License-Identifier: MIT
#include "space_floor.hpp"

#include <cstdint>

#include "encase/number.hpp"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define BENCHMARK_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define BENCHMARK_CLONES
#endif
#define BENCHMARK_INLINE inline __attribute__((always_inline))

namespace encase::benchmark {
namespace {

constexpr int kSteps = 4;
constexpr int kLanes = PackedSpacePolynomial::kLanes;

typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double)), may_alias));

BENCHMARK_INLINE double sum(const Lanes& v) {
  return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

/// Value and gradient, by Horner's rule in y and z, for all powers of x at a time.
BENCHMARK_INLINE void evaluate(const PackedSpacePolynomial& f, const Point<3>& p, double* value,
                               double* gradient) {
  const Lanes* row = reinterpret_cast<const Lanes*>(f.data());
  Lanes all = {}, of_y = {}, of_z = {};
  for (int k = f.degree(); k >= 0; --k) {
    Lanes inner = {}, slope = {};
    for (int j = f.degree() - k; j >= 0; --j, ++row) {
      slope = slope * p[1] + inner;
      inner = inner * p[1] + *row;
    }
    of_z = of_z * p[2] + all;
    of_y = of_y * p[2] + slope;
    all = all * p[2] + inner;
  }
  const double x = p[0], x2 = x * x, x4 = x2 * x2;
  const Lanes power = {1, x, x2, x2 * x, x4, x4 * x, x4 * x2, x4 * x2 * x};
  const Lanes index = {0, 1, 2, 3, 4, 5, 6, 7};
  const Lanes below = {0, 1, x, x2, x2 * x, x4, x4 * x, x4 * x2};
  *value = sum(all * power);
  gradient[0] = sum(all * (index * below));
  gradient[1] = sum(of_y * power);
  gradient[2] = sum(of_z * power);
}

}  // namespace

PackedSpacePolynomial::PackedSpacePolynomial(const Polynomial<3>& f) : degree_(f.degree()) {
  const int n = degree_ + 1, rows = n * (n + 1) / 2;
  storage_.assign(static_cast<std::size_t>((rows + 1) * kLanes), 0.0);
  const auto address = reinterpret_cast<std::uintptr_t>(storage_.data());
  const std::size_t line = kLanes * sizeof(double);
  double* first = storage_.data() + (line - address % line) % line / sizeof(double);
  data_ = first;
  for (const auto& term : f.terms()) {
    // Rows of the powers of z above that of the term, then of y above.
    int row = 0;
    for (int k = degree_; k > term.exponent[2]; --k) row += n - k;
    row += degree_ - term.exponent[2] - term.exponent[1];
    first[row * kLanes + term.exponent[0]] = nearest_double(term.coefficient);
  }
}

BENCHMARK_CLONES void newton_steps(const std::array<PackedSpacePolynomial, 3>& f,
                                   std::vector<Point<3>>& points) {
  for (Point<3>& p : points)
    for (int step = 0; step < kSteps; ++step) {
      double v[3], j[3][3];
      for (std::size_t i = 0; i < 3; ++i) evaluate(f[i], p, &v[i], j[i]);
      double minor[3], of_value[3];
      // Cramer's rule.
      for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        minor[c] = j[1][a] * j[2][b] - j[1][b] * j[2][a];
      }
      const double inverse = 1 / (j[0][0] * minor[0] + j[0][1] * minor[1] + j[0][2] * minor[2]);
      for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        of_value[c] = v[0] * minor[c] + v[1] * (j[2][a] * j[0][b] - j[2][b] * j[0][a]) +
                      v[2] * (j[0][a] * j[1][b] - j[0][b] * j[1][a]);
      }
      for (std::size_t c = 0; c < 3; ++c) p[c] -= of_value[c] * inverse;
    }
}

}  // namespace encase::benchmark
