// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <variant>

#include "encase/polynomial.hpp"
#include "source_text.hpp"

namespace encase {

/// The polynomial in x, y, z (the first D of them) that a text denotes.
///
///   equation := sum [ "=" sum ]                     lhs = rhs denotes lhs - rhs
///   sum      := product { ("+" | "-") product }
///   product  := factor { ["*" | "/"] factor }       no operator: an ordinary product
///   factor   := { "+" | "-" } power
///   power    := primary [ ("^" | "**") factor ]     binds tightest and to the right
///   primary  := number | variable | "(" sum ")"
///
/// Numbers are decimals, taken exactly; `xy^2` is x*y^2. Division is by constants that are not
/// zero, exponents are integers, and not negative but for a constant base. Degrees above
/// kMaxDegree, and coefficients of more than a million bits, are refused before anything is
/// multiplied out.
template <int D>
std::variant<Polynomial<D>, SyntaxError> parse_expression(std::string_view text);

}  // namespace encase
