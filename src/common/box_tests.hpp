// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "encase/geometry.hpp"
#include "filtered_polynomial.hpp"

/// What a single box can prove: the statements that certificates are made of. The search asks them
/// and `verify` asks them again. Each climbs the ladder: doubles, then MPFR where the rounding error
/// alone stands in the way. False means "not proved", never "disproved".
namespace encase {

/// D polynomials in D variables.
template <int D>
using System = std::array<const FilteredPolynomial<D>*, D>;

/// The sign f is proved to have on the whole closed box.
template <int D>
std::optional<Sign> sign_on_box(const FilteredPolynomial<D>& f, const Box<D>& box, Kernel& kernel);

/// The system has no common zero in the closed box.
template <int D>
bool no_common_zero(const System<D>& system, const Box<D>& box, Kernel& kernel);

/// The system has at most one common zero in the closed box, and if it has one it is simple (the
/// Jacobian is regular on the box).
template <int D>
bool at_most_one_zero(const System<D>& system, const Box<D>& box, Kernel& kernel);

/// The system has exactly one common zero in the closed box, in its interior, and it is simple.
template <int D>
bool exactly_one_zero(const System<D>& system, const Box<D>& box, Kernel& kernel);

/// No point of the closed box is both a zero of f and of its gradient, and none is a local maximum
/// of |f|: some partial derivative or a combination of them keeps a sign, or f keeps a sign and
/// f f_xx > 0, f f_yy > 0 or det Hess f < 0 holds on the box.
bool no_relevant_critical_point(const FilteredPolynomial<2>& f, const Box<2>& box, Kernel& kernel);

}  // namespace encase
