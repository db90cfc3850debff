// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "common/filtered_function.hpp"
#include "encase/geometry.hpp"

/// What a single box can prove: the statements that certificates are made of. The search asks them
/// and `verify` asks them again. False means "not proved", never "disproved".
namespace encase {

// On nets, without any precision ladder.

/// The nets of D polynomials on one box, of equal degrees.
template <int D>
using SystemNets = std::array<Bernstein<D>, D>;

template <int D>
using Matrix = std::array<std::array<double, D>, D>;

/// The system has no common zero on the closed box: one polynomial keeps a sign, or one of the
/// combinations that the adjugate of the mean Jacobian suggests does.
template <int D>
bool excluded(const SystemNets<D>& nets);

/// A preconditioner Y and a matrix E with |G - I| <= E entrywise for every matrix G whose row i is
/// the gradient (in the nets' coordinates) of the i-th component of Y F at any point of the box,
/// another point for every row if need be, and a positive vector v with E v < v. Then every such G
/// is regular, so that the system has at most one zero on the box, a simple one.
template <int D>
struct Contraction {
  Matrix<D> preconditioner;
  Matrix<D> bound;
  std::array<double, D> weights;
};

template <int D>
std::optional<Contraction<D>> contraction(const SystemNets<D>& nets, double quality = 1.0);

/// A positive vector v with E v < quality v for a matrix of bounds, if there is one.
template <int D>
std::optional<std::array<double, D>> contracting_weights(const Matrix<D>& bound, double quality);

/// How hard a box test tries.
enum class Effort { Quick, Thorough };

/// No point of the box is both a zero of f and of its gradient, and none is a local maximum of |f|:
/// a partial derivative or a combination of both keeps a sign, or f keeps a sign and f f_xx > 0,
/// f f_yy > 0 or det Hess f < 0 holds on the box. With effort: also V . grad f keeps a sign for
/// some affine vector field V, as along the ridge between two branches that stay close for a long
/// way.
bool no_relevant_critical_point(const Bernstein<2>& net, Effort effort);

// On boxes. Each climbs the ladder: doubles, then MPFR where the rounding error alone stands in the
// way of a proof.

/// D polynomials in D variables.
template <int D>
using System = std::array<const FilteredFunction<D>*, D>;

/// The sign f is proved to have on the whole closed box.
template <int D>
std::optional<Sign> sign_on_box(const FilteredFunction<D>& f, const Box<D>& box, Kernel& kernel);

/// The system has no common zero in the closed box.
template <int D>
bool no_common_zero(const System<D>& system, const Box<D>& box, Kernel& kernel);

/// The system has at most one common zero in the closed box, and if it has one it is simple.
template <int D>
bool at_most_one_zero(const System<D>& system, const Box<D>& box, Kernel& kernel);

/// The system has exactly one common zero in the closed box, in its interior, and it is simple.
template <int D>
bool exactly_one_zero(const System<D>& system, const Box<D>& box, Kernel& kernel);

/// As on nets, with effort.
bool no_relevant_critical_point(const FilteredFunction<2>& f, const Box<2>& box, Kernel& kernel);

}  // namespace encase
