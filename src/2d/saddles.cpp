// SPDX-License-Identifier: MIT
#include "2d/saddles.hpp"

#include <algorithm>
#include <cmath>

#include "common/tile_samples.hpp"

namespace encase {
namespace {

constexpr int kSteps = 4;  // of Newton's iteration

/// The saddle, with the normal of the line on which its neighbourhood falls apart.
Saddle saddle_at(int curve, const Point<2>& at, const Jet& jet) {
  const double a = jet.xx, b = jet.xy, c = jet.yy;
  // The eigenvector whose eigenvalue has the sign of f is the line's direction; the other its
  // normal.
  const double sign = jet.value > 0 ? 1 : -1;
  const double mean = 0.5 * (a + c), difference = 0.5 * (a - c);
  const double other = mean - sign * std::sqrt(difference * difference + b * b);
  const Point<2> first{b, other - a}, second{other - c, b};
  const auto square = [](const Point<2>& v) { return v[0] * v[0] + v[1] * v[1]; };
  return {curve, at, square(first) > square(second) ? first : second,
          std::sqrt(std::fabs(jet.value / other))};
}

bool near(const Point<2>& a, const Point<2>& b, double distance) {
  return std::fabs(a[0] - b[0]) < distance && std::fabs(a[1] - b[1]) < distance;
}

/// Newton's iteration from the centre of a box.
struct Search {
  Point<2> at, start;
  double size;
};

Jet jet_in_plane(const Tile& tile, const TileJets& jets, int lane) {
  const double x = 1 / tile.half[0], y = 1 / tile.half[1];
  return {jets.value[lane],
          {jets.s[lane] * x, jets.t[lane] * y},
          jets.ss[lane] * x * x,
          jets.st[lane] * x * y,
          jets.tt[lane] * y * y};
}

enum class Step { Lost, Far, Near };

Step advance(const Jet& jet, Search* search) {
  const double determinant = jet.xx * jet.yy - jet.xy * jet.xy;
  if (!(determinant < 0)) return Step::Lost;
  const Point<2> step{(jet.gradient[0] * jet.yy - jet.gradient[1] * jet.xy) / determinant,
                      (jet.gradient[1] * jet.xx - jet.gradient[0] * jet.xy) / determinant};
  search->at = {search->at[0] - step[0], search->at[1] - step[1]};
  if (!near(search->at, search->start, 1.5 * search->size)) return Step::Lost;
  return near(step, {0, 0}, 0.1 * search->size) ? Step::Near : Step::Far;
}

}  // namespace

void append_saddles(TiledFunction& f, int curve, const std::vector<Box<2>>& boxes,
                    std::vector<Saddle>* saddles) {
  const auto first = static_cast<std::ptrdiff_t>(saddles->size());
  std::vector<Search> searches;
  searches.reserve(boxes.size());
  for (const Box<2>& box : boxes)
    searches.push_back({box.center(), box.center(), box.largest_width()});
  const auto is_known = [&](const Point<2>& at, double distance) {
    return std::any_of(saddles->begin() + first, saddles->end(),
                       [&](const Saddle& s) { return near(s.at, at, distance); });
  };
  for (int i = 0; i < kSteps && !searches.empty(); ++i) {
    std::size_t left = 0, next = 0;
    while (next < searches.size()) {
      // Those in one tile together.
      const Tile& tile = f.at(searches[next].at);
      std::array<Point<2>, 8> points{};
      int count = 0;
      for (; count < 8 && next + count < searches.size(); ++count) {
        const Point<2>& at = searches[next + count].at;
        for (int k = 0; k < 2; ++k) points[count][k] = (at[k] - tile.center[k]) / tile.half[k];
        if (!near(points[count], {0, 0}, Tile::kReach) && count > 0) break;
      }
      TileJets at_points;
      jets(tile, points, &at_points);
      for (int lane = 0; lane < count; ++lane) {
        Search search = searches[next + lane];
        const Jet jet = jet_in_plane(tile, at_points, lane);
        switch (advance(jet, &search)) {
          case Step::Lost:
            break;
          case Step::Far:
            searches[left++] = search;
            break;
          case Step::Near:
            if (!is_known(search.at, 0.1 * search.size))
              saddles->push_back(saddle_at(curve, search.at, jet));
        }
      }
      next += count;
    }
    searches.resize(left);
  }
}

}  // namespace encase
