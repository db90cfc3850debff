// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "2d/earlier_encasement.hpp"
#include "2d/partition.hpp"
#include "2d/splitting_lines.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// What splitting is told, by all that split parts of one region.
struct SplittingTask {
  const EncaseOptions& options;
  const EarlierEncasement& earlier;          ///< whose cuts are repeated
  Box<2> bounds;                             ///< of the region used
  const std::vector<Unresolved>& undecided;  ///< with a box: its zone is due to a budget
  std::function<bool()> stop;                ///< asked now and then; true ends the splitting
  std::function<void(double done)> progress;
};

/// Splits open cells of a partition until every one is simple (thesis 3.1 to 3.5).
class CellSplitter {
 public:
  CellSplitter(Partition& partition, const SplittingTask& task);

  void add(OpenCell cell) { open_.push_back(std::make_unique<OpenCell>(std::move(cell))); }
  bool has_open() const { return !open_.empty(); }
  /// The first cell is not to be split by any of these lines.
  void avoid_at_first(std::vector<Line> lines) { avoided_ = std::move(lines); }
  /// Depth first, until no cell is open, `most_cells` are finished, or it is stopped.
  void run(int most_cells);
  /// Likewise, but also until it is known that there will be so many cells.
  void run_below(int cells);
  /// Cuts the only open cell in two; false if it is simple, or splitting is stopped.
  bool halve();
  /// The open cells, the next one first. They are left to others; see `join`.
  std::vector<OpenCell> hand_over();
  /// The open cells become undecided ones.
  void give_up();

  /// The cells that are finished, but for the cuts between crossings of one edge: their places come
  /// last.
  std::vector<Cell> cells;
  std::int64_t splits = 0;
  std::int64_t loop_splits = 0;
  int unfinished = 0;  ///< cells that no place that resists excuses

  /// Forgets what it has made.
  void forget();
  /// Takes over what another splitter has made of a cell that was handed over; its partition was
  /// begun with that cell.
  void join(const OpenCell& cell, CellSplitter* part);

 private:
  enum class Shape { Simple, Relaxable, Complex };
  Shape shape_of_cell() const;
  void process_next();
  void process(const OpenCell& cell);
  std::unique_ptr<OpenCell> spare_cell();
  template <class Condition>
  void run_while(Condition condition);
  int least_to_come() const;
  void rest();
  bool repeat_cut();
  bool find_cut(CellState* settled);
  bool find_cut_at_zone(const OpenCell& cell, CellState* settled);
  void finish(const OpenCell& open, CellState state);

  /// What splitting works with. It grows with the curves, so it is given back when splitting ends.
  struct Work {
    Work(Partition& partition, bool fast) : at_hand(partition), lines(at_hand, fast) {}
    CellAtHand at_hand;
    SplittingLines lines;
  };

  Partition& partition_;
  const SplittingTask& task_;
  std::unique_ptr<Work> work_;
  std::vector<std::unique_ptr<OpenCell>> open_;   // the next one last
  std::vector<std::unique_ptr<OpenCell>> spare_;  // done with: their arrays serve others
  std::vector<LoopCertificate> certificates_;     // of the cell at hand
  std::vector<Line> avoided_;                     // by the first cell
  std::int64_t count_ = 0;                        // of cells taken up
};

}  // namespace encase
