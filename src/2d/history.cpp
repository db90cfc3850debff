// SPDX-License-Identifier: MIT
#include "2d/history.hpp"

#include <cmath>
#include <utility>

#include "common/kernel.hpp"
#include "common/segments.hpp"

namespace encase {
namespace {

/// A convex polygon by the lines its edges run on: vertex k is where edge k - 1 and edge k meet.
using Sides = std::vector<int>;

/// The parts of a polygon on both sides of a line, empty where there is none.
std::pair<Sides, Sides> cut(const std::vector<Line>& lines, const Sides& sides, int line,
                            Kernel& kernel) {
  const std::size_t size = sides.size();
  std::vector<Sign> at(size);
  for (std::size_t k = 0; k < size; ++k)
    at[k] = side(lines[line], lines[sides[(k + size - 1) % size]], lines[sides[k]], kernel);
  const auto part = [&](Sign keep) {
    Sides kept;
    bool any = false;
    for (std::size_t k = 0; k < size; ++k) {
      const Sign here = at[k], next = at[(k + 1) % size];
      any |= here == keep;
      // An edge stays if some of it is in the part, and the cut follows where the boundary leaves.
      if (here == keep || next == keep) kept.push_back(sides[k]);
      if (here == keep && next != keep) kept.push_back(line);
    }
    return any ? kept : Sides{};
  };
  return {part(Sign::Negative), part(Sign::Positive)};
}

std::vector<Point<2>> points_of(const std::vector<Line>& lines, const Sides& sides) {
  std::vector<Point<2>> points;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const auto at = meet(lines[sides[(k + sides.size() - 1) % sides.size()]], lines[sides[k]]);
    const Point<2> point = {at[0].mid(), at[1].mid()};
    if (!std::isfinite(point[0]) || !std::isfinite(point[1])) return {};
    points.push_back(point);
  }
  return points;
}

}  // namespace

std::vector<std::vector<Point<2>>> history_polygons(const Encasement& encasement) {
  const std::vector<Split>& history = encasement.history;
  std::vector<Sides> sides(history.size());
  std::vector<std::vector<Point<2>>> polygons(history.size());
  if (history.empty()) return polygons;
  for (int k = 0; k < encasement.region_used.side_count(); ++k) sides[0].push_back(k);
  Kernel kernel;
  // Parents come before their children.
  for (std::size_t k = 0; k < history.size(); ++k) {
    if (sides[k].size() < 3) continue;
    polygons[k] = points_of(encasement.lines, sides[k]);
    auto parts = cut(encasement.lines, sides[k], history[k].line, kernel);
    if (history[k].negative >= 0) sides[history[k].negative] = std::move(parts.first);
    if (history[k].positive >= 0) sides[history[k].positive] = std::move(parts.second);
  }
  return polygons;
}

std::vector<HistoryPiece> pieces_after(const Encasement& encasement, int cuts) {
  const std::vector<Split>& history = encasement.history;
  std::vector<HistoryPiece> pieces;
  if (history.empty()) {
    if (!encasement.cells.empty()) pieces.push_back({-1, 0, 0});
    return pieces;
  }
  std::vector<HistoryPiece> stack = {{0, -1, 0}};
  while (!stack.empty()) {
    const HistoryPiece piece = stack.back();
    stack.pop_back();
    if (piece.split < 0 || piece.split >= cuts) {
      pieces.push_back(piece);
      continue;
    }
    const Split& split = history[piece.split];
    for (const int child : {split.positive, split.negative})
      stack.push_back({child >= 0 ? child : -1, child >= 0 ? -1 : ~child, piece.depth + 1});
  }
  return pieces;
}

}  // namespace encase
