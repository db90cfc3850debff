// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "encase/geometry.hpp"

/// Proved bounds of a surface's function near a place, for tracing and meshing.
namespace encase {

using IntervalVector = std::array<Interval, 3>;

/// The largest absolute value.
inline double magnitude(const Interval& a) { return std::fmax(std::fabs(a.lo), std::fabs(a.hi)); }

inline Interval dot(const IntervalVector& a, const IntervalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
/// A point's coordinates as intervals.
inline IntervalVector exactly(const Point<3>& p) { return {p[0], p[1], p[2]}; }

/// Ranges of the derivatives of a function on a closed box, in input coordinates.
struct DerivativeRanges {
  IntervalVector first;
  std::array<IntervalVector, 3> second;

  /// The second derivative in a direction: u^T H u.
  Interval second_along(const IntervalVector& u) const;
};

/// A function f = p + e on a box: derivatives of p at the box's centre, the ranges of its third
/// ones on the box, and bounds of every first and second derivative of e there.
struct ModelDerivatives {
  Point<3> center;
  IntervalVector first;
  std::array<IntervalVector, 3> second;
  std::array<std::array<IntervalVector, 3>, 3> third;
  double slope_error = 0, bend_error = 0;
};

/// The box with every side moved outward by at least `by`.
Box<3> inflated(const Box<3>& box, double by);

/// A function with bounds in a region of a given size. Values are scaled as FilteredFunction's.
class SurfaceBounds {
 public:
  /// `f` is to outlive this. `size`: of the region; much smaller boxes are enlarged, so that
  /// rounding does not drown what the function does in them.
  SurfaceBounds(const FilteredFunction<3>& f, double size) : f_(&f), size_(size) {}

  const FilteredFunction<3>& function() const { return *f_; }

  /// The value at a point. With `bits` more than 53 from arithmetic of that precision, still as
  /// doubles.
  Interval value(const Point<3>& point, int bits) const;
  /// What derivatives are on the box, and first ones only.
  DerivativeRanges derivatives(const Box<3>& box, int bits, Kernel& kernel) const;
  IntervalVector gradient(const Box<3>& box, int bits, Kernel& kernel) const;
  ModelDerivatives model(const Box<3>& box, Kernel& kernel) const;

 private:
  struct Net;
  Net expand(const Box<3>& box, int bits, Kernel& kernel) const;

  const FilteredFunction<3>* f_;
  double size_;
};

}  // namespace encase
