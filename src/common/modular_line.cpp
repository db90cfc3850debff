// SPDX-License-Identifier: MIT
#include "common/modular_line.hpp"

#include <algorithm>

#include "common/dyadic.hpp"

namespace encase {
namespace {

using Residue = std::uint64_t;

constexpr int kBits = 61;
constexpr Residue kPrime = kModularPrime;
/// y = a + b t, z = c + d t
struct LineCoordinate {
  Residue offset, slope;
};
constexpr LineCoordinate kY{1034971827364859203, 1234567890123456789},
    kZ{1876543210987654321, 987654321012345679};

/// The residue of a number below 2^123: 2^61 is 1 modulo the prime.
Residue reduce(unsigned __int128 x) {
  const Residue low = static_cast<Residue>(x) & kPrime, high = static_cast<Residue>(x >> kBits);
  Residue sum = low + (high & kPrime) + (high >> kBits);
  if (sum >= kPrime) sum -= kPrime;
  return sum >= kPrime ? sum - kPrime : sum;
}
Residue product(Residue a, Residue b) { return reduce(static_cast<unsigned __int128>(a) * b); }
/// a b + c d
Residue product_sum(Residue a, Residue b, Residue c, Residue d) {
  return reduce(static_cast<unsigned __int128>(a) * b + static_cast<unsigned __int128>(c) * d);
}
Residue negative(Residue a) { return a == 0 ? 0 : kPrime - a; }

/// By Fermat's theorem a^(p - 2); p - 2 has all bits but the second lowest.
Residue inverse(Residue a) {
  Residue power = a;
  for (int bit = kBits - 2; bit >= 0; --bit) {
    power = product(power, power);
    if (bit != 1) power = product(power, a);
  }
  return power;
}

Residue residue(mpz_srcptr value) {
  const Residue magnitude =
      mpz_size(value) == 1 ? reduce(mpz_limbs_read(value)[0]) : mpz_tdiv_ui(value, kPrime);
  return mpz_sgn(value) < 0 ? negative(magnitude) : magnitude;
}

/// The coefficients modulo the prime, in the order of the terms; nothing if it divides a
/// denominator.
template <int D>
std::optional<std::vector<Residue>> coefficients(const Polynomial<D>& f) {
  const auto& terms = f.terms();
  const std::size_t n = terms.size();
  std::vector<Residue> result(n);
  // Denominators other than powers of two are inverted together, at the price of one: first the
  // product of those before each.
  std::vector<std::size_t> others;
  std::vector<Residue> denominators, before;
  Residue all = 1;
  for (std::size_t k = 0; k < n; ++k) {
    const Rational& c = terms[k].coefficient;
    result[k] = residue(c.get_num_mpz_t());
    const mpz_srcptr denominator = c.get_den_mpz_t();
    if (is_power_of_two(denominator)) {
      // The inverse of 2^e is 2^(-e modulo 61).
      const long e = (bit_length(denominator) - 1) % kBits;
      if (e > 0) result[k] = product(result[k], Residue{1} << (kBits - e));
    } else {
      others.push_back(k);
      denominators.push_back(residue(denominator));
      before.push_back(all);
      all = product(all, denominators.back());
    }
  }
  if (all == 0) return std::nullopt;
  if (others.empty()) return result;
  Residue rest = inverse(all);
  for (std::size_t i = others.size(); i-- > 0;) {
    result[others[i]] = product(result[others[i]], product(rest, before[i]));
    rest = product(rest, denominators[i]);
  }
  return result;
}

void drop_zeros(ModularPolynomial& f) {
  while (!f.empty() && f.back() == 0) f.pop_back();
}

/// Turns f into a remainder of f times a constant by g, of lower degree than g, which is not zero.
void remainder(ModularPolynomial& f, const ModularPolynomial& g) {
  if (g.size() == 1) f.clear();
  while (f.size() >= g.size()) {
    const Residue lead = g.back(), factor = negative(f.back());
    const std::size_t shift = f.size() - g.size();
    for (std::size_t k = 0; k < shift; ++k) f[k] = product(f[k], lead);
    for (std::size_t k = 0; k + 1 < g.size(); ++k)
      f[shift + k] = product_sum(f[shift + k], lead, g[k], factor);
    f.pop_back();
    drop_zeros(f);
  }
}

bool coprime_in_place(ModularPolynomial& f, ModularPolynomial& g) {
  while (!f.empty() && !g.empty()) {
    if (f.size() < g.size()) f.swap(g);
    remainder(f, g);
  }
  return f.size() + g.size() == 1;
}

/// A step of Horner's rule: the first `count` coefficients become those of the polynomial times the
/// line's coordinate, plus the row.
void times_plus(const LineCoordinate& at, const Residue* row, std::size_t count,
                ModularPolynomial* result) {
  for (std::size_t k = count; k-- > 0;) {
    const Residue moved = k > 0 ? (*result)[k - 1] : 0;
    Residue& value = (*result)[k];
    value = product_sum(value, at.offset, moved, at.slope) + row[k];
    if (value >= kPrime) value -= kPrime;
  }
}

}  // namespace

std::optional<ModularPolynomial> restrict_modulo_prime(const Polynomial<3>& f) {
  const auto coefficient = coefficients(f);
  if (!coefficient) return std::nullopt;
  const std::size_t size = static_cast<std::size_t>(f.degree()) + 1;
  std::vector<Residue> dense(size * size * size);  // that of x^i y^j z^k in row j of layer k
  auto next = coefficient->begin();
  for (const auto& term : f.terms())
    dense[(static_cast<std::size_t>(term.exponent[2]) * size +
           static_cast<std::size_t>(term.exponent[1])) *
              size +
          static_cast<std::size_t>(term.exponent[0])] = *next++;
  ModularPolynomial result(size);
  for (std::size_t k = size; k-- > 0;) {
    ModularPolynomial layer(size);
    for (std::size_t j = size - k; j-- > 0;)
      times_plus(kY, &dense[(k * size + j) * size], size - k - j, &layer);
    times_plus(kZ, layer.data(), size - k, &result);
  }
  if (result.back() == 0) return std::nullopt;
  return result;
}

std::optional<ModularPolynomial> restrict_modulo_prime(const Polynomial<2>& f) {
  const auto coefficient = coefficients(f);
  if (!coefficient) return std::nullopt;
  const std::size_t size = static_cast<std::size_t>(f.degree()) + 1;
  std::vector<Residue> dense(size * size);  // that of x^i y^j in row j
  auto next = coefficient->begin();
  for (const auto& term : f.terms())
    dense[static_cast<std::size_t>(term.exponent[1]) * size +
          static_cast<std::size_t>(term.exponent[0])] = *next++;
  ModularPolynomial result(size);
  for (std::size_t j = size; j-- > 0;) times_plus(kY, &dense[j * size], size - j, &result);
  if (result.back() == 0) return std::nullopt;
  return result;
}

bool coprime(const ModularPolynomial& f, const ModularPolynomial& g) {
  ModularPolynomial a = f, b = g;
  return coprime_in_place(a, b);
}

bool square_free(const ModularPolynomial& f) {
  ModularPolynomial a = f, derivative(f.size() - 1);
  for (std::size_t k = 1; k < f.size(); ++k) derivative[k - 1] = product(f[k], k);
  return coprime_in_place(a, derivative);
}

}  // namespace encase
