// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "encase/number.hpp"
#include "encase/polynomial.hpp"

namespace encase {

/// What a step of an expression does.
enum class Operation {
  Constant,
  Pi,
  Euler,  ///< the number e
  Variable,
  Negate,
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,  ///< to an integer exponent
  Sqrt,
  Exp,
  Log,
  Sin,
  Cos,
  Tan,
  Asin,
  Acos,
  Atan,
  Sinh,
  Cosh,
  Tanh,
  Abs,
  Min,
  Max
};

/// How many operands an operation has: 0, 1 or 2.
int operands(Operation operation);

/// The name of a function (sqrt, ..., max), else none; and what a name denotes.
const char* function_name(Operation operation);
std::optional<Operation> function_named(std::string_view name);

/// A real function of x, y, z, written with arithmetic and elementary functions of exact constants.
/// It has a value where all its operations have one: a quotient where the divisor is not zero, a
/// negative power likewise, a square root of what is not negative, a logarithm of what is positive,
/// asin and acos on [-1, 1]. A value: copies share the nodes, which never change.
class Expression {
 public:
  /// One operation of a straight-line program.
  struct Step {
    Operation operation = Operation::Constant;
    int first = -1;     ///< the operands, earlier steps
    int second = -1;    ///
    int number = 0;     ///< the axis of a variable, the exponent of a power
    Rational constant;  ///< of a constant
    bool operator==(const Step&) const = default;
  };

  Expression() : Expression(Rational(0)) {}
  Expression(const Rational& constant);
  /// A polynomial by Horner's rule.
  template <int D>
  explicit Expression(const Polynomial<D>& polynomial);
  static Expression variable(int axis);
  static Expression pi();
  static Expression euler();
  /// A function of one or two operands. Constants are folded where the result is rational, but
  /// for divisions by zero.
  static Expression apply(Operation operation, const Expression& operand);
  static Expression apply(Operation operation, const Expression& first, const Expression& second);
  /// To an integer power. Constants are folded up to a million bits.
  Expression power(int exponent) const;

  Expression operator-() const { return apply(Operation::Negate, *this); }
  friend Expression operator+(const Expression& a, const Expression& b) {
    return apply(Operation::Add, a, b);
  }
  friend Expression operator-(const Expression& a, const Expression& b) {
    return apply(Operation::Subtract, a, b);
  }
  friend Expression operator*(const Expression& a, const Expression& b) {
    return apply(Operation::Multiply, a, b);
  }
  friend Expression operator/(const Expression& a, const Expression& b) {
    return apply(Operation::Divide, a, b);
  }

  /// The straight-line program: operands before what uses them, equal steps only once; the last
  /// one is the value.
  std::vector<Step> steps() const;
  /// The number of operations, constants and variables as written, at most kMaxInt.
  int size() const;
  /// The constant, if it is a rational one that is written or folded as such.
  const Rational* constant() const;
  /// Whether it has the variable of an axis.
  bool uses(int axis) const;
  /// Whether the steps are the same. (Different steps may denote the same function.)
  bool operator==(const Expression& other) const;

  /// A text the parser reads back to the same expression, in x, y, z. As long as `size`.
  std::string to_string() const;

 private:
  struct Node;
  explicit Expression(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

}  // namespace encase
