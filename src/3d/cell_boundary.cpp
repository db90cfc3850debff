// SPDX-License-Identifier: MIT
#include "3d/cell_boundary.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "common/union_find.hpp"

namespace encase {

namespace {

/// A half-edge of a surface in the direction of its loop.
struct Step {
  FacetEdge edge;
  int from = -1, to = -1;  ///< facet points; -1 without vertices
  bool used = false;
};

/// The coordinates of a side's ends: the first that differs.
std::array<Rational, 2> ends_of_side(const PlaneChart& chart, const RationalPoint<2>& from,
                                     const RationalPoint<2>& to) {
  const auto [u, v] = chart.axes();
  const std::array<Rational, 4>& plane = chart.plane();
  if (plane[u] == 0 && plane[v] == 0) {
    // The third coordinate is the same everywhere.
    const std::size_t lower = u < v ? 0 : 1;
    const std::size_t first = from[lower] != to[lower] ? lower : 1 - lower;
    return {from[first], to[first]};
  }
  const RationalPoint<3> start = chart.lift(from), end = chart.lift(to);
  std::size_t axis = 0;
  while (start[axis] == end[axis]) ++axis;
  return {start[axis], end[axis]};
}

/// Components of what a surface leaves of some facets.
class SignComponents {
 public:
  SignComponents(const CellBoundary& boundary, int surface,
                 const std::function<bool(int)>& is_included)
      : boundary_(boundary), surface_(surface) {
    for (const int f : boundary.facets())
      if (is_included(f)) facets_.push_back(f);
  }

  int count(Sign sign) {
    std::size_t faces = 0;
    for (const int f : facets_) {
      first_node_[f] = static_cast<int>(faces);
      const std::size_t n = boundary_.facet(f).arrangement.faces.size();
      faces += std::max<std::size_t>(n, 1);
    }
    for (const int f : facets_) join_within(f);
    join_along_lines(static_cast<int>(faces));
    UnionFind sets(static_cast<std::size_t>(next_node_));
    for (const auto& [a, b] : joined_) sets.join(a, b);
    std::vector<int> roots;
    for (const int f : facets_) collect(f, sign, sets, &roots);
    std::sort(roots.begin(), roots.end());
    return static_cast<int>(std::unique(roots.begin(), roots.end()) - roots.begin());
  }

 private:
  /// The node of a face; all of a facet that the surface does not meet are one.
  int node(int facet, int face) const {
    const int first = first_node_.at(facet);
    return boundary_.curve_of(facet, surface_) < 0 ? first : first + face;
  }

  void join_within(int index) {
    const int curve = boundary_.curve_of(index, surface_);
    if (curve < 0) return;
    const Arrangement& a = boundary_.facet(index).arrangement;
    for (std::size_t e = 0; e < a.edges.size(); ++e) {
      if (a.edges[e].curve < 0 || a.edges[e].curve == curve) continue;
      const auto [left, right] = a.faces_at(static_cast<int>(e));
      joined_.emplace_back(node(index, left), node(index, right));
    }
  }

  void collect(int index, Sign sign, UnionFind& sets, std::vector<int>* roots) {
    const int curve = boundary_.curve_of(index, surface_);
    if (curve < 0) {
      if (boundary_.sign_at_corner(surface_, index) == sign)
        roots->push_back(sets.find(node(index, 0)));
      return;
    }
    const Arrangement& a = boundary_.facet(index).arrangement;
    for (std::size_t face = 0; face < a.faces.size(); ++face)
      if (static_cast<int>(face) != a.outside &&
          a.faces[face].signs[static_cast<std::size_t>(curve)] == sign)
        roots->push_back(sets.find(node(index, static_cast<int>(face))));
  }

  /// The nodes along a side, in the direction of the coordinate; between them lie the surface's
  /// crossings with the line.
  std::vector<std::vector<int>> nodes_along(const SidePart& part) const {
    std::vector<std::vector<int>> gaps(1);
    const int curve = boundary_.curve_of(part.facet, surface_);
    if (curve < 0) return {{node(part.facet, 0)}};
    const Facet& facet = boundary_.facet(part.facet);
    const Arrangement& a = facet.arrangement;
    int vertex = part.side;
    do {
      const auto h =
          static_cast<std::size_t>(a.vertices[static_cast<std::size_t>(vertex)].half_edge);
      gaps.back().push_back(node(part.facet, a.half_edges[h].face));
      vertex = a.half_edges[h ^ 1].origin;
      const Arrangement::Vertex& end = a.vertices[static_cast<std::size_t>(vertex)];
      if (end.kind == Arrangement::Vertex::Kind::OnBoundary &&
          facet.encasement.line_crossings[static_cast<std::size_t>(end.index)].curve == curve)
        gaps.emplace_back();
    } while (a.vertices[static_cast<std::size_t>(vertex)].kind !=
             Arrangement::Vertex::Kind::Corner);
    if (!part.forward) std::reverse(gaps.begin(), gaps.end());
    return gaps;
  }

  /// The facets on both sides of a line cover the same of it, in different parts. So what lies
  /// behind equally many crossings from where they begin is the same gap between crossings; all
  /// faces at a gap belong together.
  void join_along_lines(int first_gap) {
    next_node_ = first_gap;
    std::map<std::tuple<std::array<int, 2>, Rational, int>, int> node_of_gap;
    int crossings = 0;
    const SidePart* before = nullptr;
    const Rational* begin = nullptr;
    for (const SidePart& part : boundary_.side_parts()) {
      if (first_node_.count(part.facet) == 0) continue;
      if (!before || part.chain() != before->chain() || part.lo != before->hi) {
        crossings = 0;
        begin = &part.lo;
      }
      before = &part;
      const auto gaps = nodes_along(part);
      for (std::size_t g = 0; g < gaps.size(); ++g) {
        const auto [gap, is_new] = node_of_gap.try_emplace(
            {part.line, *begin, crossings + static_cast<int>(g)}, next_node_);
        next_node_ += is_new ? 1 : 0;
        for (const int n : gaps[g]) joined_.emplace_back(n, gap->second);
      }
      crossings += static_cast<int>(gaps.size()) - 1;
    }
  }

  const CellBoundary& boundary_;
  int surface_;
  std::vector<int> facets_;
  std::map<int, int> first_node_;
  std::vector<std::pair<int, int>> joined_;
  int next_node_ = 0;
};

}  // namespace

int CellBoundary::curve_of(int index, int surface) const {
  const std::vector<int>& list = facet(index).surfaces;
  const auto at = std::lower_bound(list.begin(), list.end(), surface);
  return at != list.end() && *at == surface ? static_cast<int>(at - list.begin()) : -1;
}

// Where the patch lies. Let m be the normal of the facet's plane, T the direction of a half-edge
// that has f > 0 to the left, seen from where m points. Then grad f = a m x T + b m with a > 0, and
// into the patch that lies to the left of T, seen from where f > 0, points grad f x T = - a m +
// b m x T: to the plane's negative side. So these half-edges belong to a cell there; to one on the
// positive side belong those with f < 0 to the left.
std::optional<std::vector<BoundaryLoop>> CellBoundary::loops(int surface) const {
  std::vector<Step> steps;
  for (const int index : facets_) {
    const int curve = curve_of(index, surface);
    if (curve < 0) continue;
    const Facet& f = facet(index);
    const Arrangement& a = f.arrangement;
    const Sign left = is_below(index) ? Sign::Positive : Sign::Negative;
    for (std::size_t e = 0; e < a.edges.size(); ++e) {
      if (a.edges[e].curve != curve) continue;
      std::size_t h = 2 * e;
      const int face = a.half_edges[h].face;
      if (a.faces[static_cast<std::size_t>(face)].signs[static_cast<std::size_t>(curve)] != left)
        ++h;
      const auto point = [&](int vertex) {
        return vertex < 0 ? -1 : f.points[static_cast<std::size_t>(vertex)];
      };
      steps.push_back({{index, static_cast<int>(h)},
                       point(a.half_edges[h].origin),
                       point(a.half_edges[h ^ 1].origin)});
    }
  }
  std::map<int, std::size_t> step_from;
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k].from >= 0 && !step_from.emplace(steps[k].from, k).second) return std::nullopt;
  std::vector<BoundaryLoop> result;
  for (Step& first : steps) {
    if (first.used) continue;
    BoundaryLoop& loop = result.emplace_back();
    Step* step = &first;
    while (!step->used) {
      step->used = true;
      loop.edges.push_back(step->edge);
      loop.points.push_back(step->from);
      if (step->from < 0) break;
      const auto next = step_from.find(step->to);
      if (next == step_from.end()) return std::nullopt;
      step = &steps[next->second];
    }
    if (step != &first) return std::nullopt;
  }
  return result;
}

int CellBoundary::components(int surface, Sign sign,
                             const std::function<bool(int)>& is_included) const {
  return SignComponents(*this, surface, is_included).count(sign);
}

const std::vector<SidePart>& CellBoundary::side_parts() const {
  if (!side_parts_.empty()) return side_parts_;
  for (const int index : facets_) {
    const Facet& f = facet(index);
    const auto& corners = f.polygon.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      auto [from, to] =
          ends_of_side(complex_.charts.of(f.plane), corners[k], corners[(k + 1) % corners.size()]);
      SidePart part;
      part.facet = index;
      part.side = static_cast<int>(k);
      part.line = {std::min(f.plane, f.side_planes[k]), std::max(f.plane, f.side_planes[k])};
      part.plane = f.plane;
      part.forward = from < to;
      part.lo = std::move(part.forward ? from : to);
      part.hi = std::move(part.forward ? to : from);
      side_parts_.push_back(std::move(part));
    }
  }
  std::sort(side_parts_.begin(), side_parts_.end(), [](const SidePart& a, const SidePart& b) {
    return a.chain() != b.chain() ? a.chain() < b.chain() : a.lo < b.lo;
  });
  return side_parts_;
}

Sign CellBoundary::sign_at_corner(int surface, int index) const {
  const Facet& f = facet(index);
  const RationalPoint<3> corner = complex_.charts.of(f.plane).lift(f.polygon.corners.front());
  return complex_.surfaces[static_cast<std::size_t>(surface)].sign_at(corner, complex_.kernel);
}

}  // namespace encase
