// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "encase/expression.hpp"
#include "encase/inclusion_function.hpp"
#include "encase/polynomial.hpp"

namespace encase {

/// What a curve or surface is the zero set of: a polynomial, an expression that is none, or what an
/// inclusion function encloses.
template <int D>
class Function {
 public:
  Function() = default;
  Function(Polynomial<D> polynomial) : function_(std::move(polynomial)) {}
  Function(Expression expression) : function_(std::move(expression)) {}
  Function(InclusionFunction<D> enclose) : function_(Inclusion<D>(std::move(enclose))) {}
  Function(Inclusion<D> inclusion) : function_(std::move(inclusion)) {}

  bool is_polynomial() const { return std::holds_alternative<Polynomial<D>>(function_); }
  bool is_expression() const { return std::holds_alternative<Expression>(function_); }
  bool is_inclusion() const { return std::holds_alternative<Inclusion<D>>(function_); }
  /// Only of a polynomial.
  const Polynomial<D>& polynomial() const { return std::get<Polynomial<D>>(function_); }
  /// Only of an expression.
  const Expression& expression() const { return std::get<Expression>(function_); }
  /// Only of what an inclusion function encloses.
  const Inclusion<D>& inclusion() const { return std::get<Inclusion<D>>(function_); }

  bool operator==(const Function&) const = default;
  std::string to_string() const {
    return std::visit([](const auto& f) { return f.to_string(); }, function_);
  }

 private:
  std::variant<Polynomial<D>, Expression, Inclusion<D>> function_;
};

/// A curve or surface as the user wrote it: the zero set of the function.
template <int D>
struct NamedFunction {
  std::string name;
  Function<D> function;
};

}  // namespace encase
