// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "common/bernstein.hpp"
#include "common/coefficient_rows.hpp"
#include "common/kernel.hpp"
#include "common/segment_chart.hpp"
#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"

namespace encase {

/// An exact polynomial with what the kernel needs to ask about it quickly: its coefficients as
/// doubles, and on demand as pairs of doubles, in extended precision and in MPFR. Scaled by a power
/// of two so that the largest coefficient lies in [1/2, 2). Immutable but for the cache of what is
/// made on demand, which is guarded: const queries may run in parallel. The error bounds are
/// derived in docs/error-bounds.md.
template <int D>
class FilteredPolynomial {
 public:
  explicit FilteredPolynomial(Polynomial<D> exact);

  const Polynomial<D>& exact() const { return exact_; }
  int degree() const { return degree_; }
  /// The power of two (rounded into the range of doubles) by which scaled values are to be
  /// multiplied.
  double scale() const { return std::ldexp(1.0, exponent_); }

  /// The scaled coefficients: dense, (degree() + 1)^D, last variable fastest. Each is within one
  /// unit in the last place of the exact one, or within 2^-1022.
  const std::vector<double>& coefficients() const { return coefficients_; }
  /// Whether coefficients() are the scaled coefficients exactly.
  bool exact_coefficients() const { return exact_coefficients_; }
  /// In the same layout what coefficients() lack: the sum of both is within 2^-104 of the exact
  /// coefficient, relatively, or within 2^-1022. All zero if coefficients() are exact.
  const std::vector<double>& low_coefficients() const;

  /// The Bernstein form on a box whose corner lo goes to (-1, ..., -1) and hi to (1, ..., 1), of
  /// degree `net_degree` (>= degree()) in every variable. `bits` is 53 for doubles, else the MPFR
  /// precision in which the local Taylor coefficients are computed. The form is valid on
  /// lo <= x <= hi if (lo + hi) / 2 is a double, else on a slightly larger box around the double
  /// nearest to the centre.
  void expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel, Bernstein<D>* net) const;

  /// Taylor's coefficients in the coordinates [-1,1]^D of a box (as in `expand`), dense, degree()
  /// in every variable, and the sum of their errors.
  struct Taylor {
    std::vector<double> coefficients;
    double error;
  };
  Taylor taylor(const Box<D>& box, int bits, Kernel& kernel) const;

  /// The Bernstein form on a segment, of degree degree().
  void restrict_to(const SegmentChart& segment, int bits, Kernel& kernel, Bernstein<1>* net) const
      requires(D == 2);

  /// A double and a proved bound on its distance from the exact (scaled) value.
  struct Value {
    double value;
    double error;
  };
  Value evaluate(const Point<D>& point, int bits) const;
  /// In doubles at a point of which `point` is an approximation: every coordinate comes from at
  /// most `roundings` roundings of sums of terms whose absolute values add up to at most
  /// `magnitude`.
  Value evaluate_rounded(const Point<D>& point, const Point<D>& magnitude, int roundings) const;

  /// Approximate (scaled) value and derivatives, for heuristics and Newton steps.
  double approximate(const Point<D>& point) const;
  Point<D> gradient(const Point<D>& point) const;
  struct ValueAndGradient {
    double value;
    Point<D> gradient;
  };
  ValueAndGradient value_and_gradient(const Point<D>& point) const;
  Jet jet(const Point<D>& point) const requires(D == 2);

  /// The exact sign at a rational point: doubles, MPFR, then exact arithmetic. Never fails.
  Sign sign_at(const RationalPoint<D>& point, Kernel& kernel) const;

  /// |f|(x) for x >= 0: the sum of |coefficient| x_0^i x_1^j ..., rounded up.
  double absolute(const Point<D>& magnitude) const;

 private:
  struct Cache;
  static std::size_t index_of(const Exponent<D>& exponent, int degree);
  Rational scaled(const Rational& coefficient) const;
  void set_coefficient(std::size_t index, const Rational& exact);
  /// `Number` stands for the precision `bits`.
  template <class Number>
  const std::vector<Number>& coefficients_in(int bits) const;
  /// run(coefficients) in the numbers that `bits` stands for.
  template <class Run>
  void with_coefficients(int bits, Kernel& kernel, Run run) const;
  template <class Number, class Coordinate>
  Number sum(const std::vector<Number>& coefficients, const std::array<Coordinate, D>& point,
             int bits) const;
  template <class Coordinate>
  double value_at(const std::array<Coordinate, D>& point, int bits) const;
  int roundings_at_point() const;
  Point<D> gradient_by_horner(const Point<D>& point) const;
  Value with_error(double value, const Point<D>& magnitude, int roundings, int bits) const;

  Polynomial<D> exact_;
  int degree_ = 0;
  int exponent_ = 0;                  ///< the scaled polynomial is exact_ / 2^exponent_
  std::vector<double> coefficients_;  ///< dense, (degree_ + 1)^D, last variable fastest
  bool exact_coefficients_ = true;    ///< the doubles are the scaled coefficients
  std::vector<double> magnitudes_;    ///< |coefficients_|, rounded up
  CoefficientRows rows_;              ///< in two variables, of coefficients_
  std::shared_ptr<Cache> cache_;
};

}  // namespace encase
