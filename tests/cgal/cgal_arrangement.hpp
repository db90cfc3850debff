// SPDX-License-Identifier: MIT
//
// The implementation includes CGAL's arrangements, which are under the GPL: a program that links it
// is a combined work under the GPL. It serves tests and the benchmark only and is not installed.
#pragma once

#include <vector>

#include "encase/polynomial.hpp"

/// What CGAL's Arrangement_2 with Arr_algebraic_segment_traits_2 counts for square-free, pairwise
/// coprime curves in the whole plane.
struct CgalArrangement {
  int crossings = 0;              ///< vertices where more than two edges meet
  int faces = 0;                  ///< the unbounded ones included
  double seconds = 0;             ///< of CPU
  double coordinate_seconds = 0;  ///< after that, for the vertices' coordinates as doubles
};
/// Finds the coordinates only if asked.
CgalArrangement cgal_arrangement(const std::vector<encase::Polynomial<2>>& curves,
                                 bool coordinates = false);
