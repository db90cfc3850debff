// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "common/bernstein.hpp"
#include "encase/polynomial.hpp"

/// Bernstein forms on [-1,1]^K in exact arithmetic, the slow and obvious way.
namespace encase::exact_bernstein {

inline Rational binomial(int n, int k) {
  Integer result;
  mpz_bin_uiui(result.get_mpz_t(), static_cast<unsigned>(n), static_cast<unsigned>(k));
  return result;
}

/// Coefficient j in degree n of s^k = (2 u - 1)^k, u in [0,1]: that of u^m is C(j, m) / C(n, m).
inline Rational of_power(int k, int n, int j) {
  Rational sum = 0;
  for (int m = 0; m <= std::min(j, k); ++m) {
    const Rational sign = (k - m) % 2 ? -1 : 1;
    Rational two;
    mpz_ui_pow_ui(two.get_num_mpz_t(), 2, static_cast<unsigned>(m));
    sum += sign * binomial(k, m) * two * binomial(j, m) / binomial(n, m);
  }
  return sum;
}

/// The exponent (or index) that follows, the last axis running fastest; false after the last one.
template <int K>
bool advance(std::array<int, K>& index, const std::array<int, K>& degree) {
  for (int i = K - 1; i >= 0; --i) {
    if (++index[i] <= degree[i]) return true;
    index[i] = 0;
  }
  return false;
}

/// The coefficients of f, in the order of `Bernstein::b`.
template <int K>
std::vector<Rational> coefficients(const Polynomial<K>& f, const std::array<int, K>& degree) {
  std::vector<Rational> result;
  std::array<int, K> index{};
  do {
    Rational sum = 0;
    for (const auto& term : f.terms()) {
      Rational product = term.coefficient;
      for (int i = 0; i < K; ++i) product *= of_power(term.exponent[i], degree[i], index[i]);
      sum += product;
    }
    result.push_back(sum);
  } while (advance<K>(index, degree));
  return result;
}

/// The polynomial whose coefficients are exactly the doubles of the net.
template <int K>
Polynomial<K> polynomial(const Bernstein<K>& net) {
  const auto half = [](int axis, int sign) {  // (1 +- s) / 2
    return Polynomial<K>::constant(Rational(1, 2)) +
           Polynomial<K>::constant(Rational(sign, 2)) * Polynomial<K>::variable(axis);
  };
  std::array<std::vector<Polynomial<K>>, K> basis;
  for (int i = 0; i < K; ++i)
    for (int j = 0; j <= net.degree[i]; ++j)
      basis[i].push_back(Polynomial<K>::constant(binomial(net.degree[i], j)) * half(i, 1).power(j) *
                         half(i, -1).power(net.degree[i] - j));
  std::vector<typename Polynomial<K>::Term> terms;
  std::array<int, K> index{};
  std::size_t k = 0;
  do {
    Polynomial<K> product = Polynomial<K>::constant(Rational(net.b[k++]));
    for (int i = 0; i < K; ++i) product = product * basis[i][index[i]];
    terms.insert(terms.end(), product.terms().begin(), product.terms().end());
  } while (advance<K>(index, net.degree));
  return Polynomial<K>::from_terms(std::move(terms));
}

/// f with offset_i + scale_i s_i in place of the i-th variable.
template <int K>
Polynomial<K> compose(const Polynomial<K>& f, const RationalPoint<K>& offset,
                      const RationalPoint<K>& scale) {
  std::array<std::vector<Polynomial<K>>, K> powers;
  for (int i = 0; i < K; ++i) {
    const Polynomial<K> affine = Polynomial<K>::constant(offset[i]) +
                                 Polynomial<K>::constant(scale[i]) * Polynomial<K>::variable(i);
    powers[i].push_back(Polynomial<K>::constant(1));
    for (int k = 1; k <= f.degree(i); ++k) powers[i].push_back(powers[i].back() * affine);
  }
  std::vector<typename Polynomial<K>::Term> terms;
  for (const auto& term : f.terms()) {
    Polynomial<K> product = Polynomial<K>::constant(term.coefficient);
    for (int i = 0; i < K; ++i) product = product * powers[i][term.exponent[i]];
    terms.insert(terms.end(), product.terms().begin(), product.terms().end());
  }
  return Polynomial<K>::from_terms(std::move(terms));
}

/// The largest distance of a coefficient of `net` from that of f.
template <int K>
Rational largest_error(const Bernstein<K>& net, const Polynomial<K>& f) {
  const std::vector<Rational> exact = coefficients<K>(f, net.degree);
  Rational largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Rational error = abs(Rational(Rational(net.b[i]) - exact[i]));
    if (error > largest) largest = error;
  }
  return largest;
}

/// Whether the net's claim holds for f: no coefficient is further away than its radius.
template <int K>
bool encloses(const Bernstein<K>& net, const Polynomial<K>& f) {
  if (net.b.size() != static_cast<std::size_t>(net.size())) return false;
  for (int i = 0; i < K; ++i)
    if (f.degree(i) > net.degree[i]) return false;
  return std::isfinite(net.radius) && largest_error<K>(net, f) <= Rational(net.radius);
}

}  // namespace encase::exact_bernstein
