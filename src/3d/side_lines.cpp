// SPDX-License-Identifier: MIT
#include "3d/side_lines.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/segments.hpp"

namespace encase {
namespace {

/// A piece of a facet's side, between two neighbours among its corners and the points where
/// surfaces meet it.
struct SidePiece {
  int facet = -1, face = -1;
  std::array<int, 2> ends{};  ///< points of the line
};

/// A point of the line: a corner of a facet, or where a surface meets the line. By one coordinate,
/// exactly, or by an open interval of it with one root of the function.
struct LinePoint {
  Rational lo, hi;
  int surface = -1;
};

/// The common line of two planes.
struct SideLine {
  int axis = -1;                       ///< the coordinate that orders its points
  RationalPoint<3> origin, direction;  ///< the direction's coordinate `axis` is 1
  std::vector<LinePoint> points;
  std::vector<SidePiece> pieces;
  std::map<Rational, int> corners;  ///< in `points`, by the coordinate
  std::map<int, int> facet_points;  ///< in `points`
};

class SideLines {
 public:
  explicit SideLines(const SurfaceEncasement& e) : e_(e), functions_(e.surfaces.size()) {}

  std::string run(const std::function<void(int, int, int, int)>& tell) {
    name_planes();
    for (std::size_t f = 0; f < e_.facets.size() && fault_.empty(); ++f) add(static_cast<int>(f));
    for (auto& [planes, line] : lines_)
      if (fault_.empty()) sweep(line, tell);
    return fault_;
  }

 private:
  /// Equal planes have one name, whatever their index.
  void name_planes() {
    std::map<std::array<Rational, 4>, int> names;
    for (std::size_t k = 0; k < e_.planes.size(); ++k) {
      std::array<Rational, 4> plane = e_.planes[k].exact();
      const auto first = std::find_if(plane.begin(), plane.end(), [](auto& c) { return c != 0; });
      if (first != plane.end()) {
        const Rational unit = *first;
        for (Rational& c : plane) c /= unit;
      }
      plane_names_.push_back(names.emplace(std::move(plane), static_cast<int>(k)).first->second);
    }
  }

  void add(int index) {
    const Facet& facet = e_.facets[index];
    const PlaneChart chart(e_.planes[facet.plane].exact());
    const int sides = facet.polygon.side_count();
    if (facet.surfaces.empty()) {
      for (int k = 0; k < sides; ++k) {
        SideLine& line = line_of(facet, chart, k);
        line.pieces.push_back(
            {index,
             0,
             {corner(line, facet, chart, k), corner(line, facet, chart, (k + 1) % sides)}});
      }
      return;
    }
    const Arrangement& a = facet.arrangement;
    for (std::size_t h = 0; h < a.half_edges.size(); ++h) {
      const auto& edge = a.edges[Arrangement::edge_of(static_cast<int>(h))];
      if (edge.side < 0 || a.half_edges[h].face == a.outside) continue;
      SideLine& line = line_of(facet, chart, edge.side);
      const int to = a.half_edges[Arrangement::twin(static_cast<int>(h))].origin;
      line.pieces.push_back(
          {index,
           a.half_edges[h].face,
           {end(line, facet, chart, a.half_edges[h].origin), end(line, facet, chart, to)}});
    }
  }

  SideLine& line_of(const Facet& facet, const PlaneChart& chart, int side) {
    int p = plane_names_[facet.plane], q = plane_names_[facet.side_planes[side]];
    if (p > q) std::swap(p, q);
    SideLine& line = lines_[{p, q}];
    if (line.axis < 0) {
      line.origin = chart.lift(facet.polygon.corners[side]);
      const RationalPoint<3> to =
          chart.lift(facet.polygon.corners[(side + 1) % facet.polygon.side_count()]);
      for (int i = 0; i < 3; ++i) line.direction[i] = to[i] - line.origin[i];
      line.axis = 0;
      for (int i = 1; i < 3; ++i)
        if (abs(line.direction[i]) > abs(line.direction[line.axis])) line.axis = i;
      const Rational unit = line.direction[line.axis];
      for (Rational& c : line.direction) c /= unit;
    }
    return line;
  }

  int corner(SideLine& line, const Facet& facet, const PlaneChart& chart, int k) {
    const Rational at = chart.lift(facet.polygon.corners[k])[line.axis];
    const auto [place, fresh] = line.corners.emplace(at, static_cast<int>(line.points.size()));
    if (fresh) line.points.push_back({at, at, -1});
    return place->second;
  }

  int end(SideLine& line, const Facet& facet, const PlaneChart& chart, int vertex) {
    const Arrangement::Vertex& v = facet.arrangement.vertices[vertex];
    if (v.kind == Arrangement::Vertex::Kind::Corner) return corner(line, facet, chart, v.index);
    const auto [place, fresh] =
        line.facet_points.emplace(facet.points[vertex], static_cast<int>(line.points.size()));
    if (!fresh) return place->second;
    const LineCrossing& crossing = facet.encasement.line_crossings[v.index];
    const int axis = chart.axes()[parameter_axis(facet.encasement.lines[crossing.line])];
    // From the coordinate that is the parameter of the facet's side to that of the line.
    const auto converted = [&](double value) {
      return Rational(line.origin[line.axis] +
                      (Rational(value) - line.origin[axis]) / line.direction[axis]);
    };
    LinePoint point{converted(crossing.lo), converted(crossing.hi), facet.surfaces[crossing.curve]};
    if (point.lo > point.hi) std::swap(point.lo, point.hi);
    line.points.push_back(std::move(point));
    return place->second;
  }

  Sign sign_on(const SideLine& line, int surface, const Rational& at) {
    RationalPoint<3> point;
    for (int i = 0; i < 3; ++i)
      point[i] = line.origin[i] + (at - line.origin[line.axis]) * line.direction[i];
    auto& f = functions_[surface];
    if (!f) f.emplace(e_.surfaces[surface].function);
    return f->sign_at(point, kernel_);
  }

  /// Cuts a root's interval at a point in its inside.
  void narrow(const SideLine& line, LinePoint* root, const Rational& at) {
    const Sign below = sign_on(line, root->surface, root->lo);
    const Sign here = sign_on(line, root->surface, at);
    if (here == Sign::Zero || below == Sign::Zero) {
      fault_ = "a surface has no sign at a corner of a facet";
      return;
    }
    (here == below ? root->lo : root->hi) = at;
  }

  /// Narrows the roots until all points of the line are in a proved order, and puts them in it.
  std::vector<int> order(SideLine& line) {
    std::vector<int> sorted(line.points.size());
    for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k] = static_cast<int>(k);
    constexpr int kMostRounds = 2000;
    for (int round = 0; round < kMostRounds && fault_.empty(); ++round) {
      std::sort(sorted.begin(), sorted.end(), [&](int a, int b) {
        const LinePoint &p = line.points[a], &q = line.points[b];
        return p.lo != q.lo ? p.lo < q.lo : p.hi < q.hi;
      });
      bool apart = true;
      for (std::size_t k = 0; k + 1 < sorted.size() && fault_.empty(); ++k) {
        LinePoint &p = line.points[sorted[k]], &q = line.points[sorted[k + 1]];
        if (p.hi <= q.lo) continue;
        apart = false;
        // A corner in the inside of a root's interval cuts it, else both are halved.
        if (q.surface < 0) {
          narrow(line, &p, q.lo);
        } else {
          narrow(line, &p, (p.lo + p.hi) / 2);
          if (q.lo < q.hi) narrow(line, &q, (q.lo + q.hi) / 2);
        }
      }
      if (apart) return sorted;
    }
    if (fault_.empty()) fault_ = "points on an edge of cells cannot be put in order";
    return sorted;
  }

  void sweep(SideLine& line, const std::function<void(int, int, int, int)>& tell) {
    const std::vector<int> sorted = order(line);
    if (!fault_.empty()) return;
    std::vector<int> rank(sorted.size());
    for (std::size_t k = 0; k < sorted.size(); ++k) rank[sorted[k]] = static_cast<int>(k);
    for (SidePiece& piece : line.pieces) {
      for (int& end : piece.ends) end = rank[end];
      if (piece.ends[0] > piece.ends[1]) std::swap(piece.ends[0], piece.ends[1]);
    }
    std::sort(line.pieces.begin(), line.pieces.end(),
              [](const SidePiece& a, const SidePiece& b) { return a.ends < b.ends; });
    // Pieces that overlap are told of one after the other: each with that which reaches farthest of
    // those before it.
    const SidePiece* farthest = nullptr;
    for (const SidePiece& piece : line.pieces) {
      if (farthest && piece.ends[0] < farthest->ends[1])
        tell(farthest->facet, farthest->face, piece.facet, piece.face);
      if (!farthest || piece.ends[1] > farthest->ends[1]) farthest = &piece;
    }
  }

  const SurfaceEncasement& e_;
  std::vector<std::optional<FilteredFunction<3>>> functions_;
  Kernel kernel_;
  std::vector<int> plane_names_;
  std::map<std::array<int, 2>, SideLine> lines_;
  std::string fault_;
};

}  // namespace

void for_neighbours_along_lines(
    const SurfaceEncasement& encasement,
    const std::function<void(int facet, int face, int other_facet, int other_face)>& tell,
    std::string* fault) {
  *fault = SideLines(encasement).run(tell);
}

}  // namespace encase
