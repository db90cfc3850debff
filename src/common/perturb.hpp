// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "encase/polynomial.hpp"

namespace encase {

/// Adds u (1 + |c|) to every coefficient c of the dense polynomial of f's total degree, zero ones
/// included; every u is delta times an odd multiple of 2^-53 drawn uniformly from (-1, 1). Exact;
/// the zero polynomial stays as it is. (Masterjohn 2017, section 4.1; zero coefficients are
/// perturbed too, so that y^2 - x^3 loses its cusp.) Requires a finite delta > 0.
template <int D>
Polynomial<D> perturb(const Polynomial<D>& f, double delta, std::mt19937_64& generator);

}  // namespace encase
