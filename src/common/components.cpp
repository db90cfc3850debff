// SPDX-License-Identifier: MIT
#include "components.hpp"

#include <flint/fmpz_mpoly_factor.h>
#include <flint/fmpz_poly.h>
#include <flint/nmod_poly.h>
#include <flint/ulong_extras.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/integer_terms.hpp"
#include "common/modular_line.hpp"
#include "flint_polynomial.hpp"

namespace encase {

namespace {

class ModularPoly {
 public:
  explicit ModularPoly(ulong prime) { nmod_poly_init(value_, prime); }
  ~ModularPoly() { nmod_poly_clear(value_); }
  ModularPoly(const ModularPoly&) = delete;
  ModularPoly& operator=(const ModularPoly&) = delete;
  operator nmod_poly_struct*() { return value_; }
  operator const nmod_poly_struct*() const { return value_; }

 private:
  nmod_poly_t value_;
};

class IntegerPoly {
 public:
  IntegerPoly() { fmpz_poly_init(value_); }
  explicit IntegerPoly(const Polynomial<1>& f) : IntegerPoly() { set(f); }
  IntegerPoly(const IntegerPoly& other) : IntegerPoly() { fmpz_poly_set(value_, other.value_); }
  IntegerPoly& operator=(const IntegerPoly& other) {
    fmpz_poly_set(value_, other.value_);
    return *this;
  }
  ~IntegerPoly() { fmpz_poly_clear(value_); }
  fmpz_poly_struct* operator->() { return value_; }
  operator fmpz_poly_struct*() { return value_; }
  operator const fmpz_poly_struct*() const { return value_; }

  /// Takes f times the least common multiple of its denominators.
  void set(const Polynomial<1>& f) {
    fmpz_poly_zero(value_);
    const Integer denominator = common_denominator(f);
    for (const auto& term : f.terms())
      fmpz_poly_set_coeff_mpz(value_, term.exponent[0],
                              scaled(term.coefficient, denominator).get_mpz_t());
  }
  Polynomial<1> get() const {
    std::vector<Polynomial<1>::Term> terms;
    for (slong k = 0; k < fmpz_poly_length(value_); ++k) {
      Polynomial<1>::Term term{{static_cast<int>(k)}, 0};
      fmpz_poly_get_coeff_mpz(term.coefficient.get_num_mpz_t(), value_, k);
      terms.push_back(std::move(term));
    }
    return Polynomial<1>::from_terms(std::move(terms));
  }

 private:
  fmpz_poly_t value_;
};

/// FLINT reports failure only for exponents beyond a machine word, far above kMaxDegree.
void require(int success) {
  if (!success) throw std::logic_error("FLINT could not compute a greatest common divisor");
}

/// A factor in the making. `input` is the index of the input it equals up to a constant, or -1.
template <int D>
struct FactorElement {
  using Source = typename BaseElement<D>::Source;
  std::unique_ptr<FlintPolynomial<D>> factor;
  std::vector<Source> sources;
  int input = -1;
};

template <int D>
class Refinement {
  using Element = FactorElement<D>;
  using Source = typename Element::Source;

 public:
  /// Adds an input as the product of its square-free parts' powers.
  void add(int index, const Polynomial<D>& f) {
    fmpz_mpoly_factor_t parts;
    fmpz_mpoly_factor_init(parts, context_);
    FlintPolynomial<D> whole(context_), base(context_);
    whole.set(f);
    std::map<slong, std::unique_ptr<FlintPolynomial<D>>> by_multiplicity;
    require(fmpz_mpoly_factor_squarefree(parts, whole, context_));
    for (slong k = 0; k < fmpz_mpoly_factor_length(parts, context_); ++k) {
      const slong multiplicity = fmpz_mpoly_factor_get_exp_si(parts, k, context_);
      fmpz_mpoly_factor_get_base(base, parts, k, context_);
      auto& product = by_multiplicity[multiplicity];
      if (!product) {
        product = std::make_unique<FlintPolynomial<D>>(context_);
        fmpz_mpoly_one(*product, context_);
      }
      fmpz_mpoly_mul(*product, *product, base, context_);
    }
    fmpz_mpoly_factor_clear(parts, context_);
    for (auto& [multiplicity, product] : by_multiplicity)
      insert(std::move(product), {index, static_cast<int>(multiplicity)},
             multiplicity == 1 && by_multiplicity.size() == 1);
  }

  std::vector<BaseElement<D>> take(const std::vector<Polynomial<D>>& inputs) && {
    std::vector<BaseElement<D>> base;
    for (Element& element : elements_)
      base.push_back({element.input >= 0 ? inputs[static_cast<std::size_t>(element.input)]
                                         : element.factor->get(1),
                      std::move(element.sources)});
    return base;
  }

 private:
  /// Splits the elements by a square-free polynomial coprime to all others of its source.
  /// Invariant: two irreducible factors met so far are in one element exactly if their sources are
  /// equal.
  void insert(std::unique_ptr<FlintPolynomial<D>> rest, Source source, bool is_input) {
    std::vector<Element> refined;
    for (Element& element : elements_) {
      auto common = std::make_unique<FlintPolynomial<D>>(context_);
      require(fmpz_mpoly_gcd(*common, *element.factor, *rest, context_));
      if (fmpz_mpoly_is_fmpz(*common, context_)) {
        refined.push_back(std::move(element));
        continue;
      }
      FlintPolynomial<D> remaining(context_);
      fmpz_mpoly_divides(remaining, *rest, *common, context_);
      const bool rest_divides = fmpz_mpoly_is_fmpz(remaining, context_);
      fmpz_mpoly_swap(*rest, remaining, context_);
      Element shared{std::move(common), element.sources, -1};
      shared.sources.push_back(source);
      fmpz_mpoly_divides(remaining, *element.factor, *shared.factor, context_);
      if (fmpz_mpoly_is_fmpz(remaining, context_)) {
        shared.input = element.input;
      } else {
        if (rest_divides && is_input) shared.input = source.index;
        fmpz_mpoly_swap(*element.factor, remaining, context_);
        element.input = -1;
        refined.push_back(std::move(element));
      }
      is_input = false;
      refined.push_back(std::move(shared));
    }
    elements_ = std::move(refined);
    if (!fmpz_mpoly_is_fmpz(*rest, context_))
      elements_.push_back({std::move(rest), {source}, is_input ? source.index : -1});
  }

  FlintContext<D> context_;
  std::vector<Element> elements_;
};

/// From so many polynomials on their product is looked at first, not all pairs.
constexpr std::size_t kMany = 24;

/// The product of `count` polynomials modulo their prime: of that of either half.
void multiply_all(const std::optional<ModularPolynomial>* first, std::size_t count,
                  nmod_poly_struct* product) {
  if (count == 1) {
    const ModularPolynomial& f = **first;
    for (std::size_t k = f.size(); k-- > 0;)
      nmod_poly_set_coeff_ui(product, static_cast<slong>(k), f[k]);
    return;
  }
  ModularPoly lower(nmod_poly_modulus(product)), upper(nmod_poly_modulus(product));
  multiply_all(first, count / 2, lower);
  multiply_all(first + count / 2, count - count / 2, upper);
  nmod_poly_mul(product, lower, upper);
}

/// Whether there are restrictions of all polynomials, and none has a multiple factor modulo the
/// prime or one in common with another. One greatest common divisor for all of them.
bool product_is_square_free(const std::vector<std::optional<ModularPolynomial>>& restrictions) {
  for (const auto& f : restrictions)
    if (!f) return false;
  ModularPoly product(kModularPrime), derivative(kModularPrime), common(kModularPrime);
  multiply_all(restrictions.data(), restrictions.size(), product);
  nmod_poly_derivative(derivative, product);
  nmod_poly_gcd(common, product, derivative);
  return nmod_poly_degree(common) == 0;
}

}  // namespace

// Restricting to one line modulo one prime p proves both statements below, whenever the restriction
// r of f keeps the total degree of f.
//
// No repeated factor: let f = c G^2 H with c rational and G, H primitive in Z[x,y] (Gauss; in
// Z[x,y,z] alike), G not constant. p divides no denominator of f, so c is a p-integer, and r = c
// (G|)^2 (H|), where | is the restriction modulo p. No degree grows under |, and the degrees on
// both sides are equal: so deg G| = deg G > 0, and r is not square-free.
//
// No shared factor: let f = c H F' and g = c' H G' likewise, with H not constant. As before
// deg H| = deg H > 0, and H| divides r and the restriction of g (which may be of any degree).
//
// So nothing is repeated or shared among polynomials whose restrictions all keep the degree and
// have a square-free product.
namespace {

template <int D>
std::vector<BaseElement<D>> coprime_base(const std::vector<Polynomial<D>>& inputs) {
  const std::size_t n = inputs.size();
  std::vector<std::optional<ModularPolynomial>> restriction(n);  // that keep the degree
  for (std::size_t i = 0; i < n; ++i)
    if (!inputs[i].is_constant()) restriction[i] = restrict_modulo_prime(inputs[i]);
  if (n >= kMany && product_is_square_free(restriction)) {
    std::vector<BaseElement<D>> all;
    for (std::size_t i = 0; i < n; ++i) all.push_back({inputs[i], {{static_cast<int>(i), 1}}});
    return all;
  }
  std::vector<char> simple(n);
  for (std::size_t i = 0; i < n; ++i) simple[i] = restriction[i] && square_free(*restriction[i]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (inputs[i].is_constant() || inputs[j].is_constant()) continue;
      if (!simple[i] && !simple[j]) continue;
      if (restriction[i] && restriction[j] && coprime(*restriction[i], *restriction[j])) continue;
      simple[i] = simple[j] = false;
    }

  // What is still simple was so at each of its pairs, and so proved coprime to every other input.
  // The rest is refined among itself.
  std::vector<BaseElement<D>> base;
  std::optional<Refinement<D>> refinement;
  for (std::size_t i = 0; i < n; ++i) {
    if (inputs[i].is_constant()) continue;
    if (simple[i]) {
      base.push_back({inputs[i], {{static_cast<int>(i), 1}}});
    } else {
      if (!refinement) refinement.emplace();
      refinement->add(static_cast<int>(i), inputs[i]);
    }
  }
  if (!refinement) return base;
  for (auto& element : std::move(*refinement).take(inputs)) base.push_back(std::move(element));
  std::stable_sort(base.begin(), base.end(), [](const auto& a, const auto& b) {
    return a.sources.front().index < b.sources.front().index;
  });
  return base;
}

}  // namespace

std::vector<BaseElement<2>> coprime_square_free_base(const std::vector<Polynomial<2>>& inputs) {
  return coprime_base(inputs);
}
std::vector<BaseElement<3>> coprime_square_free_base(const std::vector<Polynomial<3>>& inputs) {
  return coprime_base(inputs);
}

namespace {

/// An integer polynomial as one in the eliminated variable: rows[j] holds the coefficient of its
/// j-th power by powers of the other variable.
struct Rows {
  std::vector<std::vector<Integer>> rows;
  Integer denominator;  ///< what the polynomial was multiplied with
  Integer norm = 0;     ///< the sum of the absolute values of all coefficients
  int degree = 0;       ///< in the eliminated variable
  int other_degree = 0;
  int total_degree = 0;

  Rows(const Polynomial<2>& f, int eliminated_axis)
      : denominator(common_denominator(f)),
        degree(f.degree(eliminated_axis)),
        other_degree(f.degree(1 - eliminated_axis)),
        total_degree(f.degree()) {
    rows.assign(static_cast<std::size_t>(degree) + 1,
                std::vector<Integer>(static_cast<std::size_t>(other_degree) + 1));
    for (const auto& term : f.terms()) {
      const Integer coefficient = scaled(term.coefficient, denominator);
      norm += abs(coefficient);
      rows[static_cast<std::size_t>(term.exponent[eliminated_axis])]
          [static_cast<std::size_t>(term.exponent[1 - eliminated_axis])] = coefficient;
    }
  }
};

/// Rows modulo a prime, to be evaluated at values of the other variable.
class ModularRows {
 public:
  ModularRows(const Rows& f, const nmod_t& mod) : mod_(mod) {
    for (const auto& row : f.rows) {
      auto& reduced = rows_.emplace_back();
      for (const Integer& c : row) reduced.push_back(mpz_fdiv_ui(c.get_mpz_t(), mod.n));
    }
  }
  bool keeps_degree() const {
    return std::any_of(rows_.back().begin(), rows_.back().end(), [](ulong c) { return c != 0; });
  }
  /// False if the degree drops there.
  bool evaluate(ulong x, ModularPoly* value) const {
    nmod_poly_zero(*value);
    for (std::size_t j = rows_.size(); j-- > 0;) {
      ulong sum = 0;
      for (std::size_t i = rows_[j].size(); i-- > 0;)
        sum = nmod_add(nmod_mul(sum, x, mod_), rows_[j][i], mod_);
      if (j + 1 == rows_.size() && sum == 0) return false;
      nmod_poly_set_coeff_ui(*value, static_cast<slong>(j), sum);
    }
    return true;
  }

 private:
  nmod_t mod_;
  std::vector<std::vector<ulong>> rows_;
};

long bits_of(const Integer& value) {
  return static_cast<long>(mpz_sizeinbase(value.get_mpz_t(), 2));
}

}  // namespace

// The Sylvester determinant commutes with every ring homomorphism, so where neither leading
// coefficient vanishes the resultant modulo p at x = x_k is the resultant of the values. The values
// at degree + 1 points determine it modulo p, and enough primes determine it over the integers:
// each term of the determinant takes deg g factors from rows of f and deg f from rows of g, so that
// the sum of the absolute values of its coefficients is at most |f|_1^(deg g) |g|_1^(deg f).
Polynomial<1> resultant(const Polynomial<2>& f, const Polynomial<2>& g, int eliminated_axis) {
  const Rows a(f, eliminated_axis), b(g, eliminated_axis);
  const long bits = b.degree * bits_of(a.norm) + a.degree * bits_of(b.norm) + 2;
  const int degree = std::min(a.total_degree * b.total_degree,
                              a.degree * b.other_degree + b.degree * a.other_degree);
  const std::size_t size = static_cast<std::size_t>(degree) + 1;

  std::vector<ulong> primes;
  std::vector<std::vector<ulong>> residues(size);  // by coefficient, then by prime
  std::vector<ulong> point(size), value(size);
  ulong prime = ulong{1} << 61;
  while (61 * static_cast<long>(primes.size()) < bits) {
    prime = n_nextprime(prime, 1);
    nmod_t mod;
    nmod_init(&mod, prime);
    const ModularRows a_mod(a, mod), b_mod(b, mod);
    if (!a_mod.keeps_degree() || !b_mod.keeps_degree()) continue;
    ModularPoly a_value(prime), b_value(prime), result(prime);
    ulong x = 0;
    for (std::size_t k = 0; k < size; ++x) {
      if (!a_mod.evaluate(x, &a_value) || !b_mod.evaluate(x, &b_value)) continue;
      point[k] = x;
      value[k++] = nmod_poly_resultant(a_value, b_value);
    }
    nmod_poly_interpolate_nmod_vec(result, point.data(), value.data(), static_cast<slong>(size));
    primes.push_back(prime);
    for (std::size_t k = 0; k < size; ++k)
      residues[k].push_back(nmod_poly_get_coeff_ui(result, static_cast<slong>(k)));
  }

  Integer scale_a, scale_b;
  mpz_pow_ui(scale_a.get_mpz_t(), a.denominator.get_mpz_t(), static_cast<ulong>(b.degree));
  mpz_pow_ui(scale_b.get_mpz_t(), b.denominator.get_mpz_t(), static_cast<ulong>(a.degree));
  const Rational scale(1, scale_a * scale_b);
  std::vector<Polynomial<1>::Term> terms(size);
  fmpz_comb_t comb;
  fmpz_comb_temp_t space;
  fmpz_comb_init(comb, primes.data(), static_cast<slong>(primes.size()));
  fmpz_comb_temp_init(space, comb);
  fmpz_t coefficient;
  fmpz_init(coefficient);
  for (std::size_t k = 0; k < size; ++k) {
    fmpz_multi_CRT_ui(coefficient, residues[k].data(), comb, space, 1);
    terms[k].exponent[0] = static_cast<int>(k);
    fmpz_get_mpz(terms[k].coefficient.get_num_mpz_t(), coefficient);
    terms[k].coefficient *= scale;
  }
  fmpz_clear(coefficient);
  fmpz_comb_temp_clear(space);
  fmpz_comb_clear(comb);
  return Polynomial<1>::from_terms(std::move(terms));
}

Polynomial<1> gcd(const Polynomial<1>& f, const Polynomial<1>& g) {
  IntegerPoly common, a(f), b(g);
  fmpz_poly_gcd(common, a, b);
  if (fmpz_poly_is_zero(common)) return {};
  fmpz_poly_primitive_part(common, common);
  return common.get();
}

namespace {

void make_square_free(IntegerPoly* f) {
  IntegerPoly derivative, common;
  fmpz_poly_primitive_part(*f, *f);
  fmpz_poly_derivative(derivative, *f);
  fmpz_poly_gcd(common, *f, derivative);
  if (fmpz_poly_degree(common) > 0) fmpz_poly_div(*f, *f, common);
}

int sign_variations(const fmpz_poly_struct* f) {
  int variations = 0, previous = 0;
  for (slong k = 0; k < f->length; ++k) {
    const int sign = fmpz_sgn(f->coeffs + k);
    if (sign == 0) continue;
    if (sign == -previous) ++variations;
    previous = sign;
  }
  return variations;
}

/// The number of roots in the open interval (0, 1) of a square-free f. By Descartes' rule it is the
/// number of sign variations of (1 + t)^n f(1 / (1 + t)) if that is 0 or 1; halving gets there
/// after finitely many steps because the roots are simple (Vincent's theorem).
int count_in_unit_interval(const IntegerPoly& f) {
  int count = 0;
  std::vector<IntegerPoly> pending{f};
  while (!pending.empty()) {
    IntegerPoly lower = std::move(pending.back());
    pending.pop_back();
    const slong degree = fmpz_poly_degree(lower);
    if (degree < 1) continue;
    IntegerPoly moved;
    fmpz_poly_reverse(moved, lower, degree + 1);
    fmpz_t one;
    fmpz_init_set_ui(one, 1);
    fmpz_poly_taylor_shift(moved, moved, one);
    const int variations = sign_variations(moved);
    if (variations <= 1) {
      count += variations;
      fmpz_clear(one);
      continue;
    }
    // 2^n f(t / 2), and the same shifted by one for the upper half.
    for (slong k = 0; k <= degree; ++k)
      fmpz_mul_2exp(fmpz_poly_get_coeff_ptr(lower, k), fmpz_poly_get_coeff_ptr(lower, k),
                    static_cast<ulong>(degree - k));
    IntegerPoly upper;
    fmpz_poly_taylor_shift(upper, lower, one);
    fmpz_clear(one);
    if (fmpz_is_zero(fmpz_poly_get_coeff_ptr(upper, 0))) {
      ++count;
      fmpz_poly_shift_right(upper, upper, 1);
    }
    pending.push_back(upper);
    pending.push_back(lower);
  }
  return count;
}

}  // namespace

Polynomial<1> square_free_part(const Polynomial<1>& f) {
  IntegerPoly part(f);
  make_square_free(&part);
  if (fmpz_sgn(fmpz_poly_lead(part)) < 0) fmpz_poly_neg(part, part);
  return part.get();
}

int count_real_roots(const Polynomial<1>& f, const Rational& lo, const Rational& hi) {
  if (lo > hi || f.is_constant()) return 0;
  if (lo == hi) return f({lo}) == 0 ? 1 : 0;
  IntegerPoly g(f);
  make_square_free(&g);
  const Polynomial<1> reduced = g.get();
  int count = 0;
  if (reduced({hi}) == 0) ++count;
  if (reduced({lo}) == 0) ++count;
  // With lo = a / c and hi = b / c: c^n g((a + (b - a) t) / c), whose roots at 0 are divided out. A
  // root at 1 makes no difference to the count in the open interval.
  Integer c;
  mpz_lcm(c.get_mpz_t(), lo.get_den_mpz_t(), hi.get_den_mpz_t());
  const Integer a = lo.get_num() * (c / lo.get_den());
  const Integer length = hi.get_num() * (c / hi.get_den()) - a;
  const slong degree = fmpz_poly_degree(g);
  fmpz_t factor, scale, shift;
  fmpz_init_set_ui(factor, 1);
  fmpz_init(scale);
  fmpz_init(shift);
  fmpz_set_mpz(scale, c.get_mpz_t());
  fmpz_set_mpz(shift, a.get_mpz_t());
  for (slong k = degree; k >= 0; --k) {
    fmpz_mul(fmpz_poly_get_coeff_ptr(g, k), fmpz_poly_get_coeff_ptr(g, k), factor);
    fmpz_mul(factor, factor, scale);
  }
  fmpz_poly_taylor_shift(g, g, shift);
  fmpz_set_mpz(scale, length.get_mpz_t());
  fmpz_one(factor);
  for (slong k = 0; k <= degree; ++k) {
    fmpz_mul(fmpz_poly_get_coeff_ptr(g, k), fmpz_poly_get_coeff_ptr(g, k), factor);
    fmpz_mul(factor, factor, scale);
  }
  fmpz_clear(factor);
  fmpz_clear(scale);
  fmpz_clear(shift);
  if (fmpz_is_zero(fmpz_poly_get_coeff_ptr(g, 0))) fmpz_poly_shift_right(g, g, 1);
  fmpz_poly_primitive_part(g, g);
  return count + count_in_unit_interval(g);
}

}  // namespace encase
