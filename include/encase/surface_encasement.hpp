// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/encasement.hpp"
#include "encase/polyhedron.hpp"
#include "encase/result.hpp"
#include "encase/slice.hpp"

/// The encasement of surfaces in a convex polyhedron: a partition of the polyhedron by planes into
/// convex cells, such that in each cell
///   - a surface is absent, or a certified graph along a field of lines whose pieces in the cell
///   are discs, each bounded by one loop on the cell's boundary; or the only piece of a surface in
///   the cell is a closed sphere;
///   - two surfaces do not meet, or meet in arcs along which a known direction grows, each from one
///   point of the cell's boundary to another;
///   - three surfaces meet in isolated points, ordered along these arcs.
/// What happens on the cells' sides is the plane's matter: every facet is encased in its plane.
/// Everything that proves it is stored in `SurfaceEncasement`, and `verify` re-proves it.
namespace encase {

/// A surface that is encased: a polynomial is square-free and without a component in common with
/// the others. A component shared by several input surfaces is one that carries several sources.
struct Surface {
  std::string name;
  Function<3> function;
  std::vector<int> sources;  ///< indices of the input surfaces that contain it
};

/// Proof that a surface f has no zero in a cell: f has this sign on the box, which contains the
/// cell.
struct AbsenceCertificate {
  int surface = -1;
  Box<3> box;
  Sign sign = Sign::Zero;
};

/// Proof that a surface f is a graph in a cell: with V(x) = direction + spread (x - center),
/// V . grad f + multiplier f > 0 on the box, which contains the cell. So each of the lines along V
/// (parallel if spread = 0, else through the point center - direction / spread) meets f at most
/// once within the cell, upwards.
struct GraphCertificate {
  int surface = -1;
  Box<3> box;
  Point<3> direction{};
  double spread = 0;
  Point<3> center{};
  double multiplier = 0;
};

/// All points at which the curve f = g of two surfaces runs across a direction w, or is singular:
/// the common zeros of f, g and (grad f x grad g) . w, with the proof that the list is complete
/// (tokens as in CrossingCover; token k names points[k]).
struct CurveCriticalPoints {
  std::array<int, 2> surfaces{};
  Point<3> direction{};
  std::vector<Box<3>> points;
  Box<3> root;
  std::vector<int> tokens;
};

/// Proof of how two surfaces f, g meet in a cell, which lies in the box.
struct PairCertificate {
  enum class Kind {
    Apart,   ///< alpha f + beta g > 0 on the box
    Listed,  ///< no critical point of list `critical` lies in the box
    Local    ///< (grad f x grad g) . w + alpha f + beta g > 0 on the box
  };
  Kind kind = Kind::Apart;
  std::array<int, 2> surfaces{};
  Box<3> box;
  double alpha = 0, beta = 0;
  int critical = -1;     ///< of Listed: index in `critical_points`
  Point<3> direction{};  ///< w, of Listed and Local: strictly monotone along every arc in the box
};

/// A simple, transversal common point of three surfaces. The closed box holds exactly one common
/// point of them, in its interior.
struct TriplePoint {
  std::array<int, 3> surfaces{};  ///< ascending
  Box<3> box;
  Point<3> point{};      ///< as Crossing's
  bool rounded = false;  ///< as Crossing's
  /// With respect to the region asked, exactly; nothing for a point that is not told apart from a
  /// plane of its boundary.
  std::optional<Location> location;
  int cell = -1;  ///< the cell that holds it in its interior
};

/// Proof that the list of common points of three surfaces is complete, as CrossingCover.
struct TriplePointCover {
  std::array<int, 3> surfaces{};
  Box<3> root;
  std::vector<int> tokens;
};

/// A point where a surface meets the common line of two planes, or two surfaces a facet.
struct FacetPoint {
  std::array<int, 2> surfaces{};  ///< ascending; the second is -1 on a line
  std::array<int, 2> planes{};    ///< ascending; the second is -1 within a facet
  Point<3> point{};               ///< approximately
};

/// Where two neighbouring cells touch, or a cell and the outside of the region used: a convex
/// polygon in a plane.
struct Facet {
  int plane = -1;
  std::array<int, 2> cells{-1, -1};  ///< on the plane's negative and positive side; -1: outside
  Region polygon;                    ///< in PlaneChart's coordinates of the plane
  std::vector<int> side_planes;      ///< the plane that meets this one in the polygon's side k
  /// Those that may meet it: absent in neither cell, and not constant on the plane. None between
  /// cells that are not certified.
  std::vector<int> surfaces;
  /// The curves in which they meet it; curve k is that of surfaces[k] and has the same sign.
  /// Certified, and of the polygon exactly (region_used = polygon). Empty if `surfaces` is.
  Encasement encasement;
  Arrangement arrangement;  ///< of the encasement; without boundary points (ArrangeOptions)
  /// For each vertex of the arrangement the index in `facet_points`; -1 for the polygon's corners.
  std::vector<int> points;
};

/// A half-edge of a facet's arrangement that lies on a surface.
struct FacetEdge {
  int facet = -1;
  int half_edge = -1;
};

/// A connected piece of a surface in a cell.
struct SurfacePatch {
  int surface = -1;
  /// The loop on the cell's boundary that bounds it, a disc: in such an order that the patch lies
  /// to the left if looked at from where f > 0. Empty: a closed sphere.
  std::vector<FacetEdge> loop;
};

/// A connected piece of the curve of two surfaces in a cell.
struct SurfaceArc {
  std::array<int, 2> surfaces{};  ///< ascending
  std::array<int, 2> patches{};   ///< of the cell, on which it lies
  std::array<int, 2> ends{};      ///< in `facet_points`; the direction w grows from first to second
  std::vector<int> triple_points;  ///< on it, in that order
  int certificate = -1;            ///< in `pair_certificates`: names w
};

struct SpaceCell {
  CellState state = CellState::Undecided;
  Box<3> box;  ///< the cell is its part of region_used
  int depth = 0;
  std::vector<int> facets;            ///< all, ascending
  std::vector<Sign> signs;            ///< of every surface; Zero for those that may meet the cell
  std::vector<int> absences;          ///< in `absence_certificates`
  std::vector<int> graphs;            ///< in `graph_certificates`
  std::vector<int> pairs;             ///< in `pair_certificates`
  std::vector<SurfacePatch> patches;  ///< in the order of the surfaces; empty unless certified
  std::vector<SurfaceArc> arcs;       ///< in the order of the pairs; empty unless certified
};

/// A place that resists, in space; as Unresolved.
struct UnresolvedInSpace {
  Unresolved::Kind kind = Unresolved::Kind::Budget;
  Box<3> box;
  bool has_box = false;
  std::vector<int> surfaces;
  std::vector<int>
      cells;  ///< that are not certified because of it, ascending; its box is their hull
  bool proved = false;
  std::string reason;
};

struct SpaceStatistics {
  DecisionCounts decisions;
  std::int64_t point_boxes = 0;     ///< boxes visited for triple points
  std::int64_t critical_boxes = 0;  ///< boxes visited for critical points of curves
  std::int64_t certificate_tests = 0;
  std::int64_t facets_encased = 0;
  std::int64_t splits_after_reading = 0;  ///< cells split because their reading was ambiguous
};

/// The answer, with everything that proves it. All indices refer to lists here.
struct SurfaceEncasement {
  Outcome outcome = Outcome::Undecided;
  std::vector<NamedSurface> input;  ///< as encased from: after perturbation, before reduction
  double perturbation = 0;          ///< delta, 0 for none
  std::uint64_t seed = 0;           ///< of the perturbation
  std::vector<Surface> surfaces;
  Polyhedron region;          ///< as asked
  Polyhedron region_used;     ///< partitioned: `region`, or larger by at most 2^-30 of its diameter
  std::vector<Plane> planes;  ///< the sides of region_used in order, then the splitting planes
  std::vector<Split> history;  ///< `line` is the index of a plane; in an order as in 2D
  std::vector<SpaceCell> cells;
  std::vector<Facet> facets;
  std::vector<FacetPoint> facet_points;
  std::vector<TriplePoint> triple_points;
  /// One a triple of surfaces, but for those of which two are apart in all cells.
  std::vector<TriplePointCover> triple_point_covers;
  std::vector<CurveCriticalPoints> critical_points;  ///< of a pair for several directions, or none
  std::vector<AbsenceCertificate> absence_certificates;
  std::vector<GraphCertificate> graph_certificates;
  std::vector<PairCertificate> pair_certificates;
  std::vector<UnresolvedInSpace> degenerate;
  std::vector<UnresolvedInSpace> undecided;
  SpaceStatistics statistics;
  double seconds = 0;  ///< CPU; not part of the result's bytes
};

struct SurfaceOptions {
  int max_cells = 20000;
  double max_seconds = 60;  ///< CPU seconds, of all threads together
  int max_bits = 848;       ///< precision cap of the MPFR rung
  int start_bits = 53;      ///< 53: doubles first; more: MPFR from there
  /// A curve along which surfaces are singular or touch is left in cells of this part of the
  /// region's size: Degenerate. (A single such point in far smaller ones.)
  double singular_width = 0x1p-6;
  int threads = 1;          ///< how many may work; the result is the same for any number
  double perturbation = 0;  ///< delta > 0 perturbs every coefficient
  std::uint64_t seed = 1;
  /// As EncaseOptions'.
  std::function<bool(const char* stage, double done)> progress;
};

/// Encases the surfaces in the region. BadInput for a zero or constant polynomial or a degree above
/// kMaxDegree, for an expression without variables or one to be perturbed; every other input gets
/// an answer, of the three kinds of `Outcome`. Deterministic. See docs/surfaces.md.
Result<SurfaceEncasement> encase(const std::vector<NamedSurface>& surfaces,
                                 const Polyhedron& region, const SurfaceOptions& options = {});

/// Re-proves an encasement from its stored facts and the exact input, without the search that found
/// it.
Verification verify(const SurfaceEncasement& encasement, const VerifyOptions& options = {});

}  // namespace encase
