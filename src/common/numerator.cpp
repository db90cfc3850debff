// SPDX-License-Identifier: MIT
#include "common/numerator.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace encase {
namespace {

constexpr std::size_t kMostDivisors = 16;

/// top / bottom, or top.
struct Quotient {
  Expression top;
  std::optional<Expression> bottom;
};

using Factor = std::optional<Expression>;

bool varies(const Expression& f) { return f.uses(0) || f.uses(1) || f.uses(2); }

Factor product(const Factor& a, const Factor& b) {
  if (!a) return b;
  if (!b) return a;
  return *a * *b;
}

Expression times(const Expression& a, const Factor& b) { return b ? a * *b : a; }

class Reducer {
 public:
  Numerator run(const Expression& f) {
    for (const Expression::Step& step : f.steps()) {
      written_.push_back(written(step));
      reduced_.push_back(reduced(step));
    }
    // Without a bottom nothing is gained.
    if (!reduced_.back().bottom || divisors_.size() > kMostDivisors) return {f, {}};
    return {reduced_.back().top, std::move(divisors_)};
  }

 private:
  template <class T>
  static const T& at(const std::vector<T>& list, int k) {
    return list[static_cast<std::size_t>(k)];
  }

  Expression written(const Expression::Step& step) const {
    switch (step.operation) {
      case Operation::Constant:
        return Expression(step.constant);
      case Operation::Pi:
        return Expression::pi();
      case Operation::Euler:
        return Expression::euler();
      case Operation::Variable:
        return Expression::variable(step.number);
      case Operation::Power:
        return at(written_, step.first).power(step.number);
      default:
        return step.second < 0 ? Expression::apply(step.operation, at(written_, step.first))
                               : Expression::apply(step.operation, at(written_, step.first),
                                                   at(written_, step.second));
    }
  }

  Quotient reduced(const Expression::Step& step) {
    if (step.first < 0) return {written_.back(), {}};
    const Quotient a = at(reduced_, step.first);
    switch (step.operation) {
      case Operation::Negate:
        return {-a.top, a.bottom};
      case Operation::Add:
      case Operation::Subtract:
        return sum(a, at(reduced_, step.second), step.operation);
      case Operation::Multiply: {
        const Quotient& b = at(reduced_, step.second);
        return {a.top * b.top, product(a.bottom, b.bottom)};
      }
      case Operation::Divide: {
        const Quotient& b = at(reduced_, step.second);
        if (!varies(b.top)) return {a.top / at(written_, step.second), a.bottom};
        divide_by(b.top);
        return {times(a.top, b.bottom), product(a.bottom, b.top)};
      }
      case Operation::Power:
        return power(a, step.number);
      case Operation::Tan: {
        if (a.bottom || !varies(a.top)) break;
        const Expression cosine = Expression::apply(Operation::Cos, a.top);
        divide_by(cosine);
        return {Expression::apply(Operation::Sin, a.top), cosine};
      }
      default:
        break;
    }
    return {written_.back(), {}};
  }

  static Quotient sum(const Quotient& a, const Quotient& b, Operation operation) {
    if (a.bottom && b.bottom && *a.bottom == *b.bottom)
      return {Expression::apply(operation, a.top, b.top), a.bottom};
    return {Expression::apply(operation, times(a.top, b.bottom), times(b.top, a.bottom)),
            product(a.bottom, b.bottom)};
  }

  Quotient power(const Quotient& a, int exponent) {
    const auto raised = [](const Factor& b, int n) { return b ? Factor(b->power(n)) : b; };
    if (exponent >= 0) return {a.top.power(exponent), raised(a.bottom, exponent)};
    if (!varies(a.top)) return {written_.back(), {}};
    divide_by(a.top);
    return {raised(a.bottom, -exponent).value_or(Expression(Rational(1))), a.top.power(-exponent)};
  }

  void divide_by(const Expression& divisor) {
    if (std::find(divisors_.begin(), divisors_.end(), divisor) == divisors_.end())
      divisors_.push_back(divisor);
  }

  std::vector<Expression> written_;
  std::vector<Quotient> reduced_;
  std::vector<Expression> divisors_;
};

}  // namespace

Numerator numerator_of(const Expression& f) { return Reducer().run(f); }

}  // namespace encase
