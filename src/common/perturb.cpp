// SPDX-License-Identifier: MIT
#include "perturb.hpp"

#include <map>
#include <utility>
#include <vector>

#include "random_polynomials.hpp"

namespace encase {

template <int D>
Polynomial<D> perturb(const Polynomial<D>& f, double delta, std::mt19937_64& generator) {
  if (f.is_zero()) return f;
  std::map<Exponent<D>, Rational> coefficient;
  for (const auto& term : f.terms()) coefficient[term.exponent] = term.coefficient;
  std::vector<typename Polynomial<D>::Term> terms;
  for (const auto& e : dense_exponents<D>(f.degree())) {
    const Rational& c = coefficient[e];
    const Rational u = Rational(delta) * Rational(symmetric_random(generator));
    terms.push_back({e, c + u * (1 + abs(c))});
  }
  return Polynomial<D>::from_terms(std::move(terms));
}

template Polynomial<2> perturb(const Polynomial<2>&, double, std::mt19937_64&);
template Polynomial<3> perturb(const Polynomial<3>&, double, std::mt19937_64&);

}  // namespace encase
