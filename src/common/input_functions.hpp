// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/function.hpp"
#include "encase/result.hpp"

/// Step 1 of an encasement, in the plane and in space alike: functions are refused that have no
/// zero set, perturbed on demand, and taken apart so that each component is encased once.
namespace encase {

/// BadInput for a polynomial that is zero or constant or has a degree above kMaxDegree, for an
/// expression without a variable or with one too many, and for an inclusion function that does
/// something wrong on the box; nothing for others.
template <int D>
Status check_function(const NamedFunction<D>& input, const Box<D>& box);

/// The first such error of the functions; else BadInput for a perturbation by `delta` that cannot
/// be: delta is negative or not finite, or positive and a function is no polynomial.
template <int D>
Status check_functions(const std::vector<NamedFunction<D>>& inputs, const Box<D>& box,
                       double delta);

/// Perturbs the polynomials (`perturb`) from `first` on; each as it would be if first were 0.
/// Requires delta > 0 and no others.
template <int D>
void perturb_functions(std::vector<NamedFunction<D>>* inputs, std::size_t first, double delta,
                       std::uint64_t seed);

/// A function that is encased, the product of components that the same inputs contain.
template <int D>
struct SeparateFunction {
  std::string name;
  Function<D> function;
  std::vector<int> sources;  ///< indices of the inputs that contain it, ascending
};

/// A component that inputs share, or that one contains repeatedly; proved.
struct ComponentNote {
  Unresolved::Kind kind = Unresolved::Kind::SharedComponent;  ///< or RepeatedComponent
  std::vector<int> inputs;
  std::string reason;  ///< a sentence for people
};

template <int D>
struct SeparateFunctions {
  std::vector<SeparateFunction<D>> functions;
  std::vector<ComponentNote> notes;
};

/// Square-free polynomials, pairwise coprime, with together the zeros of the polynomials given
/// (`coprime_square_free_base`), and the other functions as they are, equal ones once: nothing else
/// is known of what those have in common. In the order of the inputs that first contain them.
template <int D>
SeparateFunctions<D> separate_functions(const std::vector<NamedFunction<D>>& inputs);

}  // namespace encase
