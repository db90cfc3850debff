// SPDX-License-Identifier: MIT
//
// The implementation includes CGAL's algebraic kernel, part of which is under the GPL: a program
// that links it is a combined work under the GPL. The benchmark is not installed.
#pragma once

#include <string>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase::benchmark {

/// CPU seconds that CGAL's Algebraic_kernel_d_2 with CORE numbers needs for one pair of curves.
struct CgalFigures {
  double curves = 0;       ///< both curve analyses: all event points and the arcs between them
  double solve = 0;        ///< Solve_2 after that: all common points in the plane
  double coordinates = 0;  ///< both coordinates of every common point to 2^-53
  int roots = 0;           ///< common points in the plane
  int roots_in_box = 0;
  double total() const { return curves + solve + coordinates; }
};

/// The release of CGAL, or nothing if the program was built without it.
std::string cgal_version();

/// One run from integer coefficients, with a kernel of its own, so that nothing is cached.
CgalFigures run_cgal(const Polynomial<2>& f, const Polynomial<2>& g, const Box<2>& box);

/// The same with Solve_2 restricted to the box, and the coordinates of what lies in it.
CgalFigures run_cgal_in_box(const Polynomial<2>& f, const Polynomial<2>& g, const Box<2>& box);

}  // namespace encase::benchmark
