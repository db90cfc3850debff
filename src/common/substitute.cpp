// SPDX-License-Identifier: MIT
#include "common/substitute.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace encase {

template <int K, int D>
Polynomial<K> substitute(const Polynomial<D>& f, const std::array<Polynomial<K>, D>& replacements) {
  std::array<std::vector<Polynomial<K>>, D> powers;
  for (int i = 0; i < D; ++i) {
    powers[i].push_back(Polynomial<K>::constant(1));
    for (int k = 1; k <= f.degree(i); ++k) powers[i].push_back(powers[i].back() * replacements[i]);
  }
  std::vector<typename Polynomial<K>::Term> terms;
  const auto multiply = [](typename Polynomial<K>::Term& term, const auto& factor) {
    if (factor.coefficient != 1) term.coefficient *= factor.coefficient;
    for (int i = 0; i < K; ++i) term.exponent[i] += factor.exponent[i];
  };
  for (const auto& term : f.terms()) {
    // Products with single terms, nearly all there are, are made without polynomials.
    typename Polynomial<K>::Term single{{}, term.coefficient};
    std::optional<Polynomial<K>> product;
    for (int i = 0; i < D; ++i) {
      const Polynomial<K>& factor = powers[i][term.exponent[i]];
      if (factor.terms().size() == 1)
        multiply(single, factor.terms()[0]);
      else
        product = product ? *product * factor : factor;
    }
    if (!product) {
      terms.push_back(std::move(single));
      continue;
    }
    for (auto t : product->terms()) {
      multiply(t, single);
      terms.push_back(std::move(t));
    }
  }
  return Polynomial<K>::from_terms(std::move(terms));
}

template Polynomial<1> substitute<1, 2>(const Polynomial<2>&, const std::array<Polynomial<1>, 2>&);
template Polynomial<1> substitute<1, 3>(const Polynomial<3>&, const std::array<Polynomial<1>, 3>&);
template Polynomial<2> substitute<2, 2>(const Polynomial<2>&, const std::array<Polynomial<2>, 2>&);
template Polynomial<2> substitute<2, 3>(const Polynomial<3>&, const std::array<Polynomial<2>, 3>&);

Polynomial<1> restrict_exactly(const Polynomial<2>& f, const Line& line) {
  const auto c = line.exact();
  const int p = parameter_axis(line), q = 1 - p;
  std::array<Polynomial<1>, 2> at;
  at[p] = Polynomial<1>::variable(0);
  at[q] = Polynomial<1>::constant(Rational(-c[2] / c[q])) +
          Polynomial<1>::constant(Rational(-c[p] / c[q])) * Polynomial<1>::variable(0);
  return substitute<1, 2>(f, at);
}

Polynomial<2> outside_of_rectangle(const Polynomial<2>& f, const Point<2>& half, int chart) {
  const int degree = f.degree();
  std::vector<Polynomial<2>::Term> terms;
  for (const auto& term : f.terms()) {
    Rational c = term.coefficient;
    for (int k = 0; k < 2; ++k)
      for (int n = 0; half[k] != 1 && n < term.exponent[k]; ++n) c *= Rational(half[k]);
    terms.push_back({{degree - term.exponent[0] - term.exponent[1], term.exponent[1 - chart]}, c});
  }
  return Polynomial<2>::from_terms(std::move(terms));
}

}  // namespace encase
