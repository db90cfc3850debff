// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "common/filtered_expression.hpp"
#include "common/filtered_inclusion.hpp"
#include "common/filtered_polynomial.hpp"
#include "encase/function.hpp"

namespace encase {

/// What a curve or surface is the zero set of, prepared for the questions that algorithms ask; the
/// answers are those of what it holds. Values are scaled as those of FilteredPolynomial.
template <int D>
class FilteredFunction {
  using Filtered = std::variant<FilteredPolynomial<D>, FilteredExpression<D>, FilteredInclusion<D>>;

 public:
  explicit FilteredFunction(const Function<D>& function)
      : filtered_(function.is_polynomial() ? Filtered(FilteredPolynomial<D>(function.polynomial()))
                  : function.is_expression()
                      ? Filtered(FilteredExpression<D>(function.expression()))
                      : FilteredInclusion<D>(function.inclusion())) {}
  explicit FilteredFunction(Polynomial<D> polynomial)
      : filtered_(FilteredPolynomial<D>(std::move(polynomial))) {}

  bool is_polynomial() const { return std::holds_alternative<FilteredPolynomial<D>>(filtered_); }
  bool is_expression() const { return std::holds_alternative<FilteredExpression<D>>(filtered_); }
  /// Only of a polynomial.
  const FilteredPolynomial<D>& polynomial() const {
    return std::get<FilteredPolynomial<D>>(filtered_);
  }
  /// Only of what an inclusion function encloses.
  bool is_inclusion() const { return std::holds_alternative<FilteredInclusion<D>>(filtered_); }
  const FilteredInclusion<D>& inclusion() const {
    return std::get<FilteredInclusion<D>>(filtered_);
  }
  /// Only of an expression.
  const FilteredExpression<D>& expression() const {
    return std::get<FilteredExpression<D>>(filtered_);
  }

  /// The Taylor model on center + half * [-1,1]^D, as FilteredExpression's or FilteredInclusion's;
  /// not of a polynomial.
  const TaylorModel<D, double>& model(const Point<D>& center, const Point<D>& half, int degree,
                                      int bits, Kernel& kernel) const {
    if (is_expression()) return expression().model(center, half, degree, bits, kernel);
    return inclusion().local(center, half, kernel).model;
  }
  /// As FilteredExpression's; not of a polynomial.
  double precise_value(const Point<D>& point, double error, int max_bits) const {
    if (is_expression()) return expression().precise_value(point, error, max_bits);
    return inclusion().precise_value(point, error, max_bits);
  }

  /// The degree of its Bernstein forms: that of a polynomial.
  int degree() const {
    return std::visit([](const auto& f) { return f.degree(); }, filtered_);
  }
  double scale() const {
    return std::visit([](const auto& f) { return f.scale(); }, filtered_);
  }
  /// As FilteredPolynomial's.
  void expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel,
              Bernstein<D>* net) const {
    std::visit([&](const auto& f) { f.expand(box, net_degree, bits, kernel, net); }, filtered_);
  }
  void restrict_to(const SegmentChart& segment, int bits, Kernel& kernel, Bernstein<1>* net) const
      requires(D == 2) {
    std::visit([&](const auto& f) { f.restrict_to(segment, bits, kernel, net); }, filtered_);
  }
  /// Whether a net from more precise arithmetic could be closer to the function: on large parts of
  /// the plane an expression's lacks terms, which precision does not bring back; of an inclusion
  /// function there is no more.
  template <int K>
  bool precision_helps(const Bernstein<K>& net) const {
    if (is_polynomial()) return true;
    return is_expression() && net.radius < 0x1p-32 * (1 + largest_coefficient(net));
  }
  using Value = typename FilteredPolynomial<D>::Value;
  Value evaluate(const Point<D>& point, int bits) const {
    return std::visit([&](const auto& f) { return f.evaluate(point, bits); }, filtered_);
  }
  Value evaluate_rounded(const Point<D>& point, const Point<D>& magnitude, int roundings) const {
    return std::visit(
        [&](const auto& f) { return f.evaluate_rounded(point, magnitude, roundings); }, filtered_);
  }
  double approximate(const Point<D>& point) const {
    return std::visit([&](const auto& f) { return f.approximate(point); }, filtered_);
  }
  Point<D> gradient(const Point<D>& point) const {
    return std::visit([&](const auto& f) { return f.gradient(point); }, filtered_);
  }
  using ValueAndGradient = typename FilteredPolynomial<D>::ValueAndGradient;
  ValueAndGradient value_and_gradient(const Point<D>& point) const {
    return std::visit([&](const auto& f) { return f.value_and_gradient(point); }, filtered_);
  }
  Jet jet(const Point<D>& point) const requires(D == 2) {
    return std::visit([&](const auto& f) { return f.jet(point); }, filtered_);
  }
  /// The exact sign of a polynomial; of others Zero means that none was proved.
  Sign sign_at(const RationalPoint<D>& point, Kernel& kernel) const {
    return std::visit([&](const auto& f) { return f.sign_at(point, kernel); }, filtered_);
  }

 private:
  Filtered filtered_;
};

}  // namespace encase
