// SPDX-License-Identifier: MIT
#include "2d/nested_tiles.hpp"

#include <algorithm>
#include <cmath>

#include "common/segments.hpp"

namespace encase {
namespace {

constexpr double kSmaller = 0.125;    // an inner box, as a part of the next
constexpr double kBlurred = 0x1p-12;  // of all terms, what those of low degree are less than
constexpr int kMostNested = 12;
constexpr double kStopMargin = 0x1p-10;  // of a box's width

/// Whether what matters around the middle of a tile drowns in the roundings of the other terms.
bool is_blurred(const Tile& tile) {
  double low = 0;
  for (int i = 0; i <= 2; ++i)
    for (int j = 0; i + j <= 2; ++j) low += std::fabs(tile.a[i][j]);
  return low < kBlurred * tile.sum;
}

/// The next box around the middle; `box` contains it if it contains the middle well inside.
Box<2> inner_box(const Box<2>& box, const Point<2>& middle) {
  Box<2> inner;
  for (int i = 0; i < 2; ++i) {
    const double half = 0.5 * kSmaller * box.width(i);
    inner.lo[i] = middle[i] - half;
    inner.hi[i] = middle[i] + half;
  }
  return inner;
}

}  // namespace

Box<2> box_on_line(const Line& line, double from, double to) {
  const int p = parameter_axis(line), q = 1 - p;
  Box<2> box;
  box.lo[p] = from;
  box.hi[p] = to;
  const double slope = -line.normal[p] / line.normal[q], base = -line.offset / line.normal[q],
               a = base + slope * from, b = base + slope * to;
  box.lo[q] = std::min(a, b);
  box.hi[q] = std::max(a, b);
  return box;
}

NestedTiles::NestedTiles(const std::vector<FilteredFunction<2>>& polynomials,
                         std::vector<TiledFunction>& whole, const Point<2>& middle, bool nested,
                         const Kernel& kernel)
    : whole_(whole), inner_(whole.size()) {
  for (std::size_t c = 0; nested && c < whole.size(); ++c) {
    std::vector<TiledFunction>& inner = inner_[c];
    for (int k = 0; k < kMostNested; ++k) {
      TiledFunction& outer = inner.empty() ? whole[c] : inner.back();
      const Box<2> box = inner_box(outer.box(), middle);
      if (!outer.box().contains(box) || !is_blurred(outer.at(middle))) break;
      inner.emplace_back(polynomials[c], box, kernels_.emplace_back(kernel.fresh()));
      inner.back().take_gaps_of(whole[c]);
    }
  }
}

void NestedTiles::add_counts_to(Kernel* kernel) {
  for (Kernel& counted : kernels_) {
    kernel->add(counted);
    counted = counted.fresh();
  }
}

TiledFunction& NestedTiles::about(int polynomial, const Box<2>& part) {
  std::vector<TiledFunction>& inner = inner_[index(polynomial)];
  for (auto tiles = inner.rbegin(); tiles != inner.rend(); ++tiles)
    if (tiles->box().contains(part)) return *tiles;
  return whole(polynomial);
}

void NestedTiles::append_stops(int polynomial, const Line& line, double from, double to,
                               std::vector<double>* stops) const {
  const auto first = static_cast<std::ptrdiff_t>(stops->size());
  const int p = parameter_axis(line), q = 1 - p;
  const double slope = -line.normal[p] / line.normal[q], base = -line.offset / line.normal[q];
  for (const TiledFunction& tiles : inner_[index(polynomial)]) {
    // A little inside, so that what lies between the stops is inside.
    const Box<2>& box = tiles.box();
    double lo = box.lo[p], hi = box.hi[p];
    if (slope != 0) {
      const double a = (box.lo[q] - base) / slope, b = (box.hi[q] - base) / slope;
      lo = std::max(lo, std::min(a, b));
      hi = std::min(hi, std::max(a, b));
    } else if (!(box.lo[q] < base && base < box.hi[q])) {
      break;
    }
    const double margin = kStopMargin * box.width(p);
    lo += margin;
    hi -= margin;
    if (!(lo < hi)) break;
    for (const double stop : {lo, hi})
      if (from < stop && stop < to) stops->push_back(stop);
  }
  std::sort(stops->begin() + first, stops->end());
}

}  // namespace encase
