// SPDX-License-Identifier: MIT
#include "common/verify_functions.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "common/components.hpp"
#include "common/well_formed.hpp"
#include "common/wording.hpp"

namespace encase::verification {
namespace {

template <int D>
const char* const kCapitalNoun = D == 2 ? "Curve" : "Surface";

/// Whether f = c g for a constant c.
template <int D>
bool proportional(const Polynomial<D>& f, const Polynomial<D>& g) {
  if (f == g) return true;
  if (f.terms().size() != g.terms().size() || f.is_zero()) return false;
  const Rational ratio = f.terms()[0].coefficient / g.terms()[0].coefficient;
  for (std::size_t k = 0; k < f.terms().size(); ++k)
    if (f.terms()[k].exponent != g.terms()[k].exponent ||
        f.terms()[k].coefficient != ratio * g.terms()[k].coefficient)
      return false;
  return true;
}

/// The indices of the functions in a list that are polynomials, or of those that are none.
template <class List>
std::vector<int> of_kind(const List& list, bool polynomials) {
  std::vector<int> indices;
  for (std::size_t k = 0; k < list.size(); ++k)
    if (list[k].function.is_polynomial() == polynomials) indices.push_back(static_cast<int>(k));
  return indices;
}

template <int D>
const Function<D>& input_function(const FunctionClaims<D>& c, int i) {
  return c.input[static_cast<std::size_t>(i)].function;
}
template <int D>
const typename FunctionClaims<D>::Encased& encased(const FunctionClaims<D>& c, int k) {
  return c.encased[static_cast<std::size_t>(k)];
}

/// Whether the functions are, up to constants, the inputs one by one: of those that are
/// polynomials.
template <int D>
bool one_to_one(const FunctionClaims<D>& c, const std::vector<int>& inputs,
                const std::vector<int>& functions) {
  std::set<int> seen;
  for (const int k : functions) {
    const auto& [function, sources] = encased(c, k);
    if (sources.size() != 1 || !seen.insert(sources[0]).second) return false;
    const Function<D>& source = input_function(c, sources[0]);
    if (!source.is_polynomial() || !proportional(function.polynomial(), source.polynomial()))
      return false;
  }
  return seen.size() == inputs.size();
}

/// The polynomials' common refinement assigns every irreducible factor its sources.
template <int D>
void check_factors(Reporter& reporter, const FunctionClaims<D>& c, std::set<int>* repeated) {
  const std::string noun = kZeroSet<D>, capital = kCapitalNoun<D>;
  const std::vector<int> all_inputs = of_kind(c.input, true), all = of_kind(c.encased, true);
  const bool generic = one_to_one(c, all_inputs, all);
  std::vector<Polynomial<D>> polynomials;
  if (!generic)
    for (const int i : all_inputs) polynomials.push_back(input_function(c, i).polynomial());
  const std::size_t first = polynomials.size();
  for (const int k : all) polynomials.push_back(encased(c, k).function.polynomial());

  for (const auto& element : coprime_square_free_base(polynomials)) {
    std::vector<int> inputs, functions;
    for (const auto& source : element.sources) {
      const auto k = static_cast<std::size_t>(source.index);
      if (k < first) {
        inputs.push_back(all_inputs[k]);
        if (source.multiplicity > 1) repeated->insert(inputs.back());
      } else {
        functions.push_back(all[k - first]);
        reporter.require(source.multiplicity == 1, capital, " ", functions.back(),
                         " has a repeated component.");
      }
    }
    // Every factor in one function alone: they are coprime, and no component is missing.
    if (functions.size() > 1)
      reporter.require(false, capital, "s ", functions[0], " and ", functions[1],
                       " share a component.");
    else if (functions.empty())
      reporter.require(false, "A component of input ", noun, " ", inputs[0], " is in no ", noun,
                       ".");
    else if (!generic)
      reporter.require(inputs == encased(c, functions[0]).sources, capital, " ", functions[0],
                       " does not have the components that its sources say.");
  }
}

template <int D>
void check_others(Reporter& reporter, const FunctionClaims<D>& c) {
  const std::string noun = kZeroSet<D>;
  std::vector<int> count(c.input.size(), 0);
  for (const int k : of_kind(c.encased, false)) {
    std::vector<int> equal;
    for (const int i : of_kind(c.input, false))
      if (input_function(c, i) == encased(c, k).function) equal.push_back(i);
    for (const int i : equal) ++count[static_cast<std::size_t>(i)];
    reporter.require(equal == encased(c, k).sources, kCapitalNoun<D>, " ", k,
                     " is not the function of its sources, or not of them alone.");
  }
  for (const int i : of_kind(c.input, false))
    reporter.require(count[static_cast<std::size_t>(i)] == 1, "The function of input ", noun, " ",
                     i, " is not that of one ", noun, ".");
}

/// Whether all these inputs have a component in common.
template <int D>
bool are_sources(const FunctionClaims<D>& c, const std::vector<int>& inputs) {
  return inputs.size() > 1 && std::any_of(c.encased.begin(), c.encased.end(), [&](const auto& f) {
           return std::includes(f.sources.begin(), f.sources.end(), inputs.begin(), inputs.end());
         });
}

/// The reported components are those there are.
template <int D>
void check_reports(Reporter& reporter, const FunctionClaims<D>& c, const std::set<int>& repeated) {
  const std::string noun = kZeroSet<D>;
  using Kind = Unresolved::Kind;
  for (const auto& entry : c.undecided)
    reporter.require(entry.kind != Kind::SharedComponent && entry.kind != Kind::RepeatedComponent,
                     "A shared or repeated component is listed as undecided.");
  std::set<int> reported;
  std::set<std::pair<int, int>> reported_pairs;
  for (std::size_t i = 0; i < c.degenerate.size() && !reporter.full(); ++i) {
    const auto& [kind, inputs] = c.degenerate[i];
    if (kind == Kind::RepeatedComponent) {
      reported.insert(inputs.begin(), inputs.end());
      reporter.require(!inputs.empty() && std::includes(repeated.begin(), repeated.end(),
                                                        inputs.begin(), inputs.end()),
                       "Degenerate entry ", i, " reports a repeated component that is not there.");
    }
    if (kind == Kind::SharedComponent) {
      for (std::size_t k = 0; k < inputs.size(); ++k)
        for (std::size_t l = 0; l < k; ++l) reported_pairs.insert({inputs[l], inputs[k]});
      reporter.require(are_sources(c, inputs), "Degenerate entry ", i,
                       " reports a shared component that is not there.");
    }
  }
  for (const int k : repeated)
    reporter.require(reported.count(k) > 0, "The repeated component of input ", noun, " ", k,
                     " is not reported.");
  for (const auto& f : c.encased)
    for (std::size_t k = 0; k < f.sources.size(); ++k)
      for (std::size_t l = 0; l < k; ++l)
        reporter.require(reported_pairs.count({f.sources[l], f.sources[k]}) > 0,
                         "The component that input ", noun, "s ", f.sources[l], " and ",
                         f.sources[k], " share is not reported.");
}

template <int D>
bool is_proper_polynomial(const Polynomial<D>& f) {
  for (const auto& term : f.terms()) {
    for (const int e : term.exponent)
      if (e < 0 || e > kMaxDegree) return false;
    if (!proper(term.coefficient)) return false;
  }
  return f.degree() >= 1 && f.degree() <= kMaxDegree;
}

/// (That operations have their operands, earlier ones, is so by construction.)
template <int D>
bool is_proper_expression(const Expression& f) {
  for (const Expression::Step& step : f.steps())
    if (step.operation == Operation::Constant && !proper(step.constant)) return false;
  bool uses_any = false;
  for (int axis = 0; axis < D; ++axis) uses_any = uses_any || f.uses(axis);
  return uses_any && !(D == 2 && f.uses(2));
}

}  // namespace

template <int D>
bool is_proper(const Function<D>& function) {
  if (function.is_inclusion()) return true;
  return function.is_polynomial() ? is_proper_polynomial(function.polynomial())
                                  : is_proper_expression<D>(function.expression());
}

template <int D>
void check_functions(Reporter& reporter, const FunctionClaims<D>& claims) {
  std::set<int> repeated;
  check_factors(reporter, claims, &repeated);
  check_others(reporter, claims);
  check_reports(reporter, claims, repeated);
}

template bool is_proper(const Function<2>&);
template bool is_proper(const Function<3>&);
template void check_functions(Reporter&, const FunctionClaims<2>&);
template void check_functions(Reporter&, const FunctionClaims<3>&);

}  // namespace encase::verification
