// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace encase {

/// `count` vectors of M numbers, stored number by number: components[i] points to `count` doubles.
template <int M>
using VectorList = std::array<const double*, M>;

/// Weights w with w . v > 0 for all vectors v of a list, as nearly as roundings tell, that come
/// close to the largest margin; nothing if the search finds none. A heuristic: what it finds is
/// proved where it is used. It is the search for the point of the vectors' convex hull that is
/// nearest to the origin (P. Wolfe, Finding the nearest point in a polytope, 1976); for it each
/// number is multiplied by its entry of `scale`, so that all are of about the same size.
/// Cost: some ten passes over the list.
template <int M>
std::optional<std::array<double, M>> separate(const VectorList<M>& components, int count,
                                              const std::array<double, M>& scale);

}  // namespace encase
