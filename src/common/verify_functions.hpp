// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/reporter.hpp"
#include "encase/encasement.hpp"
#include "encase/function.hpp"

namespace encase::verification {

/// A polynomial of degree 1 to kMaxDegree, an expression that has some of the D coordinates and
/// nothing else, or an inclusion function.
template <int D>
bool is_proper(const Function<D>& function);

/// What a result says of its functions, in the plane and in space alike: those given, those
/// encased, and the components that several given ones share or one has repeatedly.
template <int D>
struct FunctionClaims {
  struct Encased {
    const Function<D>& function;
    const std::vector<int>& sources;  ///< in range and ascending
  };
  /// An entry of the degenerate or undecided places.
  struct Entry {
    Unresolved::Kind kind;
    const std::vector<int>& functions;
  };
  const std::vector<NamedFunction<D>>& input;
  std::vector<Encased> encased{};
  std::vector<Entry> degenerate{}, undecided{};
};

/// The encased polynomials are square-free, pairwise coprime, and together have the zeros of those
/// of the input; what is no polynomial is that of the input, equal ones once. (That those have no
/// component in common, and none twice, is not known beforehand: where they had one, no cover could
/// be proved.) Repeated and shared components are reported, and no others.
template <int D>
void check_functions(Reporter& reporter, const FunctionClaims<D>& claims);

}  // namespace encase::verification
