// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "common/random_polynomials.hpp"
#include "encase/common_points.hpp"

namespace encase {

/// Three polynomials of a degree through random points of [-1,1]^3, with coefficients that are
/// doubles.
inline std::array<Polynomial<3>, 3> random_triple(int degree, std::uint64_t seed) {
  RandomOptions options;
  options.degree = degree;
  options.count = 3;
  options.seed = seed;
  std::array<Polynomial<3>, 3> triple;
  std::size_t k = 0;
  for (const Polynomial<3>& f : random_polynomials<3>(options)) {
    std::vector<Polynomial<3>::Term> terms = f.terms();
    for (auto& term : terms) term.coefficient = Rational(nearest_double(term.coefficient));
    triple[k++] = Polynomial<3>::from_terms(std::move(terms));
  }
  return triple;
}

inline std::array<NamedSurface, 3> named(const std::array<Polynomial<3>, 3>& triple) {
  return {NamedSurface{"f", triple[0]}, NamedSurface{"g", triple[1]}, NamedSurface{"h", triple[2]}};
}

inline Polyhedron cube(const Rational& half) {
  return make_box({-half, -half, -half}, {half, half, half}).value();
}

}  // namespace encase
