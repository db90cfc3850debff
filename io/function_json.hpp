// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "encase/function.hpp"
#include "io/expression_parser.hpp"
#include "io/json_node.hpp"
#include "io/json_writer.hpp"

/// Functions in results: the key `terms`, `expression` or `inclusion` (docs/json.md).
namespace encase {

template <int D>
void put_terms(JsonWriter& w, const Polynomial<D>& polynomial) {
  w.list(polynomial.terms(), [&](const typename Polynomial<D>::Term& term) {
    w.raw("[");
    for (const int exponent : term.exponent) w.put(exponent), w.raw(",");
    w.put(term.coefficient);
    w.raw("]");
  });
}

/// The terms of a polynomial, an expression as a text, or that there is an inclusion function.
template <int D>
void put_function(JsonWriter& w, const Function<D>& function) {
  if (function.is_polynomial()) {
    w.key("terms"), put_terms(w, function.polynomial());
  } else if (function.is_inclusion()) {
    w.field("inclusion", true);
  } else {
    w.field("expression", function.to_string());
  }
}

template <int D>
void put_functions(JsonWriter& w, const std::vector<NamedFunction<D>>& functions) {
  w.lines(functions, [&](const NamedFunction<D>& named) {
    w.raw("{");
    w.field("name", named.name);
    put_function(w, named.function);
    w.raw("}");
  });
}

template <int D>
Polynomial<D> read_terms(const JsonNode& node) {
  auto terms = node.map([](const JsonNode& term) {
    term.of_size(D + 1);
    typename Polynomial<D>::Term read;
    int left = kMaxDegree;
    for (int i = 0; i < D; ++i) {
      read.exponent[i] = static_cast<int>(term.item(i).integer(0, left));
      left -= read.exponent[i];
    }
    read.coefficient = term.item(D).rational();
    return read;
  });
  Polynomial<D> polynomial = Polynomial<D>::from_terms(std::move(terms));
  if (polynomial.is_constant()) node.fail("the polynomial is constant");
  return polynomial;
}

/// What a curve or surface is the zero set of.
template <int D>
Function<D> read_function(const JsonNode& named) {
  if (named.has("inclusion"))
    named.fail(
        "is given by an inclusion function, which a file cannot hold: this result can be "
        "verified only by the program that has the function");
  if (!named.has("expression")) return read_terms<D>(named.member("terms"));
  const JsonNode node = named.member("expression");
  auto expression = parse_expression<D>(node.text());
  if (const auto* e = std::get_if<SyntaxError>(&expression))
    node.fail("at character " + std::to_string(e->offset + 1) + ": " + e->message);
  return std::move(std::get<Expression>(expression));
}

template <int D>
std::vector<NamedFunction<D>> read_functions(const JsonNode& list) {
  return list.map([](const JsonNode& named) {
    return NamedFunction<D>{named.member("name").text(), read_function<D>(named)};
  });
}

}  // namespace encase
