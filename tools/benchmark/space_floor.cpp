// SPDX-License-Identifier: MIT
#include "space_floor.hpp"

#include <cstdint>

#include "encase/number.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "space_floor.cpp"
#include <hwy/foreach_target.h>

#include "common/simd_rows-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace encase::HWY_NAMESPACE {

using benchmark::PackedSpacePolynomial;
constexpr int kSteps = 4;

/// Value and gradient, by Horner's rule in y and z, for all powers of x at a time.
HWY_INLINE void evaluate(const PackedSpacePolynomial& f, const Point<3>& p, double* value,
                         double* gradient) {
  const double* row = f.data();
  const Row zero = Row::all(0), y = Row::all(p[1]), z = Row::all(p[2]);
  Row all = zero, of_y = zero, of_z = zero;
  for (int k = f.degree(); k >= 0; --k) {
    Row inner = zero, slope = zero;
    for (int j = f.degree() - k; j >= 0; --j, row += PackedSpacePolynomial::kLanes) {
      slope = multiply_add(slope, y, inner);
      inner = multiply_add(inner, y, Row::load(row));
    }
    of_z = multiply_add(of_z, z, all);
    of_y = multiply_add(of_y, z, slope);
    all = multiply_add(all, z, inner);
  }
  const double x = p[0], x2 = x * x, x3 = x2 * x, x4 = x2 * x2;
  HWY_ALIGN const double powers[8] = {1, x, x2, x3, x4, x4 * x, x4 * x2, x4 * x3};
  HWY_ALIGN const double slopes[8] = {0,      1,      2 * x,        3 * x2,
                                      4 * x3, 5 * x4, 6 * (x4 * x), 7 * (x4 * x2)};
  const Row power = Row::load(powers);
  *value = sum_of_lanes(all * power);
  gradient[0] = sum_of_lanes(all * Row::load(slopes));
  gradient[1] = sum_of_lanes(of_y * power);
  gradient[2] = sum_of_lanes(of_z * power);
}

void newton_steps(const std::array<PackedSpacePolynomial, 3>& f, std::vector<Point<3>>& points) {
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

}  // namespace encase::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace encase {
namespace {

HWY_EXPORT(newton_steps);

}  // namespace

namespace benchmark {

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

void newton_steps(const std::array<PackedSpacePolynomial, 3>& f, std::vector<Point<3>>& points) {
  HWY_DYNAMIC_DISPATCH(newton_steps)(f, points);
}

}  // namespace benchmark
}  // namespace encase
#endif
