// SPDX-License-Identifier: MIT
#pragma once

#include <random>
#include <string>
#include <vector>

#include "encase/encasement.hpp"

/// Circles with rational centres and radii: how often two cross is known in closed form.
namespace encase {

struct Circle {
  int x, y, r;  // in thousandths
};

inline std::vector<NamedCurve> curves_of(const std::vector<Circle>& circles) {
  std::vector<NamedCurve> curves;
  for (const Circle& c : circles) {
    const Rational x(c.x, 1000), y(c.y, 1000), r(c.r, 1000);
    curves.push_back({"c" + std::to_string(curves.size()),
                      Polynomial<2>::from_terms({{{2, 0}, 1},
                                                 {{0, 2}, 1},
                                                 {{1, 0}, Rational(-2 * x)},
                                                 {{0, 1}, Rational(-2 * y)},
                                                 {{0, 0}, Rational(x * x + y * y - r * r)}})});
  }
  return curves;
}

/// Circles in general position well inside the square [-1,1]^2.
inline std::vector<Circle> random_circles(int count, int least, int most, unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](int lo, int hi) {
    return lo + static_cast<int>(random() % static_cast<unsigned>(hi - lo + 1));
  };
  std::vector<Circle> circles;
  while (static_cast<int>(circles.size()) < count) {
    const int r = between(least, most);
    circles.push_back({between(-990 + r, 990 - r), between(-990 + r, 990 - r), r});
  }
  return circles;
}

/// Two, where the distance of the centres lies between the difference and the sum of the radii.
inline int common_points(const Circle& a, const Circle& b) {
  const int dx = a.x - b.x, dy = a.y - b.y, d2 = dx * dx + dy * dy;
  const int sum = a.r + b.r, difference = a.r - b.r;
  return difference * difference < d2 && d2 < sum * sum ? 2 : 0;
}

}  // namespace encase
