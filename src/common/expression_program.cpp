// SPDX-License-Identifier: MIT
#include "common/expression_program.hpp"

#include <utility>

namespace encase {

namespace {

Interval number_like(const Interval&, double value) { return value; }
MpfrInterval number_like(const MpfrInterval& like, double value) {
  return MpfrInterval(like.bits(), value);
}

Interval whole_line_like(const Interval&) { return elementary::whole_line(); }
MpfrInterval whole_line_like(const MpfrInterval& like) {
  const Interval line = elementary::whole_line();
  return MpfrInterval(like.bits(), line.lo, line.hi);
}

template <class Step>
Interval constant_like(const Interval&, const Step& step) {
  return step.enclosure;
}
template <class Step>
MpfrInterval constant_like(const MpfrInterval& like, const Step& step) {
  if (step.operation == Operation::Pi) return elementary::pi(like.bits());
  if (step.operation == Operation::Euler) return elementary::euler(like.bits());
  return MpfrInterval(like.bits(), step.constant);
}

/// The value of a function of one variable and as many derivatives as the order says; others are
/// left as they are.
template <class Real>
struct Derivatives {
  Real value, first, second;
};

/// f = u^n, f' = n u^(n-1), f'' = n (n-1) u^(n-2).
template <int Order, class Real>
void derive_power(const Real& u, long n, Regularity& regularity, Derivatives<Real>* f) {
  using namespace elementary;
  Regularity ignored = Regularity::Smooth;
  const auto number = [&](long value) { return number_like(u, static_cast<double>(value)); };
  f->value = power(u, n, regularity);
  if constexpr (Order >= 1) f->first = multiply(number(n), power(u, n - 1, ignored));
  if constexpr (Order >= 2)
    f->second = multiply(multiply(number(n), number(n - 1)), power(u, n - 2, ignored));
}

/// The others, by the textbook. A derivative's own domain says nothing new of the function.
template <int Order, class Real>
void derive(Operation operation, const Real& u, Regularity& regularity, Derivatives<Real>* f) {
  using namespace elementary;
  Regularity ignored = Regularity::Smooth;
  const auto number = [&](double value) { return number_like(u, value); };
  const auto reciprocal = [&](const Real& a) { return divide(number(1), a, ignored); };
  const auto square = [&](const Real& a) { return power(a, 2, ignored); };
  switch (operation) {
    case Operation::Negate:
      f->value = negate(u);
      if constexpr (Order >= 1) f->first = number(-1);
      if constexpr (Order >= 2) f->second = number(0);
      break;
    case Operation::Sqrt:
      f->value = sqrt(u, regularity);
      if constexpr (Order >= 1) f->first = reciprocal(multiply(number(2), f->value));
      if constexpr (Order >= 2)
        f->second = negate(divide(f->first, multiply(number(2), u), ignored));
      break;
    case Operation::Exp:
      f->value = exp(u);
      if constexpr (Order >= 1) f->first = f->value;
      if constexpr (Order >= 2) f->second = f->value;
      break;
    case Operation::Log:
      f->value = log(u, regularity);
      if constexpr (Order >= 1) f->first = reciprocal(u);
      if constexpr (Order >= 2) f->second = negate(square(f->first));
      break;
    case Operation::Sin:
      f->value = sin(u);
      if constexpr (Order >= 1) f->first = cos(u);
      if constexpr (Order >= 2) f->second = negate(f->value);
      break;
    case Operation::Cos:
      f->value = cos(u);
      if constexpr (Order >= 1) f->first = negate(sin(u));
      if constexpr (Order >= 2) f->second = negate(f->value);
      break;
    case Operation::Tan:
      f->value = tan(u, regularity);
      if constexpr (Order >= 1) f->first = add(number(1), square(f->value));
      if constexpr (Order >= 2) f->second = multiply(multiply(number(2), f->value), f->first);
      break;
    case Operation::Asin:
    case Operation::Acos:
      f->value = operation == Operation::Asin ? asin(u, regularity) : acos(u, regularity);
      if constexpr (Order >= 1) {
        const Real product = multiply(subtract(number(1), u), add(number(1), u));
        f->first = reciprocal(sqrt(product, ignored));
        if (operation == Operation::Acos) f->first = negate(f->first);
        if constexpr (Order >= 2) f->second = multiply(u, divide(f->first, product, ignored));
      }
      break;
    case Operation::Atan:
      f->value = atan(u);
      if constexpr (Order >= 1) f->first = reciprocal(add(number(1), square(u)));
      if constexpr (Order >= 2) f->second = multiply(multiply(number(-2), u), square(f->first));
      break;
    case Operation::Sinh:
      f->value = sinh(u);
      if constexpr (Order >= 1) f->first = cosh(u);
      if constexpr (Order >= 2) f->second = f->value;
      break;
    case Operation::Cosh:
      f->value = cosh(u);
      if constexpr (Order >= 1) f->first = sinh(u);
      if constexpr (Order >= 2) f->second = f->value;
      break;
    case Operation::Tanh:
      f->value = tanh(u);
      // Not 1 - tanh^2, which cancels.
      if constexpr (Order >= 1) f->first = reciprocal(square(cosh(u)));
      if constexpr (Order >= 2) f->second = multiply(multiply(number(-2), f->value), f->first);
      break;
    case Operation::Abs:
      f->value = abs(u, regularity);
      if constexpr (Order >= 1) {
        const Real zero = number(0), one = number(1);
        f->first = is_below(zero, u)   ? one
                   : is_below(u, zero) ? negate(one)
                                       : hull(negate(one), one);
      }
      if constexpr (Order >= 2) f->second = number(0);
      break;
    default:
      break;
  }
}

/// Calls part(p) for every part of a jet that may differ from zero if only the variables of `axes`
/// occur, with the variables i <= j of a second derivative.
template <int D, int Order, class First, class Second>
void for_derivatives(int axes, const First& first, const Second& second) {
  if constexpr (Order >= 1)
    for (int i = 0; i < D; ++i) {
      if (axes >> i & 1) first(i);
      if constexpr (Order >= 2)
        for (int j = i; j < D; ++j)
          if ((axes >> i & 1) && (axes >> j & 1)) second(i, j);
    }
}

/// One step on jets; what does not depend on a variable has derivatives zero already.
template <class Real, int D, int Order>
class StepOnJets {
 public:
  using Jet = IntervalJet<Real, D, Order>;
  using Step = typename ExpressionProgram<D>::Step;

  StepOnJets(const std::vector<Step>& steps, std::vector<Jet>& jets, Regularity& regularity)
      : steps_(steps), jets_(jets), regularity_(regularity) {}

  void run(const Step& step, Jet* result) const {
    switch (step.operation) {
      case Operation::Add:
      case Operation::Subtract:
        return add(step, result);
      case Operation::Multiply:
        return multiply(step, result);
      case Operation::Divide:
        return divide(step, result);
      case Operation::Min:
      case Operation::Max:
        return choose(step, result);
      default:
        return chain(step, result);
    }
  }

 private:
  const Jet& jet(int index) const { return jets_[static_cast<std::size_t>(index)]; }
  int axes(int index) const { return steps_[static_cast<std::size_t>(index)].axes; }
  static Real& first(Jet* jet, int i) { return jet->part[static_cast<std::size_t>(1 + i)]; }
  static Real& second(Jet* jet, int i, int j) { return jet->part[Jet::second_index(i, j)]; }

  void add(const Step& step, Jet* r) const {
    const Jet &a = jet(step.first), &b = jet(step.second);
    const bool minus = step.operation == Operation::Subtract;
    const auto sum = [&](const Real& s, const Real& t) {
      return minus ? elementary::subtract(s, t) : elementary::add(s, t);
    };
    r->part[0] = sum(a.value(), b.value());
    for_derivatives<D, Order>(
        step.axes, [&](int i) { first(r, i) = sum(a.first(i), b.first(i)); },
        [&](int i, int j) { second(r, i, j) = sum(a.second(i, j), b.second(i, j)); });
  }

  /// (a b)_i = a_i b + a b_i, (a b)_ij = a_ij b + a_i b_j + a_j b_i + a b_ij.
  void multiply(const Step& step, Jet* r) const {
    const Jet &a = jet(step.first), &b = jet(step.second);
    const int of_a = axes(step.first), of_b = axes(step.second);
    const auto both = [&](int i) { return (of_a & of_b) >> i & 1; };
    r->part[0] = elementary::multiply(a.value(), b.value());
    for_derivatives<D, Order>(
        step.axes,
        [&](int i) {
          if (both(i))
            first(r, i) = elementary::add(elementary::multiply(a.first(i), b.value()),
                                          elementary::multiply(a.value(), b.first(i)));
          else if (of_a >> i & 1)
            first(r, i) = elementary::multiply(a.first(i), b.value());
          else
            first(r, i) = elementary::multiply(a.value(), b.first(i));
        },
        [&](int i, int j) {
          const Real mixed = elementary::add(elementary::multiply(a.first(i), b.first(j)),
                                             elementary::multiply(a.first(j), b.first(i)));
          second(r, i, j) =
              elementary::add(elementary::add(elementary::multiply(a.second(i, j), b.value()),
                                              elementary::multiply(a.value(), b.second(i, j))),
                              mixed);
        });
  }

  /// q = a / b: q_i = (a_i - q b_i) / b, q_ij = (a_ij - q_i b_j - q_j b_i - q b_ij) / b.
  void divide(const Step& step, Jet* r) const {
    const Jet &a = jet(step.first), &b = jet(step.second);
    Regularity ignored = Regularity::Smooth;
    r->part[0] = elementary::divide(a.value(), b.value(), regularity_);
    const bool constant = axes(step.second) == 0;
    for_derivatives<D, Order>(
        step.axes,
        [&](int i) {
          first(r, i) = elementary::divide(
              constant
                  ? a.first(i)
                  : elementary::subtract(a.first(i), elementary::multiply(r->value(), b.first(i))),
              b.value(), ignored);
        },
        [](int, int) {});
    if constexpr (Order >= 2)
      for_derivatives<D, Order>(
          step.axes, [](int) {},
          [&](int i, int j) {
            const Real mixed = elementary::add(elementary::multiply(r->first(i), b.first(j)),
                                               elementary::multiply(r->first(j), b.first(i)));
            const Real rest =
                elementary::add(mixed, elementary::multiply(r->value(), b.second(i, j)));
            second(r, i, j) =
                elementary::divide(elementary::subtract(a.second(i, j), rest), b.value(), ignored);
          });
  }

  void choose(const Step& step, Jet* r) const {
    const Jet &a = jet(step.first), &b = jet(step.second);
    const bool least = step.operation == Operation::Min;
    if (elementary::is_below(a.value(), b.value())) {
      *r = least ? a : b;
    } else if (elementary::is_below(b.value(), a.value())) {
      *r = least ? b : a;
    } else {
      for (std::size_t p = 1; p < Jet::kSize; ++p)
        r->part[p] = elementary::hull(a.part[p], b.part[p]);
      r->part[0] = least ? elementary::min(a.value(), b.value(), regularity_)
                         : elementary::max(a.value(), b.value(), regularity_);
    }
  }

  /// f(u)_i = f' u_i, f(u)_ij = f'' u_i u_j + f' u_ij.
  void chain(const Step& step, Jet* r) const {
    const Jet& u = jet(step.first);
    Derivatives<Real> f;
    if (step.operation == Operation::Power)
      derive_power<Order>(u.value(), step.number, regularity_, &f);
    else
      derive<Order>(step.operation, u.value(), regularity_, &f);
    r->part[0] = f.value;
    for_derivatives<D, Order>(
        step.axes, [&](int i) { first(r, i) = elementary::multiply(f.first, u.first(i)); },
        [&](int i, int j) {
          second(r, i, j) = elementary::add(
              elementary::multiply(f.second, elementary::multiply(u.first(i), u.first(j))),
              elementary::multiply(f.first, u.second(i, j)));
        });
  }

  const std::vector<Step>& steps_;
  std::vector<Jet>& jets_;
  Regularity& regularity_;
};

/// What a proved enclosure of the value at a point says of its sign.
template <class Evaluation>
std::optional<PointSign> sign_in(const Evaluation& evaluation) {
  if (evaluation.nowhere()) return PointSign::NoValue;
  if (!evaluation.continuous()) return std::nullopt;
  const auto sign = evaluation.range().sign();
  if (!sign) return std::nullopt;
  return *sign == Sign::Zero       ? PointSign::Zero
         : *sign == Sign::Positive ? PointSign::Positive
                                   : PointSign::Negative;
}

}  // namespace

template <int D>
ExpressionProgram<D>::ExpressionProgram(const Expression& expression) {
  for (const Expression::Step& from : expression.steps()) {
    Step step;
    step.operation = from.operation;
    step.first = from.first;
    step.second = from.second;
    step.number = from.number;
    step.constant = from.constant;
    if (from.operation == Operation::Variable) step.axes = 1 << from.number;
    for (const int operand : {from.first, from.second})
      if (operand >= 0) step.axes |= steps_[static_cast<std::size_t>(operand)].axes;
    if (from.operation == Operation::Multiply && from.first == from.second) {
      // A square, which is not negative.
      step.operation = Operation::Power;
      step.second = -1;
      step.number = 2;
    }
    if (from.operation == Operation::Constant)
      step.enclosure = Interval::enclose(from.constant);
    else if (from.operation == Operation::Pi)
      step.enclosure = elementary::rounded_outward(elementary::pi(64));
    else if (from.operation == Operation::Euler)
      step.enclosure = elementary::rounded_outward(elementary::euler(64));
    steps_.push_back(std::move(step));
  }
}

template <int D>
template <int Order, class Real>
JetOnBox<Real, D, Order> ExpressionProgram<D>::evaluate(const std::array<Real, D>& box,
                                                        Workspace<Real>& workspace) const {
  auto& jets = workspace.template jets<Order>();
  if (jets.size() < steps_.size()) jets.resize(steps_.size());
  Regularity regularity = Regularity::Smooth;
  const Real zero = number_like(box[0], 0);
  const StepOnJets<Real, D, Order> on_jets(steps_, jets, regularity);
  for (std::size_t k = 0; k < steps_.size() && regularity != Regularity::Nowhere; ++k) {
    const Step& step = steps_[k];
    auto& part = jets[k].part;
    std::fill(part.begin() + 1, part.end(), zero);
    if (step.operation == Operation::Variable) {
      const auto axis = static_cast<std::size_t>(step.number);
      part[0] = box[axis];
      if constexpr (Order >= 1) part[1 + axis] = number_like(box[0], 1);
    } else if (step.first < 0) {
      part[0] = constant_like(box[0], step);
    } else {
      on_jets.run(step, &jets[k]);
    }
  }
  JetOnBox<Real, D, Order> result{jets[steps_.size() - 1], regularity};
  if (regularity == Regularity::Nowhere) result.jet.part.fill(whole_line_like(box[0]));
  return result;
}

template <int D>
PointSign ExpressionProgram<D>::sign_at(const RationalPoint<D>& point, Kernel& kernel) const {
  if (kernel.start_bits == Kernel::kDoubleBits) {
    std::array<Interval, D> at;
    for (std::size_t i = 0; i < D; ++i) at[i] = Interval::enclose(point[i]);
    Workspace<Interval> workspace;
    if (const auto sign = sign_in(value(at, workspace))) {
      ++kernel.decisions.by_double;
      return *sign;
    }
  }
  Workspace<MpfrInterval> workspace;
  for (int bits = kernel.start_bits; bits > 0; bits = kernel.next(bits)) {
    if (!Kernel::is_mpfr(bits)) continue;
    if (const auto sign = sign_in(value(intervals<D>(point, bits), workspace))) {
      ++kernel.decisions.by_mpfr;
      return *sign;
    }
  }
  if (const auto sign = exact_sign(point)) {
    ++kernel.decisions.by_exact;
    return *sign;
  }
  ++kernel.decisions.undecided;
  return PointSign::Unknown;
}

namespace {

/// A rational value, if it is known to be one; or that there is none.
struct ExactValue {
  std::optional<Rational> value;
  bool exists = true;
};

constexpr std::size_t kMaxBits = 1000000;

std::size_t bits_of(const Rational& value) {
  return std::max(mpz_sizeinbase(value.get_num_mpz_t(), 2),
                  mpz_sizeinbase(value.get_den_mpz_t(), 2));
}

ExactValue exact_power(const Rational& base, int exponent) {
  if (exponent == 0) return {Rational(1)};
  if (base == 0) return exponent < 0 ? ExactValue{{}, false} : ExactValue{Rational(0)};
  const auto size = static_cast<std::size_t>(std::labs(exponent));
  if (abs(base) != 1 && size > kMaxBits / bits_of(base)) return {};
  Rational result;
  const unsigned long times = abs(base) == 1 ? size % 2 : size;
  mpz_pow_ui(result.get_num_mpz_t(), base.get_num_mpz_t(), times);
  mpz_pow_ui(result.get_den_mpz_t(), base.get_den_mpz_t(), times);
  if (exponent < 0) result = 1 / result;
  return {result};
}

ExactValue exact_sqrt(const Rational& u) {
  if (u < 0) return {{}, false};
  if (!mpz_perfect_square_p(u.get_num_mpz_t()) || !mpz_perfect_square_p(u.get_den_mpz_t()))
    return {};
  return {Rational(::sqrt(u.get_num()), ::sqrt(u.get_den()))};
}

ExactValue exact_value(Operation operation, const Rational& u) {
  // Where a function has a rational value at a rational number at all, but for these:
  const auto at_zero = [&](int value) {
    return u == 0 ? ExactValue{Rational(value)} : ExactValue();
  };
  switch (operation) {
    case Operation::Negate:
      return {Rational(-u)};
    case Operation::Abs:
      return {Rational(abs(u))};
    case Operation::Sqrt:
      return exact_sqrt(u);
    case Operation::Sin:
    case Operation::Tan:
    case Operation::Atan:
    case Operation::Sinh:
    case Operation::Tanh:
      return at_zero(0);
    case Operation::Exp:
    case Operation::Cos:
    case Operation::Cosh:
      return at_zero(1);
    case Operation::Log:
      if (u <= 0) return {{}, false};
      return u == 1 ? ExactValue{Rational(0)} : ExactValue();
    case Operation::Asin:
      if (abs(u) > 1) return {{}, false};
      return at_zero(0);
    case Operation::Acos:
      if (abs(u) > 1) return {{}, false};
      return u == 1 ? ExactValue{Rational(0)} : ExactValue();
    default:
      return {};
  }
}

ExactValue exact_value(Operation operation, const Rational& a, const Rational& b) {
  if (operation == Operation::Divide && b == 0) return {{}, false};
  if (bits_of(a) + bits_of(b) > kMaxBits) return {};
  switch (operation) {
    case Operation::Add:
      return {Rational(a + b)};
    case Operation::Subtract:
      return {Rational(a - b)};
    case Operation::Multiply:
      return {Rational(a * b)};
    case Operation::Divide:
      return {Rational(a / b)};
    case Operation::Min:
      return {std::min(a, b)};
    case Operation::Max:
      return {std::max(a, b)};
    default:
      return {};
  }
}

}  // namespace

template <int D>
std::optional<PointSign> ExpressionProgram<D>::exact_sign(const RationalPoint<D>& point) const {
  std::vector<std::optional<Rational>> values;
  for (const Step& step : steps_) {
    const auto value = [&](int index) -> const std::optional<Rational>& {
      return values[static_cast<std::size_t>(index)];
    };
    ExactValue result;
    if (step.operation == Operation::Constant)
      result.value = step.constant;
    else if (step.operation == Operation::Variable)
      result.value = point[static_cast<std::size_t>(step.number)];
    else if (step.first < 0 || !value(step.first) || (step.second >= 0 && !value(step.second)))
      result.value = std::nullopt;
    else if (step.operation == Operation::Power)
      result = exact_power(*value(step.first), step.number);
    else if (step.second < 0)
      result = exact_value(step.operation, *value(step.first));
    else
      result = exact_value(step.operation, *value(step.first), *value(step.second));
    if (!result.exists) return PointSign::NoValue;
    values.push_back(std::move(result.value));
  }
  if (!values.back()) return std::nullopt;
  const int sign = sgn(*values.back());
  return sign < 0 ? PointSign::Negative : sign > 0 ? PointSign::Positive : PointSign::Zero;
}

template class ExpressionProgram<1>;
template class ExpressionProgram<2>;
template class ExpressionProgram<3>;

#define ENCASE_EVALUATE(Real, D, Order)                                          \
  template JetOnBox<Real, D, Order> ExpressionProgram<D>::evaluate<Order, Real>( \
      const std::array<Real, D>&, Workspace<Real>&) const;
#define ENCASE_EVALUATE_ORDERS(Real, D) \
  ENCASE_EVALUATE(Real, D, 0) ENCASE_EVALUATE(Real, D, 1) ENCASE_EVALUATE(Real, D, 2)
ENCASE_EVALUATE_ORDERS(Interval, 1)
ENCASE_EVALUATE_ORDERS(Interval, 2)
ENCASE_EVALUATE_ORDERS(Interval, 3)
ENCASE_EVALUATE_ORDERS(MpfrInterval, 1)
ENCASE_EVALUATE_ORDERS(MpfrInterval, 2)
ENCASE_EVALUATE_ORDERS(MpfrInterval, 3)
#undef ENCASE_EVALUATE
#undef ENCASE_EVALUATE_ORDERS

}  // namespace encase
