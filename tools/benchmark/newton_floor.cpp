// SPDX-License-Identifier: MIT
#include "newton_floor.hpp"

#include <cstdint>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define BENCHMARK_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#define BENCHMARK_HAS_CLONES 1
#else
#define BENCHMARK_CLONES
#define BENCHMARK_HAS_CLONES 0
#endif
#define BENCHMARK_INLINE inline __attribute__((always_inline))

namespace encase::benchmark {
namespace {

constexpr int kSteps = 4;
constexpr int kLanes = PackedPolynomial::kLanes;
constexpr int kMostBlocks = kMaxDegree / kLanes + 1;

typedef double Lanes __attribute__((vector_size(kLanes * sizeof(double)), may_alias));

/// Value and gradient.
struct Local {
  double value, dx, dy;
};

BENCHMARK_INLINE double sum(const Lanes& v) {
  return ((v[0] + v[4]) + (v[1] + v[5])) + ((v[2] + v[6]) + (v[3] + v[7]));
}

/// 1, x, ..., and 0, 1, 2 x, ...
template <int Blocks>
struct Powers {
  Lanes power[Blocks], slope[Blocks];

  BENCHMARK_INLINE explicit Powers(double x) {
    const double x2 = x * x, x4 = x2 * x2;
    const Lanes odd = {1, x, 1, x, 1, x, 1, x}, two = {1, 1, x2, x2, 1, 1, x2, x2},
                four = {1, 1, 1, 1, x4, x4, x4, x4};
    power[0] = odd * two * four;
    const Lanes index = {0, 1, 2, 3, 4, 5, 6, 7};
    const Lanes up = {0, 1, x, x2, x2 * x, x4, x4 * x, x4 * x2};
    slope[0] = index * up;
    const double x8 = x4 * x4, x7 = x4 * x2 * x;
    for (int b = 1; b < Blocks; ++b) {
      power[b] = power[b - 1] * x8;
      // (x^(k + 8))' = x^8 (x^k)' + 8 x^7 x^k
      slope[b] = slope[b - 1] * x8 + power[b - 1] * (8 * x7);
    }
  }
};

/// Horner's scheme in y, for eight powers of x at a time.
template <int Blocks>
struct Columns {
  Lanes value[Blocks] = {}, slope[Blocks] = {};

  BENCHMARK_INLINE const Lanes* add(const Lanes* row, int used, double y) {
    for (int b = 0; b < Blocks; ++b) {
      if (b >= used) break;
      slope[b] = slope[b] * y + value[b];
      value[b] = value[b] * y + row[b];
    }
    return row + used;
  }
  BENCHMARK_INLINE Local at(const Powers<Blocks>& x) const {
    Lanes f = value[0] * x.power[0], fx = value[0] * x.slope[0], fy = slope[0] * x.power[0];
    for (int b = 1; b < Blocks; ++b) {
      f += value[b] * x.power[b];
      fx += value[b] * x.slope[b];
      fy += slope[b] * x.power[b];
    }
    return {sum(f), sum(fx), sum(fy)};
  }
};

/// Both polynomials in one pass over the powers of y: twice as many independent operations.
template <int Blocks>
BENCHMARK_INLINE void evaluate(const PackedPolynomial& f, const PackedPolynomial& g,
                               const Point<2>& at, Local* of_f, Local* of_g) {
  const Lanes* row_f = reinterpret_cast<const Lanes*>(f.data());
  const Lanes* row_g = reinterpret_cast<const Lanes*>(g.data());
  Columns<Blocks> columns_f, columns_g;
  int j = f.degree();
#pragma GCC unroll 8
  for (int used = 1; used <= Blocks; ++used) {
    for (; j >= 0 && f.blocks(j) == used; --j) {
      row_f = columns_f.add(row_f, used, at[1]);
      row_g = columns_g.add(row_g, used, at[1]);
    }
  }
  const Powers<Blocks> x(at[0]);
  *of_f = columns_f.at(x);
  *of_g = columns_g.at(x);
}

template <int Blocks>
BENCHMARK_INLINE void steps(const PackedPolynomial& f, const PackedPolynomial& g,
                            std::vector<Point<2>>& points) {
  for (Point<2>& p : points)
    for (int step = 0; step < kSteps; ++step) {
      Local a, b;
      evaluate<Blocks>(f, g, p, &a, &b);
      const double inverse = 1 / (a.dx * b.dy - a.dy * b.dx);
      p[0] -= (a.value * b.dy - b.value * a.dy) * inverse;
      p[1] -= (b.value * a.dx - a.value * b.dx) * inverse;
    }
}

/// Eight points: a coefficient is multiplied with the powers of all at once.
struct LocalLanes {
  Lanes value, dx, dy;
};

BENCHMARK_INLINE void evaluate_lanes(const PackedPolynomial& f, const Lanes& x, const Lanes& y,
                                     LocalLanes* out) {
  const double* row = f.data();
  Lanes value = {}, dx = {}, dy = {};
  for (int j = f.degree(); j >= 0; --j) {
    // The polynomial in x that belongs to the power j of y, and its derivative.
    Lanes r = {}, s = {};
    for (int i = f.degree() - j; i >= 0; --i) {
      s = s * x + r;
      r = r * x + row[i];
    }
    dy = dy * y + value;
    value = value * y + r;
    dx = dx * y + s;
    row += f.blocks(j) * kLanes;
  }
  *out = {value, dx, dy};
}

}  // namespace

PackedPolynomial::PackedPolynomial(const Polynomial<2>& f, int degree) : degree_(degree) {
  std::vector<std::size_t> start(static_cast<std::size_t>(degree) + 1);
  std::size_t size = 0;
  for (int j = degree; j >= 0; --j) {
    start[static_cast<std::size_t>(j)] = size;
    size += static_cast<std::size_t>(blocks(j) * kLanes);
  }
  storage_.resize(size + kLanes);
  const std::size_t bytes = kLanes * sizeof(double);
  const std::size_t past = reinterpret_cast<std::uintptr_t>(storage_.data()) % bytes;
  double* first = storage_.data() + (past == 0 ? 0 : (bytes - past) / sizeof(double));
  for (const auto& term : f.terms())
    first[start[static_cast<std::size_t>(term.exponent[1])] +
          static_cast<std::size_t>(term.exponent[0])] = nearest_double(term.coefficient);
  data_ = first;
}

BENCHMARK_CLONES void newton_steps(const PackedPolynomial& f, const PackedPolynomial& g,
                                   std::vector<Point<2>>& points) {
  static_assert(kMostBlocks == 8);
  switch (f.blocks(0)) {
    case 1:
      return steps<1>(f, g, points);
    case 2:
      return steps<2>(f, g, points);
    case 3:
      return steps<3>(f, g, points);
    case 4:
      return steps<4>(f, g, points);
    case 5:
      return steps<5>(f, g, points);
    case 6:
      return steps<6>(f, g, points);
    case 7:
      return steps<7>(f, g, points);
    default:
      return steps<8>(f, g, points);
  }
}

BENCHMARK_CLONES void newton_steps_together(const PackedPolynomial& f, const PackedPolynomial& g,
                                            std::vector<Point<2>>& points) {
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    Lanes x = {}, y = {};
    const std::size_t n = points.size() - first < kLanes ? points.size() - first : kLanes;
    for (std::size_t k = 0; k < n; ++k) {
      x[k] = points[first + k][0];
      y[k] = points[first + k][1];
    }
    for (int step = 0; step < kSteps; ++step) {
      LocalLanes a, b;
      evaluate_lanes(f, x, y, &a);
      evaluate_lanes(g, x, y, &b);
      const Lanes inverse = 1.0 / (a.dx * b.dy - a.dy * b.dx);
      x -= (a.value * b.dy - b.value * a.dy) * inverse;
      y -= (b.value * a.dx - a.value * b.dx) * inverse;
    }
    for (std::size_t k = 0; k < n; ++k) points[first + k] = {x[k], y[k]};
  }
}

std::string vector_instructions() {
#if BENCHMARK_HAS_CLONES
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
  if (__builtin_cpu_supports("fma")) return "AVX with FMA";
#endif
  return "baseline";
}

}  // namespace encase::benchmark
