// SPDX-License-Identifier: MIT
#include "2d/saddles.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

constexpr int kSteps = 4;  // of Newton's iteration

/// The saddle, with the normal of the line on which its neighbourhood falls apart.
Saddle saddle_at(int curve, const Point<2>& at, const Jet& jet) {
  const double a = jet.xx, b = jet.xy, c = jet.yy;
  // The eigenvector whose eigenvalue has the sign of f is the line's direction; the other its
  // normal.
  const double sign = jet.value > 0 ? 1 : -1;
  const double mean = 0.5 * (a + c), difference = 0.5 * (a - c);
  const double other = mean - sign * std::sqrt(difference * difference + b * b);
  const Point<2> first{b, other - a}, second{other - c, b};
  const auto square = [](const Point<2>& v) { return v[0] * v[0] + v[1] * v[1]; };
  return {curve, at, square(first) > square(second) ? first : second,
          std::sqrt(std::fabs(jet.value / other))};
}

}  // namespace

void append_saddles(const FilteredPolynomial<2>& f, int curve, const std::vector<Box<2>>& boxes,
                    std::vector<Saddle>* saddles) {
  const std::size_t first = saddles->size();
  const auto near = [](const Point<2>& a, const Point<2>& b, double distance) {
    return std::fabs(a[0] - b[0]) < distance && std::fabs(a[1] - b[1]) < distance;
  };
  for (const Box<2>& box : boxes) {
    const double size = box.largest_width();
    Point<2> at = box.center();
    for (int i = 0; i < kSteps; ++i) {
      const Jet jet = f.jet(at);
      const double determinant = jet.xx * jet.yy - jet.xy * jet.xy;
      if (!(determinant < 0)) break;
      const Point<2> step{(jet.gradient[0] * jet.yy - jet.gradient[1] * jet.xy) / determinant,
                          (jet.gradient[1] * jet.xx - jet.gradient[0] * jet.xy) / determinant};
      at = {at[0] - step[0], at[1] - step[1]};
      if (!near(at, box.center(), 0.75 * size)) break;
      if (std::any_of(saddles->begin() + static_cast<std::ptrdiff_t>(first), saddles->end(),
                      [&](const Saddle& s) { return near(s.at, at, 0.1 * size); }))
        break;
      if (near(step, {0, 0}, 0.1 * size)) {
        saddles->push_back(saddle_at(curve, at, jet));
        break;
      }
    }
  }
}

}  // namespace encase
