// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <optional>

#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// A closed box, kept with its centre and half widths, so that the side of a line on which it lies
/// is nearly always told by one scalar product.
struct Place {
  Place() = default;
  Place(const Box<2>& around);
  Place(const std::array<Interval, 2>& at);

  Box<2> box;
  Point<2> center{};
  Point<2> half{};  ///< rounded up: the box lies in center +- half

  Interval range(int axis) const { return {box.lo[axis], box.hi[axis]}; }
  bool finite() const;
};

/// normal . x + offset at the place's centre, and a bound on its distance from the exact values on
/// the whole place (docs/error-bounds.md, section 8). For a line whose doubles are exact.
struct LineValue {
  double value;
  double error;
};
inline LineValue value_at(const Line& line, const Place& place) {
  const double x = line.normal[0] * place.center[0], y = line.normal[1] * place.center[1];
  const double reach =
      std::fabs(line.normal[0]) * place.half[0] + std::fabs(line.normal[1]) * place.half[1];
  const double sum = std::fabs(x) + std::fabs(y) + std::fabs(line.offset);
  return {x + y + line.offset, reach * (1 + 0x1p-50) + 0x1p-51 * sum + 0x1p-1000};
}

/// normal . x + offset, approximately.
inline double height(const Line& line, const Point<2>& at) {
  return line.normal[0] * at[0] + line.normal[1] * at[1] + line.offset;
}

/// The side of the line on which the whole place lies, if it does not meet the line. Exact.
std::optional<Sign> side(const Line& line, const Place& place, Kernel& kernel);

/// Where two lines meet, enclosed; infinite if they are or nearly are parallel.
Place meeting_place(const Line& first, const Line& second);

}  // namespace encase
