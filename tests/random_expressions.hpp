// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <random>

#include "encase/expression.hpp"

namespace encase::random_expressions {

/// A tree over all operations, of about `size` of them, in the first `dimension` variables. The
/// same for the same state of the generator, with any standard library.
inline Expression tree(int size, int dimension, std::mt19937_64& generator) {
  const auto below = [&](int count) {
    return static_cast<int>(generator() % static_cast<unsigned>(count));
  };
  if (size <= 1) {
    const int choice = below(10);
    if (choice < 6) return Expression::variable(below(dimension));
    if (choice == 6) return Expression::pi();
    if (choice == 7) return Expression::euler();
    Rational constant(below(41) - 20, below(8) + 1);
    constant.canonicalize();
    return Expression(constant);
  }
  constexpr std::array kUnary = {
      Operation::Negate, Operation::Sqrt, Operation::Exp,  Operation::Log,  Operation::Sin,
      Operation::Cos,    Operation::Tan,  Operation::Asin, Operation::Acos, Operation::Atan,
      Operation::Sinh,   Operation::Cosh, Operation::Tanh, Operation::Abs};
  constexpr std::array kBinary = {Operation::Add,    Operation::Subtract, Operation::Multiply,
                                  Operation::Divide, Operation::Min,      Operation::Max};
  const int choice = below(10);
  if (choice < 4 || size == 2) {
    const Expression operand = tree(size - 1, dimension, generator);
    if (below(5) == 0) return operand.power(below(9) - 4);
    return Expression::apply(kUnary[static_cast<std::size_t>(below(kUnary.size()))], operand);
  }
  const int left = 1 + below(size - 2);
  const Expression first = tree(left, dimension, generator);
  const Expression second = tree(size - 1 - left, dimension, generator);
  // Arithmetic more often than the rest.
  return Expression::apply(kBinary[static_cast<std::size_t>(below(choice < 9 ? 4 : 6))], first,
                           second);
}

}  // namespace encase::random_expressions
