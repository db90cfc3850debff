// SPDX-License-Identifier: MIT
#include "newton_floor.hpp"

#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "newton_floor.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

#ifndef BENCHMARK_NEWTON_FLOOR_SHARED
#define BENCHMARK_NEWTON_FLOOR_SHARED
namespace encase::benchmark {
namespace {

constexpr int kSteps = 4;
constexpr int kBlock = PackedPolynomial::kLanes;
constexpr int kMostBlocks = kMaxDegree / kBlock + 1;

/// Value and gradient.
struct Local {
  double value, dx, dy;
};

}  // namespace
}  // namespace encase::benchmark
#endif

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

using benchmark::kBlock;
using benchmark::kSteps;
using benchmark::Local;
using benchmark::PackedPolynomial;

/// 1, x, ..., and 0, 1, 2 x, ...
template <int Blocks>
struct Powers {
  Row power[Blocks], slope[Blocks];

  HWY_INLINE explicit Powers(double x) {
    const double x2 = x * x, x3 = x2 * x, x4 = x2 * x2;
    HWY_ALIGN const double powers[8] = {1, x, x2, x3, x4, x4 * x, x4 * x2, x4 * x3};
    HWY_ALIGN const double slopes[8] = {0,      1,      2 * x,        3 * x2,
                                        4 * x3, 5 * x4, 6 * (x4 * x), 7 * (x4 * x2)};
    power[0] = Row::load(powers);
    slope[0] = Row::load(slopes);
    const Row x8 = Row::all(x4 * x4), x7 = Row::all(8 * (x4 * x3));
    for (int b = 1; b < Blocks; ++b) {
      power[b] = power[b - 1] * x8;
      // (x^(k + 8))' = x^8 (x^k)' + 8 x^7 x^k
      slope[b] = multiply_add(slope[b - 1], x8, power[b - 1] * x7);
    }
  }
};

/// Horner's scheme in y, for eight powers of x at a time.
template <int Blocks>
struct Columns {
  Row value[Blocks], slope[Blocks];

  HWY_INLINE Columns() {
    for (int b = 0; b < Blocks; ++b) value[b] = slope[b] = Row::all(0);
  }
  HWY_INLINE const double* add(const double* row, int used, const Row& y) {
    for (int b = 0; b < Blocks; ++b) {
      if (b >= used) break;
      slope[b] = multiply_add(slope[b], y, value[b]);
      value[b] = multiply_add(value[b], y, Row::load(row + kBlock * b));
    }
    return row + kBlock * used;
  }
  HWY_INLINE Local at(const Powers<Blocks>& x) const {
    Row f = value[0] * x.power[0], fx = value[0] * x.slope[0], fy = slope[0] * x.power[0];
    for (int b = 1; b < Blocks; ++b) {
      f = multiply_add(value[b], x.power[b], f);
      fx = multiply_add(value[b], x.slope[b], fx);
      fy = multiply_add(slope[b], x.power[b], fy);
    }
    return {sum_of_lanes(f), sum_of_lanes(fx), sum_of_lanes(fy)};
  }
};

template <int Blocks>
HWY_INLINE Columns<Blocks> columns_of(const PackedPolynomial& f, const Row& y) {
  const double* row = f.data();
  Columns<Blocks> columns;
  int j = f.degree();
#pragma GCC unroll 8
  for (int used = 1; used <= Blocks; ++used)
    for (; j >= 0 && f.blocks(j) == used; --j) row = columns.add(row, used, y);
  return columns;
}

/// Both polynomials in one pass over the powers of y where there are registers for it: twice as
/// many independent operations.
template <int Blocks>
HWY_INLINE void evaluate(const PackedPolynomial& f, const PackedPolynomial& g, const Point<2>& at,
                         Local* of_f, Local* of_g) {
  const Row y = Row::all(at[1]);
  const Powers<Blocks> x(at[0]);
  if constexpr (HWY_MAX_BYTES < 64 && Blocks > 1) {
    *of_f = columns_of<Blocks>(f, y).at(x);
    *of_g = columns_of<Blocks>(g, y).at(x);
  } else {
    const double *row_f = f.data(), *row_g = g.data();
    Columns<Blocks> columns_f, columns_g;
    int j = f.degree();
#pragma GCC unroll 8
    for (int used = 1; used <= Blocks; ++used) {
      for (; j >= 0 && f.blocks(j) == used; --j) {
        row_f = columns_f.add(row_f, used, y);
        row_g = columns_g.add(row_g, used, y);
      }
    }
    *of_f = columns_f.at(x);
    *of_g = columns_g.at(x);
  }
}

template <int Blocks>
void steps(const PackedPolynomial& f, const PackedPolynomial& g, std::vector<Point<2>>& points) {
  for (Point<2>& p : points)
    for (int step = 0; step < kSteps; ++step) {
      Local a, b;
      evaluate<Blocks>(f, g, p, &a, &b);
      const double inverse = 1 / (a.dx * b.dy - a.dy * b.dx);
      p[0] -= (a.value * b.dy - b.value * a.dy) * inverse;
      p[1] -= (b.value * a.dx - a.value * b.dx) * inverse;
    }
}

void newton_steps(const PackedPolynomial& f, const PackedPolynomial& g,
                  std::vector<Point<2>>& points) {
  static_assert(benchmark::kMostBlocks == 8);
  constexpr decltype(&steps<1>) of_blocks[] = {steps<1>, steps<2>, steps<3>, steps<4>,
                                               steps<5>, steps<6>, steps<7>, steps<8>};
  of_blocks[f.blocks(0) - 1](f, g, points);
}

/// Eight points: a coefficient is multiplied with the powers of all at once.
struct LocalLanes {
  Row value, dx, dy;
};

HWY_INLINE LocalLanes evaluate_lanes(const PackedPolynomial& f, const Row& x, const Row& y) {
  const double* row = f.data();
  const Row zero = Row::all(0);
  LocalLanes local{zero, zero, zero};
  for (int j = f.degree(); j >= 0; --j) {
    // The polynomial in x that belongs to the power j of y, and its derivative.
    Row r = zero, s = zero;
    for (int i = f.degree() - j; i >= 0; --i) {
      s = multiply_add(s, x, r);
      r = multiply_add(r, x, Row::all(row[i]));
    }
    local.dy = multiply_add(local.dy, y, local.value);
    local.value = multiply_add(local.value, y, r);
    local.dx = multiply_add(local.dx, y, s);
    row += f.blocks(j) * kBlock;
  }
  return local;
}

/// The quotients of lanes.
HWY_INLINE Row divide(const Row& a, const Row& b) {
  Row r;
  for (int k = 0; k < kParts; ++k) r.part[k] = hn::Div(a.part[k], b.part[k]);
  return r;
}

void newton_steps_together(const PackedPolynomial& f, const PackedPolynomial& g,
                           std::vector<Point<2>>& points) {
  for (std::size_t first = 0; first < points.size(); first += kBlock) {
    HWY_ALIGN double coordinates[2][kBlock] = {};
    const std::size_t n = points.size() - first < kBlock ? points.size() - first : kBlock;
    for (std::size_t k = 0; k < n; ++k)
      for (int i = 0; i < 2; ++i) coordinates[i][k] = points[first + k][i];
    Row x = Row::load(coordinates[0]), y = Row::load(coordinates[1]);
    for (int step = 0; step < kSteps; ++step) {
      const LocalLanes a = evaluate_lanes(f, x, y), b = evaluate_lanes(g, x, y);
      const Row determinant = a.dx * b.dy - a.dy * b.dx;
      x = x - divide(a.value * b.dy - b.value * a.dy, determinant);
      y = y - divide(b.value * a.dx - a.value * b.dx, determinant);
    }
    x.store(coordinates[0]);
    y.store(coordinates[1]);
    for (std::size_t k = 0; k < n; ++k) points[first + k] = {coordinates[0][k], coordinates[1][k]};
  }
}

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(newton_steps);
HWY_EXPORT(newton_steps_together);

}  // namespace

namespace benchmark {

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

void newton_steps(const PackedPolynomial& f, const PackedPolynomial& g,
                  std::vector<Point<2>>& points) {
  HWY_DYNAMIC_DISPATCH(newton_steps)(f, g, points);
}

void newton_steps_together(const PackedPolynomial& f, const PackedPolynomial& g,
                           std::vector<Point<2>>& points) {
  HWY_DYNAMIC_DISPATCH(newton_steps_together)(f, g, points);
}

}  // namespace benchmark
}  // namespace encase
#endif
