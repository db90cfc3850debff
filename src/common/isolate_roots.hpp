// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/box_tests.hpp"
#include "common/root_isolation.hpp"
#include "common/sought.hpp"
#include "common/subdivision.hpp"

namespace encase {

/// Isolates the common zeros of D functions in D variables in the part of `box` that lies on the
/// negative side of every half space; D is 2 or 3. Subdivision with Bernstein exclusion; uniqueness
/// from a preconditioned Jacobian, existence by Krawczyk's test (thesis 3.3, replaced as
/// docs/encasement.md says). Root boxes are some ulps wide where the system is well conditioned.
/// Boxes around contacts and singular points stay unresolved, as do those that the limits do not
/// suffice for. Cost: about ten boxes a zero in the plane, a hundred in space, each
/// O(degree^(D+1)); in space degrees of 16 and more take many times longer.
template <int D>
RootIsolation<D> isolate_roots(const System<D>& system, const Box<D>& box,
                               const std::vector<Hyperplane<D>>& half_spaces,
                               const SubdivisionLimits& limits, Kernel& kernel);
template <>
RootIsolation<2> isolate_roots<2>(const System<2>& system, const Box<2>& box,
                                  const std::vector<Line>& half_planes,
                                  const SubdivisionLimits& limits, Kernel& kernel);
template <>
RootIsolation<3> isolate_roots<3>(const System<3>& system, const Box<3>& box,
                                  const std::vector<Hyperplane<3>>& half_spaces,
                                  const SubdivisionLimits& limits, Kernel& kernel);

/// The same in the plane, for polynomials with tiles that cover `root`, which is subdivided.
RootIsolation<2> isolate_roots(TiledFunction& f, TiledFunction& g, const Box<2>& root,
                               const std::vector<Line>& half_planes,
                               const SubdivisionLimits& limits, Kernel& kernel);

/// The same in leaves of a subdivision that is begun; its other leaves keep their tokens.
RootIsolation<2> isolate_roots(Sought<2> sought, const std::vector<Line>& half_planes,
                               const SubdivisionLimits& limits, Kernel& kernel);

}  // namespace encase
