// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "2d/cell_splitter.hpp"
#include "2d/encaser.hpp"
#include "common/segments.hpp"

namespace encase {

namespace {

// A part is worth so many crossings; and there are enough of them for the threads of most machines.
constexpr int kCrossingsOfAPart = 64, kMostParts = 32;

}  // namespace

/// A part of the region, split by itself.
struct Encaser::Part {
  Part(Encaser& run, const OpenCell& cell, const SplittingTask& task)
      : kernel(run.kernel_.fresh()),
        partition(run.polynomials_, *run.tiles_, run.features_, kernel),
        splitter(partition, task) {
    splitter.add(partition.begin(*run.partition_, cell));
  }
  Kernel kernel;
  Partition partition;
  CellSplitter splitter;
};

void Encaser::split_cells() {
  partition_->fill(&first_cell_);
  const auto tell = [this](double done) { progress("splitting cells", done); };
  const SplittingTask task{options_, bounds_, result_.undecided, [this] { return out_of_budget(); },
                           tell};
  CellSplitter splitter(*partition_, task);
  splitter.cells.reserve(2 * features_.crossings.size() + 16);
  splitter.add(std::move(first_cell_));
  const int parts =
      std::min(static_cast<int>(features_.crossings.size()) / kCrossingsOfAPart, kMostParts);
  if (polynomials_.size() > 2 && parts > 1) split_in_parts(&splitter, task, parts);
  run_out(&splitter, options_.max_cells);
  take_cells(&splitter);
}

/// Splits what is open until the cells are at most so many. What is open then stays undecided.
void Encaser::run_out(CellSplitter* splitter, int most_cells) {
  splitter->run(most_cells);
  if (!splitter->has_open()) return;
  use_up_budget("the limit of " + std::to_string(options_.max_cells) + " cells was reached");
  splitter->give_up();
}

/// Cuts the region into parts and splits these. What the parts are does not depend on the threads.
void Encaser::split_in_parts(CellSplitter* splitter, const SplittingTask& task, int parts) {
  splitter->divide(parts);
  if (splitter->open_cells() < 2) return;
  const std::vector<OpenCell> cells = splitter->hand_over();
  Tasks tasks{"splitting cells", static_cast<int>(cells.size())};
  SplittingTask of_part = task;
  of_part.progress = [&](double) { progress(tasks.stage, tasks.part_done()); };
  // Each may make as many cells as the others; what is left then goes to those that need more, one
  // after the other.
  int left = options_.max_cells - static_cast<int>(splitter->cells.size());
  const int share = std::max(left, 0) / tasks.count;
  std::vector<std::unique_ptr<Part>> made(cells.size());
  run(tasks, [&](int k) {
    made[k] = std::make_unique<Part>(*this, cells[k], of_part);
    made[k]->splitter.run(share);
  });
  for (const auto& part : made) left -= static_cast<int>(part->splitter.cells.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    CellSplitter& part = made[k]->splitter;
    const int had = static_cast<int>(part.cells.size());
    run_out(&part, had + std::max(left, 0));
    left -= static_cast<int>(part.cells.size()) - had;
    splitter->join(cells[k], &part);
    kernel_.add(made[k]->kernel);
    made[k].reset();
  }
}

void Encaser::take_cells(CellSplitter* splitter) {
  result_.cells = std::move(splitter->cells);
  result_.statistics.splits = splitter->splits;
  result_.statistics.loop_splits = splitter->loop_splits;
  unfinished_ = splitter->unfinished;
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
