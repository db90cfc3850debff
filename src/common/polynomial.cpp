// SPDX-License-Identifier: MIT
#include "encase/polynomial.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "common/integer_terms.hpp"
#include "flint_polynomial.hpp"

namespace encase {

namespace {

/// a + sign * b, both in ascending order of exponents.
template <class Term>
std::vector<Term> merged(const std::vector<Term>& a, const std::vector<Term>& b, int sign) {
  std::vector<Term> sum;
  sum.reserve(a.size() + b.size());
  auto i = a.begin();
  auto j = b.begin();
  const auto push_b = [&] {
    sum.push_back(*j++);
    if (sign < 0) sum.back().coefficient = -sum.back().coefficient;
  };
  while (i != a.end() && j != b.end()) {
    if (i->exponent < j->exponent) {
      sum.push_back(*i++);
    } else if (j->exponent < i->exponent) {
      push_b();
    } else {
      Term term = *i++;
      if (sign < 0)
        term.coefficient -= j->coefficient;
      else
        term.coefficient += j->coefficient;
      ++j;
      if (term.coefficient != 0) sum.push_back(std::move(term));
    }
  }
  sum.insert(sum.end(), i, a.end());
  while (j != b.end()) push_b();
  return sum;
}

}  // namespace

template <int D>
const std::vector<typename Polynomial<D>::Term>& Polynomial<D>::terms() const {
  static const std::vector<Term> none;
  return shared_ ? shared_->terms : none;
}

template <int D>
Polynomial<D> Polynomial<D>::from_ordered(std::vector<Term> terms) {
  Polynomial f;
  if (terms.empty()) return f;
  int degree = 0;
  for (const Term& term : terms)
    degree = std::max(degree, std::accumulate(term.exponent.begin(), term.exponent.end(), 0));
  f.shared_ = std::make_shared<const Shared>(Shared{std::move(terms), degree});
  return f;
}

template <int D>
Polynomial<D> Polynomial<D>::from_terms(std::vector<Term> terms) {
  const auto less = [](const Term& a, const Term& b) { return a.exponent < b.exponent; };
  if (!std::is_sorted(terms.begin(), terms.end(), less))
    std::sort(terms.begin(), terms.end(), less);
  std::vector<Term> sums;
  sums.reserve(terms.size());
  for (Term& term : terms) {
    if (!sums.empty() && sums.back().exponent == term.exponent) {
      sums.back().coefficient += term.coefficient;
    } else {
      if (!sums.empty() && sums.back().coefficient == 0) sums.pop_back();
      sums.push_back(std::move(term));
    }
  }
  if (!sums.empty() && sums.back().coefficient == 0) sums.pop_back();
  return from_ordered(std::move(sums));
}

template <int D>
Polynomial<D> Polynomial<D>::constant(const Rational& value) {
  return from_terms({{Exponent<D>{}, value}});
}

template <int D>
Polynomial<D> Polynomial<D>::variable(int axis) {
  Exponent<D> exponent{};
  exponent[axis] = 1;
  return from_terms({{exponent, 1}});
}

template <int D>
int Polynomial<D>::degree(int axis) const {
  int largest = -1;
  for (const Term& term : terms()) largest = std::max(largest, term.exponent[axis]);
  return largest;
}

template <int D>
Polynomial<D> Polynomial<D>::operator-() const {
  std::vector<Term> negated = terms();
  for (Term& term : negated) term.coefficient = -term.coefficient;
  return from_ordered(std::move(negated));
}

template <int D>
Polynomial<D> Polynomial<D>::operator+(const Polynomial& other) const {
  return from_ordered(merged(terms(), other.terms(), 1));
}

template <int D>
Polynomial<D> Polynomial<D>::operator-(const Polynomial& other) const {
  return from_ordered(merged(terms(), other.terms(), -1));
}

template <int D>
Polynomial<D> Polynomial<D>::operator*(const Polynomial& other) const {
  if (is_zero() || other.is_zero()) return {};
  if (terms().size() == 1 || other.terms().size() == 1) {
    // Multiplying by one term keeps the order of the others.
    const bool first = terms().size() == 1;
    const Term& factor = first ? terms().front() : other.terms().front();
    std::vector<Term> product = first ? other.terms() : terms();
    for (Term& term : product) {
      term.coefficient *= factor.coefficient;
      for (int i = 0; i < D; ++i) term.exponent[i] += factor.exponent[i];
    }
    return from_ordered(std::move(product));
  }
  const FlintContext<D> context;
  FlintPolynomial<D> a(context), b(context), product(context);
  const Integer denominator_a = a.set(*this);
  const Integer denominator_b = b.set(other);
  fmpz_mpoly_mul(product, a, b, context);
  return product.get(denominator_a * denominator_b);
}

template <int D>
Polynomial<D> Polynomial<D>::power(int exponent) const {
  if (exponent == 0) return constant(1);
  if (exponent == 1 || is_zero()) return *this;
  if (terms().size() == 1) {
    Term term = terms().front();
    const unsigned long n = static_cast<unsigned long>(exponent);
    mpz_pow_ui(term.coefficient.get_num_mpz_t(), term.coefficient.get_num_mpz_t(), n);
    mpz_pow_ui(term.coefficient.get_den_mpz_t(), term.coefficient.get_den_mpz_t(), n);
    for (int& e : term.exponent) e *= exponent;
    return from_ordered({std::move(term)});
  }
  const FlintContext<D> context;
  FlintPolynomial<D> base(context), result(context);
  const Integer denominator = base.set(*this);
  const unsigned long e = static_cast<unsigned long>(exponent);
  fmpz_mpoly_pow_ui(result, base, e, context);
  Integer scale;
  mpz_pow_ui(scale.get_mpz_t(), denominator.get_mpz_t(), e);
  return result.get(scale);
}

template <int D>
Polynomial<D> Polynomial<D>::derivative(int axis) const {
  // Exponents that keep their order: each of them loses 1 in one place.
  std::vector<Term> derived;
  for (const Term& term : terms()) {
    if (term.exponent[axis] == 0) continue;
    derived.push_back(term);
    derived.back().coefficient *= term.exponent[axis];
    --derived.back().exponent[axis];
  }
  return from_ordered(std::move(derived));
}

template <int D>
Rational Polynomial<D>::operator()(const RationalPoint<D>& point) const {
  if (is_zero()) return 0;
  // With x_i = n_i / d_i and m_i the degree in x_i, the sum of c prod n_i^e_i d_i^(m_i - e_i) over
  // the terms is taken in integers, and divided once by prod d_i^m_i and the common denominator of
  // the coefficients.
  std::array<std::vector<Integer>, D> factor;
  Integer denominator = 1;
  for (int i = 0; i < D; ++i) {
    const int m = degree(i);
    const Integer& n = point[i].get_num();
    const Integer& d = point[i].get_den();
    factor[i].assign(static_cast<std::size_t>(m) + 1, Integer(1));
    for (int e = 1; e <= m; ++e) factor[i][e] = factor[i][e - 1] * n;
    Integer scale = 1;
    for (int e = m - 1; e >= 0; --e) {
      scale *= d;
      factor[i][e] *= scale;
    }
    denominator *= scale;
  }
  const Integer common = common_denominator(*this);
  Integer sum = 0;
  for (const Term& term : terms()) {
    Integer product = scaled(term.coefficient, common);
    for (int i = 0; i < D; ++i) product *= factor[i][term.exponent[i]];
    sum += product;
  }
  Rational value(sum, denominator * common);
  value.canonicalize();
  return value;
}

template <int D>
std::string Polynomial<D>::to_string() const {
  if (is_zero()) return "0";
  std::string text;
  for (auto term = terms().rbegin(); term != terms().rend(); ++term) {
    const bool negative = term->coefficient < 0;
    if (text.empty())
      text = negative ? "-" : "";
    else
      text += negative ? " - " : " + ";
    std::string product;
    for (int i = 0; i < D; ++i) {
      if (term->exponent[i] == 0) continue;
      if (!product.empty()) product += '*';
      product += "xyz"[i];
      if (term->exponent[i] > 1) product += '^' + std::to_string(term->exponent[i]);
    }
    const Rational magnitude = abs(term->coefficient);
    if (product.empty())
      product = magnitude.get_str();
    else if (magnitude != 1)
      product = magnitude.get_str() + '*' + product;
    text += product;
  }
  return text;
}

template class Polynomial<1>;
template class Polynomial<2>;
template class Polynomial<3>;

}  // namespace encase
