// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/box_tests.hpp"
#include "common/root_isolation.hpp"
#include "common/sought.hpp"
#include "common/subdivision.hpp"

namespace encase {

/// Isolates the common zeros of D polynomials in D variables in the part of `box` that lies on the
/// negative side of every half space. Subdivision with Bernstein exclusion; uniqueness from a
/// preconditioned Jacobian, existence by Krawczyk's test (thesis 3.3, replaced as
/// docs/encasement.md says). Root boxes are some ulps wide where the system is well conditioned.
/// Cost: about ten boxes a zero, each O(degree^(D+1)).
template <int D>
RootIsolation<D> isolate_roots(const System<D>& system, const Box<D>& box,
                               const std::vector<Hyperplane<D>>& half_spaces,
                               const SubdivisionLimits& limits, Kernel& kernel);
template <>
RootIsolation<2> isolate_roots<2>(const System<2>& system, const Box<2>& box,
                                  const std::vector<Line>& half_planes,
                                  const SubdivisionLimits& limits, Kernel& kernel);

/// The same in the plane, for polynomials with tiles that cover `root`, which is subdivided.
RootIsolation<2> isolate_roots(TiledFunction& f, TiledFunction& g, const Box<2>& root,
                               const std::vector<Line>& half_planes,
                               const SubdivisionLimits& limits, Kernel& kernel);

/// The same in leaves of a subdivision that is begun; its other leaves keep their tokens.
RootIsolation<2> isolate_roots(Sought<2> sought, const std::vector<Line>& half_planes,
                               const SubdivisionLimits& limits, Kernel& kernel);

}  // namespace encase
