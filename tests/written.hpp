// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <variant>

#include "encase/polynomial.hpp"
#include "io/expression_parser.hpp"

namespace encase::written {

/// The polynomial that a text denotes.
template <int D>
Polynomial<D> polynomial(const std::string& text) {
  auto parsed = parse_polynomial<D>(text);
  if (!std::holds_alternative<Polynomial<D>>(parsed))
    throw std::invalid_argument("not a polynomial: " + text);
  return std::get<Polynomial<D>>(std::move(parsed));
}

}  // namespace encase::written
