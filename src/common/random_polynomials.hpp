// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/polynomial.hpp"

/// Random input for tests, benchmarks and `encase random`, and the perturbation of a given one.
/// Equal seeds give equal polynomials everywhere: the generator is fixed by the C++ standard and
/// numbers are made from its bits here.
namespace encase {

struct RandomOptions {
  enum class Kind {
    Interpolating,  ///< through as many random points of the box as determine the polynomial, up to
                    ///< the constant coefficient, which is 1
    Dense           ///< every coefficient uniform among the signed integers of `bits` bits
  };
  Kind kind = Kind::Interpolating;
  int degree = 5;
  int count = 2;
  std::uint64_t seed = 1;
  Rational lo = -1;  ///< the box [lo, hi]^D
  Rational hi = 1;
  int bits = 32;  ///< of the coefficients of Dense
};

/// `count` polynomials of total degree at most `degree` (exactly, but for chance). Those that
/// interpolate have coefficients of 17 decimal digits, from a system solved in doubles: they pass
/// near their points. Requires 1 <= degree <= kMaxDegree, lo < hi, bits >= 1. Cost of an
/// interpolating one: the cube of the number of its coefficients.
template <int D>
std::vector<Polynomial<D>> random_polynomials(const RandomOptions& options);

/// random_polynomials<2>, named c0, c1, ...
std::vector<NamedCurve> random_curves(const RandomOptions& options);

/// All exponents of total degree at most `degree`, in ascending lexicographic order.
template <int D>
std::vector<Exponent<D>> dense_exponents(int degree);

/// Uniform among the odd multiples of 2^-53 in (-1, 1).
double symmetric_random(std::mt19937_64& generator);

}  // namespace encase
