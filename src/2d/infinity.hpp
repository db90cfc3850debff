// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "common/kernel.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// A rectangle around the origin outside of which the curves are as simple as can be, and the
/// proof.
struct Surroundings {
  Point<2> half{};
  std::vector<InfinityPiece> pieces;
  /// Where that could not be proved, and for which curves: directions in which curves touch the
  /// line at infinity or meet on it, or nearly.
  struct Open {
    int chart;
    double lo, hi;
    std::vector<int> curves;
  };
  std::vector<Open> open;
};

/// The smallest one that is found, with half widths powers of two and a few ratios; the one with
/// the fewest open directions where there are such in all of them.
/// `stop` is asked now and then; when it says so nothing is found, and both charts stay open.
Surroundings find_surroundings(const std::vector<Polynomial<2>>& curves,
                               const std::function<bool()>& stop, Kernel& kernel);

}  // namespace encase
