// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "bernstein.hpp"
#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"
#include "kernel.hpp"

namespace encase {

/// An exact polynomial with what the kernel needs to ask about it quickly: its coefficients as
/// doubles, and on demand as MPFR intervals of any precision. Immutable but for the cache of
/// the latter, which is guarded: const queries may run in parallel.
template <int D>
class FilteredPolynomial {
 public:
  explicit FilteredPolynomial(Polynomial<D> exact);

  const Polynomial<D>& exact() const { return exact_; }
  int degree() const { return degree_; }

  /// The Bernstein form on a box whose corner lo goes to (-1, ..., -1) and hi to (1, ..., 1), of
  /// degree `net_degree` (>= degree()) in every variable. `bits` is 53 for doubles with an a-priori
  /// bound, else the precision of the MPFR intervals the local Taylor coefficients are computed in.
  /// The form is valid on lo <= x <= hi if (lo + hi) / 2 is a double, else on a slightly larger box
  /// with the doubles nearest to the centre and above the half widths.
  void expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel,
              Bernstein<D>* net) const;

  /// A double value at a point, with a proved bound on its error.
  struct Value {
    double value;
    double error;
  };
  Value evaluate(const Point<D>& point) const;

  /// A double value whose error is proved at a point, computed with `bits` of MPFR precision.
  Value evaluate(const Point<D>& point, int bits) const;

  /// The exact sign at a rational point: doubles, MPFR, then exact arithmetic. Never fails.
  Sign sign_at(const RationalPoint<D>& point, Kernel& kernel) const;

 private:
  template <int>
  friend class LineRestriction;

  struct Cache;
  Polynomial<D> exact_;
  int degree_ = 0;
  std::vector<double> coefficients_;  // dense, (degree_ + 1)^D, last variable fastest
  std::shared_ptr<Cache> cache_;
};

}  // namespace encase
