// SPDX-License-Identifier: MIT
#include "flint_polynomial.hpp"

#include <vector>

#include "common/integer_terms.hpp"

namespace encase {

template <int D>
Integer FlintPolynomial<D>::set(const Polynomial<D>& f) {
  const Integer denominator = common_denominator(f);
  fmpz_mpoly_zero(value_, context_);
  fmpz_t coefficient;
  fmpz_init(coefficient);
  std::array<ulong, D> exponent;
  // FLINT keeps terms in descending order, Polynomial in ascending.
  for (auto term = f.terms().rbegin(); term != f.terms().rend(); ++term) {
    fmpz_set_mpz(coefficient, scaled(term->coefficient, denominator).get_mpz_t());
    for (int i = 0; i < D; ++i) exponent[i] = static_cast<ulong>(term->exponent[i]);
    fmpz_mpoly_push_term_fmpz_ui(value_, coefficient, exponent.data(), context_);
  }
  fmpz_clear(coefficient);
  return denominator;
}

template <int D>
Polynomial<D> FlintPolynomial<D>::get(const Integer& denominator) const {
  std::vector<typename Polynomial<D>::Term> terms(
      static_cast<std::size_t>(fmpz_mpoly_length(value_, context_)));
  fmpz_t coefficient;
  fmpz_init(coefficient);
  std::array<ulong, D> exponent;
  for (std::size_t k = 0; k < terms.size(); ++k) {
    auto& term = terms[terms.size() - 1 - k];
    const slong index = static_cast<slong>(k);
    fmpz_mpoly_get_term_coeff_fmpz(coefficient, value_, index, context_);
    fmpz_mpoly_get_term_exp_ui(exponent.data(), value_, index, context_);
    for (int i = 0; i < D; ++i) term.exponent[i] = static_cast<int>(exponent[i]);
    fmpz_get_mpz(term.coefficient.get_num_mpz_t(), coefficient);
    if (denominator != 1) {
      term.coefficient.get_den() = denominator;
      term.coefficient.canonicalize();
    }
  }
  fmpz_clear(coefficient);
  return Polynomial<D>::from_terms(std::move(terms));
}

template class FlintPolynomial<1>;
template class FlintPolynomial<2>;
template class FlintPolynomial<3>;

}  // namespace encase
