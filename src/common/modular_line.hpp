// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "encase/polynomial.hpp"

namespace encase {

inline constexpr std::uint64_t kModularPrime = (std::uint64_t{1} << 61) - 1;

/// A polynomial in one variable modulo the prime 2^61 - 1: residues, constant coefficient first,
/// the last one not zero.
using ModularPolynomial = std::vector<std::uint64_t>;

/// The restriction of f, which is not constant, to a line x = t, y = a + b t (z = c + d t) modulo
/// the prime, for fixed a, b, c and d that no one has reason to avoid; nothing if the degree of the
/// restriction is less than that of f or the prime divides a denominator.
std::optional<ModularPolynomial> restrict_modulo_prime(const Polynomial<2>& f);
std::optional<ModularPolynomial> restrict_modulo_prime(const Polynomial<3>& f);

/// Whether a greatest common divisor modulo the prime is constant. Neither is zero.
bool coprime(const ModularPolynomial& f, const ModularPolynomial& g);

/// Whether the polynomial, of a degree from 1 to below the prime, has no multiple factor modulo the
/// prime.
bool square_free(const ModularPolynomial& f);

}  // namespace encase
