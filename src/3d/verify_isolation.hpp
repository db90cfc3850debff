// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "common/box_tests.hpp"
#include "common/root_isolation.hpp"
#include "encase/verify.hpp"

namespace encase {

/// Re-proves from the system alone, without the search, that `isolation` lists all common zeros in
/// the part of `box` on the negative side of every half space, except for what lies in its
/// unresolved boxes: the subdivision covers `box`; no leaf that it calls excluded has a common
/// zero; a box around a leaf of root k and the root's box has at most one (shown by halving the
/// leaf where the whole does not show it); every root's box has exactly one, and no two of them
/// meet; the boxes called outside are. Objections name the item in a sentence.
Verification verify_isolation(const System<3>& system, const Box<3>& box,
                              const std::vector<Hyperplane<3>>& half_spaces,
                              const RootIsolation<3>& isolation, const VerifyOptions& options = {});

}  // namespace encase
