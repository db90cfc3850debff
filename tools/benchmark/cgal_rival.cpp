// SPDX-License-Identifier: MIT
#include "cgal_rival.hpp"

#include <CGAL/Algebraic_kernel_d_2.h>
#include <CGAL/CORE_BigInt.h>
#include <CGAL/version.h>

#include <iterator>
#include <utility>
#include <vector>

#include "stopwatch.hpp"

namespace encase::benchmark {
namespace {

using Coefficient = CGAL::CORE_arithmetic_kernel::Integer;
using Kernel = CGAL::Algebraic_kernel_d_2<Coefficient>;
using CgalPolynomial = Kernel::Polynomial_2;
using Roots = std::vector<std::pair<Kernel::Algebraic_real_2, Kernel::Multiplicity_type>>;

/// The polynomial times the least common denominator of its coefficients.
CgalPolynomial with_integer_coefficients(const Polynomial<2>& f) {
  Integer denominator = 1;
  for (const auto& term : f.terms())
    mpz_lcm(denominator.get_mpz_t(), denominator.get_mpz_t(),
            term.coefficient.get_den().get_mpz_t());
  std::vector<std::pair<CGAL::Exponent_vector, Coefficient>> terms;
  for (const auto& term : f.terms()) {
    const Integer c = term.coefficient.get_num() * (denominator / term.coefficient.get_den());
    terms.emplace_back(CGAL::Exponent_vector(term.exponent[0], term.exponent[1]),
                       Coefficient(c.get_str()));
  }
  return CGAL::Polynomial_traits_d<CgalPolynomial>::Construct_polynomial()(terms.begin(),
                                                                           terms.end());
}

/// Makes all that the analysis of a curve consists of; unasked, CGAL makes it when needed.
void analyse(const Kernel::Curve_analysis_2& curve) {
  const int events = static_cast<int>(curve.number_of_status_lines_with_event());
  for (int i = 0; i < events; ++i) curve.status_line_at_event(i);
  for (int i = 0; i <= events; ++i) curve.status_line_of_interval(i);
}

Rational middle(const std::pair<Kernel::Bound, Kernel::Bound>& bounds) {
  return (Rational(bounds.first.get_mp()) + Rational(bounds.second.get_mp())) / 2;
}

bool in_interval(const Rational& value, double lo, double hi) {
  return Rational(lo) <= value && value <= Rational(hi);
}

/// Makes the coordinates of all roots and counts the roots in the box.
int find_coordinates(const Kernel& kernel, const Roots& roots, const Box<2>& box) {
  constexpr int kBits = 53;
  int inside = 0;
  for (const auto& [root, multiplicity] : roots) {
    const auto x = kernel.approximate_absolute_x_2_object()(root, kBits);
    const auto y = kernel.approximate_absolute_y_2_object()(root, kBits);
    inside += in_interval(middle(x), box.lo[0], box.hi[0]) &&
              in_interval(middle(y), box.lo[1], box.hi[1]);
  }
  return inside;
}

CgalFigures run(const Polynomial<2>& f, const Polynomial<2>& g, const Box<2>& box,
                bool solve_in_box) {
  const CgalPolynomial first = with_integer_coefficients(f), second = with_integer_coefficients(g);
  const Kernel kernel;
  CgalFigures figures;
  Stopwatch watch;
  for (const CgalPolynomial* p : {&first, &second}) analyse(kernel.construct_curve_2_object()(*p));
  figures.curves = watch.lap();

  Roots roots;
  const auto out = std::back_inserter(roots);
  if (solve_in_box)
    kernel.solve_2_object()(first, second, Kernel::Bound(box.lo[0]), Kernel::Bound(box.hi[0]),
                            Kernel::Bound(box.lo[1]), Kernel::Bound(box.hi[1]), out);
  else
    kernel.solve_2_object()(first, second, out);
  figures.solve = watch.lap();

  figures.roots = static_cast<int>(roots.size());
  figures.roots_in_box = find_coordinates(kernel, roots, box);
  figures.coordinates = watch.lap();
  return figures;
}

}  // namespace

std::string cgal_version() { return CGAL_STR(CGAL_VERSION); }

CgalFigures run_cgal(const Polynomial<2>& f, const Polynomial<2>& g, const Box<2>& box) {
  return run(f, g, box, false);
}

CgalFigures run_cgal_in_box(const Polynomial<2>& f, const Polynomial<2>& g, const Box<2>& box) {
  return run(f, g, box, true);
}

}  // namespace encase::benchmark
