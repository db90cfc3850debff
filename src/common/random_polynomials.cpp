// SPDX-License-Identifier: MIT
#include "random_polynomials.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace encase {

double symmetric_random(std::mt19937_64& generator) {
  const auto odd = static_cast<std::int64_t>(generator() >> 10 | 1);  // 54 bits
  return static_cast<double>(odd - (std::int64_t{1} << 53)) * 0x1p-53;
}

template <int D>
std::vector<Exponent<D>> dense_exponents(int degree) {
  std::vector<Exponent<D>> list;
  Exponent<D> e{};
  int total = 0;
  for (;;) {
    list.push_back(e);
    // The last exponent that can grow does; those behind it start again from zero.
    std::size_t axis = D - 1;
    while (total == degree) {
      total -= e[axis];
      e[axis] = 0;
      if (axis-- == 0) return list;
    }
    ++e[axis];
    ++total;
  }
}

namespace {

/// A signed integer of `bits` bits: uniform in [-2^(bits - 1), 2^(bits - 1)).
Integer signed_integer(int bits, std::mt19937_64& generator) {
  Integer value = 0, unit = 1;
  for (int left = bits; left > 0; left -= 32) {
    const int part = left < 32 ? left : 32;
    value <<= part;
    value += static_cast<unsigned long>(generator() >> (64 - part));
  }
  unit <<= bits - 1;
  return value - unit;
}

double power(double base, int exponent) {
  double result = 1;
  for (int k = 0; k < exponent; ++k) result *= base;
  return result;
}

/// Solves A x = b by elimination with partial pivoting; nothing if a pivot is zero.
std::optional<std::vector<double>> solve(std::vector<std::vector<double>> a,
                                         std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::fabs(a[i][k]) > std::fabs(a[pivot][k])) pivot = i;
    if (!(std::fabs(a[pivot][k]) > 0)) return std::nullopt;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k + 1; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

/// The number that 17 significant digits of `value` denote.
Rational decimal(double value) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text - 1, value, std::chars_format::scientific, 16);
  *end.ptr = '\0';
  Rational result;
  parse_rational(text, &result);
  return result;
}

template <int D>
Polynomial<D> interpolating(const RandomOptions& options, std::mt19937_64& generator) {
  // The constant term comes first.
  const auto list = dense_exponents<D>(options.degree);
  const double lo = nearest_double(options.lo), hi = nearest_double(options.hi);
  const std::size_t n = list.size() - 1;
  for (;;) {
    std::vector<std::vector<double>> matrix(n, std::vector<double>(n));
    for (auto& row : matrix) {
      Point<D> point;
      for (double& c : point) c = lo + (hi - lo) * (0.5 + 0.5 * symmetric_random(generator));
      for (std::size_t k = 0; k < n; ++k) {
        row[k] = 1;
        for (int i = 0; i < D; ++i) row[k] *= power(point[i], list[k + 1][i]);
      }
    }
    const auto solution = solve(std::move(matrix), std::vector<double>(n, -1.0));
    if (!solution) continue;  // the points lie on a curve through the origin, by rare chance
    std::vector<typename Polynomial<D>::Term> terms{{list[0], 1}};
    bool finite = true;
    for (std::size_t k = 0; k < n; ++k) {
      finite = finite && std::isfinite((*solution)[k]);
      if (finite) terms.push_back({list[k + 1], decimal((*solution)[k])});
    }
    if (finite) return Polynomial<D>::from_terms(std::move(terms));
  }
}

template <int D>
Polynomial<D> dense(const RandomOptions& options, std::mt19937_64& generator) {
  std::vector<typename Polynomial<D>::Term> terms;
  for (const auto& e : dense_exponents<D>(options.degree))
    terms.push_back({e, signed_integer(options.bits, generator)});
  return Polynomial<D>::from_terms(std::move(terms));
}

}  // namespace

template <int D>
std::vector<Polynomial<D>> random_polynomials(const RandomOptions& options) {
  std::mt19937_64 generator(options.seed);
  std::vector<Polynomial<D>> list;
  while (static_cast<int>(list.size()) < options.count) {
    Polynomial<D> f = options.kind == RandomOptions::Kind::Interpolating
                          ? interpolating<D>(options, generator)
                          : dense<D>(options, generator);
    if (!f.is_constant()) list.push_back(std::move(f));
  }
  return list;
}

std::vector<NamedCurve> random_curves(const RandomOptions& options) {
  std::vector<NamedCurve> curves;
  for (Polynomial<2>& f : random_polynomials<2>(options))
    curves.push_back({"c" + std::to_string(curves.size()), std::move(f)});
  return curves;
}

template std::vector<Exponent<2>> dense_exponents<2>(int);
template std::vector<Exponent<3>> dense_exponents<3>(int);
template std::vector<Polynomial<1>> random_polynomials<1>(const RandomOptions&);
template std::vector<Polynomial<2>> random_polynomials<2>(const RandomOptions&);
template std::vector<Polynomial<3>> random_polynomials<3>(const RandomOptions&);

}  // namespace encase
