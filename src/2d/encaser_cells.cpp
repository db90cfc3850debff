// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "2d/cell_splitter.hpp"
#include "2d/encaser.hpp"
#include "2d/least_cells.hpp"
#include "common/segments.hpp"

namespace encase {
namespace {

// A part is worth so much work, and there are enough of them for the threads of most machines.
constexpr std::size_t kLeastPart = 512;
constexpr int kMostHalvings = 12;

// Cells are too many, and worth second thoughts, if they are more than this many times the least,
// but not far more: then curves run close beside each other, as a rule, and no few cells do.
constexpr int kTooMany = 2, kFarTooMany = 4;
// There are second thoughts on so many cells or fewer. (In larger regions too many cells in one
// place are made up for by others.)
constexpr int kMostReconsidered = 64;
constexpr int kMostTried = 200;  // cells of all second thoughts

/// About in proportion to the work that a cell takes.
std::size_t size_of(const OpenCell& cell) {
  return cell.crossings.size() + cell.critical_regions.size() + cell.word.size() / 2;
}

bool all_are_certified(const std::vector<Cell>& cells) {
  return std::all_of(cells.begin(), cells.end(),
                     [](const Cell& cell) { return cell.state == CellState::Certified; });
}

}  // namespace

/// A part of the region, split by itself; or cut in two, which are split by themselves.
struct Encaser::Part {
  Part(Encaser& run, const Partition& whole, const OpenCell& part, const SplittingTask& task,
       int cells_allowed)
      : cell(part),
        most_cells(cells_allowed),
        kernel(run.kernel_.fresh()),
        partition(run.polynomials_, *run.tiles_, run.features_, kernel),
        splitter(partition, task) {
    splitter.add(partition.begin(whole, cell));
  }
  const OpenCell& cell;  // of the partition that this is a part of
  const int most_cells;
  Kernel kernel;
  Partition partition;
  CellSplitter splitter;
  std::vector<OpenCell> halves;
  std::vector<std::unique_ptr<Part>> parts;  // of the halves
};

void Encaser::split_cells() {
  partition_->fill(&first_cell_);
  first_cell_.earlier_cut = earlier_.first_cut();
  const auto tell = [this](double done) { progress("splitting cells", done); };
  const SplittingTask task{
      options_, earlier_, bounds_, result_.undecided, [this] { return out_of_budget(); }, tell};
  CellSplitter splitter(*partition_, task);
  if (polynomials_.size() > 2)
    split_in_parts(task, &splitter);
  else
    split_whole(task, &splitter);
  take_cells(&splitter);
}

/// The region in one, and again if that makes too many cells.
void Encaser::split_whole(const SplittingTask& task, CellSplitter* result) {
  OpenCell whole(partition_->memory());
  if (!options_.fast) whole = first_cell_;
  const std::size_t expected = 2 * features_.crossings.size() + 16;
  result->cells.reserve(expected);
  partition_->reserve(expected);
  result->add(std::move(first_cell_));
  run_out(result, options_.max_cells);
  const int enough = enough_cells(result->cells);
  if (static_cast<int>(result->cells.size()) > enough) think_again(task, whole, enough, result);
}

/// With how many cells a partition is good enough, not to be tried again: with those it has, unless
/// they are too many.
int Encaser::enough_cells(const std::vector<Cell>& cells) const {
  const int made = static_cast<int>(cells.size());
  const auto crossings = std::count_if(cells.begin(), cells.end(),
                                       [](const Cell& cell) { return cell.crossing >= 0; });
  if (options_.fast || earlier_.first_cut() >= 0 || made > kMostReconsidered ||
      made <= kTooMany * crossings || !all_are_certified(cells))
    return made;
  const int least = least_cells(cells, partition_->line_crossings, static_cast<int>(sides_.size()));
  return made > kFarTooMany * least ? made : kTooMany * least;
}

/// Splits the region again, each time by another line at first, until the cells are few enough or
/// it has been tried long enough; keeps the fewest. A try ends as soon as it cannot be better.
void Encaser::think_again(const SplittingTask& task, const OpenCell& whole, int enough,
                          CellSplitter* result) {
  SplittingTask of_try = task;
  of_try.progress = [&](double) { task.progress(1); };
  std::vector<Line> first_lines{partition_->lines[whole.edges.size()]};
  std::unique_ptr<Part> best;
  int fewest = static_cast<int>(result->cells.size());
  std::int64_t tried = 0;
  while (fewest > enough && tried + fewest <= kMostTried && !out_of_budget()) {
    auto part = std::make_unique<Part>(*this, *partition_, whole, of_try, options_.max_cells);
    part->splitter.avoid_at_first(first_lines);
    part->splitter.run_below(fewest);
    kernel_.add(part->kernel);
    if (part->partition.history.empty()) break;
    tried += part->splitter.splits + 1;
    first_lines.push_back(part->partition.lines[whole.edges.size()]);
    partition_->lines_tried += std::exchange(part->partition.lines_tried, 0);
    if (part->splitter.has_open() || !all_are_certified(part->splitter.cells)) continue;
    fewest = static_cast<int>(part->splitter.cells.size());
    best = std::move(part);
  }
  if (best) {
    partition_->forget_cuts(whole);
    result->forget();
    result->join(whole, &best->splitter);
  }
  // (Every try has given the crossings cells.)
  for (std::size_t k = 0; k < result->cells.size(); ++k)
    if (const int crossing = result->cells[k].crossing; crossing >= 0)
      features_.crossings[crossing].cell = static_cast<int>(k);
}

/// Splits what is open until the cells are at most so many. What is open then stays undecided.
void Encaser::run_out(CellSplitter* splitter, int most_cells) {
  splitter->run(most_cells);
  if (!splitter->has_open()) return;
  use_up_budget("the limit of " + std::to_string(options_.max_cells) + " cells was reached");
  splitter->give_up();
}

/// Halves the region, its halves and so on while they are large, and splits what is not; the parts
/// of one size at the same time. What the parts are does not depend on the number of threads.
void Encaser::split_in_parts(const SplittingTask& task, CellSplitter* result) {
  std::atomic<std::size_t> split = 0;  // crossings in the parts that are
  SplittingTask of_part = task;
  of_part.progress = [&](double) {
    task.progress(static_cast<double>(split) / static_cast<double>(features_.crossings.size() + 1));
  };
  Part all(*this, *partition_, first_cell_, of_part, options_.max_cells);
  std::vector<Part*> level{&all};
  for (int halvings = 0; !level.empty(); ++halvings) {
    Tasks tasks{"splitting cells", static_cast<int>(level.size())};
    run(tasks, [&](int k) {
      Part& part = *level[k];
      if (halvings < kMostHalvings && size_of(part.cell) >= 2 * kLeastPart &&
          part.splitter.halve()) {
        part.halves = part.splitter.hand_over();
      } else {
        part.splitter.run(part.most_cells);
        split += part.cell.crossings.size();
      }
    });
    std::vector<Part*> next;
    for (Part* part : level) {
      // Each half may have cells in proportion to its size.
      double size = 0;
      for (const OpenCell& half : part->halves) size += static_cast<double>(size_of(half) + 1);
      const int left =
          std::max(0, part->most_cells - static_cast<int>(part->splitter.cells.size()));
      for (const OpenCell& half : part->halves) {
        const double share = static_cast<double>(size_of(half) + 1) / size;
        part->parts.push_back(std::make_unique<Part>(*this, part->partition, half, of_part,
                                                     static_cast<int>(share * left)));
        next.push_back(part->parts.back().get());
      }
    }
    level = std::move(next);
  }
  int left = options_.max_cells - cells_in(all);
  gather(&all, &left);
  result->join(all.cell, &all.splitter);
  kernel_.add(all.kernel);
}

int Encaser::cells_in(const Part& part) {
  int count = static_cast<int>(part.splitter.cells.size());
  for (const auto& inner : part.parts) count += cells_in(*inner);
  return count;
}

/// Joins the parts of a part. Those that need more cells than they were allowed get what the others
/// have left, one after the other.
void Encaser::gather(Part* part, int* left) {
  if (part->parts.empty()) {
    const int had = static_cast<int>(part->splitter.cells.size());
    run_out(&part->splitter, had + std::max(*left, 0));
    *left -= static_cast<int>(part->splitter.cells.size()) - had;
  }
  for (auto& inner : part->parts) {
    gather(inner.get(), left);
    part->splitter.join(inner->cell, &inner->splitter);
    part->kernel.add(inner->kernel);
    inner.reset();
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
