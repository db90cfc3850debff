// SPDX-License-Identifier: MIT
#include "common/local_jet.hpp"

#include <cmath>

namespace encase {

template <int D>
LocalJet<D> LocalJet<D>::of(Operation operation, int exponent) const {
  const double u = value;
  switch (operation) {
    case Operation::Negate:
      return composed(-u, -1, 0);
    case Operation::Power: {
      const double n = exponent;
      return composed(std::pow(u, n), n == 0 ? 0 : n * std::pow(u, n - 1),
                      n == 0 || n == 1 ? 0 : n * (n - 1) * std::pow(u, n - 2));
    }
    case Operation::Sqrt: {
      const double g = std::sqrt(u);
      return composed(g, 0.5 / g, -0.25 / (g * u));
    }
    case Operation::Exp: {
      const double g = std::exp(u);
      return composed(g, g, g);
    }
    case Operation::Log:
      return composed(std::log(u), 1 / u, -1 / (u * u));
    case Operation::Sin:
      return composed(std::sin(u), std::cos(u), -std::sin(u));
    case Operation::Cos:
      return composed(std::cos(u), -std::sin(u), -std::cos(u));
    case Operation::Tan: {
      const double g = std::tan(u), slope = 1 + g * g;
      return composed(g, slope, 2 * g * slope);
    }
    case Operation::Asin:
    case Operation::Acos: {
      const double square = 1 - u * u, slope = 1 / std::sqrt(square), bend = u * slope / square;
      return operation == Operation::Asin ? composed(std::asin(u), slope, bend)
                                          : composed(std::acos(u), -slope, -bend);
    }
    case Operation::Atan: {
      const double slope = 1 / (1 + u * u);
      return composed(std::atan(u), slope, -2 * u * slope * slope);
    }
    case Operation::Sinh:
      return composed(std::sinh(u), std::cosh(u), std::sinh(u));
    case Operation::Cosh:
      return composed(std::cosh(u), std::sinh(u), std::cosh(u));
    case Operation::Tanh: {
      const double g = std::tanh(u), slope = 1 - g * g;
      return composed(g, slope, -2 * g * slope);
    }
    case Operation::Abs:
      return u < 0 ? composed(-u, -1, 0) : *this;
    default:
      return *this;
  }
}

template struct LocalJet<1>;
template struct LocalJet<2>;
template struct LocalJet<3>;

}  // namespace encase
