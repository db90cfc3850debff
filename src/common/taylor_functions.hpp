// SPDX-License-Identifier: MIT
#pragma once

#include "common/taylor_model.hpp"

namespace encase {

/// Elementary functions of Taylor models, by their series at the constant term. As with the
/// arithmetic, results must not be operands, and where a function is not analytic on the polydisc,
/// as far as the norms tell, or something overflows, the result claims nothing.
template <int D, class Number>
class TaylorFunctions : public TaylorArithmetic<D, Number> {
  using Arithmetic = TaylorArithmetic<D, Number>;

 public:
  using Model = TaylorModel<D, Number>;
  using Arithmetic::add, Arithmetic::constant, Arithmetic::invert, Arithmetic::multiply;

  void sqrt(Model& a, Model* r);
  void exp(Model& a, Model* r);
  void log(Model& a, Model* r);
  void sin(Model& a, Model* r);
  void cos(Model& a, Model* r);
  void tan(Model& a, Model* r);
  void asin(Model& a, Model* r);
  void acos(Model& a, Model* r);
  void atan(Model& a, Model* r);
  void sinh(Model& a, Model* r);
  void cosh(Model& a, Model* r);
  void tanh(Model& a, Model* r);
  /// A correctly rounded constant.
  void pi(Model* r) const;
  void euler(Model* r) const;

 private:
  enum class Kind { Sin, Cos, Sinh, Cosh };
  Number sine_and_cosine(const Number& of, bool circular, Number* cosine, double* error) const;
  void entire(Model& a, Kind kind, Model* r);

  using Arithmetic::compose, Arithmetic::gamma, Arithmetic::number, Arithmetic::rest_norm;
  using Arithmetic::first_, Arithmetic::next_, Arithmetic::second_, Arithmetic::series_;
  using Arithmetic::third_;
};

}  // namespace encase
