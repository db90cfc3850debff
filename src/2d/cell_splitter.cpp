// SPDX-License-Identifier: MIT
#include "2d/cell_splitter.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "2d/loop_certificates.hpp"
#include "2d/places.hpp"

namespace encase {
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

CellSplitter::CellSplitter(Partition& partition, const SplittingTask& task)
    : partition_(partition), task_(task) {}

CellSplitter::Shape CellSplitter::shape_of_cell() const {
  const OpenCell& cell = work_->at_hand.cell();
  int curves = 0;
  for (const auto& presence : work_->at_hand.curves()) {
    if (presence.ends > 2) return Shape::Complex;
    curves += presence.ends > 0;
  }
  if (curves < 2) return cell.crossings.empty() ? Shape::Simple : Shape::Complex;
  if (curves > 2) return Shape::Complex;
  const bool alternates = work_->at_hand.curve_at(0) == work_->at_hand.curve_at(2);
  if (cell.crossings.size() == 1 && alternates) return Shape::Simple;
  if (cell.crossings.empty() && !alternates) return Shape::Relaxable;
  return Shape::Complex;
}

/// A cell that meets a zone is cut down to the clearance of one.
bool CellSplitter::find_cut_at_zone(const OpenCell& cell, CellState* settled) {
  const Box<2> bounds = bounds_of(cell);
  const double diameter = task_.bounds.largest_width();
  for (const int k : cell.zones) {
    const Zone& zone = partition_.zones[k];
    if (!zone.crossable && zone.box.largest_width() > diameter / 8) break;
    for (const double scale : {1.0, 0.83, 1.21, 11.0, 97.0}) {
      if (scale > 2 && !zone.crossable) break;  // others are kept clear of features
      Box<2> around = zone.clearance;
      for (int i = 0; i < 2; ++i) {
        around.lo[i] = zone.box.lo[i] - scale * (zone.box.lo[i] - zone.clearance.lo[i]);
        around.hi[i] = zone.box.hi[i] + scale * (zone.clearance.hi[i] - zone.box.hi[i]);
      }
      if (around.contains(bounds)) break;
      if (work_->lines.find_along(around)) return true;
    }
  }
  // What is left of a cell around a zone is not proved.
  bool budget = false;
  for (const Unresolved& entry : task_.undecided)
    for (const int k : cell.zones)
      budget = budget || (entry.has_box && partition_.zones[k].box.contains(entry.box));
  *settled = budget ? CellState::Undecided : CellState::Degenerate;
  return false;
}

/// Whether the line that cut the cell at hand in the earlier encasement cuts it now.
bool CellSplitter::repeat_cut() {
  const int cut = work_->at_hand.cell().earlier_cut;
  return cut >= 0 && work_->at_hand.prove_only(task_.earlier.line(cut));
}

/// The line that splits the cell at hand next, or false and the state it is settled in.
bool CellSplitter::find_cut(CellState* settled) {
  const OpenCell& cell = work_->at_hand.cell();
  if (!cell.zones.empty()) return find_cut_at_zone(cell, settled);
  *settled = CellState::Undecided;
  const Shape shape = shape_of_cell();
  const EncaseOptions& options = task_.options;
  const bool relax =
      shape == Shape::Relaxable && (options.relaxed || cell.stall >= options.relax_after_splits);
  if (shape != Shape::Simple && !relax)
    return cell.depth < 400 && (work_->lines.find_best() || work_->lines.find_any());
  // Loops last: a ray for every critical region inside, or a split through it.
  for (const int k : cell.critical_regions) {
    if (auto certificate = certify_no_loop(work_->at_hand, k)) {
      certificates_.push_back(*certificate);
      continue;
    }
    ++loop_splits;
    for (const Box<2>& box : partition_.critical_regions[k].boxes)
      if (work_->lines.find_through(box.center())) return true;
    return work_->lines.find_any();
  }
  *settled = relax ? CellState::Relaxed : CellState::Certified;
  return false;
}

std::unique_ptr<OpenCell> CellSplitter::spare_cell() {
  if (spare_.empty()) return std::make_unique<OpenCell>(partition_.memory());
  std::unique_ptr<OpenCell> cell = std::move(spare_.back());
  spare_.pop_back();
  return cell;
}

void CellSplitter::process_next() {
  if (!work_) work_ = std::make_unique<Work>(partition_, task_.options.fast);
  std::unique_ptr<OpenCell> cell = std::move(open_.back());
  open_.pop_back();
  process(*cell);
  spare_.push_back(std::move(cell));
}

/// Finishes a cell, or puts its halves on top of the open ones.
void CellSplitter::process(const OpenCell& cell) {
  CellState settled = CellState::Undecided;
  certificates_.clear();
  work_->at_hand.take(cell);
  if (cell.parent < 0) work_->at_hand.avoid(avoided_);
  bool repeated = repeat_cut();
  const bool found = repeated || find_cut(&settled);
  if (!found) {
    finish(cell, settled);
    return;
  }
  std::unique_ptr<OpenCell> negative = spare_cell(), positive = spare_cell();
  const auto apply = [&] {
    return partition_.apply(cell, &work_->at_hand.cut(), negative.get(), positive.get());
  };
  if (!apply()) {
    // The order of the roots on the line cannot be proved: any other line.
    repeated = false;
    if (!work_->lines.find_any() || !apply()) {
      finish(cell, CellState::Undecided);
      return;
    }
  }
  ++splits;
  negative->sketches = positive->sketches = work_->at_hand.sketches();
  if (repeated)
    std::tie(negative->earlier_cut, positive->earlier_cut) =
        task_.earlier.next_cuts(cell.earlier_cut);
  open_.push_back(std::move(positive));
  open_.push_back(std::move(negative));
}

template <class Condition>
void CellSplitter::run_while(Condition condition) {
  const double features = static_cast<double>(partition_.crossings.size() + 1);
  for (; has_open() && condition(); ++count_) {
    const auto done = static_cast<double>(cells.size()),
               left = static_cast<double>(open_.size() - 1) + features;
    if (count_ % 64 == 63) task_.progress(done / (done + left));
    // The clock is slow to read.
    if (count_ % 16 == 0 && task_.stop()) break;
    process_next();
  }
  rest();
}

void CellSplitter::run(int most_cells) {
  run_while([&] { return static_cast<int>(cells.size()) < most_cells; });
}

/// The least number of cells that the open ones become: one for each crossing and, as a crossing
/// lies on two branches, for each branch beyond.
int CellSplitter::least_to_come() const {
  std::size_t least = 0;
  for (const auto& cell : open_) {
    const std::size_t crossings = cell->crossings.size(), branches = cell->word.size() / 2;
    least +=
        std::max<std::size_t>(1, std::max(crossings, branches - std::min(branches, crossings)));
  }
  return static_cast<int>(least);
}

void CellSplitter::run_below(int bound) {
  run_while([&] { return static_cast<int>(cells.size()) + least_to_come() < bound; });
}

void CellSplitter::rest() {
  work_.reset();
  for (const auto& cell : open_) cell->sketches = -1;
}

bool CellSplitter::halve() {
  if (open_.size() == 1 && !task_.stop()) process_next();
  return open_.size() == 2;
}

std::vector<OpenCell> CellSplitter::hand_over() {
  rest();
  std::vector<OpenCell> handed_over;
  for (; has_open(); open_.pop_back()) handed_over.push_back(std::move(*open_.back()));
  return handed_over;
}

void CellSplitter::give_up() {
  certificates_.clear();
  for (; has_open(); open_.pop_back()) finish(*open_.back(), CellState::Undecided);
}

void CellSplitter::finish(const OpenCell& open, CellState state) {
  const int id = static_cast<int>(cells.size());
  if (open.parent >= 0) {
    Split& above = partition_.history[open.parent];
    (open.positive ? above.positive : above.negative) = ~id;
  }
  Cell& cell = cells.emplace_back();
  cell.state = state;
  cell.depth = open.depth;
  const int n = static_cast<int>(open.edges.size());
  const Box<2>& bounds = task_.bounds;
  const double size = std::max({std::fabs(bounds.lo[0]), std::fabs(bounds.hi[0]),
                                std::fabs(bounds.lo[1]), std::fabs(bounds.hi[1])});
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
        rounded_meet(partition_.lines[before], partition_.lines[edge.line], open.vertices[k], size);
    cell.vertices.push_back(vertex);
    for (int i = open.begin_of(k) + 1; i < edge.end; ++i)
      cell.vertices.push_back({edge.line, edge.line, 0, {}});
  }
  for (const int k : open.crossings) partition_.crossings[k].cell = id;
  if (state == CellState::Undecided && open.zones.empty()) ++unfinished;
  if (state != CellState::Certified && state != CellState::Relaxed) return;
  if (!open.crossings.empty()) cell.crossing = open.crossings.front();
  cell.branches.reserve(cell.word.size() / 2);
  for (std::size_t i = 0; i < cell.word.size(); ++i)
    for (std::size_t j = i + 1; j < cell.word.size(); ++j) {
      const int c = partition_.line_crossings[cell.word[i]].curve;
      if (partition_.line_crossings[cell.word[j]].curve == c)
        cell.branches.push_back({c, cell.word[i], cell.word[j]});
    }
  cell.loop_certificates = certificates_;
}

void CellSplitter::forget() {
  cells.clear();
  splits = loop_splits = 0;
  unfinished = 0;
}

void CellSplitter::join(const OpenCell& cell, CellSplitter* part) {
  const int first = static_cast<int>(cells.size());
  const Partition::Numbers numbers = partition_.join(cell, part->partition_, first);
  cells.reserve(cells.size() + part->cells.size());
  for (Cell& made : part->cells) {
    for (Vertex& vertex : made.vertices) {
      vertex.line_in = numbers.lines[vertex.line_in];
      vertex.line_out = numbers.lines[vertex.line_out];
    }
    for (int& c : made.word) c = numbers.line_crossings[c];
    for (Branch& branch : made.branches) {
      branch.from = numbers.line_crossings[branch.from];
      branch.to = numbers.line_crossings[branch.to];
    }
    cells.push_back(std::move(made));
  }
  // (The part has given every crossing inside one of its cells.)
  for (const int k : cell.crossings) partition_.crossings[k].cell += first;
  splits += part->splits;
  loop_splits += part->loop_splits;
  unfinished += part->unfinished;
}

}  // namespace encase
