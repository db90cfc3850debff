// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "encase/geometry.hpp"

namespace encase {

/// An affine map from [-1,1] to R^2 that parametrises a segment: of a line, or between two points.
class SegmentChart {
 public:
  /// The part of a line whose parameter (see `parameter_axis`) lies in [lo, hi]; s = -1 is lo. The
  /// chart covers at least that part.
  static SegmentChart of_line(const Line& line, double lo, double hi);
  /// The segment from s = -1 to s = 1.
  static SegmentChart between(const Point<2>& from, const Point<2>& to);
  /// The part lo <= s <= hi of a segment between two points, or slightly more.
  SegmentChart part(double lo, double hi) const;

  /// The coordinates are origin + direction s; `Number`: double, long double or Mpfr.
  template <class Number>
  void origin_and_direction(std::array<Number, 2>* origin, std::array<Number, 2>* direction) const;
  /// Roundings in a coordinate of the origin or direction, at most.
  int roundings() const;
  /// At least the sums of the absolute values of the terms that make up the coordinates.
  Point<2> reach() const;

 private:
  Line line_;
  bool on_line_ = false;
  double lo_ = -1, hi_ = 1;  ///< of the line's parameter, or of the segment's s
  Point<2> from_{}, to_{};
};

/// For |t| <= reach: a bound on |a t / b| + |c / b|, the terms of the other coordinate of the
/// line's point with parameter t. Its rounding error is relative to this, also where something
/// underflows.
double reach_across(const Line& line, double reach);

}  // namespace encase
