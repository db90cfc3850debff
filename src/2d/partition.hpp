// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "common/filtered_polynomial.hpp"
#include "common/interval.hpp"
#include "common/segments.hpp"
#include "encase/encasement.hpp"

/// The growing binary space partition: cells, and how a line cuts one in two.
namespace encase {

/// A cell while it is being worked on. Counter-clockwise: edge k runs on its line from vertex k to
/// vertex k + 1.
struct OpenCell {
  struct Edge {
    int line = -1;
    bool positive = false;       ///< the cell is on the line's positive side
    std::vector<int> crossings;  ///< line crossings on the edge, counter-clockwise
  };
  std::vector<Edge> edges;
  std::vector<std::array<Interval, 2>> vertices;  ///< enclosures
  std::vector<int> crossings;                     ///< crossings of two curves inside
  std::vector<int> critical_regions;              ///< those that lie wholly inside
  std::vector<int> zones;                         ///< unresolved zones that it meets
  int depth = 0;
  int parent = -1;        ///< node of the history that made it, -1 for the region used
  bool positive = false;  ///< on the positive side of that node's line
  double least_estimate = 1e300;
  int stall = 0;  ///< levels since the estimate has last fallen
};

/// A box that resists, grown by what the search keeps clear around it.
struct Zone {
  Box<2> box;
  Box<2> clearance;  ///< the cell that holds the zone is cut down to about this box
};

/// What a line would do to a cell.
struct Cut {
  Line line;
  int out = -1;        ///< the edge on which the boundary leaves the negative side
  int in = -1;         ///< the edge on which it comes back
  int before_out = 0;  ///< crossings on edge `out` before the cut
  int before_in = 0;   ///< crossings on edge `in` before the cut
  std::array<Interval, 2> vertex_out, vertex_in;
  struct Root {
    int curve;
    RootInterval interval;
  };
  std::vector<Root> roots;  ///< of every curve alive on the chord
  /// For each side (0 negative, 1 positive), boundary crossings of every curve.
  std::array<std::vector<int>, 2> counts;
  std::array<std::vector<int>, 2> crossings;  ///< crossings of two curves on each side
  double score = 0;
};

class Partition {
 public:
  Partition(const std::vector<FilteredPolynomial<2>>& curves, Kernel& kernel);

  std::vector<Line> lines;
  std::vector<LineCrossing> line_crossings;
  std::vector<Crossing> crossings;
  std::vector<CriticalRegion> critical_regions;
  std::vector<Zone> zones;
  std::vector<Split> history;
  std::int64_t lines_tried = 0;

  const std::vector<FilteredPolynomial<2>>& curves() const { return curves_; }
  /// The partial derivatives of a curve's polynomial (each scaled on its own), for heuristics.
  const std::array<FilteredPolynomial<2>, 2>& partials(int curve) const { return partials_[curve]; }
  Kernel& kernel() { return kernel_; }

  /// The polygon with the given sides (its inside negative) as the first cell, its sides crossed by
  /// the curves: nothing if a crossing is not simple, at a corner, or not told from another one.
  std::optional<OpenCell> open(const std::vector<Line>& sides);

  /// What `line` would do to the cell; nothing if it misses the cell, meets a vertex, a crossing
  /// box or a zone, or if the roots on it are not proved. `enough`: the score above which it is of
  /// no interest. Refines crossings on the cell's edges where it must.
  std::optional<Cut> try_line(const OpenCell& cell, const Line& line, double enough);

  /// Makes the cut and records it; false (and no change) if the order of the roots on the line
  /// cannot be proved.
  bool apply(const OpenCell& cell, Cut cut, OpenCell* negative, OpenCell* positive);

  /// The curves that may meet the cell: those that cross its boundary or have a critical region in
  /// it.
  std::vector<int> alive(const OpenCell& cell) const;
  /// Boundary crossings of every curve.
  std::vector<int> crossing_counts(const OpenCell& cell) const;
  /// The cyclic order of the line crossings, from vertex 0.
  std::vector<int> word(const OpenCell& cell) const;
  /// About where a line crossing is, and the curve's unit gradient there; heuristics use them.
  struct Spot {
    Point<2> at;
    Point<2> normal;
  };
  const Spot& spot(int line_crossing);

  /// A measure of the cells still to come: branches that no crossing ties together, at least 1.
  double estimate(const std::vector<int>& counts, const std::vector<int>& crossings) const;

  /// Whether a critical region lies in the interior of the polygon that was opened.
  bool inside(const CriticalRegion& region);

 private:
  bool order_on_line(const Line& line, std::vector<Cut::Root>* roots);
  std::optional<int> crossings_before(const OpenCell& cell, int edge, const Interval& parameter);

  const std::vector<FilteredPolynomial<2>>& curves_;
  std::vector<std::array<FilteredPolynomial<2>, 2>> partials_;
  Kernel& kernel_;
  int side_count_ = 0;
  std::vector<Spot> spots_;  ///< of the first line crossings
};

/// Whether a line's parameter grows along an edge on it that runs counter-clockwise around a cell
/// on the line's negative or positive side. Exact: the signs of the doubles are those of the
/// coefficients.
bool parameter_grows(const Line& line, bool positive);

/// The midpoint of an enclosure.
inline Point<2> middle(const std::array<Interval, 2>& at) { return {at[0].mid(), at[1].mid()}; }

}  // namespace encase
