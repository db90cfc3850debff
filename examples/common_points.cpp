// SPDX-License-Identifier: MIT
//
// All points in which a sphere, a plane and a saddle meet.
#include <cstdio>

#include "encase/common_points.hpp"

int main() {
  using namespace encase;
  const auto x = Polynomial<3>::variable(0), y = Polynomial<3>::variable(1),
             z = Polynomial<3>::variable(2), one = Polynomial<3>::constant(1);
  const auto region = make_box({-2, -2, -2}, {2, 2, 2}).value();
  const std::array<NamedSurface, 3> surfaces{NamedSurface{"sphere", x * x + y * y + z * z - one},
                                             NamedSurface{"plane", x + y + z},
                                             NamedSurface{"saddle", z - x * y}};
  const CommonPoints result = common_points(surfaces, region).value();
  for (const CommonPoint& p : result.points)
    std::printf("(%.17g, %.17g, %.17g)\n", p.point[0], p.point[1], p.point[2]);
  const bool proved = result.outcome == Outcome::Certified && verify(result).ok();
  std::printf("%zu points, %s\n", result.points.size(), proved ? "proved" : "not proved");
  return proved ? 0 : 1;
}
