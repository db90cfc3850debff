// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "2d/partition.hpp"
#include "2d/splitting_lines.hpp"
#include "common/run_clock.hpp"
#include "common/subdivision.hpp"
#include "common/tile.hpp"
#include "encase/encasement.hpp"

namespace encase {

/// One run of `encase`; the members are called in the order of their numbers.
class Encaser {
 public:
  Encaser(const std::vector<NamedCurve>& input, const Region& region, const EncaseOptions& options);

  Status check_input() const;    // 1. sanity
  void separate_components();    // 1. shared and repeated components
  bool open_region();            // 2. a generic polygon
  void isolate_crossings();      // 2. crossings first
  void find_critical_regions();  // 3. critical regions
  void give_up_on_region();      //    or one undecided cell
  void collect_zones();          //    what resists, kept apart
  void split_cells();            // 4. split until every cell is simple; loops last
  void finish_cells();           // 5. the cells and their certificates
  void decide_outcome();
  Encasement take_result() { return std::move(result_); }

 private:
  enum class Shape { Simple, Relaxable, Complex };
  static Shape shape_of(const CellAtHand& at_hand);
  bool find_cut(CellAtHand& at_hand, SplittingLines& lines, CellState* settled);
  bool find_cut_at_zone(const OpenCell& cell, SplittingLines& lines, CellState* settled);
  bool out_of_budget();
  /// Tells the caller's progress callback; a refusal uses the budget up.
  void progress(const char* stage, double done);
  bool open_polygon();
  bool open_plane();
  SubdivisionLimits limits(const char* stage, Unresolved::Kind kind, const Box<2>& root);
  std::function<bool()> stop(const char* stage);
  void isolate_pair(const std::array<int, 2>& curves, const Box<2>& root,
                    const std::vector<Box<2>>* leaves);
  void use_region(const Region& region);
  std::vector<Box<2>> clusters_of(const std::vector<Box<2>>& unresolved) const;
  void report(const std::vector<Box<2>>& unresolved, const Box<2>& root, Unresolved::Kind kind,
              double smallest, std::vector<int> curves);
  void count_pairs();
  void report_concurrency();
  void finish(const OpenCell& open, CellState state);
  template <class Action>
  void for_each_cut(Cell* cell, Action action);

  const EncaseOptions& options_;
  RunClock clock_;
  Kernel kernel_;
  Encasement result_;
  std::vector<FilteredPolynomial<2>> polynomials_;
  std::vector<TiledPolynomial> tiled_;  // the same, over the box of region_used
  std::vector<Line> sides_;             // of region_used
  Box<2> bounds_;                       // of region_used
  std::vector<Box<2>> curve_roots_;     // of the curves' critical covers; negative widths: none
  std::unique_ptr<Partition> partition_;
  OpenCell first_cell_;
  int unfinished_ = 0;                         // cells that no place that resists excuses
  std::vector<LoopCertificate> certificates_;  // of the cell at hand
  std::string budget_;                         // the sentence that tells which ran out
};

}  // namespace encase
