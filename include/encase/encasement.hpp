// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "encase/cover.hpp"
#include "encase/function.hpp"
#include "encase/geometry.hpp"
#include "encase/polynomial.hpp"
#include "encase/region.hpp"
#include "encase/result.hpp"

/// The encasement of plane curves in a convex region: a partition of the region by splitting lines
/// into convex cells, such that
///   - at most two curves meet a cell, each in one branch that enters and leaves through the
///   boundary;
///   - two curves in one cell cross exactly once there, transversally, in the interior (in a
///     *relaxed* cell: not at all);
///   - at most one crossing of a curve lies on a cell edge, and no cell vertex lies on a curve.
/// Everything that proves it is stored in `Encasement`, and `verify` re-proves it.
namespace encase {

/// What the user wrote.
using NamedCurve = NamedFunction<2>;

/// A curve that is encased: a polynomial is square-free and without a component in common with the
/// others. A component shared by several input curves is one curve that carries several sources.
struct Curve {
  std::string name;
  Function<2> function;
  std::vector<int> sources;  ///< indices of the input curves that contain it
};

/// Certified: proved for the input as written. Degenerate: certified outside the boxes in
/// `degenerate`. Undecided: a budget ran out, what is missing is in `undecided`.
enum class Outcome { Certified, Degenerate, Undecided };

/// Where a crossing lies with respect to the region that was asked for. It can be outside or on the
/// boundary only if `region_used` is larger (see Encasement).
enum class Location { Inside, OnBoundary, Outside };

/// A simple, transversal common point of two curves. The closed box holds exactly one common point
/// of them, in its interior.
struct Crossing {
  std::array<int, 2> curves{};  ///< ascending
  Box<2> box;
  Point<2> point{};      ///< the common point, each coordinate rounded as `rounded` says
  bool rounded = false;  ///< proved: `point` is the correctly rounded common point
  int cell = -1;         ///< the cell that holds it
  Location location = Location::Inside;
};

/// A simple crossing of a curve with a line. The line a x + b y + c = 0 is parametrised by x where
/// |b| >= |a| (as doubles), else by y; the open interval (lo, hi) of that parameter holds exactly
/// one root of the curve's restriction, simple, and the restriction is not zero at lo and hi.
struct LineCrossing {
  int line = -1;
  int curve = -1;
  double lo = 0;
  double hi = 0;
};

/// Proof of where curves can meet, for more than two: the box `root` (which contains the region
/// used) is subdivided; leaf token k >= 0 names entry k of `alive`, and every curve that is not in
/// that list has no zero in the leaf. These leaves are numbered in their order; the others are
/// kOutside, or kUnresolved in a box of `undecided` that concerns all curves.
struct SharedCover {
  Box<2> root;
  std::vector<int> tokens;
  std::vector<std::vector<int>> alive;  ///< ascending
};

/// Proof that the list of crossings of a pair is complete: the box `root` (which contains the
/// region used, or all leaves of the shared cover in which both are alive) is subdivided, and in
/// every leaf
///   - kExcluded: the two curves have no common point in the region used (that may show from the
///     shared cover: no leaf of that which meets this one has both alive);
///   - k >= 0: a box that contains the leaf and crossing k's box holds at most one common point.
struct CrossingCover {
  std::array<int, 2> curves{};
  Box<2> root;
  std::vector<int> tokens;
};

/// A connected union of closed boxes on which a curve's polynomial f has one proved sign.
/// Every closed loop of f in the region used surrounds a region of this list, unless it meets an
/// unresolved box.
struct CriticalRegion {
  int curve = -1;
  Sign sign = Sign::Zero;
  std::vector<Box<2>> boxes;
};

/// Proof that a curve's critical regions are complete and that it is smooth. The box `root`
/// contains the region used, or all leaves of the shared cover in which the curve is alive. In
/// every leaf
///   - kExcluded: f has no critical point, or f is not zero and no point is a local maximum of |f|
///     (proved by f f_xx > 0, f f_yy > 0 or det Hess f < 0);
///   - k >= 0: the leaf is a box of `critical_regions[k]`, on which f is not zero.
struct CriticalCover {
  int curve = -1;
  Box<2> root;
  std::vector<int> tokens;
};

/// A corner of a cell (line_in != line_out: where the edge on line_in ends and the edge on line_out
/// begins) or a cut of an edge between two crossings (line_in == line_out, at `parameter` exactly).
struct Vertex {
  int line_in = -1;
  int line_out = -1;
  double parameter = 0;
  Point<2> point{};  ///< the vertex, rounded
};

/// A curve's branch in a cell, between two of the cell's line crossings.
struct Branch {
  int curve = -1;
  int from = -1;
  int to = -1;
};

/// No loop in the cell surrounds the critical region:
/// the closed segment from `from` (in the region) to `to` (not in the interior of the cell) does
/// not meet the curve.
struct LoopCertificate {
  int critical_region = -1;
  Point<2> from{};
  Point<2> to{};
};

enum class CellState {
  Certified,
  Relaxed,     ///< certified; two branches that do not cross
  Degenerate,  ///< meets a box of `degenerate`
  Undecided    ///< meets a box of `undecided`, or a budget ran out before it was settled
};

struct Cell {
  CellState state = CellState::Undecided;
  std::vector<Vertex> vertices;  ///< counter-clockwise; edge k runs from vertex k to vertex k + 1
  std::vector<int> word;         ///< line crossings, counter-clockwise from vertex 0
  std::vector<Branch> branches;  ///< empty unless certified
  int crossing = -1;             ///< index of the crossing inside, or -1
  std::vector<LoopCertificate> loop_certificates;
  int depth = 0;  ///< number of splits above it
};

/// One cut of a cell in two: a node of the binary space partition. Nodes are in an order in which
/// the cuts can be made; node 0 cuts the region used. A child c >= 0 is a node, else cell ~c.
struct Split {
  int line = -1;
  int negative = 0;  ///< the child on the line's negative side
  int positive = 0;
};

/// A place that resists: something that generic position excludes, or a budget that ran out.
struct Unresolved {
  enum class Kind {
    Contact,            ///< two curves touch, nearly touch, or meet at a singular point
    SingularPoint,      ///< a curve is or may be singular
    Concurrency,        ///< three curves meet or nearly meet in a point
    SharedComponent,    ///< input curves share a component (proved, no box)
    RepeatedComponent,  ///< an input curve has a repeated component (proved, no box)
    Infinity,           ///< curves touch the line at infinity or meet on it, or nearly (no box)
    NotAnalytic,        ///< a curve's function has no value there, a pole, or no derivatives
    Budget              ///< a limit on cells, seconds, precision or a cancellation
  };
  Kind kind = Kind::Budget;
  Box<2> box;
  bool has_box = false;
  std::vector<int> curves;  ///< indices of encased curves (of input curves for components)
  bool proved = false;      ///< the diagnosis is proved
  std::string reason;       ///< a sentence for people
};

/// Part of the proof that outside of the rectangle that is partitioned in place of the whole plane
/// all is known. With the rectangle [-a, a] x [-b, b], outside of it x = a / u, y = b v / u (chart
/// 0) or x = a v / u, y = b / u (chart 1), |u| <= 1, |v| <= 1; a piece is lo <= v <= hi.
struct InfinityPiece {
  int chart = 0;
  double lo = 0, hi = 0;
  /// The only curve there, in arcs v = v(u), each from the rectangle to infinity (u = 0) and on to
  /// the rectangle's opposite side; -1: none.
  int curve = -1;
};

struct Statistics {
  DecisionCounts decisions;
  std::int64_t pairs_met = 0;        ///< pairs of curves that no leaf of a shared cover separates
  std::int64_t pairs_isolated = 0;   ///< pairs whose common zeros were isolated
  std::int64_t filter_failures = 0;  ///< among them those without a common zero in the region
  std::int64_t root_boxes = 0;       ///< boxes visited for crossings
  std::int64_t critical_boxes = 0;   ///< boxes visited for critical regions
  std::int64_t restrictions = 0;     ///< curves restricted to segments
  std::int64_t expansions = 0;       ///< local expansions from the exact coefficients
  std::int64_t mpfr_expansions = 0;
  std::int64_t candidate_lines = 0;
  std::int64_t splits = 0;
  std::int64_t loop_splits = 0;
};

/// The answer, with everything that proves it.
struct Encasement {
  Outcome outcome = Outcome::Undecided;
  std::vector<NamedCurve> input;  ///< as encased from: after perturbation, before reduction
  double perturbation = 0;        ///< delta, 0 for none
  std::uint64_t seed = 0;
  std::vector<Curve> curves;
  Region region;            ///< as asked
  Region region_used;       ///< partitioned: `region`, or larger by at most 2^-30 of its diameter
  std::vector<Line> lines;  ///< the sides of region_used in order, then the splitting lines
  std::vector<LineCrossing> line_crossings;
  std::vector<Crossing> crossings;
  std::vector<Cell> cells;
  std::vector<Split> history;
  SharedCover shared_cover;  ///< without tokens for at most two curves
  /// One a pair of curves; with a shared cover, one a pair that is alive in a common leaf.
  std::vector<CrossingCover> crossing_covers;
  /// One a curve; with a shared cover, one a curve that is alive in a leaf.
  std::vector<CriticalCover> critical_covers;
  std::vector<CriticalRegion> critical_regions;
  /// If `region` is the plane: what is proved outside of `region_used`, a rectangle around the
  /// origin; empty where something is reported there.
  std::vector<InfinityPiece> infinity;
  std::vector<Unresolved> degenerate;
  std::vector<Unresolved> undecided;
  Statistics statistics;
  /// CPU, of all threads (elapsed, below a millisecond); not part of the result's bytes.
  double seconds = 0;
};

struct EncaseOptions {
  bool relaxed = false;  ///< accept relaxed cells wherever they are simple
  bool fast = false;     ///< try fewer splitting lines: less time, more cells
  int max_cells = 100000;
  double max_seconds = 60;  ///< CPU seconds, of all threads together
  /// How many threads may work, the caller's among them (those of oneTBB; without it one works). Of
  /// at most two curves one works. The result is the same for any number, to the byte, unless
  /// seconds run out or `progress` cancels.
  int threads = 1;
  int max_bits = 848;           ///< precision cap of the MPFR rung
  int start_bits = 53;          ///< 53: doubles first; more: MPFR from there
  int relax_after_splits = 24;  ///< levels without progress before a cell may be relaxed
  double perturbation = 0;      ///< delta > 0 perturbs every coefficient
  std::uint64_t seed = 1;
  /// Called now and then with a stage and how much of it is done (0 to 1, or -1 where unknown);
  /// false cancels, and what is left becomes undecided. Any of the threads calls it, one at a time.
  std::function<bool(const char* stage, double done)> progress;
};

/// Encases the curves in the region. BadInput for a zero or constant polynomial or a degree above
/// kMaxDegree, for an expression without x and y, or one in the whole plane or to be perturbed;
/// every other input gets an answer, of the three kinds of `Outcome`. Deterministic.
/// Cost grows with the number of crossings and loops; see docs/encasement.md.
Result<Encasement> encase(const std::vector<NamedCurve>& curves, const Region& region,
                          const EncaseOptions& options = {});

/// Encases the curves of an earlier encasement and some more, in the same region. Takes over the
/// earlier one's crossings, critical regions and splitting lines wherever they still serve; so it
/// costs less than to encase all anew, needs more cells, and leads to the same arrangement. The
/// earlier perturbation and seed stay in force, those of `options` count for nothing; else as
/// `encase`. What is taken over is not proved again: `verify` does so.
Result<Encasement> add_curves(const Encasement& earlier, const std::vector<NamedCurve>& more,
                              const EncaseOptions& options = {});

}  // namespace encase
