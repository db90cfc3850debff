// SPDX-License-Identifier: MIT
#include "2d/side_roots.hpp"

#include <algorithm>

namespace encase {
namespace {

constexpr int kMostPieces = 100;
constexpr int kNewtonSteps = 2;
constexpr double kFine = 0x1p-8;  ///< one step that gains so much will do
// Pieces below this part of the segment on which f is not smooth will not do.
constexpr double kRough = 0x1p-8;
// Not one half: symmetric curves like to pass the middle.
constexpr double kCut = 0.4871;

/// Shrinks a piece on which f is strictly monotone and changes its sign by Newton's method; its
/// ends stay proved not to be zeros.
void shrink(CurveBounds& curve, int axis, const Interval& slope, Box<2>* piece) {
  const Sign at_lo = slope.lo > 0 ? Sign::Negative : Sign::Positive;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const double lo = piece->lo[axis], hi = piece->hi[axis], width = hi - lo;
    Point<2> middle = piece->center();
    const Interval newton = Interval(middle[axis]) - curve.value_at(middle) / slope;
    const double slack = 0x1p-20 * width;  // away from the zero, so that the ends have signs
    const double below = newton.lo - slack, above = newton.hi + slack;
    bool gained = false;
    if (below > lo && below < hi) {
      middle[axis] = below;
      if (curve.sign_at(middle) == at_lo) piece->lo[axis] = below, gained = true;
    }
    if (above < hi && above > piece->lo[axis]) {
      middle[axis] = above;
      if (curve.sign_at(middle) == -at_lo) piece->hi[axis] = above, gained = true;
    }
    if (!gained || piece->width(axis) > 0.5 * width || piece->width(axis) < kFine * width) return;
  }
}

}  // namespace

std::optional<std::vector<Box<2>>> side_roots(CurveBounds& curve, const Box<2>& segment, int axis) {
  std::vector<Box<2>> roots, stack{segment};
  for (int pieces = 0; !stack.empty(); ++pieces) {
    if (pieces == kMostPieces) return std::nullopt;
    Box<2> piece = stack.back();
    stack.pop_back();
    const CurveBounds::Look look = curve.look(piece);
    if (look.absent) continue;
    const Interval slope = look.slopes.slope[static_cast<std::size_t>(axis)];
    const bool smooth = look.slopes.smooth;
    if (smooth && (slope.lo > 0 || slope.hi < 0)) {
      // Monotone: what was looked at are the values at both ends.
      if (!look.changes) return std::nullopt;
      shrink(curve, axis, slope, &piece);
      roots.push_back(piece);
      continue;
    }
    if (!smooth && piece.width(axis) < kRough * segment.width(axis)) return std::nullopt;
    Box<2> upper = piece;
    const double cut = piece.lo[axis] + kCut * piece.width(axis);
    if (!(piece.lo[axis] < cut && cut < piece.hi[axis])) return std::nullopt;
    piece.hi[axis] = upper.lo[axis] = cut;
    stack.push_back(upper);
    stack.push_back(piece);
  }
  return roots;
}

}  // namespace encase
