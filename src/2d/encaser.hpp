// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "2d/cell_splitter.hpp"
#include "2d/earlier_encasement.hpp"
#include "2d/partition.hpp"
#include "2d/shared_leaves.hpp"
#include "common/isolate_roots.hpp"
#include "common/run_clock.hpp"
#include "common/subdivision.hpp"
#include "common/tile.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// One run of `encase` or `add_curves`; the members are called in the order of their numbers.
class Encaser {
 public:
  Encaser(const std::vector<NamedCurve>& input, const Region& region, const EncaseOptions& options);
  /// `earlier` must outlive this.
  Encaser(const Encasement& earlier, const std::vector<NamedCurve>& more,
          const EncaseOptions& options);

  Status check_input() const;  // 1. sanity
  void separate_components();  // 1. shared and repeated components
  /// In place of these two: the input, prepared. What its curves have in common is not looked for,
  /// and is a place that resists.
  void take_curves(const std::vector<const FilteredFunction<2>*>& prepared);
  bool open_region();            // 2. a generic polygon
  bool open_region_as_asked();   //    or only the polygon asked, if it is generic
  void isolate_crossings();      // 2. crossings first
  void find_critical_regions();  // 3. critical regions
  void give_up_on_region();      //    or one undecided cell
  void collect_zones();          //    what resists, kept apart
  void split_cells();            // 4. split until every cell is simple; loops last
  void finish_cells();           // 5. the cells and their certificates
  void decide_outcome();
  Encasement take_result() { return std::move(result_); }

 private:
  // These three may be called by several threads.
  bool out_of_budget();
  /// Tells the caller's progress callback; a refusal uses the budget up.
  void progress(const char* stage, double done);
  void use_up_budget(const std::string& reason);
  /// A step's tasks, which several threads do. They are the same, and have the same results, for
  /// any number of threads.
  struct Tasks {
    const char* stage;
    int count;
    std::atomic<int> done = 0;
    double part_done() const { return static_cast<double>(done) / count; }
  };
  void run(Tasks& tasks, const std::function<void(int index)>& task);
  bool open_polygon();
  bool open_plane();
  SubdivisionLimits limits(Tasks& tasks, Unresolved::Kind kind, const Box<2>& root);
  std::function<bool()> stop(const char* stage);
  /// A pair of curves, and where its common zeros are: in a box, and if leaves are given, in those
  /// in which it meets.
  struct Pair {
    std::array<int, 2> curves;
    Box<2> root;
    const SharedLeaves* leaves = nullptr;
    MeetingPair meeting;
  };
  RootIsolation<2> isolate_pair(const Pair& pair, SubdivisionLimits* limits, Kernel* kernel);
  void isolate_pairs(const std::vector<Pair>& pairs);
  void use_region(const Region& region);
  std::vector<Box<2>> clusters_of(const std::vector<Box<2>>& unresolved) const;
  struct Leftover {
    std::vector<Box<2>> unresolved;
    const Box<2>& root;
    double smallest;  ///< part of the root's width beyond which boxes are not halved
    bool stopped;     ///< the budget had run out
  };
  void report(Leftover left, Unresolved::Kind kind, std::vector<int> curves);
  void report_gaps();
  void count_pairs();
  void report_concurrency();
  struct Part;
  void split_whole(const SplittingTask& task, CellSplitter* result);
  int enough_cells(const std::vector<Cell>& cells) const;
  void think_again(const SplittingTask& task, const OpenCell& whole, int enough,
                   CellSplitter* result);
  void split_in_parts(const SplittingTask& task, CellSplitter* result);
  static int cells_in(const Part& part);
  void gather(Part* part, int* left);
  void run_out(CellSplitter* splitter, int most_cells);
  void take_cells(CellSplitter* splitter);
  template <class Action>
  void for_each_cut(Cell* cell, Action action);

  const EncaseOptions& options_;
  EarlierEncasement earlier_;
  std::size_t perturbed_ = 0;  // input curves that are perturbed already
  const int threads_;
  RunClock clock_;
  Kernel kernel_;
  Encasement result_;
  std::vector<FilteredFunction<2>> polynomials_;
  std::vector<Kernel> tile_kernels_;    // one a curve, so that all threads can have tiles made
  std::vector<TiledFunction> tiled_;    // the same, over the box of region_used
  std::vector<Line> sides_;             // of region_used
  Box<2> bounds_;                       // of region_used
  std::vector<Box<2>> curve_roots_;     // of the curves' critical covers; negative widths: none
  std::unique_ptr<NestedTiles> tiles_;  // with inner ones
  Features features_;
  std::unique_ptr<Partition> partition_;
  OpenCell first_cell_;
  int unfinished_ = 0;  // cells that no place that resists excuses
  std::mutex progress_mutex_, budget_mutex_;
  std::atomic<bool> is_used_up_ = false;
  std::string budget_;  // the sentence that tells which ran out; empty unless is_used_up_
};

}  // namespace encase
