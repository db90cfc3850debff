// SPDX-License-Identifier: MIT
#pragma once

#include "encase/geometry.hpp"

namespace encase {

/// Whether `proves` holds on every part of some subdivision of a closed box: what the search proved
/// by a closer look at a part of a box may not show at once. Uses up `parts`.
template <int D, class Proves>
bool proved_by_halves(const Box<D>& box, const Proves& proves, int* parts) {
  if (proves(box)) return true;
  if (--*parts < 0) return false;
  int axis = 0;
  for (int i = 1; i < D; ++i)
    if (box.width(i) > box.width(axis)) axis = i;
  Box<D> lower, upper;
  // Across the longest side, unless only another way gets somewhere.
  for (int attempt = 0; attempt <= D; ++attempt) {
    const int cut = (axis + attempt) % D;
    lower = upper = box;
    lower.hi[cut] = upper.lo[cut] = box.center()[cut];
    if (proves(lower) || proves(upper)) break;
  }
  return proved_by_halves(lower, proves, parts) && proved_by_halves(upper, proves, parts);
}

template <int D, class Proves>
bool proved_by_parts(const Box<D>& box, const Proves& proves) {
  int parts = 2000;
  return proved_by_halves(box, proves, &parts);
}

}  // namespace encase
