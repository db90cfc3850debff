// SPDX-License-Identifier: MIT
#include "common/filtered_polynomial.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "common/dyadic.hpp"
#include "common/interval.hpp"
#include "common/mpfr_number.hpp"
#include "common/rounding_bound.hpp"
#include "common/taylor_to_bernstein.hpp"

// The error bounds are derived in docs/error-bounds.md; `gamma` has the rule.
namespace encase {
namespace {

/// More than gradual underflow can add up to in the double rung: every loss is below 2^-1000 (also
/// that of converting a coefficient), there are less than 2^30, and what is lost of a coefficient
/// of a monomial is amplified like the monomial, by at most (1 + |x| + |y| + ...)^n.
template <int D>
double underflow(const Point<D>& magnitude, int degree) {
  double bound = 0x1p-960, power = 1.0;
  for (double x : magnitude) power += x;
  for (int rest = degree; rest > 0; rest /= 2, power *= power)
    if (rest % 2) bound *= power;
  return bound * (1 + 0x1p-40);
}

constexpr int kCoefficientRoundings = 2;  // mpq -> double truncates: at most one ulp

/// r += a * x, entry by entry.
void add_multiple(double* r, double a, const double* x, int count) {
  for (int i = 0; i < count; ++i) r[i] += a * x[i];
}
template <class Number>
void add_multiple(Number* r, const Number& a, const Number* x, int count) {
  for (int i = 0; i < count; ++i) add_product(r[i], a, x[i]);
}

/// p(x) -> p(origin + direction s), for `count` coefficients `stride` apart. A coefficient passes
/// through at most 4 roundings a degree.
template <class Number>
void shift_and_scale(Number* c, int count, int stride, const Number& origin,
                     const Number& direction, Number& power) {
  for (int i = 0; i + 1 < count; ++i)
    for (int j = count - 2; j >= i; --j) add_product(c[j * stride], origin, c[(j + 1) * stride]);
  for (int j = 1; j < count; ++j) {
    if (j == 1)
      power = direction;
    else
      multiply(power, direction);
    multiply(c[j * stride], power);
  }
}

/// Rounds to doubles and adds what that costs to the error.
template <class Number>
std::vector<double> round_all(const std::vector<Number>& values, double* error) {
  if constexpr (std::is_same_v<Number, double>) {
    return values;
  } else {
    std::vector<double> rounded(values.size());
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      rounded[i] = to_double(values[i]);
      sum += std::fabs(rounded[i]);
    }
    *error += 1.01 * 0x1p-53 * sum + 0x1p-1040;
    return rounded;
  }
}

}  // namespace

template <int D>
struct FilteredPolynomial<D>::Cache {
  /// What the first caller makes. (std::call_once takes a system call.)
  template <class Value>
  struct Lazy {
    Value value;
    std::atomic<bool> made = false;
  };
  template <class Value, class Make>
  const Value& get(Lazy<Value>& lazy, Make make) {
    if (!lazy.made.load(std::memory_order_acquire)) {
      std::lock_guard lock(mutex);
      if (!lazy.made.load(std::memory_order_relaxed)) {
        make(lazy.value);
        lazy.made.store(true, std::memory_order_release);
      }
    }
    return lazy.value;
  }

  std::mutex mutex;
  Lazy<std::vector<double>> low;
  Lazy<std::vector<long double>> extended;
  std::map<int, std::vector<Mpfr>> by_bits;
};

template <int D>
FilteredPolynomial<D>::FilteredPolynomial(Polynomial<D> exact)
    : exact_(std::move(exact)),
      degree_(std::max(0, exact_.degree())),
      cache_(std::make_shared<Cache>()) {
  exponent_ = exact_.is_zero() ? 0 : std::numeric_limits<int>::min();
  for (const auto& term : exact_.terms()) {
    // |numerator| and |denominator| lie in [2^(s-1), 2^s).
    const long e =
        bit_length(term.coefficient.get_num_mpz_t()) - bit_length(term.coefficient.get_den_mpz_t());
    exponent_ = static_cast<int>(std::max<long>(exponent_, e));
  }
  std::size_t size = 1;
  for (int i = 0; i < D; ++i) size *= degree_ + 1;
  coefficients_.assign(size, 0.0);
  magnitudes_.assign(size, 0.0);
  for (const auto& term : exact_.terms())
    set_coefficient(index_of(term.exponent, degree_), term.coefficient);
  if constexpr (D == 2) rows_ = CoefficientRows(coefficients_, degree_);
}

template <int D>
void FilteredPolynomial<D>::set_coefficient(std::size_t index, const Rational& exact) {
  if (const auto quick = quick_double(exact, -static_cast<long>(exponent_))) {
    coefficients_[index] = *quick;
  } else {
    const Rational value = scaled(exact);
    coefficients_[index] = value.get_d();
    exact_coefficients_ = exact_coefficients_ && is_power_of_two(value.get_den_mpz_t()) &&
                          Rational(coefficients_[index]) == value;
  }
  magnitudes_[index] = std::fabs(coefficients_[index]) * (1 + 0x1p-51);
}

template <int D>
std::size_t FilteredPolynomial<D>::index_of(const Exponent<D>& exponent, int degree) {
  std::size_t index = 0;
  for (const int e : exponent) index = index * (degree + 1) + e;
  return index;
}

template <int D>
Rational FilteredPolynomial<D>::scaled(const Rational& coefficient) const {
  Rational result;
  if (exponent_ >= 0)
    mpq_div_2exp(result.get_mpq_t(), coefficient.get_mpq_t(), exponent_);
  else
    mpq_mul_2exp(result.get_mpq_t(), coefficient.get_mpq_t(), -static_cast<long>(exponent_));
  return result;
}

template <int D>
const std::vector<double>& FilteredPolynomial<D>::low_coefficients() const {
  return cache_->get(cache_->low, [this](std::vector<double>& low) {
    low.assign(coefficients_.size(), 0.0);
    if (exact_coefficients_) return;
    for (const auto& term : exact_.terms()) {
      const std::size_t index = index_of(term.exponent, degree_);
      const Rational rest = scaled(term.coefficient) - Rational(coefficients_[index]);
      low[index] = rest.get_d();
    }
  });
}

template <int D>
template <class Number>
const std::vector<Number>& FilteredPolynomial<D>::coefficients_in(int bits) const {
  if constexpr (std::is_same_v<Number, double>) {
    return coefficients_;
  } else if constexpr (std::is_same_v<Number, long double>) {
    return cache_->get(cache_->extended, [this](std::vector<long double>& extended) {
      extended.assign(coefficients_.begin(), coefficients_.end());
      if (exact_coefficients_) return;
      for (const auto& term : exact_.terms())
        assign(extended[index_of(term.exponent, degree_)], scaled(term.coefficient));
    });
  } else {
    std::lock_guard lock(cache_->mutex);
    auto [entry, is_new] = cache_->by_bits.try_emplace(bits);
    if (is_new) {
      entry->second.assign(coefficients_.size(), Mpfr(bits));
      for (const auto& term : exact_.terms()) {
        const std::size_t index = index_of(term.exponent, degree_);
        Mpfr& c = entry->second[index];
        if (exact_coefficients_) {
          assign(c, coefficients_[index]);  // as much precision as a double at least
          continue;
        }
        assign(c, term.coefficient);
        mpfr_mul_2si(c.get(), c.get(), -static_cast<long>(exponent_), MPFR_RNDN);
      }
    }
    return entry->second;
  }
}

// Horner's rule on whole blocks: the first variable is summed out of all coefficients at once, then
// the next. The blocks of the dense array are contiguous.

namespace {

/// r = r * x + c, entry by entry.
void horner_step(double* r, double x, const double* c, int count) {
  for (int i = 0; i < count; ++i) r[i] = r[i] * x + c[i];
}
template <class Number>
void horner_step(Number* r, const Number& x, const Number* c, int count) {
  for (int i = 0; i < count; ++i) {
    multiply(r[i], x);
    add(r[i], c[i]);
  }
}

/// Sums out one variable of a dense array of n blocks; of block k only the first `used(k)` entries.
template <class Number, class Used>
void sum_out(Number* result, const Number* blocks, int n, int size, const Number& x, Used used) {
  if constexpr (std::is_floating_point_v<Number>) {
    if (size == 1) {
      Number sum = blocks[n - 1];
      for (int k = n - 2; k >= 0; --k) sum = sum * x + blocks[k];
      *result = sum;
      return;
    }
  }
  std::copy_n(blocks + static_cast<std::size_t>(n - 1) * size, size, result);
  for (int k = n - 2; k >= 0; --k)
    horner_step(result, x, blocks + static_cast<std::size_t>(k) * size, used(k));
}

}  // namespace

template <int D>
double FilteredPolynomial<D>::absolute(const Point<D>& magnitude) const {
  // All terms are non-negative: a relative error of at most gamma of the depth, and what underflows
  // (which a precision beyond doubles would not lose).
  double value = std::numeric_limits<double>::infinity();
  if constexpr (D == 2) value = rows_.absolute(magnitude);
  if (!std::isfinite(value)) value = sum<double>(magnitudes_, magnitude, Kernel::kDoubleBits);
  return value * 1.0000001 + underflow<D>(magnitude, degree_);
}

template <int D>
template <class Number, class Coordinate>
Number FilteredPolynomial<D>::sum(const std::vector<Number>& coefficients,
                                  const std::array<Coordinate, D>& point, int bits) const {
  const int n = degree_ + 1;
  int size = static_cast<int>(coefficients.size()) / n;
  thread_local std::vector<Number> first, second;
  first.resize(size, make_number<Number>(bits));
  second.resize(size, make_number<Number>(bits));
  Number x = make_number<Number>(bits);
  const Number* from = coefficients.data();
  for (int axis = 0; axis < D; ++axis, size /= n) {
    assign(x, point[axis]);
    // In two variables the block of x^k ends at the degree that k leaves; elsewhere it is full.
    sum_out(first.data(), from, n, size, x,
            [&](int k) { return D == 2 && axis == 0 ? n - k : size; });
    first.swap(second);
    from = second.data();
  }
  return second[0];
}

template <int D>
template <class Run>
void FilteredPolynomial<D>::with_coefficients(int bits, Kernel& kernel, Run run) const {
  if (Kernel::is_mpfr(bits)) {
    ++kernel.mpfr_expansions;
    run(coefficients_in<Mpfr>(bits));
  } else if (bits == Kernel::kExtendedBits) {
    run(coefficients_in<long double>(bits));
  } else {
    run(coefficients_in<double>(bits));
  }
}

template <int D>
void FilteredPolynomial<D>::expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel,
                                   Bernstein<D>* net) const {
  const Taylor t = taylor(box, bits, kernel);
  taylor_to_bernstein<D>(t.coefficients, degree_, t.error, net_degree, net);
}

template <int D>
typename FilteredPolynomial<D>::Taylor FilteredPolynomial<D>::taylor(const Box<D>& box, int bits,
                                                                     Kernel& kernel) const {
  ++kernel.expansions;
  Taylor result;
  Point<D> center, half, reach;
  for (int i = 0; i < D; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    center[i] = chart.center;
    half[i] = chart.half;
    reach[i] = (std::fabs(center[i]) + half[i]) * (1 + 0x1p-50);
  }
  const int n = degree_ + 1;
  const int roundings = (exact_coefficients_ ? 0 : kCoefficientRoundings) + 3 * degree_ + D;
  const auto run = [&]<class Number>(std::vector<Number> c) {
    Number power = make_number<Number>(bits);
    // The lines of the dense array along each axis; exponents of the others bound the length.
    std::size_t stride = c.size();
    for (int axis = 0; axis < D; ++axis) {
      stride /= n;
      Number origin = make_number<Number>(bits), direction = make_number<Number>(bits);
      assign(origin, center[axis]);
      assign(direction, half[axis]);
      for (std::size_t first = 0; first < c.size(); ++first) {
        if ((first / stride) % n != 0) continue;
        int used = 0;
        for (std::size_t rest = first; rest > 0; rest /= n) used += static_cast<int>(rest % n);
        if (used < degree_)
          shift_and_scale(&c[first], n - used, static_cast<int>(stride), origin, direction, power);
      }
    }
    double error = gamma(roundings, bits) * absolute(reach);
    if constexpr (std::is_floating_point_v<Number>) error += underflow<D>(reach, degree_);
    result.coefficients = round_all(c, &error);
    result.error = error;
  };
  with_coefficients(bits, kernel, run);
  return result;
}

template <int D>
void FilteredPolynomial<D>::restrict_to(const SegmentChart& segment, int bits, Kernel& kernel,
                                        Bernstein<1>* net) const requires(D == 2) {
  ++kernel.restrictions;
  const Point<2> reach = segment.reach();
  const int n = degree_ + 1;
  // A term x^i y^j: its coefficient, the Taylor shift of its row (3 i + 1), Horner over the rows (a
  // product and two sums each: 3 j), and those of the i + j factors; i + j <= degree_.
  const int roundings =
      (exact_coefficients_ ? 0 : kCoefficientRoundings) + (3 + segment.roundings()) * degree_ + 4;
  const auto run = [&]<class Number>(std::vector<Number> c) {
    const Number zero = make_number<Number>(bits);
    std::array<Number, 2> origin{zero, zero}, direction{zero, zero};
    segment.origin_and_direction(&origin, &direction);
    // Row j: the coefficient of y^j, gathered as a polynomial in x, then in s.
    // Taylor's shift in x of all powers of y at once: row i holds the coefficients of x^i y^j.
    for (int i = 0; i + 1 < n; ++i)
      for (int k = n - 2; k >= i; --k)
        add_multiple(&c[k * n], origin[0], &c[(k + 1) * n], n - 1 - k);
    Number power = direction[0];
    for (int k = 1; k < n; ++k) {
      for (int j = 0; j < n - k; ++j) multiply(c[k * n + j], power);
      multiply(power, direction[0]);
    }
    // Horner over the powers of y: total (in s) times (origin_y + direction_y s), plus column j.
    std::vector<Number> total(n, zero);
    for (int j = degree_; j >= 0; --j) {
      const int length = n - j;
      for (int k = length - 1; k >= 0; --k) {
        multiply(total[k], origin[1]);
        if (k > 0) add_product(total[k], direction[1], total[k - 1]);
        add(total[k], c[k * n + j]);
      }
    }
    double error = gamma(roundings, bits) * absolute(reach);
    if constexpr (std::is_floating_point_v<Number>) error += underflow<2>(reach, degree_);
    const std::vector<double> taylor = round_all(total, &error);
    taylor_to_bernstein<1>(taylor, degree_, error, degree_, net);
  };
  with_coefficients(bits, kernel, run);
}

template <int D>
template <class Coordinate>
double FilteredPolynomial<D>::value_at(const std::array<Coordinate, D>& point, int bits) const {
  if (Kernel::is_mpfr(bits)) return to_double(sum<Mpfr>(coefficients_in<Mpfr>(bits), point, bits));
  if (bits == Kernel::kExtendedBits)
    return to_double(sum<long double>(coefficients_in<long double>(bits), point, bits));
  Point<D> rounded;
  for (int i = 0; i < D; ++i) assign(rounded[i], point[i]);
  return approximate(rounded);
}

/// In any arithmetic, without those of the coefficients and coordinates. Horner's rule has
/// 2 degree_ + D.
template <int D>
int FilteredPolynomial<D>::roundings_at_point() const {
  return D == 2 ? CoefficientRows::roundings(degree_) : 2 * degree_ + D;
}

template <int D>
typename FilteredPolynomial<D>::Value FilteredPolynomial<D>::with_error(double value,
                                                                        const Point<D>& magnitude,
                                                                        int roundings,
                                                                        int bits) const {
  double error = gamma(roundings, bits) * absolute(magnitude) + std::fabs(value) * 0x1p-52;
  error += Kernel::is_mpfr(bits) ? 0x1p-1040 : underflow<D>(magnitude, degree_);
  if (!std::isfinite(value) || std::isnan(error))
    return {0.0, std::numeric_limits<double>::infinity()};
  return {value, error * (1 + 0x1p-40)};
}

template <int D>
typename FilteredPolynomial<D>::Value FilteredPolynomial<D>::evaluate(const Point<D>& point,
                                                                      int bits) const {
  Point<D> magnitude;
  for (int i = 0; i < D; ++i) magnitude[i] = std::fabs(point[i]);
  return with_error(value_at(point, bits), magnitude, kCoefficientRoundings + roundings_at_point(),
                    bits);
}

template <int D>
typename FilteredPolynomial<D>::Value FilteredPolynomial<D>::evaluate_rounded(
    const Point<D>& point, const Point<D>& magnitude, int roundings) const {
  return with_error(approximate(point), magnitude,
                    kCoefficientRoundings + roundings_at_point() + roundings * degree_,
                    Kernel::kDoubleBits);
}

template <int D>
double FilteredPolynomial<D>::approximate(const Point<D>& point) const {
  if constexpr (D == 2) {
    const double value = rows_.value(point);
    if (std::isfinite(value)) return value;
  }
  return sum<double>(coefficients_, point, Kernel::kDoubleBits);
}

template <int D>
typename FilteredPolynomial<D>::ValueAndGradient FilteredPolynomial<D>::value_and_gradient(
    const Point<D>& point) const {
  if constexpr (D == 2) {
    const Jet jet = rows_.value_and_gradient(point);
    if (std::isfinite(jet.value + jet.gradient[0] + jet.gradient[1]))
      return {jet.value, jet.gradient};
  }
  return {sum<double>(coefficients_, point, Kernel::kDoubleBits), gradient_by_horner(point)};
}

template <int D>
Point<D> FilteredPolynomial<D>::gradient(const Point<D>& point) const {
  if constexpr (D == 2) return value_and_gradient(point).gradient;
  return gradient_by_horner(point);
}

template <int D>
Jet FilteredPolynomial<D>::jet(const Point<D>& point) const requires(D == 2) {
  return rows_.jet(point);
}

template <int D>
Point<D> FilteredPolynomial<D>::gradient_by_horner(const Point<D>& point) const {
  // Forward differentiation through Horner's rule: beside the block of values go the blocks of the
  // derivatives with respect to the variables summed out so far.
  const int n = degree_ + 1;
  int size = static_cast<int>(coefficients_.size()) / n;
  thread_local std::array<std::vector<double>, D + 1> jets, next;  // values, then derivatives
  for (auto* list : {&jets, &next})
    for (auto& block : *list) block.resize(size);
  const double* from = coefficients_.data();
  for (int axis = 0; axis < D; ++axis, size /= n) {
    const double x = point[axis];
    const auto used = [&](int k) { return D == 2 && axis == 0 ? n - k : size; };
    for (int d = 0; d < axis; ++d)
      sum_out(next[d + 1].data(), jets[d + 1].data(), n, size, x, used);
    double *value = next[0].data(), *slope = next[axis + 1].data();
    std::copy_n(from + static_cast<std::size_t>(n - 1) * size, size, value);
    std::fill_n(slope, size, 0.0);
    if (size == 1) {
      for (int k = n - 2; k >= 0; --k) {
        *slope = *slope * x + *value;
        *value = *value * x + from[k];
      }
    } else {
      for (int k = n - 2; k >= 0; --k) {
        horner_step(slope, x, value, used(k));
        horner_step(value, x, from + static_cast<std::size_t>(k) * size, used(k));
      }
    }
    jets.swap(next);
    from = jets[0].data();
  }
  Point<D> result;
  for (int d = 0; d < D; ++d) result[d] = jets[d + 1][0];
  return result;
}

template <int D>
Sign FilteredPolynomial<D>::sign_at(const RationalPoint<D>& point, Kernel& kernel) const {
  Point<D> magnitude;
  for (int i = 0; i < D; ++i) {
    magnitude[i] = std::fabs(point[i].get_d()) * (1 + 0x1p-50);
    // Below the range of doubles a conversion may lose more than an ulp.
    if (magnitude[i] < 0x1p-900) magnitude[i] = 0x1p-900;
  }
  // Every factor of a coordinate brings the (at most two) roundings of its conversion along.
  const int roundings = kCoefficientRoundings + roundings_at_point() + 2 * degree_;
  for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
    const Value v = with_error(value_at(point, bits), magnitude, roundings, bits);
    if (std::fabs(v.value) > v.error) {
      kernel.count(bits);
      return v.value > 0 ? Sign::Positive : Sign::Negative;
    }
  }
  ++kernel.decisions.by_exact;
  return sign_of(sgn(exact_(point)));
}

template class FilteredPolynomial<1>;
template class FilteredPolynomial<2>;
template class FilteredPolynomial<3>;

}  // namespace encase
