// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/mpfr_number.hpp"

namespace encase {

/// A real function of s that is a polynomial up to a small analytic rest:
///
///   f(s) = sum of c_a s^a over |a| <= degree  +  e(s),
///
/// where e is a power series with sum over a of |e_a| kRadius^|a| <= error. So f is analytic on a
/// neighbourhood of [-1,1]^D, and all derivatives of e are bounded too. An infinite error claims
/// nothing. docs/error-bounds.md has the arithmetic's derivation.
template <int D, class Number>
struct TaylorModel {
  static constexpr int kMaxDegree = 15;
  /// Of the polydisc on which the series of f converges.
  static constexpr double kRadius = 1.125;
  /// At least k r^(k-1) / kRadius^k and k (k-1) r^(k-2) / kRadius^k for all k, r = 1 + 2^-10: times
  /// `error` they bound the first and second partial derivatives of e where |s_k| <= r.
  static constexpr double kSlope = 3.16, kBend = 39.8;

  int degree = 0;             ///< of the polynomial
  std::array<int, D> span{};  ///< no exponent of a variable is larger
  int stride = 1;             ///< coefficients of s_0^i s_1^j stand at i stride + j, and so on
  /// Only those within `degree` and `span` have a meaning.
  std::vector<Number> c;
  /// Entry k is at least the sum of |c_a| kRadius^k over |a| = k.
  std::array<double, kMaxDegree + 1> norm{};
  double error = 0;
  bool undefined = false;  ///< f has no value anywhere on [-1,1]^D; the error is infinite then

  bool exists() const { return std::isfinite(error); }
  void claim_nothing(bool is_undefined = false) {
    undefined = is_undefined;
    degree = 0;
    span.fill(0);
    norm.fill(0.0);
    error = std::numeric_limits<double>::infinity();
  }
  double polynomial_norm() const {
    double sum = 0;
    for (int k = 0; k <= degree; ++k) sum += norm[static_cast<std::size_t>(k)];
    return sum * (1 + 0x1p-40);
  }
};

/// Arithmetic with Taylor models of one highest degree in one precision: doubles (53 bits) or MPFR.
/// Results must not be operands. Where a function is not analytic on the polydisc, as far as the
/// norms tell, or something overflows, the result claims nothing.
///
/// At a point (degree 0, operands without s) functions that are only continuous have values too.
template <int D, class Number>
class TaylorArithmetic {
 public:
  using Model = TaylorModel<D, Number>;

  void prepare(int max_degree, int bits, bool at_point);
  int max_degree() const { return max_degree_; }
  int bits() const { return bits_; }
  /// Gives a model room for coefficients.
  void make_room(Model* model) const;

  /// A constant that is known up to an error.
  void constant(const Number& value, double error, Model* r) const;
  /// origin + sum over k of direction_k s_k; the error of all these numbers together.
  void linear(const Number& origin, const std::array<Number, D>& direction, double error,
              Model* r) const;
  void negate(const Model& a, Model* r) const;
  void add(const Model& a, const Model& b, bool subtract, Model* r) const;
  void multiply(const Model& a, const Model& b, Model* r) const;
  void invert(Model& a, Model* r);
  void divide(const Model& a, Model& b, Model* r);
  void power(Model& a, int exponent, Model* r);
  void abs(const Model& a, Model* r) const;
  void least(const Model& a, const Model& b, Model* r) const { choose(a, b, true, r); }
  void greatest(const Model& a, const Model& b, Model* r) const { choose(a, b, false, r); }

 protected:
  double gamma(int roundings) const { return 1.01 * roundings * unit_; }
  Number number(double value) const;
  /// At least the norm of the model less its constant term.
  double rest_norm(const Model& a) const;
  /// The sum of series_[k] d^k, where a = u + d with the constant term u and |d| <= `rest`. The
  /// coefficients err by relative[k] of gamma(1), `tail` bounds the sum of the terms beyond the
  /// highest degree. Uses next_.
  void compose(Model& a, double rest, double tail, const double* relative, Model* r);

  std::vector<Number> series_;
  Model next_, first_, second_, third_;  ///< intermediate results of functions

 private:
  void multiply_up_to(int limit, const Model& a, const Model& b, Model* r) const;
  void copy(const Model& a, Model* r) const;
  void measure(Model* r) const;
  void choose(const Model& a, const Model& b, bool smaller, Model* r) const;

  int max_degree_ = 0;
  int bits_ = 53;
  bool at_point_ = false;
  double unit_ = 0x1p-53;
};

}  // namespace encase
