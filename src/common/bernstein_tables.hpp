// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace encase {

/// Constant matrices for polynomials in one variable of one degree up to 15, in Bernstein form.
/// Every row is padded with zeros to 16 entries. The entries are exact values rounded to nearest
/// or truncated; those of `lower`, `upper` and `weights` are exact.
struct BernsteinTables {
  static constexpr int kMaxDegree = 15;
  static constexpr int kSize = kMaxDegree + 1;
  using Row = std::array<double, kSize>;
  using Matrix = std::array<Row, kSize>;

  /// The points -1 = nodes[0] < ... < nodes[degree] = 1 at which polynomials are interpolated: near
  /// Chebyshev's. (Degree 0: one point, 0.)
  alignas(64) Row nodes{};
  /// Row k: the Bernstein coefficients on [-1,1] of the polynomial that is 1 at node k, 0 at
  /// others.
  alignas(64) Matrix from_values{};
  /// Row k: those of s^k on [-1,1]; none exceeds 1 in absolute value.
  alignas(64) Matrix from_powers{};
  /// Row k: what coefficient k contributes to the coefficients on the lower and upper half.
  alignas(64) Matrix lower{}, upper{};
  /// Row k: the values of the k-th Bernstein polynomial at 1/9, ..., 8/9 of the way, about.
  alignas(64) std::array<std::array<double, 8>, kSize> samples{};
  /// Entry j: the binomial coefficient of degree - 2 over j (degree >= 2).
  alignas(64) Row weights{};
  /// Entry j of row k: bit k of j, and of degree - 2 - j where that is positive, as 0 or 1.
  alignas(64) std::array<Row, 4> up_bits{}, down_bits{};
  /// At least the sum of |contributions| of all values to any one Bernstein coefficient.
  double values_norm = 0;
  int degree = 0;
};

/// The tables of a degree, made when first asked for. Requires 0 <= degree <= 15.
const BernsteinTables& bernstein_tables(int degree);

}  // namespace encase
