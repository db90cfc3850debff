// SPDX-License-Identifier: MIT
#include "2d/saddles.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

/// A saddle with the directions in which its neighbourhood falls apart; nothing at an extremum.
std::optional<Saddle> saddle_at(int curve, const Point<2>& at, const Jet& jet) {
  const double a = jet.xx, b = jet.xy, c = jet.yy;
  if (!(a * c < b * b)) return std::nullopt;
  // The eigenvector whose eigenvalue has the sign of f is the line's direction; the other its
  // normal.
  const double sign = jet.value > 0 ? 1 : -1;
  const double mean = 0.5 * (a + c), difference = 0.5 * (a - c);
  const double other = mean - sign * std::sqrt(difference * difference + b * b);
  const Point<2> first{b, other - a}, second{other - c, b};
  const auto square = [](const Point<2>& v) { return v[0] * v[0] + v[1] * v[1]; };
  return Saddle{curve, at, square(first) > square(second) ? first : second,
                std::sqrt(std::fabs(jet.value / other))};
}

}  // namespace

void append_saddles(const FilteredPolynomial<2>& f, int curve, const std::vector<Box<2>>& boxes,
                    std::vector<Saddle>* saddles) {
  const std::size_t first = saddles->size();
  for (const Box<2>& box : boxes) {
    const Point<2> center = box.center();
    const double allowed = 0.75 * box.largest_width();
    Point<2> at = center;
    bool converged = false;
    Jet jet;
    for (int i = 0; i < 5 && !converged; ++i) {
      jet = f.jet(at);
      const double determinant = jet.xx * jet.yy - jet.xy * jet.xy;
      if (!(determinant < 0)) break;
      const Point<2> step{(jet.gradient[0] * jet.yy - jet.gradient[1] * jet.xy) / determinant,
                          (jet.gradient[1] * jet.xx - jet.gradient[0] * jet.xy) / determinant};
      at = {at[0] - step[0], at[1] - step[1]};
      if (!(std::fabs(at[0] - center[0]) < allowed && std::fabs(at[1] - center[1]) < allowed))
        break;
      converged = std::max(std::fabs(step[0]), std::fabs(step[1])) < 1e-3 * allowed;
    }
    if (!converged) continue;
    const bool seen = std::any_of(saddles->begin() + static_cast<std::ptrdiff_t>(first),
                                  saddles->end(), [&](const Saddle& s) {
                                    return std::fabs(s.at[0] - at[0]) < 0.02 * allowed &&
                                           std::fabs(s.at[1] - at[1]) < 0.02 * allowed;
                                  });
    if (seen) continue;
    if (const auto saddle = saddle_at(curve, at, jet)) saddles->push_back(*saddle);
  }
}

}  // namespace encase
