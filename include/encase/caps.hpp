// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/geometry.hpp"
#include "encase/region.hpp"
#include "encase/result.hpp"

/// CAPS, Curves Arrangements by Planar Subdivisions (Y. Hijazi, T. Breuel, *Computing Arrangements
/// using Subdivision and Interval Arithmetic*): a quadtree whose leaves say which curves may pass,
/// and the arrangement graph that its regions make. For every function with an inclusion function:
/// polynomials, sin, 1/x. docs/caps.md says what is proved, and how.
namespace encase {

/// A box is cut in four at lo + kCapsCut (hi - lo) along x and along y, in doubles: not quite in
/// the middle, where symmetric curves like to pass, nor at equal parts, where diagonals do. Nothing
/// is proved of a curve that passes through a corner of a leaf.
inline constexpr std::array<double, 2> kCapsCut{0x1.0028p-1, 0x1.ffa2p-2};

/// The parts, in the order of a node's children: lower left, upper left, lower right, upper right.
inline std::array<Box<2>, 4> caps_quarters(const Box<2>& box) {
  std::array<Box<2>, 4> parts;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 2; ++i) {
      const double cut = box.lo[i] + kCapsCut[i] * (box.hi[i] - box.lo[i]);
      const bool upper = i == 0 ? k / 2 : k % 2;
      parts[k].lo[i] = upper ? cut : box.lo[i];
      parts[k].hi[i] = upper ? box.hi[i] : cut;
    }
  return parts;
}

/// What a leaf holds. A curve that is not in a leaf's list is proved to have no point in the
/// (closed) leaf.
enum class CapsLabel {
  Empty,         ///< no curve
  OneCurve,      ///< one curve, proved to have a point in the leaf
  Several,       ///< of terminal size, two or more curves may pass
  Indeterminate  ///< one curve may pass, or a budget ran out
};

/// A leaf of the quadtree.
struct CapsLeaf {
  Box<2> box;
  int depth = 0;  ///< how often the root was divided into four
  CapsLabel label = CapsLabel::Empty;
  int curves = 0;  ///< the curves that may pass: an index in CapsResult::curve_sets
  int region = -1;
  /// Proved: along this axis (0: x, 1: y) the leaf's only curve is the graph of a smooth function;
  /// so it does not cross itself there. -1: not proved.
  int graph_axis = -1;
};

/// A set of leaves with the same curves that are connected through sides (not corners). Of leaves
/// with one curve, those in which it may cross itself after all efforts make regions of their own.
struct CapsRegion {
  CapsLabel label = CapsLabel::Empty;  ///< OneCurve if it is proved in one of the leaves
  int curves = 0;                      ///< index in CapsResult::curve_sets
  bool singular = false;               ///< one curve, which may cross itself here
  int leaves = 0;
  Box<2> box;                   ///< the smallest around the leaves
  std::vector<int> neighbours;  ///< regions that share a side with it, ascending
  /// Two curves, and proved: they do not meet here.
  bool apart = false;
};

/// A node of the arrangement graph: a region with two or more curves (unless they are proved to be
/// apart there) or where a curve may cross itself, or a point where a curve leaves the box.
struct CapsVertex {
  enum class Kind {
    Crossing,       ///< two curves that cross exactly once, transversally: proved
    Odd,            ///< two curves that meet an odd number of times, it seems from their ends
    Even,           ///< two curves in contact, or that meet an even number of times, or not at all
    Several,        ///< three or more curves
    SelfCrossing,   ///< one curve that may cross itself, or be singular
    Indeterminate,  ///< two curves, and how often they meet is not known
    Boundary        ///< one curve leaves the box, proved
  };
  Kind kind = Kind::Indeterminate;
  int region = -1;          ///< -1 of Boundary
  std::vector<int> curves;  ///< ascending
  Box<2> box;               ///< holds the vertex; of Boundary a piece of the box' side
};

/// A piece of a curve between vertices.
struct CapsEdge {
  int curve = -1;
  std::vector<int> vertices;  ///< where it ends, ascending
  /// Proved: the piece is one smooth arc between its two vertices (or two ends at one), or a closed
  /// loop without any. Else it is what lies in a region of leaves and may be several pieces.
  bool proved = false;
  /// If proved: points along the arc. Point k and point k + 1 lie in a leaf (or in the box of a
  /// vertex) in which the arc runs from one to the other, and no farther from it than the
  /// diagonal of that box. A closed loop ends where it begins.
  std::vector<Point<2>> polyline;
};

/// How good the answer is.
enum class CapsClass {
  Exact,      ///< proved: the graph is that of the curves' arrangement in the box
  DeltaWeak,  ///< the paper's claim: that of curves distorted by at most delta
  Undecided   ///< a budget ran out
};

/// What stands between the answer and an exact one.
struct CapsObstacles {
  int unexamined_leaves = 0;     ///< with one curve that may cross itself there
  int indeterminate_leaves = 0;  ///< where the subdivision was ended by a budget
  int open_vertices = 0;         ///< of a kind other than Crossing and Boundary
  int open_edges = 0;            ///< not proved
  bool any() const { return unexamined_leaves + indeterminate_leaves + open_vertices + open_edges; }
  bool operator==(const CapsObstacles&) const = default;
};

struct CapsResult {
  static constexpr int kDivided = -1;

  CapsClass answer = CapsClass::Undecided;
  double epsilon = 0;
  double delta = 0;  ///< 2 epsilon
  bool self_crossings = false;
  CapsObstacles obstacles;
  std::vector<NamedCurve> curves;
  Box<2> box;  ///< the root: the smallest with double bounds around the region
  /// The quadtree in preorder: kDivided, then the four children (lower left, upper left, lower
  /// right, upper right); or k >= 0 for `leaves[k]`.
  std::vector<int> tokens;
  std::vector<CapsLeaf> leaves;
  std::vector<std::vector<int>> curve_sets;  ///< each ascending, all different; the first is empty
  std::vector<CapsRegion> regions;
  std::vector<CapsVertex> vertices;
  std::vector<CapsEdge> edges;
  std::int64_t nodes = 0;        ///< of the quadtree, leaves included: the paper's quadtree size
  std::int64_t evaluations = 0;  ///< of a function on a box or at a point
  double seconds = 0;            ///< CPU; not part of the result's bytes
  double tree_seconds = 0;       ///< the part of them until the quadtree was there
};

struct CapsOptions {
  /// Boxes are divided until both widths are at most this (input units).
  double epsilon = 1e-6;
  /// Divide also leaves of one curve until it is proved not to cross itself there. Needed for an
  /// exact answer unless the curves are lines or so.
  bool self_crossings = false;
  bool polylines = true;
  std::int64_t max_boxes = 2000000;  ///< nodes of the quadtree
  double max_seconds = 60;           ///< CPU
  /// Called now and then with a stage and how much of it is done (-1: unknown); false cancels.
  std::function<bool(const char* stage, double done)> progress;
};

/// The arrangement of curves in a box by subdivision. BadInput for no curves, a zero or constant
/// function, a region that is not a rectangle along the axes, or an epsilon that is not positive or
/// larger than the region's sides. Deterministic. Cost: some microseconds a node; a crossing takes
/// some nodes for every level, curves that are nearer to each other than epsilon along a way of
/// length L take L / epsilon of them.
Result<CapsResult> caps(const std::vector<NamedCurve>& curves, const Region& region,
                        const CapsOptions& options = {});

}  // namespace encase
