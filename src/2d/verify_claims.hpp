// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "common/reporter.hpp"
#include "encase/verify.hpp"

/// The claims of an encasement, group by group in the order in which `verify` re-proves them.
/// Nothing here trusts the search: what is asked are read-only statements about single boxes,
/// segments and points (`box_tests.hpp`, `segments.hpp`) and exact arithmetic.
namespace encase::verification {

/// What all checks share: the result under test and its curves prepared for questions.
struct Facts {
  const Encasement& result;
  VerifyOptions options;
  std::vector<FilteredFunction<2>> curves{};
  std::vector<Box<2>> shared_leaves{};  ///< of the shared cover, as in its lists of curves
  /// For every split token of the shared cover the token at which its upper half begins; empty if
  /// there is no proper one.
  std::vector<std::size_t> upper_half{};
};

/// The facts, the precision ladder, and the report. Not shared between threads: see `for_each`.
struct Claims : Reporter {
  explicit Claims(Facts& f)
      : Reporter(f.options),
        facts(f),
        result(f.result),
        curves(f.curves),
        shared_leaves(f.shared_leaves),
        upper_half(f.upper_half) {
    kernel.max_bits = f.options.max_bits;
  }

  Facts& facts;
  const Encasement& result;
  std::vector<FilteredFunction<2>>& curves;
  std::vector<Box<2>>& shared_leaves;
  std::vector<std::size_t>& upper_half;
  Kernel kernel;
};

/// Calls check(part, i) for 0 <= i < count, on several threads, as the options say. `part` has the
/// facts of `claims`, which do not change meanwhile, and a report of its own: those are joined in
/// the order of i, up to the most objections. So the outcome does not depend on the threads.
void for_each(Claims& claims, std::size_t count,
              const std::function<void(Claims& part, std::size_t i)>& check);

/// Every index is in range, every number finite, every box ordered, every enumerator named. All
/// later checks rely on it: false ends the verification.
bool check_structure(Claims& claims);

/// The encased polynomials are square-free, pairwise coprime, and together have the zeros of those
/// of the input; the expressions are those of the input, equal ones once. Repeated and shared
/// components are reported, and no others.
void check_curves(Claims& claims);

/// The two regions are convex polygons; the region used contains the region asked for, exceeds it
/// by at most 2^-30 of its diameter, and its sides are the first lines. False: no partition makes
/// sense.
bool check_regions(Claims& claims);

/// A part of a line inside the polygon that it cuts, or a side of the region used, with the line
/// crossings on it in the order of the parameter.
struct Segment {
  int line = -1;
  double lo = 0;  ///< the far ends of its corners' enclosures, in the line's parameter
  double hi = 0;
  std::vector<int> crossings;
};

/// An edge of a polygon on its way counter-clockwise around it.
struct Edge {
  int line = -1;
  Sign interior = Sign::Negative;  ///< the side of the line on which the polygon lies
  int segment = -1;
  int first = 0;  ///< its crossings are those of the segment from `first` to before `last`
  int last = 0;
  std::array<Interval, 2> start;  ///< encloses the corner where it begins
};

using Polygon = std::vector<Edge>;

/// The splits, replayed.
struct Partition {
  std::vector<Segment> segments;
  std::vector<Polygon> cells;
  /// Every split cuts its polygon and every cell has its own leaf: the cells partition the region
  /// used. Where it is false nothing else here may be used.
  bool complete = false;
};

/// `AnyCell`: Cell or SpaceCell; those of space are never relaxed.
template <class AnyCell>
bool certified(const AnyCell& cell) {
  return cell.state == CellState::Certified || cell.state == CellState::Relaxed;
}

/// Whether the parameter increases along an edge counter-clockwise.
bool parameter_increases(const Line& line, Sign interior);

/// Replays the history: every line cuts its polygon properly, and on every segment the line
/// crossings are all zeros of all curves, simple, in proved order, with the segment's and the
/// cells' corners between them.
Partition replay_history(Claims& claims);

/// The cells' vertices and words are those of the replayed polygons.
void check_cell_boundaries(Claims& claims, const Partition& partition);

/// The cells whose closed polygon may meet the closed box: none that does is missing.
std::vector<int> cells_near(Claims& claims, const Partition& partition, const Box<2>& box);

/// The only cell whose interior contains all boxes of a connected set; -1 if there is none.
int cell_around(Claims& claims, const std::vector<Box<2>>& boxes);

/// Whether the closed box lies in the interior of the polygon.
bool strictly_inside(Claims& claims, const Polygon& polygon, const Box<2>& box);

/// Each crossing box holds exactly one common zero, no other box of its pair meets it, it lies in
/// the cell it names, and its location, its point and the rounding of its point are right.
void check_crossings(Claims& claims, const Partition& partition);

/// The shared cover, if there is one, is a subdivision of a box that contains the region used, and
/// curves have no zeros in the leaves in whose lists they are not. Finds claims.shared_leaves and
/// claims.upper_half.
void check_shared_cover(Claims& claims);

/// The curves that may have zeros on the part of a line that lies in a box and in the region used,
/// ascending: those alive in leaves of the shared cover that may meet it, or all.
std::vector<int> curves_near(Claims& claims, const Line& line, const Box<2>& box);

/// The lists of crossings and of critical regions are complete, and the latter are what they claim.
void check_crossing_covers(Claims& claims);
void check_critical_regions(Claims& claims);
void check_critical_covers(Claims& claims);

/// The certified cells satisfy the definition, every critical region inside one has its loop
/// certificate, and no unresolved box meets one.
void check_cells(Claims& claims, const Partition& partition);

/// The outcome is what the lists and the cells make it. `E`: Encasement or SurfaceEncasement.
template <class E>
void check_outcome(Reporter& reporter, const E& e) {
  bool settled = true, undecided = !e.undecided.empty();
  for (const auto& cell : e.cells) {
    settled = settled && certified(cell);
    undecided = undecided || cell.state == CellState::Undecided;
  }
  const Outcome outcome = undecided                         ? Outcome::Undecided
                          : settled && e.degenerate.empty() ? Outcome::Certified
                                                            : Outcome::Degenerate;
  reporter.require(e.outcome == outcome, "The outcome should be ",
                   outcome == Outcome::Certified   ? "certified"
                   : outcome == Outcome::Undecided ? "undecided"
                                                   : "degenerate",
                   ", as the cells and the unresolved entries are.");
}

/// The parts of a certified result fit together to an arrangement, of which Euler's relation and
/// the other rules of `check` hold.
void check_arrangement(Claims& claims);

}  // namespace encase::verification
