// SPDX-License-Identifier: MIT
#include "cgal_roots.hpp"

#include <CGAL/Algebraic_kernel_d_2.h>
#include <CGAL/CORE_BigInt.h>

#include <utility>
#include <vector>

#include "cgal_polynomial.hpp"

namespace {

using Coefficient = CGAL::CORE_arithmetic_kernel::Integer;
using Kernel = CGAL::Algebraic_kernel_d_2<Coefficient>;
using Polynomial = Kernel::Polynomial_2;

encase::Rational to_rational(const Kernel::Bound& bound) {
  encase::Rational r(bound.get_mp());
  return r;
}

}  // namespace

struct CgalRoots::Roots {
  Kernel kernel;
  std::vector<std::pair<Kernel::Algebraic_real_2, Kernel::Multiplicity_type>> list;
};

CgalRoots::CgalRoots(const encase::Polynomial<2>& f, const encase::Polynomial<2>& g)
    : roots_(std::make_unique<Roots>()) {
  const auto integral = &with_integer_coefficients<Polynomial, Coefficient>;
  roots_->kernel.solve_2_object()(integral(f), integral(g), std::back_inserter(roots_->list));
}

CgalRoots::~CgalRoots() = default;

int CgalRoots::size() const { return static_cast<int>(roots_->list.size()); }

int CgalRoots::multiplicity(int i) const { return static_cast<int>(roots_->list[i].second); }

CgalRoots::Enclosure CgalRoots::enclose(int i, int bits) const {
  const auto& root = roots_->list[i].first;
  const auto x = roots_->kernel.approximate_absolute_x_2_object()(root, bits);
  const auto y = roots_->kernel.approximate_absolute_y_2_object()(root, bits);
  return {{to_rational(x.first), to_rational(y.first)},
          {to_rational(x.second), to_rational(y.second)}};
}
