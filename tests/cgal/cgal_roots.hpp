// SPDX-License-Identifier: MIT
//
// The implementation includes CGAL's algebraic kernel, which is under the GPL: a program that links
// it is a combined work under the GPL. It serves tests only and is not installed.
#pragma once

#include <memory>

#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

/// All common points of two coprime, square-free polynomials in the plane, by CGAL's
/// Algebraic_kernel_d_2 (resultants and cylindrical decomposition), in lexicographic order.
class CgalRoots {
 public:
  CgalRoots(const encase::Polynomial<2>& f, const encase::Polynomial<2>& g);
  ~CgalRoots();

  int size() const;
  /// The multiplicity of root i as CGAL counts it.
  int multiplicity(int i) const;

  struct Enclosure {
    encase::RationalPoint<2> lo;
    encase::RationalPoint<2> hi;
  };
  /// A closed box of width at most 2^-bits that holds root i. The cost grows with bits.
  Enclosure enclose(int i, int bits) const;

 private:
  struct Roots;
  std::unique_ptr<Roots> roots_;
};
