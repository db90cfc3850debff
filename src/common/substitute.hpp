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

/// A plane curve outside of the rectangle |x| <= half[0], |y| <= half[1], as a polynomial in (u,
/// v):
///
///   chart 0: x = half[0] / u,     y = half[1] v / u      (to the right and to the left)
///   chart 1: x = half[0] v / u,   y = half[1] / u        (above and below)
///
/// for |u| <= 1 and |v| <= 1; u = 0 is the line at infinity. Times u^degree, which makes it a
/// polynomial; exact.
Polynomial<2> outside_of_rectangle(const Polynomial<2>& f, const Point<2>& half, int chart);

}  // namespace encase
