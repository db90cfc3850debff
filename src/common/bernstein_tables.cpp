// SPDX-License-Identifier: MIT
#include "common/bernstein_tables.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <vector>

#include "encase/number.hpp"

namespace encase {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNodeUnit = 0x1p20;  // nodes are multiples of its reciprocal

Integer binomial(int n, int k) {
  Integer result;
  mpz_bin_uiui(result.get_mpz_t(), static_cast<unsigned long>(n), static_cast<unsigned long>(k));
  return result;
}

/// The Bernstein coefficient j of s^k on [-1,1] in degree n: the blossom of s^k at j ones and n - j
/// minus ones.
Rational power_coefficient(int n, int k, int j) {
  Integer sum = 0;
  for (int i = std::max(0, k - (n - j)); i <= std::min(j, k); ++i) {
    const Integer term = binomial(j, i) * binomial(n - j, k - i);
    if ((k - i) % 2)
      sum -= term;
    else
      sum += term;
  }
  Rational result(sum, binomial(n, k));
  result.canonicalize();
  return result;
}

double make_node(int n, int k) {
  if (n == 0) return 0;
  return -std::nearbyint(std::cos(kPi * k / n) * kNodeUnit) / kNodeUnit;
}

/// Lagrange's polynomials in integers: the numerator's coefficients, scaled by kNodeUnit^n, and the
/// value at its own node.
void fill_from_values(int n, BernsteinTables* tables) {
  std::vector<Integer> nodes;
  for (int k = 0; k <= n; ++k) {
    tables->nodes[k] = make_node(n, k);
    nodes.emplace_back(tables->nodes[k] * kNodeUnit);
  }
  std::vector<Rational> sums(n + 1);
  for (int k = 0; k <= n; ++k) {
    std::vector<Integer> product{1};  // of (kNodeUnit s - node l), l != k
    Integer at_node = 1;
    for (int l = 0; l <= n; ++l) {
      if (l == k) continue;
      product.emplace_back(0);
      for (std::size_t i = product.size(); i-- > 0;) {
        product[i] *= -nodes[l];
        if (i > 0) product[i] += product[i - 1] * Integer(kNodeUnit);
      }
      at_node *= nodes[k] - nodes[l];
    }
    for (int j = 0; j <= n; ++j) {
      Rational entry = 0;
      for (int i = 0; i <= n; ++i) entry += product[i] * power_coefficient(n, i, j);
      entry /= at_node;
      sums[j] += abs(entry);
      tables->from_values[k][j] = entry.get_d();
    }
  }
  tables->values_norm = std::max_element(sums.begin(), sums.end())->get_d() * (1 + 0x1p-50);
}

std::unique_ptr<const BernsteinTables> make_tables(int n) {
  auto tables = std::make_unique<BernsteinTables>();
  tables->degree = n;
  fill_from_values(n, tables.get());
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j) {
      tables->from_powers[k][j] = power_coefficient(n, k, j).get_d();
      if (k <= j) tables->lower[k][j] = std::ldexp(binomial(j, k).get_d(), -j);
      if (k >= j) tables->upper[k][j] = std::ldexp(binomial(n - j, n - k).get_d(), -(n - j));
    }
  for (int k = 0; k <= n; ++k)
    for (int i = 0; i < 8; ++i) {
      const double v = (i + 1) / 9.0;
      tables->samples[k][i] = binomial(n, k).get_d() * std::pow(v, k) * std::pow(1 - v, n - k);
    }
  for (int j = 0; j <= n - 2; ++j) tables->weights[j] = binomial(n - 2, j).get_d();
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < BernsteinTables::kSize; ++j) {
      tables->up_bits[k][j] = (j >> k) & 1;
      tables->down_bits[k][j] = (std::max(0, n - 2 - j) >> k) & 1;
    }
  return tables;
}

}  // namespace

const BernsteinTables& bernstein_tables(int degree) {
  static std::array<std::atomic<const BernsteinTables*>, BernsteinTables::kSize> known;
  const BernsteinTables* found = known[degree].load(std::memory_order_acquire);
  if (found) return *found;
  static std::mutex mutex;
  static std::array<std::unique_ptr<const BernsteinTables>, BernsteinTables::kSize> owned;
  std::lock_guard lock(mutex);
  if (!owned[degree]) {
    owned[degree] = make_tables(degree);
    known[degree].store(owned[degree].get(), std::memory_order_release);
  }
  return *owned[degree];
}

}  // namespace encase
