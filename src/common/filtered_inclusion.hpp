// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/filtered_polynomial.hpp"
#include "common/interval.hpp"
#include "common/taylor_model.hpp"
#include "encase/inclusion_function.hpp"

namespace encase {

/// What an inclusion function tells, as outward rounded intervals; unbounded where that is nothing.
template <int D>
struct EnclosedJet {
  Interval value;
  std::array<Interval, D> gradient;
  std::array<std::array<Interval, D>, D> hessian;                     ///< symmetric
  bool has_value = false, has_gradient = false, has_hessian = false;  ///< bounded
};
template <int D>
EnclosedJet<D> enclosed(const Inclusion<D>& f, const Box<D>& box);

/// What an inclusion function does wrong on a box or at its centre: it throws, or gives an interval
/// that is empty or no interval.
template <int D>
std::optional<std::string> complaint(const Inclusion<D>& f, const Box<D>& box);

/// Three affine functions of (u, v), each by the factors of u and v and the constant.
using PlaneMap = std::array<std::array<Rational, 3>, 3>;

/// f with affine functions in place of its coordinates, by the chain rule.
Inclusion<2> restricted(const Inclusion<3>& f, const PlaneMap& map);

/// A function given by its inclusion function with what algorithms ask about it, as
/// FilteredExpression; all from Taylor polynomials of degree 2. There are only doubles: more bits
/// bring nothing.
template <int D>
class FilteredInclusion {
 public:
  static constexpr int kDegree = 2;

  explicit FilteredInclusion(Inclusion<D> exact) : exact_(std::move(exact)) {}

  const Inclusion<D>& exact() const { return exact_; }
  int degree() const { return kDegree; }
  double scale() const { return 1; }

  /// The value and gradient at the centre and the middle of the Hessian's range on center + half *
  /// [-1,1]^D as a model. Unlike what a model claims otherwise its rest is only known to be twice
  /// differentiable: it is at most `error`, and its derivatives are at most kSlope and kBend times
  /// that.
  struct Local {
    TaylorModel<D, double> model;
    Point<D> slope_error{};  ///< at least the rest's first derivatives; less than those bounds
  };
  /// Valid until the thread asks for another one.
  const Local& local(const Point<D>& center, const Point<D>& half, Kernel& kernel) const;

  /// As FilteredExpression's.
  void expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel, Bernstein<D>* net) const;
  void restrict_to(const SegmentChart& segment, int bits, Kernel& kernel, Bernstein<1>* net) const
      requires(D == 2);

  using Value = typename FilteredPolynomial<D>::Value;
  Value evaluate(const Point<D>& point, int bits) const;
  Value evaluate_rounded(const Point<D>& point, const Point<D>& magnitude, int roundings) const;
  double precise_value(const Point<D>& point, double error, int max_bits) const;

  double approximate(const Point<D>& point) const;
  Point<D> gradient(const Point<D>& point) const;
  using ValueAndGradient = typename FilteredPolynomial<D>::ValueAndGradient;
  ValueAndGradient value_and_gradient(const Point<D>& point) const;
  Jet jet(const Point<D>& point) const requires(D == 2);

  /// A proved sign, else Zero.
  Sign sign_at(const RationalPoint<D>& point, Kernel& kernel) const;

 private:
  Inclusion<D> exact_;
};

}  // namespace encase
