// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "2d/encaser.hpp"
#include "2d/loop_certificates.hpp"
#include "2d/splitting_lines.hpp"

namespace encase {

Encaser::Shape Encaser::shape_of(const OpenCell& cell) const {
  const std::vector<int> word = partition_->word(cell);
  std::vector<int> counts = partition_->crossing_counts(cell);
  int curves = 0;
  for (const int count : counts) {
    if (count > 2) return Shape::Complex;
    curves += count > 0;
  }
  if (curves < 2) return cell.crossings.empty() ? Shape::Simple : Shape::Complex;
  if (curves > 2) return Shape::Complex;
  const bool alternates =
      partition_->line_crossings[word[0]].curve == partition_->line_crossings[word[2]].curve;
  if (cell.crossings.size() == 1 && alternates) return Shape::Simple;
  if (cell.crossings.empty() && !alternates) return Shape::Relaxable;
  return Shape::Complex;
}

/// The line that splits a cell next, or nothing and the state it is settled in.
std::optional<Cut> Encaser::next_cut(const OpenCell& cell, CellState* settled) {
  Partition& partition = *partition_;
  // Zones first: cut the cell down to the clearance of one.
  if (!cell.zones.empty()) {
    Box<2> bounds{middle(cell.vertices[0]), middle(cell.vertices[0])};
    for (const auto& v : cell.vertices) bounds = hull(bounds, Box<2>{middle(v), middle(v)});
    const double diameter = result_.region_used.bounding_box().largest_width();
    for (const int k : cell.zones) {
      const Zone& zone = partition.zones[k];
      if (zone.box.largest_width() > diameter / 8) break;
      for (const double scale : {1.0, 0.83, 1.21}) {
        Box<2> around = zone.clearance;
        for (int i = 0; i < 2; ++i) {
          around.lo[i] = zone.box.lo[i] - scale * (zone.box.lo[i] - zone.clearance.lo[i]);
          around.hi[i] = zone.box.hi[i] + scale * (zone.clearance.hi[i] - zone.box.hi[i]);
        }
        if (around.contains(bounds)) break;
        if (auto cut = best_cut_along(partition, cell, around)) return cut;
      }
    }
    // What is left of a cell around a zone is not proved.
    bool budget = false;
    for (const Unresolved& entry : result_.undecided)
      for (const int k : cell.zones)
        budget = budget || (entry.has_box && partition.zones[k].box.contains(entry.box));
    *settled = budget ? CellState::Undecided : CellState::Degenerate;
    return std::nullopt;
  }
  const Shape shape = shape_of(cell);
  const bool relax =
      shape == Shape::Relaxable && (options_.relaxed || cell.stall >= options_.relax_after_splits);
  if (shape == Shape::Simple || relax) {
    // Loops last: a ray for every critical region inside, or a split through it.
    certificates_.clear();
    for (const int k : cell.critical_regions) {
      if (auto certificate = certify_no_loop(partition, cell, k)) {
        certificates_.push_back(*certificate);
        continue;
      }
      ++result_.statistics.loop_splits;
      for (const Box<2>& box : partition.critical_regions[k].boxes)
        if (auto cut = best_cut_through(partition, cell, box.center())) return cut;
      if (auto cut = any_cut(partition, cell)) return cut;
      *settled = CellState::Undecided;
      return std::nullopt;
    }
    *settled = relax ? CellState::Relaxed : CellState::Certified;
    return std::nullopt;
  }
  if (cell.depth < 400) {
    if (auto cut = best_cut(partition, cell)) return cut;
    if (auto cut = any_cut(partition, cell)) return cut;
  }
  *settled = CellState::Undecided;
  return std::nullopt;
}

void Encaser::split_cells() {
  Partition& partition = *partition_;
  for (std::size_t k = 0; k < partition.crossings.size(); ++k) {
    bool inside = true;
    for (const Line& line : sides_)
      inside = inside && side(line, partition.crossings[k].box, kernel_) == Sign::Negative;
    if (inside)
      first_cell_.crossings.push_back(static_cast<int>(k));
    else
      partition.crossings[k].location = Location::Outside;
  }
  for (std::size_t k = 0; k < partition.critical_regions.size(); ++k)
    if (partition.inside(partition.critical_regions[k]))
      first_cell_.critical_regions.push_back(static_cast<int>(k));
  for (std::size_t k = 0; k < partition.zones.size(); ++k) {
    bool outside = false;
    for (const Line& line : sides_)
      outside = outside || side(line, partition.zones[k].box, kernel_) == Sign::Positive;
    if (!outside) first_cell_.zones.push_back(static_cast<int>(k));
  }

  std::vector<OpenCell> stack{first_cell_};
  const double features = static_cast<double>(partition.crossings.size() + 1);
  int until_progress = 0;
  while (!stack.empty()) {
    OpenCell cell = std::move(stack.back());
    stack.pop_back();
    if (++until_progress % 64 == 0)
      progress("splitting cells",
               static_cast<double>(finished_.size()) /
                   (static_cast<double>(finished_.size() + stack.size()) + features));
    CellState settled = CellState::Undecided;
    std::optional<Cut> cut;
    certificates_.clear();
    if (!out_of_budget()) cut = next_cut(cell, &settled);
    if (cut) {
      OpenCell negative, positive;
      // The order of the roots on the line could not be proved: any other line.
      bool done = partition.apply(cell, std::move(*cut), &negative, &positive);
      if (!done)
        if (auto other = any_cut(partition, cell))
          done = partition.apply(cell, std::move(*other), &negative, &positive);
      if (done) {
        ++result_.statistics.splits;
        stack.push_back(std::move(positive));
        stack.push_back(std::move(negative));
        continue;
      }
      settled = CellState::Undecided;
      certificates_.clear();
    }
    if (cell.parent >= 0)
      (cell.positive ? partition.history[cell.parent].positive
                     : partition.history[cell.parent].negative) =
          ~static_cast<int>(finished_.size());
    finished_.push_back({std::move(cell), settled, std::move(certificates_)});
  }
}

namespace {

/// The meeting point of two lines, good to an ulp or so of `size`: from its enclosure where that is
/// tight, in extended precision where the lines meet at a small angle, or exactly.
Point<2> rounded_meet(const Line& first, const Line& second, const std::array<Interval, 2>& at,
                      double size) {
  const double width = std::max(at[0].width(), at[1].width());
  if (width <= 0x1p-51 * size) return middle(at);
  if (Kernel::kHasExtended && width <= 0x1p-42 * size && !first.rational && !second.rational) {
    const long double a = first.normal[0], b = first.normal[1], c = first.offset;
    const long double d = second.normal[0], e = second.normal[1], f = second.offset;
    const long double determinant = a * e - b * d;
    return {static_cast<double>((b * f - c * e) / determinant),
            static_cast<double>((c * d - a * f) / determinant)};
  }
  const auto exact = exact_meet(first, second);
  return {nearest_double(exact[0]), nearest_double(exact[1])};
}

}  // namespace

Cell Encaser::finish(const OpenCell& open, CellState state, int id) {
  Partition& partition = *partition_;
  Cell cell;
  cell.state = state;
  cell.depth = open.depth;
  const int n = static_cast<int>(open.edges.size());
  const Box<2> bounds = result_.region_used.bounding_box();
  const double size = std::max({std::fabs(bounds.lo[0]), std::fabs(bounds.hi[0]),
                                std::fabs(bounds.lo[1]), std::fabs(bounds.hi[1])});
  for (int k = 0; k < n; ++k) {
    const auto& edge = open.edges[k];
    const int before = open.edges[(k + n - 1) % n].line;
    Vertex vertex{before, edge.line, 0, {}};
    vertex.point =
        rounded_meet(partition.lines[before], partition.lines[edge.line], open.vertices[k], size);
    cell.vertices.push_back(vertex);
    for (std::size_t i = 0; i < edge.crossings.size(); ++i) {
      if (i > 0) {
        // A cut between two crossings of one edge; both cells beside it compute the same.
        const LineCrossing *a = &partition.line_crossings[edge.crossings[i - 1]],
                           *b = &partition.line_crossings[edge.crossings[i]];
        if (a->lo > b->lo) std::swap(a, b);
        const double at = a->hi + 0.5 * (b->lo - a->hi);
        cell.vertices.push_back({edge.line, edge.line, at,
                                 middle(point_on_line(partition.lines[edge.line], Interval(at)))});
      }
      cell.word.push_back(edge.crossings[i]);
    }
  }
  for (const int k : open.crossings) partition.crossings[k].cell = id;
  if (state == CellState::Certified || state == CellState::Relaxed) {
    if (!open.crossings.empty()) cell.crossing = open.crossings.front();
    for (std::size_t i = 0; i < cell.word.size(); ++i)
      for (std::size_t j = i + 1; j < cell.word.size(); ++j) {
        const int c = partition.line_crossings[cell.word[i]].curve;
        if (partition.line_crossings[cell.word[j]].curve == c)
          cell.branches.push_back({c, cell.word[i], cell.word[j]});
      }
  }
  return cell;
}

void Encaser::finish_cells() {
  Partition& partition = *partition_;
  // Neighbours on one edge get a gap, so that the edge can be cut between them.
  for (const Finished& f : finished_)
    for (const auto& edge : f.cell.edges)
      for (std::size_t i = 0; i + 1 < edge.crossings.size(); ++i) {
        LineCrossing *a = &partition.line_crossings[edge.crossings[i]],
                     *b = &partition.line_crossings[edge.crossings[i + 1]];
        if (a->lo > b->lo) std::swap(a, b);
        for (int tries = 0; tries < 80; ++tries) {
          if (a->hi < b->lo && a->hi + 0.5 * (b->lo - a->hi) > a->hi) break;
          for (LineCrossing* c : {a, b}) {
            RootInterval root{c->lo, c->hi};
            refine_on_line(polynomials_[c->curve], partition.lines[edge.line], &root, kernel_);
            c->lo = root.lo;
            c->hi = root.hi;
          }
        }
      }
  int unfinished = 0;
  for (std::size_t k = 0; k < finished_.size(); ++k) {
    Finished& f = finished_[k];
    Cell cell = finish(f.cell, f.state, static_cast<int>(k));
    if (f.state == CellState::Certified || f.state == CellState::Relaxed)
      cell.loop_certificates = std::move(f.certificates);
    if (f.state == CellState::Undecided && f.cell.zones.empty()) ++unfinished;
    result_.cells.push_back(std::move(cell));
  }
  if (unfinished > 0) {
    Unresolved entry;
    entry.kind = Unresolved::Kind::Budget;
    entry.reason =
        std::to_string(unfinished) + (unfinished == 1 ? " cell is" : " cells are") +
        " not settled: " + (budget_.empty() ? "no splitting line could be proved" : budget_);
    result_.undecided.push_back(std::move(entry));
  }
  result_.lines = std::move(partition.lines);
  result_.line_crossings = std::move(partition.line_crossings);
  result_.crossings = std::move(partition.crossings);
  result_.critical_regions = std::move(partition.critical_regions);
  result_.history = std::move(partition.history);
}

}  // namespace encase
