// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <variant>

#include "encase/function.hpp"
#include "source_text.hpp"

namespace encase {

/// What a text in x, y, z (the first D of them) denotes.
///
///   equation := sum [ "=" sum ]                     lhs = rhs denotes lhs - rhs
///   sum      := product { ("+" | "-") product }
///   product  := factor { ["*" | "/"] factor }       no operator: an ordinary product
///   factor   := { "+" | "-" } power
///   power    := primary [ ("^" | "**") factor ]     binds tightest and to the right
///   primary  := number | variable | "pi" | "e" | "(" sum ")" | function "(" sum [ "," sum ] ")"
///
/// Numbers are decimals, taken exactly; `xy^2` is x*y^2. Functions are those of Expression, `ln`,
/// `arcsin`, `arccos`, `arctan` and `pow`. Integer exponents denote Expression::power, the exponent
/// n/2 the n-th power of a square root, other exponents b of a positive a exp(b log(a)), which for
/// a = e is exp(b).
///
/// A polynomial has rational coefficients, divisions by constants that are not zero, exponents that
/// are integers and not negative but for a constant base, and of functions abs, min, max of
/// constants. Degrees above kMaxDegree, and coefficients of more than a million bits, are refused
/// before anything is multiplied out.
template <int D>
std::variant<Polynomial<D>, SyntaxError> parse_polynomial(std::string_view text);

/// The expression as it is written, which is not expanded but for constants that are folded.
/// Expressions of more than kMaxOperations are refused, exponents above a million, and divisions by
/// the constant zero.
inline constexpr int kMaxOperations = 20000;
template <int D>
std::variant<Expression, SyntaxError> parse_expression(std::string_view text);

/// A polynomial where the text is one, with all its limits; else an expression.
template <int D>
std::variant<Function<D>, SyntaxError> parse_function(std::string_view text);

}  // namespace encase
