// SPDX-License-Identifier: MIT
#include "common/input_functions.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "common/components.hpp"
#include "common/filtered_inclusion.hpp"
#include "common/perturb.hpp"
#include "common/wording.hpp"

namespace encase {
namespace {

Status bad_input(std::string message) {
  return Status(Error{Error::Code::BadInput, std::move(message)});
}

template <int D>
std::string quoted(const NamedFunction<D>& input) {
  return std::string(kZeroSet<D>) + " '" + input.name + "'";
}

template <int D>
Status check(const std::string& name, const Polynomial<D>& f) {
  if (f.is_zero()) return bad_input(name + " is the zero polynomial: every point lies on it");
  if (f.is_constant()) return bad_input(name + " is a constant: no point lies on it");
  if (f.degree() > kMaxDegree)
    return bad_input(name + " has degree " + std::to_string(f.degree()) + ", above the limit of " +
                     std::to_string(kMaxDegree));
  return std::nullopt;
}

template <int D>
Status check(const std::string& name, const Expression& f) {
  bool constant = true;
  for (int axis = 0; axis < D; ++axis) constant = constant && !f.uses(axis);
  if (constant)
    return bad_input(name + " is a constant: it has no " + (D == 2 ? "x and no y" : "x, y or z"));
  if (D == 2 && f.uses(2))
    return bad_input(name + " has a z: a curve in the plane has x and y only");
  return std::nullopt;
}

/// "P = 0", of the component with this polynomial.
template <int D>
std::string equation(const Polynomial<D>& component) {
  return component.to_string() + " = 0";
}

template <int D>
void separate_polynomials(const std::vector<NamedFunction<D>>& inputs, SeparateFunctions<D>* out) {
  const std::string kind = kZeroSet<D>;
  std::vector<Polynomial<D>> polynomials;
  std::vector<int> input_of;
  for (std::size_t k = 0; k < inputs.size(); ++k)
    if (inputs[k].function.is_polynomial()) {
      polynomials.push_back(inputs[k].function.polynomial());
      input_of.push_back(static_cast<int>(k));
    }
  std::vector<int> used(inputs.size(), 0);  // functions that are of this input alone
  for (BaseElement<D>& element : coprime_square_free_base(polynomials)) {
    SeparateFunction<D> f;
    for (const auto& source : element.sources) {
      const int index = input_of[static_cast<std::size_t>(source.index)];
      const NamedFunction<D>& from = inputs[static_cast<std::size_t>(index)];
      f.sources.push_back(index);
      f.name += (f.name.empty() ? "" : " & ") + from.name;
      if (source.multiplicity > 1)
        out->notes.push_back(
            {Unresolved::Kind::RepeatedComponent,
             {index},
             quoted(from) + " contains the component " + equation(element.polynomial) + " " +
                 std::to_string(source.multiplicity) + " times; it is encased once"});
    }
    if (f.sources.size() > 1) {
      out->notes.push_back({Unresolved::Kind::SharedComponent, f.sources,
                            kind + "s '" + f.name + "' share the component " +
                                equation(element.polynomial) + "; it is encased as one " + kind});
    } else if (const int count = ++used[static_cast<std::size_t>(f.sources[0])]; count > 1) {
      f.name += " (" + std::to_string(count) + ")";
    }
    f.function = std::move(element.polynomial);
    out->functions.push_back(std::move(f));
  }
}

template <int D>
void separate_others(const std::vector<NamedFunction<D>>& inputs, SeparateFunctions<D>* out) {
  const std::string kind = kZeroSet<D>;
  std::vector<SeparateFunction<D>> others;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const NamedFunction<D>& from = inputs[k];
    if (from.function.is_polynomial()) continue;
    const auto same = std::find_if(
        others.begin(), others.end(),
        [&](const SeparateFunction<D>& other) { return other.function == from.function; });
    if (same == others.end()) {
      others.push_back({from.name, from.function, {static_cast<int>(k)}});
    } else {
      same->name += " & " + from.name;
      same->sources.push_back(static_cast<int>(k));
    }
  }
  for (SeparateFunction<D>& f : others) {
    if (f.sources.size() > 1)
      out->notes.push_back(
          {Unresolved::Kind::SharedComponent, f.sources,
           kind + "s '" + f.name + "' are the same; they are encased as one " + kind});
    out->functions.push_back(std::move(f));
  }
}

}  // namespace

template <int D>
Status check_function(const NamedFunction<D>& input, const Box<D>& box) {
  const std::string name = quoted(input);
  if (input.function.is_polynomial()) return check(name, input.function.polynomial());
  if (input.function.is_expression()) return check<D>(name, input.function.expression());
  const std::optional<std::string> trouble = complaint(input.function.inclusion(), box);
  return trouble ? bad_input("the inclusion function of " + name + " " + *trouble) : std::nullopt;
}

template <int D>
Status check_functions(const std::vector<NamedFunction<D>>& inputs, const Box<D>& box,
                       double delta) {
  for (const NamedFunction<D>& input : inputs)
    if (Status bad = check_function(input, box)) return bad;
  if (!(delta >= 0) || !std::isfinite(delta))
    return bad_input("the perturbation must be a number that is not negative");
  for (const NamedFunction<D>& input : inputs)
    if (delta > 0 && !input.function.is_polynomial())
      return bad_input(quoted(input) + " is no polynomial: only those can be perturbed");
  return std::nullopt;
}

template <int D>
void perturb_functions(std::vector<NamedFunction<D>>* inputs, std::size_t first, double delta,
                       std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  for (std::size_t k = 0; k < inputs->size(); ++k) {
    Function<D>& function = (*inputs)[k].function;
    // Also those before the first, so that the others get what they would all together.
    Polynomial<D> perturbed = perturb(function.polynomial(), delta, generator);
    if (k >= first) function = std::move(perturbed);
  }
}

template <int D>
SeparateFunctions<D> separate_functions(const std::vector<NamedFunction<D>>& inputs) {
  SeparateFunctions<D> out;
  separate_polynomials(inputs, &out);
  const std::size_t polynomials = out.functions.size();
  separate_others(inputs, &out);
  if (out.functions.size() > polynomials)
    std::stable_sort(out.functions.begin(), out.functions.end(),
                     [](const SeparateFunction<D>& a, const SeparateFunction<D>& b) {
                       return a.sources[0] < b.sources[0];
                     });
  return out;
}

template Status check_function(const NamedFunction<2>&, const Box<2>&);
template Status check_function(const NamedFunction<3>&, const Box<3>&);
template Status check_functions(const std::vector<NamedFunction<2>>&, const Box<2>&, double);
template Status check_functions(const std::vector<NamedFunction<3>>&, const Box<3>&, double);
template void perturb_functions(std::vector<NamedFunction<2>>*, std::size_t, double, std::uint64_t);
template void perturb_functions(std::vector<NamedFunction<3>>*, std::size_t, double, std::uint64_t);
template SeparateFunctions<2> separate_functions(const std::vector<NamedFunction<2>>&);
template SeparateFunctions<3> separate_functions(const std::vector<NamedFunction<3>>&);

}  // namespace encase
