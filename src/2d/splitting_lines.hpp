// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "2d/cell_at_hand.hpp"

namespace encase {

/// Proposes lines for a cell; what they do is proved by `CellAtHand`, which keeps the best. Each
/// member tells whether there is a cut.
class SplittingLines {
 public:
  /// `fast`: content with the first line that is not bad instead of looking for the best.
  SplittingLines(CellAtHand& cell, bool fast);

  /// The line to split the cell by, chosen by how simple it leaves the parts (docs/encasement.md).
  bool find_best();
  /// The best line through a point.
  bool find_through(const Point<2>& point);
  /// The best line along a side of the box.
  bool find_along(const Box<2>& box);
  /// A line that cuts the cell, after the others have failed.
  bool find_any();

 private:
  using BoundaryPoint = CellAtHand::BoundaryPoint;
  struct Pair {
    int a, b;
    double gap;  ///< squared
  };
  /// Between neighbours among projections on a direction.
  struct Gap {
    Point<2> direction;
    double width, middle;
  };
  bool of_many() const { return cell_.curves().size() > 2; }
  void keep_closest(std::size_t count);
  bool seems_to_save(double cells) const;
  bool is_good_enough();
  Gap widest_gap(const Point<2>& direction);
  void propose_between_crossings();
  void propose_through_saddles(int curve);
  void propose_between_branches();
  void propose_between_curves();
  void separate(const std::array<int, 4>& ends);
  void propose_between_two_branches();
  void approach();
  void project(double reach);
  void propose_closest_approach();
  void propose_fans();
  Pair longest_chord();
  bool find_bisector();
  void propose_refinement();

  CellAtHand& cell_;
  Partition& partition_;
  const bool fast_;
  std::vector<Pair> pairs_;
  std::array<BoundaryPoint, 16> approached_;  // the first points of the pairs, then the second
  std::vector<Point<2>> projected_;
  std::vector<double> projections_;
};

Line line_through(const Point<2>& point, const Point<2>& normal);

}  // namespace encase
