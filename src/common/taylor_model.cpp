// SPDX-License-Identifier: MIT
#include "common/taylor_model.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "common/taylor_bounds.hpp"

namespace encase {

using namespace taylor;

namespace {

/// f(offset, count, degree) for the rows of coefficients that a model has: where they begin, how
/// many there are, and the total degree of the first.
template <int D, class Row>
void for_rows(const std::array<int, D>& span, int degree, int stride, Row row) {
  const auto count = [&](int left) { return std::min(span[D - 1], left) + 1; };
  if constexpr (D == 1) {
    row(0, count(degree), 0);
  } else {
    for (int i = 0; i <= std::min(span[0], degree); ++i)
      if constexpr (D == 2) {
        row(i * stride, count(degree - i), i);
      } else {
        for (int j = 0; j <= std::min(span[1], degree - i); ++j)
          row((i * stride + j) * stride, count(degree - i - j), i + j);
      }
  }
}

/// How many coefficients a model has at most.
template <class Model>
int terms(const Model& a) {
  int count = 1;
  for (const int s : a.span) count *= std::min(s, a.degree) + 1;
  return count;
}

/// r += a b without the terms beyond a total degree; K variables are left.
template <int K, int D, class Number>
void add_products(Number* r, const Number* a, int degree_a, const std::array<int, D>& span_a,
                  const Number* b, int degree_b, const std::array<int, D>& span_b, int limit,
                  int stride) {
  constexpr int axis = D - K;
  const int end_a = std::min({span_a[axis], degree_a, limit});
  if constexpr (K == 1) {
    for (int i = 0; i <= end_a; ++i) {
      if (is_zero(a[i])) continue;
      const int end_b = std::min({span_b[axis], degree_b, limit - i});
      Number* to = r + i;
      for (int j = 0; j <= end_b; ++j) add_product(to[j], a[i], b[j]);
    }
  } else {
    int step = stride;
    for (int k = K; k > 2; --k) step *= stride;
    for (int i = 0; i <= end_a; ++i) {
      const int end_b = std::min({span_b[axis], degree_b, limit - i});
      for (int j = 0; j <= end_b; ++j)
        add_products<K - 1, D>(r + (i + j) * step, a + i * step, degree_a - i, span_a, b + j * step,
                               degree_b - j, span_b, limit - i - j, stride);
    }
  }
}

template <int D, class Number>
bool both_exist(const TaylorModel<D, Number>& a, const TaylorModel<D, Number>& b,
                TaylorModel<D, Number>* r) {
  if (a.exists() && b.exists()) return true;
  r->claim_nothing(a.undefined || b.undefined);
  return false;
}

}  // namespace

template <int D, class Number>
Number TaylorArithmetic<D, Number>::number(double value) const {
  if constexpr (std::is_same_v<Number, double>) {
    return value;
  } else {
    Mpfr result(bits_);
    assign(result, value);
    return result;
  }
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::prepare(int max_degree, int bits, bool at_point) {
  const bool fresh = bits != bits_ || series_.empty();
  max_degree_ = max_degree;
  bits_ = bits;
  at_point_ = at_point;
  unit_ = std::ldexp(1.0, -std::min(bits, 900));
  if (fresh) series_.assign(Model::kMaxDegree + 1, number(0));
  for (Model* model : {&next_, &first_, &second_, &third_}) {
    if (fresh) model->c.clear();
    make_room(model);
  }
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::make_room(Model* model) const {
  model->stride = max_degree_ + 1;
  std::size_t size = 1;
  for (int k = 0; k < D; ++k) size *= static_cast<std::size_t>(max_degree_) + 1;
  if constexpr (!std::is_same_v<Number, double>)
    if (!model->c.empty() && mpfr_get_prec(model->c[0].get()) != bits_) model->c.clear();
  model->c.resize(size, number(0));
}

/// The norms of the coefficients; those of the highest degrees go to the error where they do not
/// matter.
template <int D, class Number>
void TaylorArithmetic<D, Number>::measure(Model* r) const {
  static const auto powers = [] {
    std::array<double, Model::kMaxDegree + 1> p;
    p[0] = 1;
    for (std::size_t k = 1; k < p.size(); ++k) p[k] = p[k - 1] * Model::kRadius * kUp;
    return p;
  }();
  r->norm.fill(0.0);
  for_rows<D>(r->span, r->degree, r->stride, [&](int offset, int count, int first) {
    const Number* row = r->c.data() + offset;
    double* norm = r->norm.data() + first;
    for (int j = 0; j < count; ++j) norm[j] += at_least(row[j]);
  });
  double sum = 0;
  for (std::size_t k = 0; k < powers.size(); ++k) {
    r->norm[k] *= powers[k] * kUp;
    sum += r->norm[k];
  }
  if (!(sum + r->error < kLargest)) return r->claim_nothing();
  const double little = 0x1p-6 * unit_ * sum;
  while (r->degree > 0 && r->norm[static_cast<std::size_t>(r->degree)] <= little) {
    double& last = r->norm[static_cast<std::size_t>(r->degree)];
    r->error = (r->error + last) * kUp;
    last = 0;
    --r->degree;
  }
  for (int& s : r->span) s = std::min(s, r->degree);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::constant(const Number& value, double error, Model* r) const {
  r->degree = 0;
  r->span.fill(0);
  r->c[0] = value;
  r->error = error;
  measure(r);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::linear(const Number& origin,
                                         const std::array<Number, D>& direction, double error,
                                         Model* r) const {
  r->degree = 0;
  r->span.fill(0);
  for (int k = 0; k < D; ++k)
    if (max_degree_ > 0 && !is_zero(direction[static_cast<std::size_t>(k)]))
      r->degree = r->span[static_cast<std::size_t>(k)] = 1;
  for_rows<D>(r->span, r->degree, r->stride, [&](int offset, int count, int) {
    for (int j = 0; j < count; ++j) assign(r->c[static_cast<std::size_t>(offset + j)], 0.0);
  });
  r->c[0] = origin;
  int at = 1;
  for (int k = D - 1; k >= 0; --k, at *= r->stride) {
    const std::size_t axis = static_cast<std::size_t>(k);
    if (r->span[axis] > 0)
      r->c[static_cast<std::size_t>(at)] = direction[axis];
    else
      error += at_least(direction[axis]) * Model::kRadius * kUp;
  }
  r->error = error * kUp;
  measure(r);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::copy(const Model& a, Model* r) const {
  r->degree = a.degree;
  r->span = a.span;
  r->norm = a.norm;
  r->error = a.error;
  r->undefined = a.undefined;
  for_rows<D>(a.span, a.degree, a.stride, [&](int offset, int count, int) {
    std::copy_n(a.c.data() + offset, count, r->c.data() + offset);
  });
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::negate(const Model& a, Model* r) const {
  copy(a, r);
  for_rows<D>(a.span, a.degree, a.stride, [&](int offset, int count, int) {
    for (int j = 0; j < count; ++j) encase::negate(r->c[static_cast<std::size_t>(offset + j)]);
  });
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::add(const Model& a, const Model& b, bool subtract,
                                      Model* r) const {
  if (!both_exist(a, b, r)) return;
  r->degree = std::max(a.degree, b.degree);
  for (std::size_t k = 0; k < D; ++k) r->span[k] = std::max(a.span[k], b.span[k]);
  Number* c = r->c.data();
  for_rows<D>(r->span, r->degree, r->stride, [&](int offset, int count, int) {
    for (int j = 0; j < count; ++j) assign(c[offset + j], 0.0);
  });
  for_rows<D>(b.span, b.degree, b.stride, [&](int offset, int count, int) {
    const Number* from = b.c.data() + offset;
    for (int j = 0; j < count; ++j) {
      c[offset + j] = from[j];
      if (subtract) encase::negate(c[offset + j]);
    }
  });
  for_rows<D>(a.span, a.degree, a.stride, [&](int offset, int count, int) {
    const Number* from = a.c.data() + offset;
    for (int j = 0; j < count; ++j) encase::add(c[offset + j], from[j]);
  });
  r->error = (a.error + b.error) * kUp;
  measure(r);
  if (r->exists()) r->error = (r->error + gamma(1) * r->polynomial_norm()) * kUp + kUnderflow;
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::multiply(const Model& a, const Model& b, Model* r) const {
  multiply_up_to(max_degree_, a, b, r);
}

/// Without the terms beyond a total degree: these go to the error.
template <int D, class Number>
void TaylorArithmetic<D, Number>::multiply_up_to(int limit, const Model& a, const Model& b,
                                                 Model* r) const {
  if (!both_exist(a, b, r)) return;
  const int terms_a = terms(a), terms_b = terms(b);
  if (terms_a > terms_b) return multiply_up_to(limit, b, a, r);
  r->degree = std::min(a.degree + b.degree, limit);
  for (std::size_t k = 0; k < D; ++k) r->span[k] = std::min(a.span[k] + b.span[k], r->degree);
  Number* c = r->c.data();
  for_rows<D>(r->span, r->degree, r->stride, [&](int offset, int count, int) {
    for (int j = 0; j < count; ++j) assign(c[offset + j], 0.0);
  });
  add_products<D, D>(c, a.c.data(), a.degree, a.span, b.c.data(), b.degree, b.span, limit,
                     r->stride);
  double lost = 0, rounding = 0;
  for (int p = 0; p <= a.degree; ++p) {
    const double of_a = a.norm[static_cast<std::size_t>(p)];
    for (int q = 0; q <= b.degree; ++q) {
      const double product = of_a * b.norm[static_cast<std::size_t>(q)];
      if (p + q > limit) {
        lost += product;
        continue;
      }
      // Of the summands of a coefficient each is rounded, and in every sum that follows.
      int summands = 1;
      for (int k = 0; k < D; ++k) summands *= (p + q) / D + 1 + ((p + q) % D > 0);
      rounding += std::min(summands, terms_a) * product;
    }
  }
  const double norm_a = a.polynomial_norm(), norm_b = b.polynomial_norm();
  r->error = (lost + gamma(1) * 1.01 * rounding + norm_a * b.error + a.error * norm_b +
              a.error * b.error) *
                 kUp +
             kUnderflow;
  measure(r);
}

template <int D, class Number>
double TaylorArithmetic<D, Number>::rest_norm(const Model& a) const {
  double rest = a.error;
  for (int k = 1; k <= a.degree; ++k) rest += a.norm[static_cast<std::size_t>(k)];
  return rest * kUp;
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::compose(Model& a, double rest, double tail,
                                          const double* relative, Model* r) {
  std::array<double, Model::kMaxDegree + 1> size;
  double power = 1, rounding = 0, most = 0;
  for (int k = 0; k <= max_degree_; ++k) {
    const std::size_t index = static_cast<std::size_t>(k);
    size[index] = at_least(series_[index]) * power * kUp;
    rounding += relative[k] * size[index];
    most = std::max(most, size[index]);
    power *= rest * kUp;
  }
  tail += kUnderflow * (1 + power);
  if (!(tail + rounding + most < kLargest)) return r->claim_nothing();
  // Terms that do not matter are left out.
  int last = max_degree_;
  while (last > 0 && tail + size[static_cast<std::size_t>(last)] <= 0x1p-6 * unit_ * most)
    tail += size[static_cast<std::size_t>(last--)];
  // Horner's rule; what multiplies d^k needs terms up to the rest of the degree only.
  const Number constant_term = std::exchange(a.c[0], number(0));
  const double constant_norm = std::exchange(a.norm[0], 0.0);
  constant(series_[static_cast<std::size_t>(last)], 0, r);
  for (int k = last - 1; k >= 0 && r->exists(); --k) {
    multiply_up_to(max_degree_ - k, a, *r, &next_);
    std::swap(next_, *r);
    // (The constant term of the product is zero.)
    r->c[0] = series_[static_cast<std::size_t>(k)];
    r->norm[0] = at_least(series_[static_cast<std::size_t>(k)]);
  }
  a.c[0] = constant_term;
  a.norm[0] = constant_norm;
  if (!r->exists()) return;
  r->error = (r->error + tail + gamma(1) * 1.01 * rounding) * kUp + kUnderflow;
  measure(r);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::invert(Model& a, Model* r) {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  const double rest = rest_norm(a), least = at_most(a.c[0]) * kDown;
  if (!(rest < least)) return r->claim_nothing();
  Number inverse = number(1);
  encase::divide(inverse, a.c[0]);
  const Number factor = inverse;
  std::array<double, Model::kMaxDegree + 1> relative;
  for (int k = 0; k <= max_degree_; ++k) {
    series_[static_cast<std::size_t>(k)] = inverse;
    relative[static_cast<std::size_t>(k)] = 2 * k + 2;
    encase::multiply(inverse, factor);
    encase::negate(inverse);
  }
  const double tail = geometric_tail(rest / least * kUp, max_degree_) / least * kUp;
  compose(a, rest, tail, relative.data(), r);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::divide(const Model& a, Model& b, Model* r) {
  invert(b, &first_);
  multiply(a, first_, r);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::power(Model& a, int exponent, Model* r) {
  if (exponent == 0) return constant(number(1), 0, r);
  if (exponent < 0) {
    power(a, -exponent, &third_);
    return invert(third_, r);
  }
  // Squares and products, the highest binary digit first.
  int digit = 30;
  while (!((exponent >> digit) & 1)) --digit;
  copy(a, r);
  while (--digit >= 0) {
    multiply(*r, *r, &next_);
    std::swap(next_, *r);
    if (!((exponent >> digit) & 1)) continue;
    multiply(*r, a, &next_);
    std::swap(next_, *r);
  }
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::abs(const Model& a, Model* r) const {
  if (!a.exists()) return r->claim_nothing(a.undefined);
  if (!at_point_ && !(rest_norm(a) < at_most(a.c[0]))) return r->claim_nothing();
  if (is_positive(a.c[0]))
    copy(a, r);
  else
    this->negate(a, r);
}

template <int D, class Number>
void TaylorArithmetic<D, Number>::choose(const Model& a, const Model& b, bool smaller,
                                         Model* r) const {
  if (!both_exist(a, b, r)) return;
  const bool first = less(a.c[0], b.c[0]) == smaller;
  if (at_point_) {
    copy(first ? a : b, r);
    r->error = std::max(a.error, b.error);
    return;
  }
  add(a, b, true, r);
  if (!r->exists() || !(rest_norm(*r) < at_most(r->c[0]))) return r->claim_nothing();
  copy(first ? a : b, r);
}

template class TaylorArithmetic<1, double>;
template class TaylorArithmetic<2, double>;
template class TaylorArithmetic<3, double>;
template class TaylorArithmetic<1, Mpfr>;
template class TaylorArithmetic<2, Mpfr>;
template class TaylorArithmetic<3, Mpfr>;

}  // namespace encase
