// SPDX-License-Identifier: MIT
// Step 2, its first part: a polygon that is generic for the curves.
#include "2d/encaser.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "2d/infinity.hpp"
#include "2d/locate.hpp"
#include "common/wording.hpp"

namespace encase {

void Encaser::use_region(const Region& region) {
  result_.region_used = region;
  bounds_ = region.bounding_box();
  sides_.clear();
  for (int k = 0; k < region.side_count(); ++k) sides_.push_back(region.side(k));
  const Box<2> root = subdivision_root(bounds_);
  tiled_.clear();
  tile_kernels_.resize(polynomials_.size(), kernel_.fresh());
  for (std::size_t c = 0; c < polynomials_.size(); ++c)
    tiled_.emplace_back(polynomials_[c], root, tile_kernels_[c]);
  if (tiles_) tiles_->add_counts_to(&kernel_);
  // (For one pair inner tiles are not worth their making.)
  tiles_ = std::make_unique<NestedTiles>(polynomials_, tiled_, bounds_.center(),
                                         polynomials_.size() > 2, kernel_);
  features_ = {};
  partition_ = std::make_unique<Partition>(polynomials_, *tiles_, features_, kernel_);
  earlier_.match(result_.curves, region);
}

bool Encaser::open_region() {
  if (result_.region.plane) return open_plane();
  // The region itself, or one of some slightly larger polygons in which every curve meets the sides
  // in simple points, none of them a corner or shared (design of the boundary: docs/encasement.md).
  for (int attempt = 0; attempt < 6; ++attempt) {
    if (attempt == 0) {
      use_region(result_.region);
    } else if (const auto used = enlarged(result_.region, attempt)) {
      use_region(*used);
    } else {
      continue;
    }
    if (open_polygon()) return true;
  }
  return false;
}

bool Encaser::open_region_as_asked() {
  use_region(result_.region);
  return open_polygon();
}

/// Whether the polygon to be used is generic for the curves.
bool Encaser::open_polygon() {
  auto cell = partition_->open(sides_);
  if (!cell) return false;
  first_cell_ = std::move(*cell);
  isolate_crossings();
  // Every crossing box must lie on one side of every side's line.
  bool clear = true;
  for (const Crossing& crossing : features_.crossings) {
    const Place place(crossing.box);
    for (const Line& line : sides_) clear = clear && side(line, place, kernel_).has_value();
  }
  return clear;
}

/// In place of the plane a rectangle outside of which the curves are known, as far as that can be.
bool Encaser::open_plane() {
  std::vector<Polynomial<2>> curves;
  for (const Curve& curve : result_.curves) curves.push_back(curve.function.polynomial());
  Surroundings surroundings = find_surroundings(curves, stop("looking for a rectangle"), kernel_);
  const Rational x(surroundings.half[0]), y(surroundings.half[1]);
  use_region(make_region(-x, x, -y, y).value());
  for (Surroundings::Open& open : surroundings.open) {
    Unresolved entry;
    entry.kind = Unresolved::Kind::Infinity;
    std::sort(open.curves.begin(), open.curves.end());
    std::string names;
    for (const int c : open.curves)
      names += (names.empty() ? "'" : " and '") + result_.curves[c].name + "'";
    const double v = 0.5 * (open.lo + open.hi), ratio = surroundings.half[1] / surroundings.half[0];
    const Point<2> direction = open.chart == 0 ? Point<2>{1, v * ratio} : Point<2>{v / ratio, 1};
    entry.reason =
        (open.curves.size() == 1
             ? "curve " + names + " touches the line at infinity, or nearly,"
             : "curves " + names + " touch the line at infinity or meet on it, or nearly,") +
        " in the direction (" + decimal(direction[0]) + ", " + decimal(direction[1]) + ")";
    entry.curves = std::move(open.curves);
    result_.degenerate.push_back(std::move(entry));
  }
  if (surroundings.open.empty()) result_.infinity = std::move(surroundings.pieces);
  return open_polygon();
}

void Encaser::give_up_on_region() {
  if (!result_.region.plane) use_region(result_.region);
  partition_->lines = sides_;
  isolate_crossings();
  find_critical_regions();
  OpenCell cell;
  const int n = static_cast<int>(partition_->lines.size());
  for (int k = 0; k < n; ++k) {
    cell.vertices.push_back(meet(partition_->lines[(k + n - 1) % n], partition_->lines[k]));
    cell.edges.push_back({k, false, {}});
  }
  const SplittingTask task{options_, earlier_, bounds_, result_.undecided, {}, {}};
  CellSplitter splitter(*partition_, task);
  splitter.add(std::move(cell));
  splitter.give_up();
  take_cells(&splitter);
  budget_ = "the curves' crossings with the region's sides could not be told apart";
  is_used_up_ = true;
  finish_cells();
}

}  // namespace encase
