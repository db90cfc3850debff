// SPDX-License-Identifier: MIT
#include "2d/side_roots.hpp"

#include <algorithm>

namespace encase {
namespace {

constexpr int kMostPieces = 400;
constexpr int kNewtonSteps = 4;
// Not one half: symmetric curves like to pass the middle.
constexpr double kCut = 0.4871;

/// Shrinks a piece on which f is strictly monotone and changes its sign by Newton's method; its
/// ends stay proved not to be zeros.
void shrink(CurveBounds& curve, int axis, const Interval& slope, Sign at_lo, Box<2>* piece) {
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
    if (!gained || piece->width(axis) > 0.5 * width) return;
  }
}

}  // namespace

std::optional<std::vector<Box<2>>> side_roots(CurveBounds& curve, const Box<2>& segment, int axis) {
  std::vector<Box<2>> roots, stack{segment};
  for (int pieces = 0; !stack.empty(); ++pieces) {
    if (pieces == kMostPieces) return std::nullopt;
    Box<2> piece = stack.back();
    stack.pop_back();
    if (curve.look(piece).absent) continue;
    const CurveBounds::Slopes slopes = curve.slopes(piece);
    const Interval slope = slopes.slope[static_cast<std::size_t>(axis)];
    if (slopes.smooth && (slope.lo > 0 || slope.hi < 0)) {
      const std::optional<Sign> at_lo = curve.sign_at(piece.lo), at_hi = curve.sign_at(piece.hi);
      if (!at_lo || !at_hi) return std::nullopt;
      if (*at_lo == *at_hi) continue;
      shrink(curve, axis, slope, *at_lo, &piece);
      roots.push_back(piece);
      continue;
    }
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
