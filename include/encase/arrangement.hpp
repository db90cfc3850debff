// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "encase/encasement.hpp"

/// The arrangement of plane curves in a convex region: the vertices, edges and faces into which
/// they divide it, read off a certified encasement. docs/arrangement.md says how and why it is
/// exact.
namespace encase {

/// A planar subdivision in half-edges. It is that of `region_used`, which may be larger than the
/// region asked by 2^-30 of its diameter. All indices refer to lists here or in the encasement.
struct Arrangement {
  /// A point where edges end.
  struct Vertex {
    enum class Kind {
      Crossing,    ///< of two curves: `index` in Encasement::crossings
      OnBoundary,  ///< a curve meets the region's boundary: `index` in Encasement::line_crossings
      Corner       ///< of the region: `index` in region_used.corners
    };
    Kind kind = Kind::Corner;
    int index = -1;
    int half_edge = -1;  ///< one that begins here
    /// The crossing's `point`; the corner, rounded to nearest; or where the curve meets a side: the
    /// parameter of the side's line rounded to nearest, and then the point of the line there.
    /// (Of a curve that is no polynomial as far as 800 bits tell.)
    Point<2> point{};
    bool operator==(const Vertex&) const = default;
  };

  /// An edge in one of its two directions; its face lies to the left. Half-edges 2 k and 2 k + 1
  /// are those of edge k, the first along its strands.
  struct HalfEdge {
    int origin = -1;  ///< vertex where it begins; -1 on a closed loop without vertices
    int next = -1;    ///< follows it around its face
    int prev = -1;    ///< precedes it
    int face = -1;
    bool operator==(const HalfEdge&) const = default;
  };

  /// A curve's branch in a cell, or the part of it on one side of the cell's crossing.
  struct Strand {
    int cell = -1;
    int branch = -1;  ///< index in the cell's branches
    int from = -1;    ///< the line crossing where it begins, or -1 for the cell's crossing
    int to = -1;      ///< and where it ends
    bool operator==(const Strand&) const = default;
  };

  /// A maximal piece of a curve or of the region's boundary without a vertex inside.
  struct Edge {
    int curve = -1;               ///< -1 on the region's boundary
    int side = -1;                ///< on the boundary: which side; else -1
    std::vector<Strand> strands;  ///< along the edge; none on the boundary
    int component = -1;
    bool operator==(const Edge&) const = default;
  };

  /// A part of a cell between its branches. It meets the cell's boundary behind entry `word` of the
  /// cell's word (0 if the word is empty).
  struct Piece {
    int cell = -1;
    int word = 0;
    int face = -1;
    bool operator==(const Piece&) const = default;
  };

  /// A maximal connected set without points of curves; face `outside` is all beyond the region.
  struct Face {
    int outer = -1;           ///< a half-edge of the outer boundary; -1 for the outside
    std::vector<int> holes;   ///< a half-edge of every other boundary
    std::vector<Sign> signs;  ///< of every curve's polynomial; none for the outside
    std::vector<int> pieces;  ///< none for the outside
    int parent = -1;          ///< the face in a hole of which it lies; -1 for the outside
    bool operator==(const Face&) const = default;
  };

  /// A connected component of the graph of edges and vertices.
  struct Component {
    int parent = -1;         ///< the face in which it lies, of which it fills a hole
    int hole = -1;           ///< the half-edge of that hole in Face::holes
    std::vector<int> faces;  ///< those whose outer boundary belongs to it
    int vertices = 0;
    int edges = 0;
    bool operator==(const Component&) const = default;
  };

  /// A connected component of a curve in the region.
  struct CurveComponent {
    int curve = -1;
    bool closed = false;          ///< a closed loop; else an arc from boundary to boundary
    std::vector<int> half_edges;  ///< along it
    std::vector<int> crossings;   ///< along it, in Encasement::crossings
    bool operator==(const CurveComponent&) const = default;
  };

  /// A vertex, an edge or a face.
  struct Feature {
    enum class Kind {
      Vertex,
      Edge,
      Face,
      /// Not told: the point lies on a curve that is no polynomial, or too close to it. The index
      /// is -1.
      Undecided
    };
    Kind kind = Kind::Face;
    int index = -1;
    bool operator==(const Feature&) const = default;
  };

  static int twin(int half_edge) { return half_edge ^ 1; }
  static int edge_of(int half_edge) { return half_edge / 2; }

  /// The half-edges that begin at a vertex, counter-clockwise.
  std::vector<int> around(int vertex) const;
  /// The faces around a vertex, counter-clockwise; the k-th lies behind the k-th half-edge of
  /// `around`.
  std::vector<int> faces_around(int vertex) const;
  /// The faces to the left and to the right of an edge.
  std::array<int, 2> faces_at(int edge) const {
    return {half_edges[2 * edge].face, half_edges[2 * edge + 1].face};
  }
  /// The face on the other side of a half-edge.
  int across(int half_edge) const { return half_edges[twin(half_edge)].face; }
  /// The faces that share an edge with a face, each once, ascending.
  std::vector<int> neighbours(int face) const;
  /// A half-edge of every boundary cycle of a face: the outer one first, if there is one.
  std::vector<int> boundaries(int face) const;
  /// The half-edges of the boundary cycle on which a half-edge lies, from it on.
  std::vector<int> cycle(int half_edge) const;
  /// Whether a part of the region's boundary is in that of a face. In the whole plane: whether the
  /// face is unbounded.
  bool touches_boundary(int face) const;
  /// The vertices that are crossings of two curves.
  std::vector<int> crossings_of(int first, int second) const;

  std::vector<Vertex> vertices;  ///< the region's corners first, in their order
  std::vector<HalfEdge> half_edges;
  std::vector<Edge> edges;
  std::vector<Face> faces;
  std::vector<Piece> pieces;  ///< in the order of the cells
  std::vector<Component> components;
  std::vector<CurveComponent> curve_components;  ///< in the order of the curves
  int outside = 0;
  bool operator==(const Arrangement&) const = default;
};

struct ArrangeOptions {
  /// Round the points where curves meet the region's boundary, which takes a part of the time; else
  /// these are zero.
  bool boundary_points = true;
};

/// The arrangement of an encasement's curves. Degenerate or Undecided if the encasement is;
/// Internal if its parts do not fit together, as in one that `verify` objects to. Cost: about that
/// of reading the encasement.
Result<Arrangement> arrange(const Encasement& encasement, const ArrangeOptions& options = {});

/// What contradicts the rules of a planar subdivision, in a sentence; empty if nothing does. The
/// rules: half-edges, cycles and faces agree, a crossing's four edges alternate between its curves,
/// the signs change across an edge as they must, and V - E + F = 1 + C (with a vertex added to
/// every closed loop that has none).
std::string check(const Arrangement& arrangement);

/// A text that is the same for arrangements that differ only in the order of their lists (not of
/// the curves and of the region's corners), and only for those: it tells which edges follow each
/// other around vertices and faces, the curves on them, the signs, and what lies in which hole.
std::string canonical_topology(const Arrangement& arrangement);

/// Tells on which face, edge or vertex points lie, exactly: of a point on a curve that is no
/// polynomial, or within about 2^-800 of it, that is in general left open (Feature::Kind). Refers
/// to the encasement, which must outlive it. Const calls may run in parallel.
class PointLocator {
 public:
  PointLocator(const Encasement& encasement, const Arrangement& arrangement);
  ~PointLocator();
  PointLocator(PointLocator&&) noexcept;
  PointLocator& operator=(PointLocator&&) noexcept;

  /// A point that is not finite lies outside. Cost: a line's side for every level of the history
  /// and the sign of at most two curves.
  Arrangement::Feature locate(const Point<2>& point) const;
  Arrangement::Feature locate(const RationalPoint<2>& point) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace encase
