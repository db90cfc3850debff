// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "common/tile.hpp"
#include "encase/geometry.hpp"

/// Values of polynomials at several points at once, computed in doubles without error bounds: what
/// heuristics look at. All instruction sets give the same bits.
namespace encase {

/// How often f changes sign between neighbours among 16 points spread over the inside of a segment:
/// nearly always the number of its roots there, and never more but for rounding.
int count_sign_changes(TiledFunction& f, const Point<2>& from, const Point<2>& to);

/// The values, gradients and second derivatives at up to eight points, in the tile's coordinates.
struct alignas(64) TileJets {
  std::array<double, 8> value, s, t, ss, st, tt;
};
void jets(const Tile& tile, const std::array<Point<2>, 8>& points, TileJets* jets);

}  // namespace encase
