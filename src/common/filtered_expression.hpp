// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "common/filtered_polynomial.hpp"
#include "common/taylor_model.hpp"
#include "encase/expression.hpp"

namespace encase {

template <int D>
struct LocalJet;

/// An expression with what algorithms ask about it, as FilteredPolynomial for polynomials; all from
/// Taylor models. It is not scaled, but its numerator (`numerator_of`) takes its place: models are
/// the numerator's, and claim nothing where that and a divisor are not proved to have no common
/// zero. So an expression may have a model around its poles. Where a question is about a part of
/// the plane on which there is none, error bounds are infinite. Immutable; const queries
/// may run in parallel. Precisions: 53 bits are doubles, all others MPFR.
template <int D>
class FilteredExpression {
 public:
  /// Of nets in either variable, and on lines.
  static constexpr int kDegree = 8, kLineDegree = 15;

  explicit FilteredExpression(Expression exact);

  const Expression& exact() const { return exact_; }
  int degree() const { return kDegree; }
  double scale() const { return 1; }

  /// The Taylor model of a degree up to TaylorModel::kMaxDegree on center + half * [-1,1]^D. Valid
  /// until the thread asks for another one.
  const TaylorModel<D, double>& model(const Point<D>& center, const Point<D>& half, int degree,
                                      int bits, Kernel& kernel) const;

  /// As FilteredPolynomial's. The difference between the expression and the net is no polynomial,
  /// but its k-th derivatives too are bounded by what the radius says of those of one, k <= 2, in
  /// the coordinates [-1,1]^D.
  void expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel, Bernstein<D>* net) const;
  /// Likewise; of degree kLineDegree.
  void restrict_to(const SegmentChart& segment, int bits, Kernel& kernel, Bernstein<1>* net) const
      requires(D == 2);

  using Value = typename FilteredPolynomial<D>::Value;
  Value evaluate(const Point<D>& point, int bits) const;
  Value evaluate_rounded(const Point<D>& point, const Point<D>& magnitude, int roundings) const;
  /// Climbs the ladder until the error is at most `error` or 2^-53 of the value; not a number where
  /// that cannot be had.
  double precise_value(const Point<D>& point, double error, int max_bits) const;

  double approximate(const Point<D>& point) const;
  Point<D> gradient(const Point<D>& point) const;
  using ValueAndGradient = typename FilteredPolynomial<D>::ValueAndGradient;
  ValueAndGradient value_and_gradient(const Point<D>& point) const;
  Jet jet(const Point<D>& point) const requires(D == 2);

  /// A proved sign; Zero where none is proved: the value may be zero or nearly so, or there may be
  /// none.
  Sign sign_at(const RationalPoint<D>& point, Kernel& kernel) const;

 private:
  struct Step {
    Operation operation;
    int first, second;  ///< where the operands are
    int result;         ///< where the result goes: places are used again
    int number;
    Rational constant;
  };
  /// What one thread works with, in one kind of numbers.
  template <int K, class Number>
  struct Workspace;
  template <int K, class Number>
  const TaylorModel<K, Number>& run(Workspace<K, Number>& workspace) const;
  void place_steps(const std::vector<Expression::Step>& steps, const std::vector<int>& results);
  template <class Coordinate>
  Value value_at(const std::array<Coordinate, D>& point, const Point<D>& error, int bits) const;
  template <class Number>
  void restrict_in(const SegmentChart& segment, int bits, Bernstein<1>* net) const requires(D == 2);
  LocalJet<D> local_jet(const Point<D>& point) const;
  bool exact_value(const RationalPoint<D>& point, Rational* value) const;

  Expression exact_;
  std::vector<Step> steps_;
  int value_ = 0;              ///< where the numerator is in the end
  std::vector<int> divisors_;  ///< where they are
  int places_ = 0;             ///< of intermediate results
  bool rational_ = true;       ///< only arithmetic: values at rational points are exact
};

}  // namespace encase
