// SPDX-License-Identifier: MIT
#include "encase/tracing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <string>
#include <utility>

#include "2d/curve_tracer.hpp"
#include "2d/polyline_topology.hpp"
#include "common/interval.hpp"

namespace encase {
namespace {

/// Traces edges, all or some of them, and refines them until they are as they should be.
class EdgeTracer {
 public:
  EdgeTracer(const Encasement& encasement, const Arrangement& arrangement,
             const TraceOptions& options)
      : e_(encasement),
        a_(arrangement),
        options_(options),
        tracers_(encasement.curves.size()),
        paths_(arrangement.edges.size()) {}

  /// The edges on the boundaries of faces; the other ones get no points.
  Tracing run(const std::vector<int>& faces) {
    std::vector<char> wanted(paths_.size(), 0);
    for (const int face : faces)
      for (const int first : a_.boundaries(face))
        for (const int h : a_.cycle(first)) wanted[Arrangement::edge_of(h)] = 1;
    for (std::size_t k = 0; k < paths_.size(); ++k)
      if (wanted[k]) paths_[k] = a_.edges[k].curve < 0 ? side_path(k) : curve_path(k);
    if (options_.check_topology) settle_topology(faces);
    return result();
  }

 private:
  CurveTracer& tracer(int curve) {
    auto& made = tracers_[curve];
    if (!made) made = std::make_unique<CurveTracer>(e_, curve, options_.tolerance);
    return *made;
  }
  int room() const { return std::max(options_.max_points - made_, 1); }

  CurvePath curve_path(std::size_t edge) {
    CurvePath path = tracer(a_.edges[edge].curve).edge(a_.edges[edge].strands, room());
    made_ += static_cast<int>(path.pieces.size());
    return path;
  }

  /// Along a side of the region.
  CurvePath side_path(std::size_t edge) {
    CurvePath path;
    double distance = 0;
    for (const std::size_t h : {2 * edge, 2 * edge + 1}) {
      const CurvePoint p = place_of(a_.vertices[a_.half_edges[h].origin]);
      double away[2];
      for (int i = 0; i < 2; ++i)
        away[i] = std::max(p.box.hi[i] - p.point[i], p.point[i] - p.box.lo[i]);
      distance = std::max(distance, round_up(away[0] + away[1]));
      path.points.push_back(p);
    }
    const int axis = parameter_axis(e_.lines[a_.edges[edge].side]);
    path.pieces.push_back({axis, 1, round_up(distance)});
    return path;
  }

  CurvePoint place_of(const Arrangement::Vertex& vertex) {
    if (vertex.kind == Arrangement::Vertex::Kind::Crossing)
      return tracer(e_.crossings[vertex.index].curves[0]).at_crossing(vertex.index);
    if (vertex.kind == Arrangement::Vertex::Kind::OnBoundary)
      return tracer(e_.line_crossings[vertex.index].curve).at_line_crossing(vertex.index);
    CurvePoint corner;
    for (int i = 0; i < 2; ++i) {
      const Rational& exact = e_.region_used.corners[vertex.index][i];
      const Interval around = Interval::enclose(exact);
      corner.point[i] = nearest_double(exact);
      corner.box.lo[i] = std::min(around.lo, corner.point[i]);
      corner.box.hi[i] = std::max(around.hi, corner.point[i]);
    }
    return corner;
  }

  /// Pieces are refined where polylines are not as they should be, while that helps.
  void settle_topology(const std::vector<int>& faces) {
    std::vector<std::vector<char>> is_new;
    for (const CurvePath& path : paths_) is_new.emplace_back(path.pieces.size(), 1);
    for (int round = 0;; ++round) {
      const EdgePolylines lines = polylines();
      std::vector<PieceConflict> found = meeting_pieces(a_, lines, is_new);
      if (found.empty()) found = misplaced_around_vertices(a_, lines);
      if (found.empty()) found = misplaced_pieces(faces, lines);
      conflicts_.clear();
      for (const PieceConflict& c : found) conflicts_.push_back({c.first.edge, c.second.edge});
      same_topology_ = found.empty();
      if (same_topology_ || round >= options_.max_rounds || !refine(found, &is_new)) return;
    }
  }

  EdgePolylines polylines() const {
    EdgePolylines lines(paths_.size());
    for (std::size_t k = 0; k < paths_.size(); ++k)
      for (const CurvePoint& p : paths_[k].points) lines[k].push_back(p.point);
    return lines;
  }

  /// All pieces of cycles that lie as they should not, as conflicts.
  std::vector<PieceConflict> misplaced_pieces(const std::vector<int>& faces,
                                              const EdgePolylines& lines) const {
    std::vector<PieceConflict> found;
    for (const int face : faces)
      for (const auto& [first, second] : misplaced_cycles(a_, lines, face))
        for (const int cycle : {first, second})
          for (const int h : a_.cycle(cycle)) {
            const int edge = Arrangement::edge_of(h), other = Arrangement::edge_of(second);
            const int count = static_cast<int>(paths_[edge].pieces.size());
            for (int k = 0; k < count; ++k) {
              const EdgePiece piece{edge, k}, example{other, 0};
              found.push_back({std::min(piece, example), std::max(piece, example)});
            }
          }
    return found;
  }

  /// Refines the pieces in conflict; false if that helps none.
  bool refine(const std::vector<PieceConflict>& conflicts, std::vector<std::vector<char>>* is_new) {
    std::vector<EdgePiece> pieces;
    for (const PieceConflict& c : conflicts) {
      pieces.push_back(c.first);
      pieces.push_back(c.second);
    }
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    for (auto& edge : *is_new) std::fill(edge.begin(), edge.end(), 0);
    bool any = false;
    for (std::size_t first = 0, end = 0; first < pieces.size(); first = end) {
      const int edge = pieces[first].edge;
      std::vector<char> chosen(paths_[edge].pieces.size(), 0);
      for (end = first; end < pieces.size() && pieces[end].edge == edge; ++end)
        chosen[pieces[end].piece] = 1;
      any = refine_edge(edge, chosen, &(*is_new)[edge]) || any;
    }
    return any;
  }

  /// Those that are chosen are new, refined or not, so that they are compared again.
  bool refine_edge(int edge, const std::vector<char>& chosen, std::vector<char>* is_new) {
    CurvePath& old = paths_[edge];
    const int curve = a_.edges[edge].curve;
    CurvePath path;
    path.points.push_back(old.points.front());
    is_new->clear();
    bool any = false;
    for (std::size_t k = 0; k < old.pieces.size(); ++k) {
      const CurvePiece& piece = old.pieces[k];
      CurvePath finer;
      if (chosen[k] && curve >= 0 && std::isfinite(piece.distance) && room() > 2)
        finer = tracer(curve).finer(old.points[k], old.points[k + 1], piece.direction,
                                    0.25 * piece.distance, room());
      const bool better = finer.pieces.size() > 1 && finer.is_proved();
      if (better) {
        any = true;
        made_ += static_cast<int>(finer.pieces.size()) - 1;
      } else {
        finer = {{old.points[k], old.points[k + 1]}, {piece}};
      }
      is_new->insert(is_new->end(), finer.pieces.size(), chosen[k]);
      path.append(finer);
    }
    old = std::move(path);
    return any;
  }

  Tracing result() {
    Tracing tracing;
    for (const CurvePath& path : paths_) {
      TracedEdge edge;
      for (const CurvePoint& p : path.points) {
        edge.points.push_back(p.point);
        edge.boxes.push_back(hull(p.box, {p.point, p.point}));
      }
      for (const CurvePiece& piece : path.pieces) {
        edge.pieces.push_back({piece.axis, piece.distance});
        tracing.distance = std::max(tracing.distance, piece.distance);
      }
      tracing.edges.push_back(std::move(edge));
    }
    tracing.within_tolerance = tracing.distance <= options_.tolerance;
    tracing.same_topology = same_topology_;
    if (!same_topology_) tracing.conflicts = std::move(conflicts_);
    std::sort(tracing.conflicts.begin(), tracing.conflicts.end());
    tracing.conflicts.erase(std::unique(tracing.conflicts.begin(), tracing.conflicts.end()),
                            tracing.conflicts.end());
    return tracing;
  }

  const Encasement& e_;
  const Arrangement& a_;
  const TraceOptions& options_;
  std::vector<std::unique_ptr<CurveTracer>> tracers_;
  std::vector<CurvePath> paths_;
  int made_ = 0;  ///< pieces of curves
  bool same_topology_ = false;
  std::vector<std::array<int, 2>> conflicts_;
};

Status check(const TraceOptions& options) {
  if (options.tolerance > 0) return std::nullopt;
  return Error{Error::Code::BadInput, "the tolerance has to be a positive number"};
}

}  // namespace

Result<Tracing> trace(const Encasement& encasement, const Arrangement& arrangement,
                      const TraceOptions& options) {
  if (const Status wrong = check(options)) return *wrong;
  std::vector<int> all(arrangement.faces.size());
  std::iota(all.begin(), all.end(), 0);
  return EdgeTracer(encasement, arrangement, options).run(all);
}

std::vector<Polyline> face_boundary(const Arrangement& arrangement, const Tracing& tracing,
                                    int face) {
  EdgePolylines lines;
  for (const TracedEdge& edge : tracing.edges) lines.push_back(edge.points);
  std::vector<Polyline> boundary;
  for (const int first : arrangement.boundaries(face))
    boundary.push_back(cycle_polyline(arrangement, lines, first));
  return boundary;
}

Result<std::vector<Polyline>> face_boundary(const Encasement& encasement,
                                            const Arrangement& arrangement, int face,
                                            double tolerance) {
  TraceOptions options;
  options.tolerance = tolerance;
  if (const Status wrong = check(options)) return *wrong;
  if (face < 0 || face >= static_cast<int>(arrangement.faces.size()))
    return Error{Error::Code::BadInput, "there is no face " + std::to_string(face)};
  const Tracing tracing = EdgeTracer(encasement, arrangement, options).run({face});
  if (!tracing.within_tolerance)
    return Error{Error::Code::Undecided,
                 "the boundary of face " + std::to_string(face) +
                     " could not be traced within the tolerance in doubles"};
  if (!tracing.same_topology)
    return Error{Error::Code::Undecided, "polylines of the boundary of face " +
                                             std::to_string(face) + " could not be kept apart"};
  return face_boundary(arrangement, tracing, face);
}

}  // namespace encase
