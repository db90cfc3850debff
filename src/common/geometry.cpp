// SPDX-License-Identifier: MIT
#include "encase/geometry.hpp"

#include <cmath>

#include "common/dyadic.hpp"

namespace encase {

template <int D>
Hyperplane<D> Hyperplane<D>::from_rationals(const std::array<Rational, D + 1>& coefficients) {
  Hyperplane h;
  bool exact = true;
  for (int i = 0; i <= D; ++i) {
    double& rounded = i < D ? h.normal[i] : h.offset;
    if (const auto quick = quick_double(coefficients[i])) {
      rounded = *quick;
    } else {
      rounded = nearest_double(coefficients[i]);
      exact = exact && std::isfinite(rounded) && Rational(rounded) == coefficients[i];
    }
  }
  if (!exact) h.rational = std::make_shared<const std::array<Rational, D + 1>>(coefficients);
  return h;
}

template <int D>
std::array<Rational, D + 1> Hyperplane<D>::exact() const {
  if (rational) return *rational;
  std::array<Rational, D + 1> c;
  for (int i = 0; i < D; ++i) c[i] = normal[i];
  c[D] = offset;
  return c;
}

template struct Hyperplane<1>;
template struct Hyperplane<2>;
template struct Hyperplane<3>;

}  // namespace encase
