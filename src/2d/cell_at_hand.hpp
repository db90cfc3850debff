// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "2d/partition.hpp"
#include "common/sketch.hpp"

namespace encase {

/// The branches of some curves in a part of a cell.
struct Branches {
  int curves = 0;    ///< with branches
  int count = 0;     ///< of branches
  double cells = 0;  ///< what they add to the cells to be expected
};

/// The open cell that is being worked on, with what trying lines on it needs again and again, the
/// lines proposed for it and the cut that was proved. One object serves all cells in turn: once its
/// arrays have grown, neither a cell nor a line costs an allocation.
class CellAtHand {
 public:
  explicit CellAtHand(Partition& partition);
  CellAtHand(const CellAtHand&) = delete;
  CellAtHand& operator=(const CellAtHand&) = delete;

  /// Turns to another cell, which must outlive this use.
  void take(const OpenCell& cell);
  /// Does not split that cell by any of these lines, which must outlive this use too.
  void avoid(const std::vector<Line>& lines) { avoided_ = &lines; }

  Partition& partition() { return partition_; }
  const OpenCell& cell() const { return *cell_; }

  /// A curve that may meet the cell: it crosses the boundary, has a critical region in the cell, or
  /// there is a zone.
  struct Presence {
    int curve = -1;
    int ends = 0;       ///< crossings with the boundary
    int crossings = 0;  ///< crossings with other curves inside
  };
  const std::vector<Presence>& curves() const { return curves_; }

  /// The curve that crosses the boundary at a place of the cell's word.
  int curve_at(int place) const { return partition_.line_crossings[cell_->word[place]].curve; }

  /// A crossing of a curve with the cell's boundary.
  struct BoundaryPoint {
    int curve;
    int index;  ///< among its curve's points, in cyclic order
    Point<2> at;
    Point<2> normal;  ///< unit gradient
  };
  const std::vector<BoundaryPoint>& points() {
    if (points_.empty()) find_points();
    return points_;
  }

  /// The values and gradients of points' curves, about.
  void values_and_gradients(const std::array<BoundaryPoint, 16>& points,
                            std::array<ValueAndGradient, 16>* result);
  /// The smallest box around the cell, about.
  const Box<2>& bounds() {
    prepare();
    return bounds_;
  }
  /// Where the sketches of the cell are, for its parts.
  int sketches() const { return last_sketches_; }

  /// The cells to be expected of the whole cell.
  double expected_cells() {
    prepare();
    return expected_cells_;
  }

  /// Notes a line that seems to cut the cell. How many roots the curves have on it is only guessed,
  /// from some values of their polynomials.
  void propose(const Line& line);
  /// The score that the best line seems to have.
  double best_score() const { return best_score_; }
  /// Whether the best line seems to leave two parts that need no further cut but for loops.
  bool seems_finished() const { return seems_finished_; }

  /// Proves what the proposed lines do, the most promising first, until none of the others can be
  /// better; forgets them and keeps the best cut. A line is dropped if it misses the cell, meets a
  /// vertex, a crossing box or a zone, or if the roots on it are not proved. False if there is no
  /// cut.
  bool prove_best();
  /// Proves what one line does, in place of all that are proposed.
  bool prove_only(const Line& line) {
    prepare();
    start_again();
    prove(line);
    return has_cut_;
  }
  bool has_cut() const { return has_cut_; }
  Cut& cut() { return *best_; }
  /// Forgets the lines proposed and the best cut.
  void start_again();

 private:
  /// What a line leaves of a curve, or of all, on its negative and its positive side.
  struct Shares {
    std::array<int, 2> ends{}, crossings{};
  };
  /// Sketches of the curves over a box, made when they are first asked for.
  struct Sketches {
    enum class State : char { Missing, Serves, Useless };
    Box<2> box;
    std::vector<int> curves;       ///< ascending
    std::vector<State> states;     ///< of their sketches
    std::vector<Sketch> sketches;  ///< at least as many
    bool serve = true;             ///< all that have been asked for
  };
  struct InnerCrossing {
    const Place* place;
    std::array<int, 2> slots;  // of its curves
  };
  struct Proposal {
    Line line;
    double score;  ///< at least so much, if the values used do not deceive
    bool sampled;  ///< the roots on the line are in the score
  };
  bool is_simple(int part) const;
  bool leaves_simple_parts() const { return is_simple(0) && is_simple(1); }
  static double expected_cells(int crossings, const Branches& branches);
  int least_cells(int part) const;
  void find_curves();
  void find_points();
  void find_crossings();
  void prepare();
  void mark();
  double score() const;
  void count_branches();
  void add_roots(std::size_t slot, int roots);
  bool guess_chord(const double* heights, std::array<Point<2>, 2>* ends) const;
  double divide_marks(const Line& line);
  void guess_division(const int* positive);
  void provide_sketches();
  const Sketch* sketch(int slot);
  int guess_roots_of(int slot, const std::array<Point<2>, 2>& ends);
  double guess_roots(const std::array<Point<2>, 2>& ends, double limit);
  bool weigh(double limit, Proposal* proposal);
  void set_slivers(const Line& line, double clearance);
  bool is_beaten(double score) const;
  void prove(const Line& line);
  bool cross_boundary(const Line& line, double* clearance);
  bool divide_crossings(const Line& line, double* clearance);
  bool count_old_crossings(const Line& line);
  bool add_new_crossings(const Line& line);
  bool cuts_well(const Line& line);

  Partition& partition_;
  const OpenCell* cell_ = nullptr;
  const std::vector<Line>* avoided_ = nullptr;
  std::vector<Presence> curves_;
  std::vector<int> slot_;  // of every curve, among those present; -1 for others
  std::vector<InnerCrossing> crossings_;
  // What the line that is tried leaves in either part.
  std::vector<Shares> shares_;  // of the curve of each slot
  std::array<int, 2> crossings_in_{};
  std::array<Branches, 2> branches_;  // of all curves
  // The vertices, the crossings and the points on the boundary; groups: all crossings, and of each
  // slot the crossings and the points. Of many curves these groups would be large and sparse: then
  // there is only the first, and what is on the positive side is counted mark by mark.
  PointGroups marks_;
  bool has_all_groups_ = true;
  int first_crossing_mark_ = 0;
  int near_marks_ = 0;  // vertices and crossings
  std::vector<double> heights_;
  std::vector<int> positive_;       // marks of each group
  std::vector<Sketches> sketches_;  // of the cell and those of its ancestors that are in use
  int last_sketches_ = 0;           // those in use
  std::vector<int> sketch_of_slot_;
  Box<2> bounds_;
  double extent_ = 0;
  double expected_cells_ = 0;
  bool is_prepared_ = false;
  double slivers_ = 0;  // the penalty of the line that is tried
  std::vector<BoundaryPoint> points_;
  std::vector<char> sides_;  // of the vertices
  std::vector<Proposal> proposals_;
  double best_score_ = HUGE_VAL;
  bool seems_finished_ = false;
  std::array<Cut, 2> cuts_;
  Cut *trial_ = &cuts_[0], *best_ = &cuts_[1];
  bool has_cut_ = false, is_finished_ = false;
};

}  // namespace encase
