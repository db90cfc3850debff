// SPDX-License-Identifier: MIT
#include "2d/caps_graph.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>

#include "2d/side_roots.hpp"
#include "common/union_find.hpp"

namespace encase {
namespace {

constexpr int kOutside = -1;

/// A point where a curve passes from one unit to another, in a piece of their common side. A unit
/// is a leaf of one curve, or a region that may be a vertex.
struct End {
  int curve = -1;
  Box<2> box;
  std::array<int, 2> units{};  ///< the second may be kOutside
};

/// Where one goes from an end within the units on both sides, as far as it is known: to another
/// end, or to a vertex (~vertex).
struct Links {
  std::array<int, 2> to{};
  int count = 0;
};

/// Pairs of ends that arcs of a curve join.
using Arcs = std::vector<std::array<int, 2>>;

class GraphMaker {
 public:
  GraphMaker(const CapsTree& tree, std::vector<CapsRegion>& regions,
             std::vector<CurveBounds>& curves, const std::function<bool()>& stop)
      : tree_(tree),
        regions_(regions),
        curves_(curves),
        stop_(stop),
        leaf_count_(static_cast<int>(tree.leaves.size())) {}

  CapsGraph make(bool polylines) {
    const std::size_t units = tree_.leaves.size() + regions_.size();
    open_.resize(units);
    find_ends();
    list_ends(units);
    links_.resize(ends_.size());
    sets_.emplace(ends_.size() + tree_.leaves.size());
    blob_.resize(tree_.leaves.size());
    vertex_of_region_.assign(regions_.size(), -1);
    for (std::size_t r = 0; r < regions_.size(); ++r)
      if (is_vertex_like(regions_[r])) settle_region(static_cast<int>(r));
    for (int leaf = 0; leaf < leaf_count_; ++leaf)
      if (unit_of(leaf) == leaf && !curves_in(leaf).empty()) settle_leaf(leaf);
    settle_boundary();
    for (const auto& [first, second] : open_sides_) join_openly(first, second);
    collect_edges(polylines);
    return std::move(graph_);
  }

 private:
  const CapsLeaf& leaf(int k) const { return tree_.leaves[static_cast<std::size_t>(k)]; }
  const std::vector<int>& curves_in(int k) const {
    return tree_.curve_sets[static_cast<std::size_t>(leaf(k).curves)];
  }
  CurveBounds& curve(int c) { return curves_[static_cast<std::size_t>(c)]; }
  const End& end(int e) const { return ends_[static_cast<std::size_t>(e)]; }
  bool is_vertex_like(const CapsRegion& region) const {
    return region.singular || tree_.curve_sets[static_cast<std::size_t>(region.curves)].size() > 1;
  }
  int unit_of(int k) const {
    const int region = leaf(k).region;
    return is_vertex_like(regions_[static_cast<std::size_t>(region)]) ? leaf_count_ + region : k;
  }
  bool is_leaf(int unit) const { return unit != kOutside && unit < leaf_count_; }

  void find_ends();
  void pass(int c, int first, int second, const Box<2>& segment, int along);
  void list_ends(std::size_t units);
  std::pair<const int*, const int*> ends_of(int unit) const {
    const std::size_t u = static_cast<std::size_t>(unit);
    return {unit_ends_.data() + first_end_[u], unit_ends_.data() + first_end_[u + 1]};
  }
  std::vector<int> ends_of(int unit, int c) const;

  std::optional<Arcs> pair_up(std::vector<int> ends, int axis) const;
  std::optional<bool> changes_between(int c, int first, int second);
  void settle_leaf(int k);
  void settle_region(int r);
  bool settle_meeting(int r);
  CapsVertex::Kind guess_meeting(int r, const std::vector<int>& pair);
  void settle_boundary();
  int add_vertex(CapsVertex::Kind kind, int region, std::vector<int> curves, const Box<2>& box);
  void add_link(int e, int to) {
    Links& links = links_[static_cast<std::size_t>(e)];
    links.to[static_cast<std::size_t>(links.count++)] = to;
  }
  void attach(int e, int vertex) {
    add_link(e, ~vertex);
    attached_.emplace_back(e, vertex);
  }
  void link(int a, int b) {
    add_link(a, b);
    add_link(b, a);
    sets_->join(a, b);
  }
  int item_of_blob(int k) const { return static_cast<int>(ends_.size()) + k; }
  void make_blob(int k) {
    blob_[static_cast<std::size_t>(k)] = true;
    const auto [from, to] = ends_of(k);
    for (const int* e = from; e != to; ++e) sets_->join(*e, item_of_blob(k));
  }
  void join_openly(int first, int second);
  void collect_edges(bool polylines);
  std::vector<Point<2>> walk(int start, bool closed) const;

  const CapsTree& tree_;
  std::vector<CapsRegion>& regions_;
  std::vector<CurveBounds>& curves_;
  const std::function<bool()>& stop_;
  std::int64_t sides_ = 0;  ///< looked at
  const int leaf_count_;
  std::vector<End> ends_;
  std::vector<bool> open_;  ///< units on a side of which the zeros of a curve are not known
  std::vector<std::array<int, 2>> open_sides_;
  std::vector<std::size_t> first_end_;  ///< by unit, in unit_ends_
  std::vector<int> unit_ends_;
  std::vector<Links> links_;           ///< of the ends
  std::optional<UnionFind> sets_;      ///< of ends, then of leaves that are blobs
  std::vector<bool> blob_;             ///< leaves in which it is not known what joins their ends
  std::vector<int> vertex_of_region_;  ///< or -1
  std::vector<std::pair<int, int>> attached_;  ///< ends and blobs to vertices
  CapsGraph graph_;
};

/// Where curves pass sides of units.
void GraphMaker::find_ends() {
  SharedSides(tree_, [&](int a, int b, int axis) {
    const int first = unit_of(a), second = unit_of(b);
    if (first == second) return;
    Box<2> segment = leaf(a).box;
    for (int i = 0; i < 2; ++i) {
      segment.lo[i] = std::max(segment.lo[i], leaf(b).box.lo[i]);
      segment.hi[i] = std::min(segment.hi[i], leaf(b).box.hi[i]);
    }
    for (const int c : curves_in(a))
      if (std::binary_search(curves_in(b).begin(), curves_in(b).end(), c))
        pass(c, first, second, segment, 1 - axis);
  });
  for (int k = 0; k < leaf_count_; ++k)
    for (int axis = 0; axis < 2; ++axis)
      for (const bool upper : {false, true}) {
        Box<2> segment = leaf(k).box;
        (upper ? segment.lo : segment.hi)[axis] = (upper ? segment.hi : segment.lo)[axis];
        if (segment.lo[axis] != (upper ? tree_.box.hi : tree_.box.lo)[axis]) continue;
        for (const int c : curves_in(k)) pass(c, unit_of(k), kOutside, segment, 1 - axis);
      }
}

/// Finds the ends of a curve on a common side of two units.
void GraphMaker::pass(int c, int first, int second, const Box<2>& segment, int along) {
  const auto unknown = [&](int unit) { return is_leaf(unit) && leaf(unit).graph_axis < 0; };
  const bool both_unknown = unknown(first) && unknown(second);
  if (++sides_ % 256 == 0 && !graph_.cut_short) graph_.cut_short = stop_ && stop_();
  std::optional<std::vector<Box<2>>> roots;
  if (!both_unknown && !graph_.cut_short) roots = side_roots(curve(c), segment, along);
  if (roots) {
    for (const Box<2>& root : *roots) ends_.push_back({c, root, {first, second}});
    return;
  }
  open_[static_cast<std::size_t>(first)] = true;
  if (second == kOutside) return;
  open_[static_cast<std::size_t>(second)] = true;
  open_sides_.push_back({first, second});
}

void GraphMaker::list_ends(std::size_t units) {
  first_end_.assign(units + 1, 0);
  for (const End& e : ends_)
    for (const int unit : e.units)
      if (unit != kOutside) ++first_end_[static_cast<std::size_t>(unit) + 1];
  for (std::size_t u = 0; u < units; ++u) first_end_[u + 1] += first_end_[u];
  unit_ends_.resize(first_end_.back());
  std::vector<std::size_t> next(first_end_.begin(), first_end_.end() - 1);
  for (std::size_t e = 0; e < ends_.size(); ++e)
    for (const int unit : ends_[e].units)
      if (unit != kOutside)
        unit_ends_[next[static_cast<std::size_t>(unit)]++] = static_cast<int>(e);
}

std::vector<int> GraphMaker::ends_of(int unit, int c) const {
  std::vector<int> result;
  const auto [from, to] = ends_of(unit);
  std::copy_if(from, to, std::back_inserter(result), [&](int e) { return end(e).curve == c; });
  return result;
}

/// The arcs of a curve that is a graph over `axis` in a box around the unit: at each of its ends
/// it passes into the unit or out of it, so that along the axis every second gap between ends is
/// an arc. Nothing if the order of the ends is not known.
std::optional<Arcs> GraphMaker::pair_up(std::vector<int> ends, int axis) const {
  if (ends.size() % 2) return std::nullopt;
  const auto lo = [&](int e) { return end(e).box.lo[axis]; };
  const auto hi = [&](int e) { return end(e).box.hi[axis]; };
  std::sort(ends.begin(), ends.end(),
            [&](int a, int b) { return std::pair(lo(a), hi(a)) < std::pair(lo(b), hi(b)); });
  for (std::size_t k = 1; k < ends.size(); ++k)
    if (hi(ends[k - 1]) > lo(ends[k])) return std::nullopt;
  Arcs arcs;
  for (std::size_t k = 0; k < ends.size(); k += 2) arcs.push_back({ends[k], ends[k + 1]});
  return arcs;
}

/// Whether curve c's function has different signs at two ends; nothing if one is not known.
std::optional<bool> GraphMaker::changes_between(int c, int first, int second) {
  const std::optional<Sign> a = curve(c).look(end(first).box).sign;
  const std::optional<Sign> b = curve(c).look(end(second).box).sign;
  if (!a || !b) return std::nullopt;
  return *a != *b;
}

/// The arcs of the only curve in a leaf, or a blob that joins all its ends.
void GraphMaker::settle_leaf(int k) {
  const CapsLeaf& l = leaf(k);
  if (l.graph_axis >= 0 && !open_[static_cast<std::size_t>(k)]) {
    const auto arcs = pair_up(ends_of(k, curves_in(k)[0]), l.graph_axis);
    if (arcs) {
      for (const auto& [a, b] : *arcs) link(a, b);
      return;
    }
  }
  make_blob(k);
}

/// A region where curves may meet: what is proved of it, or a vertex at which all its ends end.
void GraphMaker::settle_region(int r) {
  const CapsRegion& region = regions_[static_cast<std::size_t>(r)];
  const std::vector<int>& here = tree_.curve_sets[static_cast<std::size_t>(region.curves)];
  CapsVertex::Kind kind = CapsVertex::Kind::Several;
  if (region.singular) kind = CapsVertex::Kind::SelfCrossing;
  if (region.label == CapsLabel::Indeterminate && here.size() > 1)
    kind = CapsVertex::Kind::Indeterminate;
  else if (here.size() == 2) {
    if (settle_meeting(r)) return;
    kind = guess_meeting(r, here);
  }
  const int vertex = add_vertex(kind, r, here, region.box);
  const auto [from, to] = ends_of(leaf_count_ + r);
  for (const int* e = from; e != to; ++e) attach(*e, vertex);
}

/// Two curves that are graphs in a box around the region and have at most one common point there:
/// an arc of one has it if the other's function changes its sign along it. False if not proved.
bool GraphMaker::settle_meeting(int r) {
  CapsRegion& region = regions_[static_cast<std::size_t>(r)];
  const int unit = leaf_count_ + r;
  if (open_[static_cast<std::size_t>(unit)]) return false;
  const std::vector<int>& pair = tree_.curve_sets[static_cast<std::size_t>(region.curves)];
  const CurveBounds::Slopes f = curve(pair[0]).slopes(region.box);
  const CurveBounds::Slopes g = curve(pair[1]).slopes(region.box);
  const std::array<int, 2> axes{graph_axis(f), graph_axis(g)};
  if (axes[0] < 0 || axes[1] < 0) return false;
  const Interval jacobian = f.slope[0] * g.slope[1] - f.slope[1] * g.slope[0];
  if (!(jacobian.lo > 0 || jacobian.hi < 0)) return false;
  std::array<Arcs, 2> arcs;
  std::array<int, 2> through{-1, -1};  // the arc of either with the common point
  for (int i = 0; i < 2; ++i) {
    auto paired = pair_up(ends_of(unit, pair[i]), axes[i]);
    if (!paired) return false;
    arcs[i] = std::move(*paired);
    for (std::size_t k = 0; k < arcs[i].size(); ++k) {
      const auto changes = changes_between(pair[1 - i], arcs[i][k][0], arcs[i][k][1]);
      if (!changes || (*changes && through[i] >= 0)) return false;
      if (*changes) through[i] = static_cast<int>(k);
    }
  }
  if ((through[0] < 0) != (through[1] < 0)) return false;
  region.apart = through[0] < 0;
  int vertex = -1;
  if (!region.apart) vertex = add_vertex(CapsVertex::Kind::Crossing, r, pair, region.box);
  for (int i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < arcs[i].size(); ++k) {
      const auto [a, b] = arcs[i][k];
      if (static_cast<int>(k) == through[i])
        attach(a, vertex), attach(b, vertex);
      else
        link(a, b);
    }
  return true;
}

/// The paper's way: from the ends around the region. The curves meet an odd number of times if the
/// first one's ends lie an odd number of times on the second one's negative side.
CapsVertex::Kind GraphMaker::guess_meeting(int r, const std::vector<int>& pair) {
  if (open_[static_cast<std::size_t>(leaf_count_ + r)]) return CapsVertex::Kind::Indeterminate;
  const std::vector<int> ends = ends_of(leaf_count_ + r, pair[0]);
  bool odd = false;
  for (const int e : ends) {
    const std::optional<Sign> sign = curve(pair[1]).look(end(e).box).sign;
    if (!sign) return CapsVertex::Kind::Indeterminate;
    odd ^= *sign == Sign::Negative;
  }
  return odd ? CapsVertex::Kind::Odd : CapsVertex::Kind::Even;
}

void GraphMaker::settle_boundary() {
  for (std::size_t e = 0; e < ends_.size(); ++e) {
    const End& here = ends_[e];
    if (here.units[1] != kOutside) continue;
    attach(static_cast<int>(e), add_vertex(CapsVertex::Kind::Boundary, -1, {here.curve}, here.box));
  }
}

int GraphMaker::add_vertex(CapsVertex::Kind kind, int region, std::vector<int> curves,
                           const Box<2>& box) {
  const int vertex = static_cast<int>(graph_.vertices.size());
  graph_.vertices.push_back({kind, region, std::move(curves), box});
  if (region >= 0) vertex_of_region_[static_cast<std::size_t>(region)] = vertex;
  return vertex;
}

/// Two units between which a curve may pass, it is not known where.
void GraphMaker::join_openly(int first, int second) {
  if (!is_leaf(first)) std::swap(first, second);
  if (is_leaf(first) && is_leaf(second))
    sets_->join(item_of_blob(first), item_of_blob(second));
  else if (is_leaf(first))
    attached_.emplace_back(item_of_blob(first), vertex_of_region_[second - leaf_count_]);
}

/// The polyline from a vertex or, closed, from an end back to it.
std::vector<Point<2>> GraphMaker::walk(int start, bool closed) const {
  std::vector<Point<2>> points;
  const auto links = [&](int e) -> const std::array<int, 2>& {
    return links_[static_cast<std::size_t>(e)].to;
  };
  const auto visit_vertex = [&](int vertex) {
    const CapsVertex& v = graph_.vertices[static_cast<std::size_t>(vertex)];
    if (v.kind != CapsVertex::Kind::Boundary) points.push_back(v.box.center());
  };
  int slot = 0;
  if (!closed) {
    slot = links(start)[0] < 0 ? 0 : 1;
    visit_vertex(~links(start)[slot]);
    slot = 1 - slot;
  }
  for (int e = start;;) {
    points.push_back(end(e).box.center());
    const int to = links(e)[slot];
    if (to < 0) {
      visit_vertex(~to);
      break;
    }
    // Both links can lead to the same end.
    slot = links(to)[0] == e ? 1 : 0;
    if (links(to)[0] == e && links(to)[1] == e) slot = 1 - slot;
    e = to;
    if (e == start) break;
  }
  if (closed) points.push_back(points.front());
  return points;
}

void GraphMaker::collect_edges(bool polylines) {
  std::vector<int> number(ends_.size() + tree_.leaves.size(), -1);
  std::vector<int> start;  // of the polyline: an end next to a vertex, else any
  const auto edge_of = [&](int item, int c) -> CapsEdge& {
    int& edge = number[static_cast<std::size_t>(sets_->find(item))];
    if (edge < 0) {
      edge = static_cast<int>(graph_.edges.size());
      graph_.edges.push_back({c, {}, true, {}});
      start.push_back(item);
    }
    return graph_.edges[static_cast<std::size_t>(edge)];
  };
  for (std::size_t e = 0; e < ends_.size(); ++e) edge_of(static_cast<int>(e), ends_[e].curve);
  for (int k = 0; k < leaf_count_; ++k)
    if (blob_[static_cast<std::size_t>(k)])
      edge_of(item_of_blob(k), curves_in(k)[0]).proved = false;
  for (const auto& [item, vertex] : attached_) {
    const auto edge = static_cast<std::size_t>(number[static_cast<std::size_t>(sets_->find(item))]);
    graph_.edges[edge].vertices.push_back(vertex);
    start[edge] = item;
  }
  for (std::size_t k = 0; k < graph_.edges.size(); ++k) {
    CapsEdge& edge = graph_.edges[k];
    std::sort(edge.vertices.begin(), edge.vertices.end());
    if (edge.proved && polylines) edge.polyline = walk(start[k], edge.vertices.empty());
  }
}

}  // namespace

CapsGraph make_graph(const CapsTree& tree, std::vector<CapsRegion>& regions,
                     std::vector<CurveBounds>& curves, bool polylines,
                     const std::function<bool()>& stop) {
  return GraphMaker(tree, regions, curves, stop).make(polylines);
}

}  // namespace encase
