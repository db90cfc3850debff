// SPDX-License-Identifier: MIT
#include "3d/patch_faces.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/filtered_function.hpp"
#include "common/union_find.hpp"

namespace encase {

FacetTables::FacetTables(const SurfaceEncasement& encasement)
    : e_(encasement), crossings_(encasement.facet_points.size()) {
  for (std::size_t f = 0; f < e_.facets.size(); ++f) {
    const Facet& facet = e_.facets[f];
    for (std::size_t v = 0; v < facet.points.size(); ++v)
      if (facet.arrangement.vertices[v].kind == Arrangement::Vertex::Kind::Crossing &&
          facet.points[v] >= 0)
        crossings_[facet.points[v]] = {static_cast<int>(f), static_cast<int>(v)};
  }
}

Sign FacetTables::sign(int facet, int face, int surface) const {
  const Facet& f = e_.facets[facet];
  const auto here = std::find(f.surfaces.begin(), f.surfaces.end(), surface);
  if (here != f.surfaces.end()) return f.arrangement.faces[face].signs[here - f.surfaces.begin()];
  for (const int cell : f.cells)
    if (cell >= 0 && e_.cells[cell].signs[surface] != Sign::Zero)
      return e_.cells[cell].signs[surface];
  // It is constant on the facet's plane.
  const auto corner = PlaneChart(e_.planes[f.plane].exact()).lift(f.polygon.corners[0]);
  Kernel kernel;
  return FilteredFunction<3>(e_.surfaces[surface].function).sign_at(corner, kernel);
}

Sign FacetTables::sign_along(const FacetEdge& edge, int surface) const {
  return sign(edge.facet, e_.facets[edge.facet].arrangement.half_edges[edge.half_edge].face,
              surface);
}

std::vector<Sign> FacetTables::signs_around(int facet_point) const {
  std::vector<Sign> signs(e_.surfaces.size(), Sign::Zero);
  const Corner& corner = crossings_[facet_point];
  if (corner.facet < 0) return signs;
  const Arrangement& arrangement = e_.facets[corner.facet].arrangement;
  const int face = arrangement.half_edges[arrangement.vertices[corner.vertex].half_edge].face;
  const auto& own = e_.facet_points[facet_point].surfaces;
  for (std::size_t k = 0; k < signs.size(); ++k)
    if (std::find(own.begin(), own.end(), static_cast<int>(k)) == own.end())
      signs[k] = sign(corner.facet, face, static_cast<int>(k));
  return signs;
}

std::array<int, 2> FacetTables::ends(const FacetEdge& edge) const {
  const Facet& facet = e_.facets[edge.facet];
  const auto origin = [&](int half_edge) {
    const int vertex = facet.arrangement.half_edges[half_edge].origin;
    return vertex < 0 ? -1 : facet.points[vertex];
  };
  return {origin(edge.half_edge), origin(Arrangement::twin(edge.half_edge))};
}

namespace {

/// Joins what borders on the same face of a patch: edges of its loop and the two sides of each
/// piece of an arc on it. At a point where an arc leaves the loop these are an edge of the loop on
/// which the arc's other surface has a sign, and the arc's side with that sign; at a triple point
/// the sides of two arcs that see each other. (The loop and the arcs are connected, so that every
/// face of the disc has a connected boundary.)
class PatchCutter {
 public:
  PatchCutter(const SurfaceEncasement& encasement, const FacetTables& facets, const SpaceCell& cell)
      : e_(encasement), facets_(facets), cell_(cell), sets_(count(cell)) {
    number();
  }

  PatchFaces run(std::string* fault) {
    for (std::size_t p = 0; p < cell_.patches.size(); ++p) join_along_loop(static_cast<int>(p));
    for (std::size_t a = 0; a < cell_.arcs.size() && fault_.empty(); ++a)
      follow(static_cast<int>(a));
    for (std::size_t a = 0; a < cell_.arcs.size() && fault_.empty(); ++a) {
      const SurfaceArc& arc = cell_.arcs[a];
      join_at_loop(static_cast<int>(a), 0, arc.ends[0]);
      join_at_loop(static_cast<int>(a), static_cast<int>(arc.triple_points.size()), arc.ends[1]);
    }
    if (fault_.empty()) join_at_triple_points();
    if (fault_.empty()) name_faces();
    *fault = fault_;
    return std::move(result_);
  }

 private:
  static std::size_t count(const SpaceCell& cell) {
    std::size_t n = 0;
    for (const SurfacePatch& patch : cell.patches) n += std::max<std::size_t>(1, patch.loop.size());
    for (const SurfaceArc& arc : cell.arcs) n += 4 * (arc.triple_points.size() + 1);
    return n;
  }

  void number() {
    int next = 0;
    for (const SurfacePatch& patch : cell_.patches) {
      first_edge_.push_back(next);
      next += static_cast<int>(std::max<std::size_t>(1, patch.loop.size()));
    }
    for (const SurfaceArc& arc : cell_.arcs) {
      first_piece_.push_back(next);
      next += 4 * static_cast<int>(arc.triple_points.size() + 1);
    }
    result_.arc_pieces.resize(cell_.arcs.size());
  }
  int edge(int patch, int k) const { return first_edge_[patch] + k; }
  /// The side of an arc's piece on the patch of its surface `which`, where the other has the sign.
  int side(int arc, int piece, int which, Sign sign) const {
    return first_piece_[arc] + 4 * piece + 2 * which + side_index(sign);
  }

  /// No arc begins where a loop passes from one facet to another.
  void join_along_loop(int p) {
    std::map<int, int> edge_at;
    const auto& loop = cell_.patches[p].loop;
    for (std::size_t k = 0; k < loop.size(); ++k)
      for (const int point : facets_.ends(loop[k])) {
        if (point < 0 || e_.facet_points[point].planes[1] < 0) continue;
        const auto [at, fresh] = edge_at.emplace(point, static_cast<int>(k));
        if (!fresh) sets_.join(edge(p, static_cast<int>(k)), edge(p, at->second));
      }
  }

  /// The signs along an arc: at each triple point that of the third surface changes.
  void follow(int a) {
    const SurfaceArc& arc = cell_.arcs[a];
    std::vector<Sign> signs = facets_.signs_around(arc.ends[0]);
    auto& pieces = result_.arc_pieces[a];
    pieces.push_back({signs, {}});
    for (const int t : arc.triple_points) {
      for (const int third : e_.triple_points[t].surfaces)
        if (third != arc.surfaces[0] && third != arc.surfaces[1]) signs[third] = -signs[third];
      pieces.push_back({signs, {}});
    }
    // Of all but its own two surfaces the signs are proved.
    if (std::count(signs.begin(), signs.end(), Sign::Zero) != 2)
      fault_ = "a surface has no sign along an arc";
    if (signs != facets_.signs_around(arc.ends[1]))
      fault_ = "the signs along an arc do not lead to its end";
  }

  void join_at_loop(int a, int piece, int point) {
    const SurfaceArc& arc = cell_.arcs[a];
    for (int which = 0; which < 2; ++which) {
      const int p = arc.patches[which];
      const SurfacePatch& patch = cell_.patches[p];
      std::array<int, 2> met{};
      for (std::size_t k = 0; k < patch.loop.size(); ++k) {
        const auto ends = facets_.ends(patch.loop[k]);
        if (ends[0] != point && ends[1] != point) continue;
        const Sign sign = facets_.sign_along(patch.loop[k], arc.surfaces[1 - which]);
        if (sign == Sign::Zero) continue;
        ++met[side_index(sign)];
        sets_.join(edge(p, static_cast<int>(k)), side(a, piece, which, sign));
      }
      if (met[0] != 1 || met[1] != 1) fault_ = "an arc does not end on the loop of its patch";
    }
  }

  void join_at_triple_points() {
    /// Where a triple point lies on the arcs: the piece before it.
    struct Place {
      int arc, piece;
    };
    std::map<int, std::vector<Place>> places;
    for (std::size_t a = 0; a < cell_.arcs.size(); ++a)
      for (std::size_t k = 0; k < cell_.arcs[a].triple_points.size(); ++k)
        places[cell_.arcs[a].triple_points[k]].push_back(
            {static_cast<int>(a), static_cast<int>(k)});
    for (const auto& [point, through] : places) {
      if (through.size() != 3) {
        fault_ = "a triple point does not lie on three arcs";
        return;
      }
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          if (i != j) join_arcs(through[i].arc, through[i].piece, through[j].arc, through[j].piece);
    }
  }

  /// At a triple point after the given pieces of two arcs, on the patch of the surface f that they
  /// share: where the arc with g has sign b of h, and the arc with h has sign a of g, the quadrant
  /// between them has both signs.
  void join_arcs(int first, int first_piece, int second, int second_piece) {
    const auto& s = cell_.arcs[first].surfaces;
    const auto& t = cell_.arcs[second].surfaces;
    const int which = s[0] == t[0] || s[0] == t[1] ? 0 : 1;
    const int f = s[which], g = s[1 - which];
    const int other = t[0] == f ? 0 : 1;
    const int h = t[1 - other];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const Sign b = result_.arc_pieces[first][first_piece + i].signs[h];
        const Sign a = result_.arc_pieces[second][second_piece + j].signs[g];
        sets_.join(side(first, first_piece + i, which, a),
                   side(second, second_piece + j, other, b));
      }
  }

  void name_faces() {
    std::map<int, int> names;
    const auto name = [&](int element, int patch) {
      const auto [at, fresh] =
          names.emplace(sets_.find(element), static_cast<int>(result_.patch_of.size()));
      if (fresh) result_.patch_of.push_back(patch);
      if (result_.patch_of[at->second] != patch) fault_ = "a face lies on two patches";
      return at->second;
    };
    for (std::size_t p = 0; p < cell_.patches.size(); ++p) {
      const int patch = static_cast<int>(p);
      const auto& loop = cell_.patches[p].loop;
      result_.at_loop.emplace_back();
      for (std::size_t k = 0; k < loop.size(); ++k)
        result_.at_loop.back().push_back(name(edge(patch, static_cast<int>(k)), patch));
      // Without arcs the edges of a loop bound one face.
      result_.of_sphere.push_back(loop.empty() ? name(edge(patch, 0), patch) : -1);
    }
    for (std::size_t a = 0; a < cell_.arcs.size(); ++a)
      for (std::size_t k = 0; k < result_.arc_pieces[a].size(); ++k)
        for (int which = 0; which < 2; ++which)
          for (const Sign sign : {Sign::Negative, Sign::Positive})
            result_.arc_pieces[a][k].sides[which][side_index(sign)] =
                name(side(static_cast<int>(a), static_cast<int>(k), which, sign),
                     cell_.arcs[a].patches[which]);
  }

  const SurfaceEncasement& e_;
  const FacetTables& facets_;
  const SpaceCell& cell_;
  UnionFind sets_;
  std::vector<int> first_edge_, first_piece_;
  PatchFaces result_;
  std::string fault_;
};

}  // namespace

PatchFaces cut_patches(const SurfaceEncasement& encasement, const FacetTables& facets, int cell,
                       std::string* fault) {
  return PatchCutter(encasement, facets, encasement.cells[cell]).run(fault);
}

}  // namespace encase
