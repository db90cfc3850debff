// SPDX-License-Identifier: MIT
#include "common/filtered_expression.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "common/interval.hpp"
#include "common/local_jet.hpp"
#include "common/numerator.hpp"
#include "common/taylor_functions.hpp"
#include "common/taylor_to_bernstein.hpp"

namespace encase {
namespace {

constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kUnderflow = 0x1p-960;

/// There is no rung between doubles and MPFR.
int mpfr_bits(int bits) { return bits == Kernel::kExtendedBits ? 2 * Kernel::kDoubleBits : bits; }

bool is_rational(Operation operation) {
  switch (operation) {
    case Operation::Constant:
    case Operation::Variable:
    case Operation::Negate:
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Multiply:
    case Operation::Divide:
    case Operation::Power:
    case Operation::Abs:
    case Operation::Min:
    case Operation::Max:
      return true;
    default:
      return false;
  }
}

}  // namespace

template <int D>
template <int K, class Number>
struct FilteredExpression<D>::Workspace {
  TaylorFunctions<K, Number> arithmetic;
  std::vector<TaylorModel<K, Number>> places;
  std::array<Number, D> origin;
  std::array<std::array<Number, K>, D> direction;
  Point<D> error{};  ///< of all of a coordinate's numbers together

  Workspace()
      : origin(filled<D>(make_number<Number>(53))),
        direction(filled<D>(filled<K>(make_number<Number>(53)))) {}

  template <std::size_t N, class Value>
  static std::array<Value, N> filled(const Value& value) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) {
      return std::array<Value, N>{((void)I, value)...};
    }
    (std::make_index_sequence<N>());
  }

  void prepare(int degree, int bits, bool at_point, int count) {
    if (bits != arithmetic.bits()) {
      origin = filled<D>(make_number<Number>(bits));
      direction = filled<D>(filled<K>(make_number<Number>(bits)));
    }
    arithmetic.prepare(degree, bits, at_point);
    if (places.size() < static_cast<std::size_t>(count))
      places.resize(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) arithmetic.make_room(&places[static_cast<std::size_t>(k)]);
    error.fill(0.0);
  }
};

template <int D>
FilteredExpression<D>::FilteredExpression(Expression exact) : exact_(std::move(exact)) {
  // All in one list, as what it takes to have the greatest of them.
  const Numerator n = numerator_of(exact_);
  Expression all = n.numerator;
  for (const Expression& divisor : n.divisors)
    all = Expression::apply(Operation::Max, all, divisor);
  const std::vector<Expression::Step> steps = all.steps();
  std::vector<int> results{static_cast<int>(steps.size()) - 1};
  for (std::size_t k = 0; k < n.divisors.size(); ++k) {
    const Expression::Step& greatest = steps[static_cast<std::size_t>(results[0])];
    results[0] = greatest.first;
    results.push_back(greatest.second);
  }
  place_steps(steps, results);
}

/// Gives the steps that lead to results places; those of results are not used again.
template <int D>
void FilteredExpression<D>::place_steps(const std::vector<Expression::Step>& steps,
                                        const std::vector<int>& results) {
  constexpr int kUnused = -1;
  std::vector<int> last_use(steps.size(), kUnused);
  for (const int result : results)
    last_use[static_cast<std::size_t>(result)] = static_cast<int>(steps.size());
  for (std::size_t k = steps.size(); k-- > 0;) {
    if (last_use[k] == kUnused) continue;
    for (const int operand : {steps[k].first, steps[k].second})
      if (operand >= 0) {
        int& use = last_use[static_cast<std::size_t>(operand)];
        use = std::max(use, static_cast<int>(k));
      }
  }
  std::vector<int> place(steps.size(), -1), idle;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (last_use[k] == kUnused) continue;
    const Expression::Step& step = steps[k];
    if (idle.empty()) idle.push_back(places_++);
    place[k] = idle.back();
    idle.pop_back();
    const auto of = [&](int operand) {
      return operand < 0 ? -1 : place[static_cast<std::size_t>(operand)];
    };
    steps_.push_back(
        {step.operation, of(step.first), of(step.second), place[k], step.number, step.constant});
    rational_ = rational_ && is_rational(step.operation);
    for (const int operand : {step.first, step.second})
      if (operand >= 0 && last_use[static_cast<std::size_t>(operand)] == static_cast<int>(k) &&
          !(operand == step.first && operand == step.second && idle.size() > 0 &&
            idle.back() == of(operand)))
        idle.push_back(of(operand));
  }
  value_ = place[static_cast<std::size_t>(results[0])];
  for (std::size_t k = 1; k < results.size(); ++k)
    divisors_.push_back(place[static_cast<std::size_t>(results[k])]);
}

namespace {

/// Whether f has no zero on the polydisc: |c_0| is more than all else.
template <int K, class Number>
bool has_no_zero(const TaylorModel<K, Number>& f) {
  if (!f.exists()) return false;
  double rest = f.error;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(f.degree); ++k) rest += f.norm[k];
  return std::fabs(to_double(f.c[0])) > rest * kUp + kUnderflow;
}

}  // namespace

/// The model of the numerator, from the coordinates that the workspace was given.
template <int D>
template <int K, class Number>
const TaylorModel<K, Number>& FilteredExpression<D>::run(Workspace<K, Number>& w) const {
  TaylorFunctions<K, Number>& arithmetic = w.arithmetic;
  Number number = make_number<Number>(arithmetic.bits());
  const double unit = std::ldexp(1.0, -std::min(arithmetic.bits(), 900));
  for (const Step& step : steps_) {
    const auto place = [&](int k) { return &w.places[static_cast<std::size_t>(k)]; };
    TaylorModel<K, Number>* r = place(step.result);
    TaylorModel<K, Number>* a = step.first >= 0 ? place(step.first) : nullptr;
    TaylorModel<K, Number>* b = step.second >= 0 ? place(step.second) : nullptr;
    switch (step.operation) {
      case Operation::Constant: {
        assign(number, step.constant);
        // Truncated or rounded: at most one unit in the last place.
        const double size = std::fabs(to_double(number)) * (1 + 0x1p-50);
        arithmetic.constant(number, 2.02 * unit * size + kUnderflow, r);
        break;
      }
      case Operation::Pi:
        arithmetic.pi(r);
        break;
      case Operation::Euler:
        arithmetic.euler(r);
        break;
      case Operation::Variable: {
        const std::size_t axis = static_cast<std::size_t>(step.number);
        if (axis < D)
          arithmetic.linear(w.origin[axis], w.direction[axis], w.error[axis], r);
        else
          r->claim_nothing();
        break;
      }
      case Operation::Negate:
        arithmetic.negate(*a, r);
        break;
      case Operation::Add:
      case Operation::Subtract:
        arithmetic.add(*a, *b, step.operation == Operation::Subtract, r);
        break;
      case Operation::Multiply:
        arithmetic.multiply(*a, *b, r);
        break;
      case Operation::Divide:
        arithmetic.divide(*a, *b, r);
        break;
      case Operation::Power:
        arithmetic.power(*a, step.number, r);
        break;
      case Operation::Sqrt:
        arithmetic.sqrt(*a, r);
        break;
      case Operation::Exp:
        arithmetic.exp(*a, r);
        break;
      case Operation::Log:
        arithmetic.log(*a, r);
        break;
      case Operation::Sin:
        arithmetic.sin(*a, r);
        break;
      case Operation::Cos:
        arithmetic.cos(*a, r);
        break;
      case Operation::Tan:
        arithmetic.tan(*a, r);
        break;
      case Operation::Asin:
        arithmetic.asin(*a, r);
        break;
      case Operation::Acos:
        arithmetic.acos(*a, r);
        break;
      case Operation::Atan:
        arithmetic.atan(*a, r);
        break;
      case Operation::Sinh:
        arithmetic.sinh(*a, r);
        break;
      case Operation::Cosh:
        arithmetic.cosh(*a, r);
        break;
      case Operation::Tanh:
        arithmetic.tanh(*a, r);
        break;
      case Operation::Abs:
        arithmetic.abs(*a, r);
        break;
      case Operation::Min:
        arithmetic.least(*a, *b, r);
        break;
      case Operation::Max:
        arithmetic.greatest(*a, *b, r);
        break;
    }
  }
  // Where the numerator may be zero, no divisor may: else f may have no value at such a point.
  TaylorModel<K, Number>& value = w.places[static_cast<std::size_t>(value_)];
  if (value.exists() && !divisors_.empty() && !has_no_zero(value))
    for (const int divisor : divisors_)
      if (!has_no_zero(w.places[static_cast<std::size_t>(divisor)])) value.claim_nothing();
  return value;
}

namespace {

/// The model with coefficients that are doubles: dense, as `from`.
template <int K, class Number>
void round_model(const TaylorModel<K, Number>& from, TaylorModel<K, double>* to) {
  to->degree = from.degree;
  to->span = from.span;
  to->stride = from.stride;
  to->norm = from.norm;
  to->error = from.error;
  to->undefined = from.undefined;
  to->c.assign(from.c.size(), 0.0);
  if (!from.exists()) return;
  for (std::size_t k = 0; k < from.c.size(); ++k) {
    std::array<int, K> exponent;
    std::size_t rest = k;
    int total = 0;
    bool inside = true;
    for (int i = K - 1; i >= 0; --i) {
      const std::size_t axis = static_cast<std::size_t>(i);
      exponent[axis] = static_cast<int>(rest % static_cast<std::size_t>(from.stride));
      rest /= static_cast<std::size_t>(from.stride);
      total += exponent[axis];
      inside = inside && exponent[axis] <= from.span[axis];
    }
    if (inside && total <= from.degree) to->c[k] = to_double(from.c[k]);
  }
  to->error = (to->error + 1.02 * 0x1p-53 * to->polynomial_norm()) * kUp + kUnderflow;
}

}  // namespace

template <int D>
const TaylorModel<D, double>& FilteredExpression<D>::model(const Point<D>& center,
                                                           const Point<D>& half, int degree,
                                                           int bits, Kernel& kernel) const {
  ++kernel.expansions;
  const auto place = [&](auto& w) {
    for (std::size_t i = 0; i < D; ++i) {
      assign(w.origin[i], center[i]);
      for (std::size_t k = 0; k < D; ++k) assign(w.direction[i][k], i == k ? half[i] : 0.0);
    }
  };
  if (bits <= Kernel::kDoubleBits) {
    thread_local Workspace<D, double> workspace;
    workspace.prepare(degree, Kernel::kDoubleBits, false, places_);
    place(workspace);
    return run<D, double>(workspace);
  }
  ++kernel.mpfr_expansions;
  thread_local Workspace<D, Mpfr> workspace;
  workspace.prepare(degree, mpfr_bits(bits), false, places_);
  place(workspace);
  thread_local TaylorModel<D, double> rounded;
  round_model<D, Mpfr>(run<D, Mpfr>(workspace), &rounded);
  return rounded;
}

namespace {

/// Where a model claims nothing, neither does the net.
template <int K>
void make_net(const TaylorModel<K, double>& model, int net_degree, Bernstein<K>* net) {
  const int n = model.stride - 1;
  thread_local std::vector<double> dense;
  dense.assign(model.c.size(), 0.0);
  for (std::size_t k = 0; model.exists() && k < dense.size(); ++k) {
    std::size_t rest = k;
    int total = 0;
    bool inside = true;
    for (int i = K - 1; i >= 0; --i) {
      const int exponent = static_cast<int>(rest % static_cast<std::size_t>(model.stride));
      rest /= static_cast<std::size_t>(model.stride);
      total += exponent;
      inside = inside && exponent <= model.span[static_cast<std::size_t>(i)];
    }
    if (inside && total <= model.degree) dense[k] = model.c[k];
  }
  taylor_to_bernstein<K>(dense, n, model.error, net_degree, net);
}

}  // namespace

template <int D>
void FilteredExpression<D>::expand(const Box<D>& box, int net_degree, int bits, Kernel& kernel,
                                   Bernstein<D>* net) const {
  Point<D> center, half;
  for (std::size_t i = 0; i < D; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    center[i] = chart.center;
    half[i] = chart.half;
  }
  make_net<D>(model(center, half, kDegree, bits, kernel), net_degree, net);
}

template <int D>
template <class Number>
void FilteredExpression<D>::restrict_in(const SegmentChart& segment, int bits,
                                        Bernstein<1>* net) const requires(D == 2) {
  const Point<2> reach = segment.reach();
  const auto make = [&](Workspace<1, Number>& w) {
    w.prepare(kLineDegree, bits, false, places_);
    std::array<Number, 2> direction{make_number<Number>(bits), make_number<Number>(bits)};
    segment.origin_and_direction(&w.origin, &direction);
    const double unit = std::ldexp(1.0, -std::min(bits, 900));
    for (std::size_t i = 0; i < 2; ++i) {
      w.direction[i][0] = direction[i];
      w.error[i] = 1.01 * unit * (segment.roundings() + 1) * reach[i] *
                       TaylorModel<1, Number>::kRadius * kUp +
                   kUnderflow;
    }
    if constexpr (std::is_same_v<Number, double>) {
      make_net<1>(run<1, double>(w), kLineDegree, net);
    } else {
      TaylorModel<1, double> rounded;
      round_model<1, Mpfr>(run<1, Mpfr>(w), &rounded);
      make_net<1>(rounded, kLineDegree, net);
    }
  };
  thread_local Workspace<1, Number> workspace;
  make(workspace);
}

template <int D>
void FilteredExpression<D>::restrict_to(const SegmentChart& segment, int bits, Kernel& kernel,
                                        Bernstein<1>* net) const requires(D == 2) {
  ++kernel.restrictions;
  if (bits <= Kernel::kDoubleBits) return restrict_in<double>(segment, Kernel::kDoubleBits, net);
  ++kernel.mpfr_expansions;
  restrict_in<Mpfr>(segment, mpfr_bits(bits), net);
}

/// The value at a point the coordinates of which are known up to errors.
template <int D>
template <class Coordinate>
typename FilteredExpression<D>::Value FilteredExpression<D>::value_at(
    const std::array<Coordinate, D>& point, const Point<D>& error, int bits) const {
  const auto value = [&]<class Number>(Workspace<D, Number>& w) -> Value {
    w.prepare(0, bits, true, places_);
    for (std::size_t i = 0; i < D; ++i) {
      assign(w.origin[i], point[i]);
      for (std::size_t k = 0; k < D; ++k) assign(w.direction[i][k], 0.0);
      w.error[i] = error[i];
    }
    const TaylorModel<D, Number>& model = run<D, Number>(w);
    if (!model.exists()) return {0.0, kInfinite};
    const double result = to_double(model.c[0]);
    if (!std::isfinite(result)) return {0.0, kInfinite};
    const double rounding = std::is_same_v<Number, double> ? 0 : 0x1p-53 * std::fabs(result);
    return {result, (model.error + rounding) * kUp + kUnderflow};
  };
  if (bits <= Kernel::kDoubleBits) {
    thread_local Workspace<D, double> workspace;
    return value(workspace);
  }
  thread_local Workspace<D, Mpfr> workspace;
  return value(workspace);
}

template <int D>
typename FilteredExpression<D>::Value FilteredExpression<D>::evaluate(const Point<D>& point,
                                                                      int bits) const {
  return value_at(point, Point<D>{}, bits > Kernel::kDoubleBits ? mpfr_bits(bits) : bits);
}

template <int D>
typename FilteredExpression<D>::Value FilteredExpression<D>::evaluate_rounded(
    const Point<D>& point, const Point<D>& magnitude, int roundings) const {
  Point<D> error;
  for (std::size_t i = 0; i < D; ++i)
    error[i] = 1.01 * 0x1p-53 * roundings * magnitude[i] * kUp + kUnderflow;
  return value_at(point, error, Kernel::kDoubleBits);
}

template <int D>
double FilteredExpression<D>::precise_value(const Point<D>& point, double error,
                                            int max_bits) const {
  for (int bits = 2 * Kernel::kDoubleBits; bits <= max_bits; bits *= 2) {
    const Value v = value_at(point, Point<D>{}, bits);
    if (v.error <= std::max(error, 0x1.02p-53 * std::fabs(v.value))) return v.value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

// Values and derivatives in doubles, without error bounds.

template <int D>
LocalJet<D> FilteredExpression<D>::local_jet(const Point<D>& point) const {
  thread_local std::vector<LocalJet<D>> places;
  if (places.size() < static_cast<std::size_t>(places_))
    places.resize(static_cast<std::size_t>(places_));
  for (const Step& step : steps_) {
    const auto at = [&](int k) -> const LocalJet<D>& {
      return places[static_cast<std::size_t>(k)];
    };
    LocalJet<D> r;
    switch (step.operation) {
      case Operation::Constant:
        r.value = step.constant.get_d();
        break;
      case Operation::Pi:
        r.value = 3.14159265358979323846;
        break;
      case Operation::Euler:
        r.value = 2.71828182845904523536;
        break;
      case Operation::Variable:
        if (step.number < D) {
          r.value = point[static_cast<std::size_t>(step.number)];
          r.gradient[static_cast<std::size_t>(step.number)] = 1;
        }
        break;
      case Operation::Add:
        r = at(step.first).plus(1, at(step.second));
        break;
      case Operation::Subtract:
        r = at(step.first).plus(-1, at(step.second));
        break;
      case Operation::Multiply:
        r = at(step.first).times(at(step.second));
        break;
      case Operation::Divide:
        r = at(step.first).times(at(step.second).inverse());
        break;
      case Operation::Min:
        r = at(step.second).value < at(step.first).value ? at(step.second) : at(step.first);
        break;
      case Operation::Max:
        r = at(step.second).value > at(step.first).value ? at(step.second) : at(step.first);
        break;
      default:
        r = at(step.first).of(step.operation, step.number);
    }
    places[static_cast<std::size_t>(step.result)] = r;
  }
  return places[static_cast<std::size_t>(value_)];
}

template <int D>
double FilteredExpression<D>::approximate(const Point<D>& point) const {
  return local_jet(point).value;
}

template <int D>
Point<D> FilteredExpression<D>::gradient(const Point<D>& point) const {
  return local_jet(point).gradient;
}

template <int D>
typename FilteredExpression<D>::ValueAndGradient FilteredExpression<D>::value_and_gradient(
    const Point<D>& point) const {
  const LocalJet<D> jet = local_jet(point);
  return {jet.value, jet.gradient};
}

template <int D>
Jet FilteredExpression<D>::jet(const Point<D>& point) const requires(D == 2) {
  const LocalJet<D> local = local_jet(point);
  return {local.value, local.gradient, local.hessian[0][0], local.hessian[0][1],
          local.hessian[1][1]};
}

/// The numerator's exact value where only arithmetic leads to it and f has a value.
template <int D>
bool FilteredExpression<D>::exact_value(const RationalPoint<D>& point, Rational* value) const {
  std::vector<Rational> places(static_cast<std::size_t>(places_));
  for (const Step& step : steps_) {
    const auto at = [&](int k) -> const Rational& { return places[static_cast<std::size_t>(k)]; };
    Rational r;
    switch (step.operation) {
      case Operation::Constant:
        r = step.constant;
        break;
      case Operation::Variable:
        if (step.number >= D) return false;
        r = point[static_cast<std::size_t>(step.number)];
        break;
      case Operation::Negate:
        r = -at(step.first);
        break;
      case Operation::Add:
        r = at(step.first) + at(step.second);
        break;
      case Operation::Subtract:
        r = at(step.first) - at(step.second);
        break;
      case Operation::Multiply:
        r = at(step.first) * at(step.second);
        break;
      case Operation::Divide:
        if (at(step.second) == 0) return false;
        r = at(step.first) / at(step.second);
        break;
      case Operation::Power: {
        const unsigned long n = static_cast<unsigned long>(std::labs(step.number));
        if (n > kMaxDegree || (step.number < 0 && at(step.first) == 0)) return false;
        mpz_pow_ui(r.get_num_mpz_t(), at(step.first).get_num_mpz_t(), n);
        mpz_pow_ui(r.get_den_mpz_t(), at(step.first).get_den_mpz_t(), n);
        if (step.number < 0) r = 1 / r;
        break;
      }
      case Operation::Abs:
        r = ::abs(at(step.first));
        break;
      case Operation::Min:
        r = std::min(at(step.first), at(step.second));
        break;
      case Operation::Max:
        r = std::max(at(step.first), at(step.second));
        break;
      default:
        return false;
    }
    places[static_cast<std::size_t>(step.result)] = std::move(r);
  }
  for (const int divisor : divisors_)
    if (places[static_cast<std::size_t>(divisor)] == 0) return false;
  *value = places[static_cast<std::size_t>(value_)];
  return true;
}

template <int D>
Sign FilteredExpression<D>::sign_at(const RationalPoint<D>& point, Kernel& kernel) const {
  for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
    if (bits == Kernel::kExtendedBits && Kernel::kHasExtended) continue;
    // A conversion truncates or rounds: at most one unit in the last place.
    const double unit = std::ldexp(1.0, -std::min(bits, 900));
    Point<D> error;
    for (std::size_t i = 0; i < D; ++i) {
      const bool exact = bits <= Kernel::kDoubleBits && Rational(point[i].get_d()) == point[i];
      error[i] = exact ? 0.0 : 2.02 * unit * std::fabs(point[i].get_d()) * kUp + kUnderflow;
    }
    const Value v = value_at(point, error, bits);
    if (std::fabs(v.value) > v.error) {
      kernel.count(bits);
      return v.value > 0 ? Sign::Positive : Sign::Negative;
    }
  }
  if (Rational value; rational_ && exact_value(point, &value)) {
    ++kernel.decisions.by_exact;
    return sign_of(sgn(value));
  }
  ++kernel.decisions.undecided;
  return Sign::Zero;
}

template class FilteredExpression<1>;
template class FilteredExpression<2>;
template class FilteredExpression<3>;

}  // namespace encase
