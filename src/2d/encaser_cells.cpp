// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "2d/encaser.hpp"
#include "2d/loop_certificates.hpp"
#include "2d/splitting_lines.hpp"
#include "common/segments.hpp"

namespace encase {

Encaser::Shape Encaser::shape_of(const CellAtHand& at_hand) {
  const OpenCell& cell = at_hand.cell();
  int curves = 0;
  for (const auto& presence : at_hand.curves()) {
    if (presence.ends > 2) return Shape::Complex;
    curves += presence.ends > 0;
  }
  if (curves < 2) return cell.crossings.empty() ? Shape::Simple : Shape::Complex;
  if (curves > 2) return Shape::Complex;
  const bool alternates = at_hand.curve_at(0) == at_hand.curve_at(2);
  if (cell.crossings.size() == 1 && alternates) return Shape::Simple;
  if (cell.crossings.empty() && !alternates) return Shape::Relaxable;
  return Shape::Complex;
}

/// A cell that meets a zone is cut down to the clearance of one.
bool Encaser::find_cut_at_zone(const OpenCell& cell, SplittingLines& lines, CellState* settled) {
  const Partition& partition = *partition_;
  const Box<2> bounds = bounds_of(cell);
  const double diameter = bounds_.largest_width();
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
      if (lines.find_along(around)) return true;
    }
  }
  // What is left of a cell around a zone is not proved.
  bool budget = false;
  for (const Unresolved& entry : result_.undecided)
    for (const int k : cell.zones)
      budget = budget || (entry.has_box && partition.zones[k].box.contains(entry.box));
  *settled = budget ? CellState::Undecided : CellState::Degenerate;
  return false;
}

/// The line that splits the cell at hand next, or false and the state it is settled in.
bool Encaser::find_cut(CellAtHand& at_hand, SplittingLines& lines, CellState* settled) {
  const OpenCell& cell = at_hand.cell();
  if (!cell.zones.empty()) return find_cut_at_zone(cell, lines, settled);
  *settled = CellState::Undecided;
  const Shape shape = shape_of(at_hand);
  const bool relax =
      shape == Shape::Relaxable && (options_.relaxed || cell.stall >= options_.relax_after_splits);
  if (shape != Shape::Simple && !relax)
    return cell.depth < 400 && (lines.find_best() || lines.find_any());
  // Loops last: a ray for every critical region inside, or a split through it.
  for (const int k : cell.critical_regions) {
    if (auto certificate = certify_no_loop(at_hand, k)) {
      certificates_.push_back(*certificate);
      continue;
    }
    ++result_.statistics.loop_splits;
    for (const Box<2>& box : partition_->critical_regions[k].boxes)
      if (lines.find_through(box.center())) return true;
    return lines.find_any();
  }
  *settled = relax ? CellState::Relaxed : CellState::Certified;
  return false;
}

void Encaser::split_cells() {
  Partition& partition = *partition_;
  partition.fill(&first_cell_);
  CellAtHand at_hand(partition);
  SplittingLines lines(at_hand, options_.fast);
  std::vector<OpenCell> stack;
  stack.push_back(std::move(first_cell_));
  std::vector<Cell>& finished = result_.cells;
  finished.reserve(2 * partition.crossings.size() + 16);
  const double features = static_cast<double>(partition.crossings.size() + 1);
  for (std::int64_t count = 0; !stack.empty(); ++count) {
    OpenCell cell = std::move(stack.back());
    stack.pop_back();
    if (count % 64 == 63)
      progress("splitting cells",
               static_cast<double>(finished.size()) /
                   (static_cast<double>(finished.size() + stack.size()) + features));
    CellState settled = CellState::Undecided;
    certificates_.clear();
    // The clock is slow to read.
    const bool stop = count % 16 == 0 || static_cast<int>(finished.size()) >= options_.max_cells
                          ? out_of_budget()
                          : !budget_.empty();
    if (!stop) {
      at_hand.take(cell);
      bool found = find_cut(at_hand, lines, &settled);
      OpenCell negative(partition.memory()), positive(partition.memory());
      // If the order of the roots on the line cannot be proved: any other line.
      if (found && !partition.apply(cell, &at_hand.cut(), &negative, &positive)) {
        settled = CellState::Undecided;
        found = lines.find_any() && partition.apply(cell, &at_hand.cut(), &negative, &positive);
      }
      if (found) {
        ++result_.statistics.splits;
        negative.sketches = positive.sketches = at_hand.sketches();
        stack.push_back(std::move(positive));
        stack.push_back(std::move(negative));
        continue;
      }
      if (settled == CellState::Undecided) certificates_.clear();
    }
    if (cell.parent >= 0)
      (cell.positive ? partition.history[cell.parent].positive
                     : partition.history[cell.parent].negative) =
          ~static_cast<int>(finished.size());
    finish(cell, settled);
  }
}

namespace {

/// The meeting point of two lines, good to an ulp or so of `size`: from its enclosure where that is
/// tight, in extended precision where the lines meet at a small angle, or exactly.
Point<2> rounded_meet(const Line& first, const Line& second, const Place& at, double size) {
  const double width = at.box.largest_width();
  if (width <= 0x1p-51 * size) return at.center;
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

/// Makes the cell, but for the cuts between crossings of one edge: their places come last.
void Encaser::finish(const OpenCell& open, CellState state) {
  Partition& partition = *partition_;
  const int id = static_cast<int>(result_.cells.size());
  Cell& cell = result_.cells.emplace_back();
  cell.state = state;
  cell.depth = open.depth;
  const int n = static_cast<int>(open.edges.size());
  const double size = std::max({std::fabs(bounds_.lo[0]), std::fabs(bounds_.hi[0]),
                                std::fabs(bounds_.lo[1]), std::fabs(bounds_.hi[1])});
  std::size_t vertices = 0;
  for (int k = 0; k < n; ++k)
    vertices += static_cast<std::size_t>(std::max(1, open.edges[k].end - open.begin_of(k)));
  cell.vertices.reserve(vertices);
  cell.word.assign(open.word.begin(), open.word.end());
  for (int k = 0; k < n; ++k) {
    const auto& edge = open.edges[k];
    const int before = open.edges[(k + n - 1) % n].line;
    Vertex vertex{before, edge.line, 0, {}};
    vertex.point =
        rounded_meet(partition.lines[before], partition.lines[edge.line], open.vertices[k], size);
    cell.vertices.push_back(vertex);
    for (int i = open.begin_of(k) + 1; i < edge.end; ++i)
      cell.vertices.push_back({edge.line, edge.line, 0, {}});
  }
  for (const int k : open.crossings) partition.crossings[k].cell = id;
  if (state == CellState::Undecided && open.zones.empty()) ++unfinished_;
  if (state != CellState::Certified && state != CellState::Relaxed) return;
  if (!open.crossings.empty()) cell.crossing = open.crossings.front();
  cell.branches.reserve(cell.word.size() / 2);
  for (std::size_t i = 0; i < cell.word.size(); ++i)
    for (std::size_t j = i + 1; j < cell.word.size(); ++j) {
      const int c = partition.line_crossings[cell.word[i]].curve;
      if (partition.line_crossings[cell.word[j]].curve == c)
        cell.branches.push_back({c, cell.word[i], cell.word[j]});
    }
  cell.loop_certificates = certificates_;
}

/// Calls `action` with every cut between two crossings of one edge and these, in ascending order.
template <class Action>
void Encaser::for_each_cut(Cell* cell, Action action) {
  std::vector<LineCrossing>& crossings = partition_->line_crossings;
  std::size_t next = 0;  // entry of the word
  for (Vertex& vertex : cell->vertices) {
    if (vertex.line_in == vertex.line_out) {
      LineCrossing *a = &crossings[cell->word[next - 1]], *b = &crossings[cell->word[next]];
      if (a->lo > b->lo) std::swap(a, b);
      action(&vertex, a, b);
    } else if (next == cell->word.size() || crossings[cell->word[next]].line != vertex.line_out) {
      continue;  // an edge without crossings
    }
    ++next;
  }
}

void Encaser::finish_cells() {
  Partition& partition = *partition_;
  // Neighbours on one edge get a gap, so that the edge can be cut between them.
  for (Cell& cell : result_.cells)
    for_each_cut(&cell, [&](Vertex* cut, LineCrossing* a, LineCrossing* b) {
      const Line& line = partition.lines[cut->line_in];
      for (int tries = 0; tries < 80; ++tries) {
        if (a->hi < b->lo && a->hi + 0.5 * (b->lo - a->hi) > a->hi) break;
        for (LineCrossing* c : {a, b}) {
          RootInterval root{c->lo, c->hi};
          refine_on_line(polynomials_[c->curve], line, &root, kernel_);
          c->lo = root.lo;
          c->hi = root.hi;
        }
      }
    });
  // Both cells beside a cut compute the same.
  for (Cell& cell : result_.cells)
    for_each_cut(&cell, [&](Vertex* cut, const LineCrossing* a, const LineCrossing* b) {
      cut->parameter = a->hi + 0.5 * (b->lo - a->hi);
      const Line& line = partition.lines[cut->line_in];
      cut->point = Place(point_on_line(line, Interval(cut->parameter))).center;
    });
  if (unfinished_ > 0) {
    Unresolved entry;
    entry.kind = Unresolved::Kind::Budget;
    entry.reason =
        std::to_string(unfinished_) + (unfinished_ == 1 ? " cell is" : " cells are") +
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
