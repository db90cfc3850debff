// SPDX-License-Identifier: MIT
#pragma once

#include <flint/fmpz_mpoly.h>

#include "encase/polynomial.hpp"

namespace encase {

/// Owns FLINT's description of the polynomials in D variables, in lexicographic order.
template <int D>
class FlintContext {
 public:
  FlintContext() { fmpz_mpoly_ctx_init(context_, D, ORD_LEX); }
  ~FlintContext() { fmpz_mpoly_ctx_clear(context_); }
  FlintContext(const FlintContext&) = delete;
  FlintContext& operator=(const FlintContext&) = delete;
  operator const fmpz_mpoly_ctx_struct*() const { return context_; }

 private:
  fmpz_mpoly_ctx_t context_;
};

/// Owns a FLINT polynomial with integer coefficients in D variables.
template <int D>
class FlintPolynomial {
 public:
  explicit FlintPolynomial(const FlintContext<D>& context) : context_(context) {
    fmpz_mpoly_init(value_, context_);
  }
  ~FlintPolynomial() { fmpz_mpoly_clear(value_, context_); }
  FlintPolynomial(const FlintPolynomial&) = delete;
  FlintPolynomial& operator=(const FlintPolynomial&) = delete;
  operator fmpz_mpoly_struct*() { return value_; }
  operator const fmpz_mpoly_struct*() const { return value_; }

  /// Takes `f` times the least common multiple of its denominators, and returns that multiple.
  Integer set(const Polynomial<D>& f);
  /// The polynomial divided by `denominator`.
  Polynomial<D> get(const Integer& denominator) const;

 private:
  const FlintContext<D>& context_;
  fmpz_mpoly_t value_;
};

extern template class FlintPolynomial<1>;
extern template class FlintPolynomial<2>;
extern template class FlintPolynomial<3>;

}  // namespace encase
