// SPDX-License-Identifier: MIT
#include "3d/arc_direction.hpp"

namespace encase {

std::optional<Polynomial<3>> arc_direction(const Function<3>& f, const Function<3>& g,
                                           const Point<3>& w) {
  if (!f.is_polynomial() || !g.is_polynomial()) return std::nullopt;
  Polynomial<3> sum;
  for (int i = 0; i < 3; ++i) {
    if (w[i] == 0) continue;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Polynomial<3>&a = f.polynomial(), &b = g.polynomial();
    sum = sum + Polynomial<3>::constant(Rational(w[i])) *
                    (a.derivative(j) * b.derivative(k) - a.derivative(k) * b.derivative(j));
  }
  return sum;
}

}  // namespace encase
