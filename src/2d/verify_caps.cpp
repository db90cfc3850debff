// SPDX-License-Identifier: MIT
#include "2d/verify_caps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "common/union_find.hpp"
#include "common/verify_functions.hpp"
#include "common/well_formed.hpp"

namespace encase {
namespace verification {
namespace {

bool is_label(CapsLabel label) {
  return label >= CapsLabel::Empty && label <= CapsLabel::Indeterminate;
}

void check_header(CapsClaims& claims) {
  const CapsResult& r = claims.result;
  claims.require(r.answer >= CapsClass::Exact && r.answer <= CapsClass::Undecided,
                 "The answer is none that there is.");
  claims.require(std::isfinite(r.epsilon) && r.epsilon > 0 && r.delta == 2 * r.epsilon,
                 "Epsilon is not positive, or delta not twice that.");
  claims.require(ordered(r.box) && r.box.width(0) > 0 && r.box.width(1) > 0 &&
                     finite(Point<2>{r.box.width(0), r.box.width(1)}),
                 "The box has no area.");
  claims.require(!r.curves.empty(), "There are no curves.");
  for (std::size_t c = 0; c < r.curves.size(); ++c)
    claims.require(is_proper(r.curves[c].function), "Curve ", c, " is a constant, or too large.");
  bool sets = !r.curve_sets.empty() && r.curve_sets[0].empty();
  for (const std::vector<int>& set : r.curve_sets)
    sets = sets && ascending(set) && all_in_range(set, r.curves);
  sets = sets && std::set(r.curve_sets.begin(), r.curve_sets.end()).size() == r.curve_sets.size();
  claims.require(sets, "The sets of curves are not different ones, the first of them empty.");
}

/// Every index is in range, every number finite, every enumerator named. All else relies on it.
bool check_caps_structure(CapsClaims& claims) {
  const CapsResult& r = claims.result;
  check_header(claims);
  for (std::size_t k = 0; k < r.leaves.size() && !claims.full(); ++k) {
    const CapsLeaf& leaf = r.leaves[k];
    claims.require(is_label(leaf.label) && in_range(leaf.curves, r.curve_sets) &&
                       in_range(leaf.region, r.regions) && leaf.graph_axis >= -1 &&
                       leaf.graph_axis <= 1 && ordered(leaf.box),
                   "Leaf ", k, " has a label, an index or a box that cannot be.");
  }
  for (std::size_t k = 0; k < r.regions.size() && !claims.full(); ++k) {
    const CapsRegion& region = r.regions[k];
    claims.require(is_label(region.label) && in_range(region.curves, r.curve_sets) &&
                       ordered(region.box) && all_in_range(region.neighbours, r.regions),
                   "Region ", k, " has a label, an index or a box that cannot be.");
  }
  for (std::size_t k = 0; k < r.vertices.size() && !claims.full(); ++k) {
    const CapsVertex& vertex = r.vertices[k];
    const bool boundary = vertex.kind == CapsVertex::Kind::Boundary;
    claims.require(vertex.kind >= CapsVertex::Kind::Crossing &&
                       vertex.kind <= CapsVertex::Kind::Boundary && ordered(vertex.box) &&
                       all_in_range(vertex.curves, r.curves) &&
                       (boundary ? vertex.region == -1 && vertex.curves.size() == 1
                                 : in_range(vertex.region, r.regions)),
                   "Vertex ", k, " has a kind, an index or a box that cannot be.");
  }
  for (std::size_t k = 0; k < r.edges.size() && !claims.full(); ++k) {
    const CapsEdge& edge = r.edges[k];
    claims.require(in_range(edge.curve, r.curves) && all_in_range(edge.vertices, r.vertices) &&
                       std::is_sorted(edge.vertices.begin(), edge.vertices.end()) &&
                       std::all_of(edge.polyline.begin(), edge.polyline.end(),
                                   [](const Point<2>& p) { return finite(p); }),
                   "Edge ", k, " has an index or a point that cannot be.");
  }
  return claims.report.objections.empty();
}

/// What a leaf says of the curves: `alive` are those that are not proved to be absent from boxes
/// around it.
void check_leaf(CapsClaims& claims, int k, const Box<2>& box, const std::vector<int>& alive) {
  const CapsLeaf& leaf = claims.leaf(k);
  const std::vector<int>& here = claims.curves_of(leaf);
  const auto listed = [&](int c) { return std::binary_search(here.begin(), here.end(), c); };
  const double epsilon = claims.result.epsilon;
  for (const int c : alive) {
    if (listed(c)) continue;
    CurveBounds& f = claims.curve(c);
    const auto there = has_point(f, box, f.look(box), epsilon);
    claims.require(there.has_value() && !*there, "Curve ", c, " is not proved absent from leaf ", k,
                   ".");
  }
  bool fits = false;
  switch (leaf.label) {
    case CapsLabel::Empty:
      fits = here.empty();
      break;
    case CapsLabel::OneCurve: {
      fits = here.size() == 1;
      if (!fits) break;
      CurveBounds& f = claims.curve(here[0]);
      const auto there = has_point(f, box, f.look(box), epsilon);
      claims.require(there.has_value() && *there, "Curve ", here[0],
                     " is not proved to have a point in leaf ", k, ".");
      break;
    }
    case CapsLabel::Several:
      fits = here.size() > 1 && box.largest_width() <= epsilon;
      break;
    case CapsLabel::Indeterminate:
      fits = !here.empty();
      break;
  }
  claims.require(fits, "The label of leaf ", k, " does not fit its curves or its size.");
  if (leaf.graph_axis < 0) return;
  bool graph = here.size() == 1;
  if (graph) {
    const CurveBounds::Slopes slopes = claims.curve(here[0]).slopes(box);
    const Interval across = slopes.slope[static_cast<std::size_t>(1 - leaf.graph_axis)];
    graph = slopes.smooth && (across.lo > 0 || across.hi < 0);
  }
  claims.require(graph, "The curve in leaf ", k, " is not proved to be a graph over its axis.");
}

/// The leaves are those of the quadtree, each once, and what they say of the curves is so.
bool check_tree(CapsClaims& claims) {
  const CapsResult& r = claims.result;
  struct Node {
    Box<2> box;
    int depth = 0;
    std::vector<int> alive;
  };
  std::vector<Node> stack(1);
  stack[0].box = r.box;
  for (std::size_t c = 0; c < r.curves.size(); ++c) stack[0].alive.push_back(static_cast<int>(c));
  std::vector<bool> seen(r.leaves.size());
  bool tiles = r.nodes == static_cast<std::int64_t>(r.tokens.size());
  for (std::size_t t = 0; t < r.tokens.size() && tiles && !claims.full(); ++t) {
    if (stack.empty()) {
      tiles = false;
      break;
    }
    Node node = std::move(stack.back());
    stack.pop_back();
    std::erase_if(node.alive, [&](int c) { return claims.curve(c).look(node.box).absent; });
    const int k = r.tokens[t];
    if (k == CapsResult::kDivided) {
      const std::array<Box<2>, 4> parts = caps_quarters(node.box);
      for (int i = 0; i < 2; ++i)
        tiles = tiles && node.box.lo[i] < parts[0].hi[i] && parts[0].hi[i] < node.box.hi[i];
      for (std::size_t part = 4; part-- > 0;)
        stack.push_back({parts[part], node.depth + 1, node.alive});
      continue;
    }
    tiles = in_range(k, r.leaves) && !seen[static_cast<std::size_t>(k)] &&
            claims.leaf(k).box == node.box && claims.leaf(k).depth == node.depth;
    if (!tiles) break;
    seen[static_cast<std::size_t>(k)] = true;
    check_leaf(claims, k, node.box, node.alive);
  }
  if (claims.full()) return false;
  tiles = tiles && stack.empty() && std::find(seen.begin(), seen.end(), false) == seen.end();
  return claims.require(tiles, "The leaves are not those of the quadtree, each once.");
}

bool is_singular(const CapsClaims& claims, const CapsLeaf& leaf) {
  return claims.result.self_crossings && leaf.graph_axis < 0 && claims.curves_of(leaf).size() == 1;
}

/// Regions are the connected sets of equal leaves, and what they say of these is so.
void check_caps_regions(CapsClaims& claims, const std::vector<SharedSide>& sides) {
  const CapsResult& r = claims.result;
  UnionFind sets(r.leaves.size());
  std::vector<std::set<int>> neighbours(r.regions.size());
  for (const SharedSide& side : sides) {
    const CapsLeaf &a = claims.leaf(side.lower), &b = claims.leaf(side.upper);
    if (a.curves == b.curves && is_singular(claims, a) == is_singular(claims, b)) {
      sets.join(side.lower, side.upper);
    } else if (a.region != b.region) {
      neighbours[static_cast<std::size_t>(a.region)].insert(b.region);
      neighbours[static_cast<std::size_t>(b.region)].insert(a.region);
    }
  }
  std::vector<CapsRegion> found(r.regions.size());
  std::vector<int> set_of(r.regions.size(), -1);
  for (std::size_t k = 0; k < r.leaves.size() && !claims.full(); ++k) {
    const CapsLeaf& leaf = r.leaves[k];
    const auto number = static_cast<std::size_t>(leaf.region);
    const int set = sets.find(static_cast<int>(k));
    CapsRegion& region = found[number];
    if (region.leaves == 0) {
      region = {leaf.label, leaf.curves, is_singular(claims, leaf), 0, leaf.box, {}, false};
      set_of[number] = set;
    }
    claims.require(set_of[number] == set, "Leaf ", k, " is not in the region of its neighbours.");
    ++region.leaves;
    region.box = hull(region.box, leaf.box);
    const bool one = claims.curves_of(leaf).size() == 1;
    if (leaf.label == (one ? CapsLabel::OneCurve : CapsLabel::Indeterminate))
      region.label = leaf.label;
  }
  // One set of equal leaves in two regions would make these neighbours of equal curves.
  std::set<int> sets_found(set_of.begin(), set_of.end());
  claims.require(sets_found.size() == r.regions.size(), "Regions are parts of larger ones.");
  for (std::size_t k = 0; k < r.regions.size() && !claims.full(); ++k) {
    const CapsRegion &a = r.regions[k], &b = found[k];
    claims.require(a.label == b.label && a.curves == b.curves && a.singular == b.singular &&
                       a.leaves == b.leaves && a.box == b.box &&
                       std::equal(a.neighbours.begin(), a.neighbours.end(), neighbours[k].begin(),
                                  neighbours[k].end()),
                   "Region ", k, " is not what its leaves make it.");
  }
}

/// The obstacles are those that there are, and the answer is what they make it.
void check_answer(CapsClaims& claims) {
  const CapsResult& r = claims.result;
  CapsObstacles found;
  for (const CapsLeaf& leaf : r.leaves) {
    const std::size_t curves = claims.curves_of(leaf).size();
    if (curves == 1 && leaf.graph_axis < 0) ++found.unexamined_leaves;
    if (curves > 1 && leaf.label == CapsLabel::Indeterminate) ++found.indeterminate_leaves;
  }
  for (const CapsVertex& vertex : r.vertices)
    if (vertex.kind != CapsVertex::Kind::Crossing && vertex.kind != CapsVertex::Kind::Boundary)
      ++found.open_vertices;
  for (const CapsEdge& edge : r.edges)
    if (!edge.proved) ++found.open_edges;
  claims.require(found == r.obstacles, "The obstacles are not those that there are.");
  claims.require(r.answer == CapsClass::Undecided ||
                     r.answer == (found.any() ? CapsClass::DeltaWeak : CapsClass::Exact),
                 "The answer is not what the obstacles make it.");
}

}  // namespace

std::vector<SharedSide> shared_sides(const CapsResult& result) {
  std::vector<SharedSide> sides;
  for (int axis = 0; axis < 2; ++axis) {
    const int along = 1 - axis;
    // The leaves by where they begin, from there upwards.
    std::map<double, std::vector<std::pair<double, int>>> beginning;
    const int count = static_cast<int>(result.leaves.size());
    const auto box = [&](int k) -> const Box<2>& {
      return result.leaves[static_cast<std::size_t>(k)].box;
    };
    for (int k = 0; k < count; ++k) beginning[box(k).lo[axis]].emplace_back(box(k).lo[along], k);
    for (auto& [at, list] : beginning) std::sort(list.begin(), list.end());
    for (int k = 0; k < count; ++k) {
      const auto found = beginning.find(box(k).hi[axis]);
      if (found == beginning.end()) continue;
      const auto& list = found->second;
      auto next = std::upper_bound(list.begin(), list.end(), std::pair(box(k).lo[along], count));
      if (next != list.begin() && box(std::prev(next)->second).hi[along] > box(k).lo[along]) --next;
      for (; next != list.end() && next->first < box(k).hi[along]; ++next)
        sides.push_back({k, next->second, axis});
    }
  }
  return sides;
}

}  // namespace verification

Verification verify(const CapsResult& result, const VerifyOptions& options) {
  using namespace verification;
  CapsClaims claims(result, options);
  if (!check_caps_structure(claims)) return std::move(claims.report);
  for (const NamedCurve& curve : result.curves) claims.curves.emplace_back(curve.function);
  if (check_tree(claims)) {
    const std::vector<SharedSide> sides = shared_sides(result);
    check_caps_regions(claims, sides);
    if (!claims.full()) check_caps_graph(claims, sides);
    if (!claims.full()) check_answer(claims);
  }
  return std::move(claims.report);
}

}  // namespace encase
