// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase {

/// f with a polynomial in K variables in place of each of its D variables: a restriction to a line
/// (K = 1) or a plane (K = 2) where those are affine. Exact.
template <int K, int D>
Polynomial<K> substitute(const Polynomial<D>& f, const std::array<Polynomial<K>, D>& replacements);

/// A plane curve on a line, as a polynomial in the line's parameter (see parameter_axis).
Polynomial<1> restrict_exactly(const Polynomial<2>& f, const Line& line);

}  // namespace encase
