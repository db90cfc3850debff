// SPDX-License-Identifier: MIT
//
// The curve in which a sphere and a saddle meet, as a polyline within 10^-6.
#include <encase/intersection_curves.hpp>
#include <iostream>

int main() {
  using Surface = encase::Polynomial<3>;
  const auto x = Surface::variable(0), y = Surface::variable(1), z = Surface::variable(2);
  const auto sphere = x * x + y * y + z * z - Surface::constant(1), saddle = z - x * y;
  const auto region = encase::make_box({-2, -2, -2}, {2, 2, 2}).value();
  const auto result = encase::intersect(sphere, saddle, region, 1e-6).value();
  if (result.encasement.outcome != encase::Outcome::Certified) return 1;  // not all is proved
  for (const auto& curve : result.curves)
    for (std::size_t k = 0; k < curve.points.size(); ++k)
      for (const auto& v : {curve.points[k], curve.tangents[k], curve.normals[k][0]})
        std::cout << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
}
