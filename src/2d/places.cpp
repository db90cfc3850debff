// SPDX-License-Identifier: MIT
#include "2d/places.hpp"

#include <algorithm>
#include <cmath>

#include "common/segments.hpp"

namespace encase {

Place::Place(const Box<2>& around) : box(around), center(around.center()) {
  for (int i = 0; i < 2; ++i)
    half[i] = round_up(std::max(box.hi[i] - center[i], center[i] - box.lo[i]));
}

Place::Place(const std::array<Interval, 2>& at)
    : Place(Box<2>{{at[0].lo, at[1].lo}, {at[0].hi, at[1].hi}}) {}

bool Place::finite() const {
  return std::isfinite(box.lo[0]) && std::isfinite(box.lo[1]) && std::isfinite(box.hi[0]) &&
         std::isfinite(box.hi[1]);
}

std::optional<Sign> side(const Line& line, const Place& place, Kernel& kernel) {
  const LineValue at = value_at(line, place);
  if (!line.rational && std::fabs(at.value) > at.error) {
    ++kernel.decisions.by_double;
    return at.value > 0 ? Sign::Positive : Sign::Negative;
  }
  return side(line, place.box, kernel);
}

Place meeting_place(const Line& first, const Line& second) {
  if (!first.rational && !second.rational) {
    const double a = first.normal[0], b = first.normal[1], c = first.offset;
    const double d = second.normal[0], e = second.normal[1], f = second.offset;
    const double ae = a * e, bd = b * d, determinant = ae - bd;
    const double determinant_error = 0x1p-51 * (std::fabs(ae) + std::fabs(bd)) + 0x1p-1000;
    const double least = std::fabs(determinant) - determinant_error;
    if (least > 0x1p-20 * (std::fabs(ae) + std::fabs(bd))) {
      Box<2> box;
      const double p[] = {b * f, c * d}, q[] = {c * e, a * f};
      for (int i = 0; i < 2; ++i) {
        const double at = (p[i] - q[i]) / determinant;
        const double numerator_error = 0x1p-51 * (std::fabs(p[i]) + std::fabs(q[i])) + 0x1p-1000;
        const double error =
            (numerator_error + std::fabs(at) * determinant_error) / least * (1 + 0x1p-40) +
            0x1p-52 * std::fabs(at) + 0x1p-1000;
        box.lo[i] = round_down(at - error);
        box.hi[i] = round_up(at + error);
      }
      return box;
    }
  }
  return meet(first, second);
}

}  // namespace encase
