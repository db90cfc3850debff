// SPDX-License-Identifier: MIT
#include "encase/expression.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace encase {

struct Expression::Node {
  Operation operation;
  mutable std::shared_ptr<const Node> first, second;  ///< mutable for the destructor
  int number = 0;
  Rational constant = 0;
  int size = 1;
  unsigned axes = 0;  ///< a bit for every variable that occurs

  /// Not by recursion, which a long sum would take too deep.
  ~Node() {
    std::vector<std::shared_ptr<const Node>> last;
    const auto take = [&last](std::shared_ptr<const Node>& operand) {
      if (operand && operand.use_count() == 1) last.push_back(std::move(operand));
    };
    take(first), take(second);
    while (!last.empty()) {
      const std::shared_ptr<const Node> node = std::move(last.back());
      last.pop_back();
      take(node->first), take(node->second);
    }
  }
};

namespace {

struct Named {
  Operation operation;
  const char* name;
};
constexpr std::array kFunctions = {
    Named{Operation::Sqrt, "sqrt"}, Named{Operation::Exp, "exp"},   Named{Operation::Log, "log"},
    Named{Operation::Sin, "sin"},   Named{Operation::Cos, "cos"},   Named{Operation::Tan, "tan"},
    Named{Operation::Asin, "asin"}, Named{Operation::Acos, "acos"}, Named{Operation::Atan, "atan"},
    Named{Operation::Sinh, "sinh"}, Named{Operation::Cosh, "cosh"}, Named{Operation::Tanh, "tanh"},
    Named{Operation::Abs, "abs"},   Named{Operation::Min, "min"},   Named{Operation::Max, "max"}};

/// What an operation makes of rational constants, where that is rational and has a value.
bool fold(Operation operation, const Rational& a, const Rational& b, Rational* result) {
  switch (operation) {
    case Operation::Negate:
      *result = -a;
      return true;
    case Operation::Add:
      *result = a + b;
      return true;
    case Operation::Subtract:
      *result = a - b;
      return true;
    case Operation::Multiply:
      *result = a * b;
      return true;
    case Operation::Divide:
      if (b == 0) return false;
      *result = a / b;
      return true;
    case Operation::Abs:
      *result = abs(a);
      return true;
    case Operation::Min:
      *result = std::min(a, b);
      return true;
    case Operation::Max:
      *result = std::max(a, b);
      return true;
    default:
      return false;
  }
}

bool fold_power(const Rational& base, int exponent, Rational* result) {
  constexpr std::size_t kMaxBits = 1000000;
  if (base == 0 && exponent < 0) return false;
  const std::size_t bits =
      std::max(mpz_sizeinbase(base.get_num_mpz_t(), 2), mpz_sizeinbase(base.get_den_mpz_t(), 2));
  unsigned long times = static_cast<unsigned long>(std::labs(exponent));
  if (abs(base) == 1 || base == 0)
    times = times == 0 ? 0 : 2 - times % 2;
  else if (times > kMaxBits / bits)
    return false;
  mpz_pow_ui(result->get_num_mpz_t(), base.get_num_mpz_t(), times);
  mpz_pow_ui(result->get_den_mpz_t(), base.get_den_mpz_t(), times);
  if (exponent < 0) *result = 1 / *result;
  return true;
}

/// How tightly an operation binds what is written: sums, products, powers, all else.
int binding(Operation operation, const Rational& constant) {
  switch (operation) {
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Negate:
      return 0;
    case Operation::Multiply:
    case Operation::Divide:
      return 1;
    case Operation::Power:
      return 2;
    case Operation::Constant:
      return constant < 0 ? 0 : constant.get_den() != 1 ? 1 : 3;
    default:
      return 3;
  }
}

}  // namespace

const char* function_name(Operation operation) {
  for (const Named& named : kFunctions)
    if (named.operation == operation) return named.name;
  return nullptr;
}

std::optional<Operation> function_named(std::string_view name) {
  for (const Named& named : kFunctions)
    if (named.name == name) return named.operation;
  return std::nullopt;
}

int operands(Operation operation) {
  switch (operation) {
    case Operation::Constant:
    case Operation::Pi:
    case Operation::Euler:
    case Operation::Variable:
      return 0;
    case Operation::Add:
    case Operation::Subtract:
    case Operation::Multiply:
    case Operation::Divide:
    case Operation::Min:
    case Operation::Max:
      return 2;
    default:
      return 1;
  }
}

Expression::Expression(const Rational& constant)
    : node_(std::make_shared<Node>(Node{Operation::Constant, {}, {}, 0, constant, 1, 0})) {}

template <int D>
Expression::Expression(const Polynomial<D>& polynomial) : Expression() {
  // Horner's rule in the first variable, of polynomials in the others: the terms of the same
  // exponents but for the last variable stand together, highest last.
  const auto& terms = polynomial.terms();
  struct Horner {
    const std::vector<typename Polynomial<D>::Term>& terms;
    Expression run(std::size_t begin, std::size_t end, int axis) const {
      if (axis == D) return Expression(terms[begin].coefficient);
      Expression sum;
      int above = -1;  // the exponent that `sum` stands for
      for (std::size_t last = end; last > begin;) {
        const int exponent = terms[last - 1].exponent[axis];
        std::size_t first = last;
        while (first > begin && terms[first - 1].exponent[axis] == exponent) --first;
        const Expression inner = run(first, last, axis + 1);
        sum = above < 0 ? inner : sum * variable(axis).power(above - exponent) + inner;
        above = exponent;
        last = first;
      }
      return above > 0 ? sum * variable(axis).power(above) : sum;
    }
  };
  if (!terms.empty()) *this = Horner{terms}.run(0, terms.size(), 0);
}

template Expression::Expression(const Polynomial<1>&);
template Expression::Expression(const Polynomial<2>&);
template Expression::Expression(const Polynomial<3>&);

Expression Expression::variable(int axis) {
  return Expression(
      std::make_shared<Node>(Node{Operation::Variable, {}, {}, axis, 0, 1, 1U << axis}));
}

Expression Expression::pi() {
  return Expression(std::make_shared<Node>(Node{Operation::Pi, {}, {}, 0, 0, 1, 0}));
}

Expression Expression::euler() {
  return Expression(std::make_shared<Node>(Node{Operation::Euler, {}, {}, 0, 0, 1, 0}));
}

Expression Expression::apply(Operation operation, const Expression& operand) {
  Rational folded;
  if (const Rational* c = operand.constant(); c && fold(operation, *c, *c, &folded))
    return Expression(folded);
  const int size = std::min(operand.size(), std::numeric_limits<int>::max() - 1) + 1;
  return Expression(
      std::make_shared<Node>(Node{operation, operand.node_, {}, 0, 0, size, operand.node_->axes}));
}

Expression Expression::apply(Operation operation, const Expression& first,
                             const Expression& second) {
  Rational folded;
  const Rational *a = first.constant(), *b = second.constant();
  if (a && b && fold(operation, *a, *b, &folded)) return Expression(folded);
  const long long size = 1LL + first.size() + second.size();
  return Expression(std::make_shared<Node>(
      Node{operation, first.node_, second.node_, 0, 0,
           static_cast<int>(std::min<long long>(size, std::numeric_limits<int>::max())),
           first.node_->axes | second.node_->axes}));
}

Expression Expression::power(int exponent) const {
  if (exponent == 1) return *this;
  Rational folded;
  if (const Rational* c = constant(); c && fold_power(*c, exponent, &folded))
    return Expression(folded);
  const int size_of_power = std::min(size(), std::numeric_limits<int>::max() - 1) + 1;
  return Expression(std::make_shared<Node>(
      Node{Operation::Power, node_, {}, exponent, 0, size_of_power, node_->axes}));
}

int Expression::size() const { return node_->size; }

const Rational* Expression::constant() const {
  return node_->operation == Operation::Constant ? &node_->constant : nullptr;
}

bool Expression::uses(int axis) const { return (node_->axes >> axis) % 2 == 1; }

std::vector<Expression::Step> Expression::steps() const {
  std::vector<Step> steps;
  std::unordered_map<const Node*, int> step_of;
  std::map<std::tuple<Operation, int, int, int, Rational>, int> known;
  std::vector<const Node*> stack{node_.get()};
  while (!stack.empty()) {
    const Node* node = stack.back();
    if (step_of.count(node)) {
      stack.pop_back();
      continue;
    }
    bool ready = true;
    for (const Node* operand : {node->second.get(), node->first.get()})
      if (operand && !step_of.count(operand)) {
        stack.push_back(operand);
        ready = false;
      }
    if (!ready) continue;
    stack.pop_back();
    Step step{node->operation, node->first ? step_of[node->first.get()] : -1,
              node->second ? step_of[node->second.get()] : -1, node->number, node->constant};
    const auto [found, is_new] =
        known.try_emplace({step.operation, step.first, step.second, step.number, step.constant},
                          static_cast<int>(steps.size()));
    if (is_new) steps.push_back(std::move(step));
    step_of[node] = found->second;
  }
  return steps;
}

bool Expression::operator==(const Expression& other) const {
  return node_ == other.node_ || steps() == other.steps();
}

std::string Expression::to_string() const {
  // What is still to be written, the next one last: a node, in parentheses unless it binds at least
  // as tightly as required; or a text.
  struct Part {
    const Node* node;
    int required;
    std::string text;
  };
  std::vector<Part> parts{{node_.get(), 0, {}}};
  std::string written;
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    if (!part.node) {
      written += part.text;
      continue;
    }
    const Node& node = *part.node;
    const bool enclosed = binding(node.operation, node.constant) < part.required;
    if (enclosed) {
      written += "(";
      parts.push_back({nullptr, 0, ")"});
    }
    const auto infix = [&](const char* sign, int left, int right) {
      parts.push_back({node.second.get(), right, {}});
      parts.push_back({nullptr, 0, sign});
      parts.push_back({node.first.get(), left, {}});
    };
    switch (node.operation) {
      case Operation::Constant:
        written += node.constant.get_str();
        break;
      case Operation::Pi:
        written += "pi";
        break;
      case Operation::Euler:
        written += "e";
        break;
      case Operation::Variable:
        written += "xyz"[node.number];
        break;
      case Operation::Negate:
        written += "-";
        parts.push_back({node.first.get(), 2, {}});
        break;
      case Operation::Add:
        infix(" + ", 0, 1);
        break;
      case Operation::Subtract:
        infix(" - ", 0, 1);
        break;
      case Operation::Multiply:
        infix("*", 1, 2);
        break;
      case Operation::Divide:
        infix("/", 1, 2);
        break;
      case Operation::Power: {
        const std::string exponent = std::to_string(node.number);
        parts.push_back({nullptr, 0, node.number < 0 ? "^(" + exponent + ")" : "^" + exponent});
        parts.push_back({node.first.get(), 3, {}});
        break;
      }
      default:
        written += function_name(node.operation);
        written += "(";
        parts.push_back({nullptr, 0, ")"});
        if (node.second) {
          infix(", ", 0, 0);
        } else {
          parts.push_back({node.first.get(), 0, {}});
        }
    }
  }
  return written;
}

}  // namespace encase
