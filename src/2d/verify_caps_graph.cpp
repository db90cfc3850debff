// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "2d/side_roots.hpp"
#include "2d/verify_caps.hpp"
#include "common/union_find.hpp"

namespace encase::verification {
namespace {

constexpr int kNone = -1;

/// Where a curve passes from one place to another, in a piece of their common side. A place is a
/// leaf, or a region that may be a vertex; or kNone, outside of the box.
struct Passage {
  int curve = -1;
  Box<2> box;
  std::array<int, 2> places{};
  /// By place: the passage at which the arc that begins here leaves it again, or the vertex.
  std::array<int, 2> passage{kNone, kNone};
  std::array<int, 2> vertex{kNone, kNone};
};

/// An edge as it can be compared: with a polyline that does not depend on where one begins.
using Key = std::tuple<int, bool, std::vector<int>, std::vector<Point<2>>>;

Key key_of(CapsEdge edge) {
  std::vector<Point<2>>& line = edge.polyline;
  std::sort(edge.vertices.begin(), edge.vertices.end());
  if (edge.vertices.empty() && line.size() > 1 && line.front() == line.back()) {
    line.pop_back();
    std::rotate(line.begin(), std::min_element(line.begin(), line.end()), line.end());
    line.push_back(line.front());
  }
  const std::vector<Point<2>> back(line.rbegin(), line.rend());
  return {edge.curve, edge.proved, edge.vertices, std::min(line, back)};
}

class GraphChecker {
 public:
  explicit GraphChecker(CapsClaims& claims)
      : claims_(claims), r_(claims.result), leaves_(static_cast<int>(r_.leaves.size())) {}

  void check(const std::vector<SharedSide>& sides) {
    places_.resize(r_.leaves.size() + r_.regions.size());
    open_.resize(places_.size());
    blob_.resize(r_.leaves.size());
    list_vertices();
    find_passages(sides);
    for (std::size_t p = 0; p < passages_.size(); ++p)
      for (const int place : passages_[p].places)
        if (place != kNone) places_[static_cast<std::size_t>(place)].push_back(static_cast<int>(p));
    for (int k = 0; k < leaves_; ++k)
      if (place_of(k) == k && !claims_.curves_of(claims_.leaf(k)).empty()) join_in_leaf(k);
    for (std::size_t region = 0; region < r_.regions.size() && !claims_.full(); ++region)
      if (is_vertex_like(r_.regions[region])) join_in_region(static_cast<int>(region));
    leave_box();
    if (!claims_.full()) compare_edges();
  }

 private:
  bool is_vertex_like(const CapsRegion& region) const {
    return region.singular || claims_.curves_of(region).size() > 1;
  }
  int place_of(int leaf) const {
    const int region = claims_.leaf(leaf).region;
    return is_vertex_like(r_.regions[static_cast<std::size_t>(region)]) ? leaves_ + region : leaf;
  }
  bool is_open(int place) const { return open_[static_cast<std::size_t>(place)]; }
  Passage& passage(int p) { return passages_[static_cast<std::size_t>(p)]; }
  std::vector<int> passages_of(int place, int curve) const;

  /// The vertices by their regions, or by where they are on the box' sides.
  void list_vertices();
  void find_passages(const std::vector<SharedSide>& sides);
  void pass(int curve, int first, int second, const Box<2>& segment, int along);
  using Arcs = std::vector<std::array<int, 2>>;
  std::optional<Arcs> arcs_over(std::vector<int> passages, int axis);
  void join(int first, int second, int place);
  void join_in_leaf(int leaf);
  struct Meeting {
    std::array<Arcs, 2> arcs;
    /// The arc of either on which the common point lies; none: there is no such point.
    std::array<int, 2> through{kNone, kNone};
  };
  std::optional<Meeting> prove_meeting(int region);
  void join_in_region(int region);
  bool seems(CapsVertex::Kind kind, int region);
  void leave_box();
  void compare_edges();
  std::vector<Point<2>> polyline_from(int start, bool closed);
  std::vector<CapsEdge> edges(bool polylines);

  CapsClaims& claims_;
  const CapsResult& r_;
  const int leaves_;
  std::vector<int> vertex_of_region_;
  std::map<std::tuple<int, Point<2>, Point<2>>, int> boundary_vertices_;
  std::vector<Passage> passages_;
  std::vector<std::vector<int>> places_;  ///< the passages of each
  std::vector<bool> open_;                ///< places on a side of which zeros are not known
  std::vector<std::array<int, 2>> open_sides_;
  std::vector<bool> blob_;  ///< leaves in which it is not known what joins their passages
};

void GraphChecker::list_vertices() {
  vertex_of_region_.assign(r_.regions.size(), kNone);
  for (std::size_t v = 0; v < r_.vertices.size(); ++v) {
    const CapsVertex& vertex = r_.vertices[v];
    const int number = static_cast<int>(v);
    if (vertex.kind == CapsVertex::Kind::Boundary) {
      claims_.require(
          boundary_vertices_
              .emplace(std::tuple(vertex.curves[0], vertex.box.lo, vertex.box.hi), number)
              .second,
          "Vertex ", v, " is there twice.");
      continue;
    }
    const CapsRegion& region = r_.regions[static_cast<std::size_t>(vertex.region)];
    int& at = vertex_of_region_[static_cast<std::size_t>(vertex.region)];
    claims_.require(at == kNone && is_vertex_like(region) &&
                        vertex.curves == claims_.curves_of(region) && vertex.box == region.box,
                    "Vertex ", v, " is not that of its region.");
    at = number;
  }
}

void GraphChecker::find_passages(const std::vector<SharedSide>& sides) {
  for (const auto& [lower, upper, axis] : sides) {
    const int first = place_of(lower), second = place_of(upper);
    if (first == second) continue;
    const Box<2>&a = claims_.leaf(lower).box, &b = claims_.leaf(upper).box;
    const int along = 1 - axis;
    Box<2> segment = b;
    segment.hi[axis] = segment.lo[axis];
    segment.lo[along] = std::max(a.lo[along], b.lo[along]);
    segment.hi[along] = std::min(a.hi[along], b.hi[along]);
    const auto& others = claims_.curves_of(claims_.leaf(upper));
    for (const int c : claims_.curves_of(claims_.leaf(lower)))
      if (std::binary_search(others.begin(), others.end(), c))
        pass(c, first, second, segment, along);
  }
  for (int k = 0; k < leaves_; ++k)
    for (int axis = 0; axis < 2; ++axis) {
      const Box<2>& box = claims_.leaf(k).box;
      Box<2> low = box, high = box;
      low.hi[axis] = low.lo[axis];
      high.lo[axis] = high.hi[axis];
      for (const int c : claims_.curves_of(claims_.leaf(k))) {
        if (box.lo[axis] == r_.box.lo[axis]) pass(c, place_of(k), kNone, low, 1 - axis);
        if (box.hi[axis] == r_.box.hi[axis]) pass(c, place_of(k), kNone, high, 1 - axis);
      }
    }
}

/// The zeros of a curve on a common side of two places. Between two leaves in which it is no graph
/// they would be of no use.
void GraphChecker::pass(int curve, int first, int second, const Box<2>& segment, int along) {
  const auto unknown = [&](int place) {
    return place != kNone && place < leaves_ && claims_.leaf(place).graph_axis < 0;
  };
  std::optional<std::vector<Box<2>>> roots;
  if (!(unknown(first) && unknown(second)))
    roots = side_roots(claims_.curve(curve), segment, along);
  if (roots) {
    for (const Box<2>& root : *roots) passages_.push_back({curve, root, {first, second}});
    return;
  }
  for (const int place : {first, second})
    if (place != kNone) open_[static_cast<std::size_t>(place)] = true;
  if (second != kNone) open_sides_.push_back({first, second});
}

std::vector<int> GraphChecker::passages_of(int place, int curve) const {
  std::vector<int> result;
  for (const int p : places_[static_cast<std::size_t>(place)])
    if (passages_[static_cast<std::size_t>(p)].curve == curve) result.push_back(p);
  return result;
}

/// Every second gap between the passages along the axis over which the curve is a graph. Nothing if
/// their order is not known.
std::optional<GraphChecker::Arcs> GraphChecker::arcs_over(std::vector<int> list, int axis) {
  const auto lo = [&](int p) { return passage(p).box.lo[axis]; };
  const auto hi = [&](int p) { return passage(p).box.hi[axis]; };
  std::sort(list.begin(), list.end(),
            [&](int a, int b) { return std::pair(lo(a), hi(a)) < std::pair(lo(b), hi(b)); });
  if (list.size() % 2) return std::nullopt;
  Arcs arcs;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (k > 0 && hi(list[k - 1]) > lo(list[k])) return std::nullopt;
    if (k % 2) arcs.push_back({list[k - 1], list[k]});
  }
  return arcs;
}

void GraphChecker::join(int first, int second, int place) {
  for (const auto& [from, to] : {std::pair(first, second), std::pair(second, first)})
    passage(from).passage[passage(from).places[0] == place ? 0 : 1] = to;
}

void GraphChecker::join_in_leaf(int k) {
  const CapsLeaf& leaf = claims_.leaf(k);
  std::optional<Arcs> arcs;
  if (leaf.graph_axis >= 0 && !is_open(k))
    arcs = arcs_over(places_[static_cast<std::size_t>(k)], leaf.graph_axis);
  blob_[static_cast<std::size_t>(k)] = !arcs;
  if (arcs)
    for (const auto& [a, b] : *arcs) join(a, b, k);
}

/// The arcs of two curves in a region, if they have at most one common point there: an arc of one
/// has it if the other's function changes its sign along it (docs/caps.md).
std::optional<GraphChecker::Meeting> GraphChecker::prove_meeting(int r) {
  const CapsRegion& region = r_.regions[static_cast<std::size_t>(r)];
  const std::vector<int>& pair = claims_.curves_of(region);
  const int place = leaves_ + r;
  if (pair.size() != 2 || is_open(place)) return std::nullopt;
  std::array<CurveBounds::Slopes, 2> slopes;
  for (std::size_t i = 0; i < 2; ++i) slopes[i] = claims_.curve(pair[i]).slopes(region.box);
  const auto& [f, g] = slopes;
  const Interval determinant = f.slope[0] * g.slope[1] - f.slope[1] * g.slope[0];
  if (!(determinant.lo > 0 || determinant.hi < 0)) return std::nullopt;
  Meeting meeting;
  for (std::size_t i = 0; i < 2; ++i) {
    const int axis = graph_axis(slopes[i]);
    if (axis < 0) return std::nullopt;
    auto arcs = arcs_over(passages_of(place, pair[i]), axis);
    if (!arcs) return std::nullopt;
    for (std::size_t k = 0; k < arcs->size(); ++k) {
      std::array<std::optional<Sign>, 2> sign;
      for (std::size_t e = 0; e < 2; ++e)
        sign[e] = claims_.curve(pair[1 - i]).look(passage((*arcs)[k][e]).box).sign;
      if (!sign[0] || !sign[1]) return std::nullopt;
      if (*sign[0] == *sign[1]) continue;
      if (meeting.through[i] != kNone) return std::nullopt;
      meeting.through[i] = static_cast<int>(k);
    }
    meeting.arcs[i] = std::move(*arcs);
  }
  if ((meeting.through[0] == kNone) != (meeting.through[1] == kNone)) return std::nullopt;
  return meeting;
}

/// Whether a vertex that is not a proved crossing is called what it seems to be.
bool GraphChecker::seems(CapsVertex::Kind kind, int r) {
  const CapsRegion& region = r_.regions[static_cast<std::size_t>(r)];
  const std::vector<int>& here = claims_.curves_of(region);
  switch (kind) {
    case CapsVertex::Kind::Several:
      return here.size() > 2;
    case CapsVertex::Kind::SelfCrossing:
      return region.singular;
    case CapsVertex::Kind::Indeterminate:
      return here.size() > 1;
    case CapsVertex::Kind::Odd:
    case CapsVertex::Kind::Even: {
      if (here.size() != 2 || is_open(leaves_ + r)) return false;
      bool odd = false;
      for (const int p : passages_of(leaves_ + r, here[0])) {
        const std::optional<Sign> sign = claims_.curve(here[1]).look(passage(p).box).sign;
        if (!sign) return false;
        if (*sign == Sign::Negative) odd = !odd;
      }
      return odd == (kind == CapsVertex::Kind::Odd);
    }
    default:
      return false;
  }
}

/// What is said of a region in which curves may meet, and where its passages lead accordingly.
void GraphChecker::join_in_region(int r) {
  const CapsRegion& region = r_.regions[static_cast<std::size_t>(r)];
  const int place = leaves_ + r, vertex = vertex_of_region_[static_cast<std::size_t>(r)];
  const bool crossing = vertex != kNone && r_.vertices[static_cast<std::size_t>(vertex)].kind ==
                                               CapsVertex::Kind::Crossing;
  claims_.require(region.apart == (vertex == kNone), "Region ", r,
                  " is not either a vertex or one where curves are apart.");
  const auto attach = [&](int p) {
    passage(p).vertex[passage(p).places[0] == place ? 0 : 1] = vertex;
  };
  std::optional<Meeting> meeting;
  if (region.apart || crossing) meeting = prove_meeting(r);
  if (region.apart)
    claims_.require(meeting && meeting->through[0] == kNone,
                    "That curves are apart is not proved in region ", r, ".");
  else if (crossing)
    claims_.require(meeting && meeting->through[0] != kNone, "Vertex ", vertex,
                    " is not proved to be one crossing of two arcs.");
  else
    claims_.require(seems(r_.vertices[static_cast<std::size_t>(vertex)].kind, r), "Vertex ", vertex,
                    " is not what it is called.");
  if (!meeting) {
    for (const int p : places_[static_cast<std::size_t>(place)]) attach(p);
    return;
  }
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t k = 0; k < meeting->arcs[i].size(); ++k) {
      const auto [a, b] = meeting->arcs[i][k];
      if (static_cast<int>(k) == meeting->through[i])
        attach(a), attach(b);
      else
        join(a, b, place);
    }
}

/// The vertices on the box' sides are the passages there.
void GraphChecker::leave_box() {
  std::size_t found = 0;
  for (Passage& p : passages_) {
    if (p.places[1] != kNone) continue;
    const auto vertex = boundary_vertices_.find({p.curve, p.box.lo, p.box.hi});
    if (vertex != boundary_vertices_.end()) {
      p.vertex[1] = vertex->second;
      ++found;
    } else {
      claims_.require(r_.answer == CapsClass::Undecided, "Curve ", p.curve,
                      " leaves the box where there is no vertex.");
    }
  }
  claims_.require(found == boundary_vertices_.size(),
                  "Of a vertex it is not proved that a curve leaves the box there.");
}

/// The points of an arc from the passage on: to the vertex at its other end or, closed, back.
std::vector<Point<2>> GraphChecker::polyline_from(int start, bool closed) {
  std::vector<Point<2>> points;
  const auto visit = [&](int v) {
    const CapsVertex& vertex = r_.vertices[static_cast<std::size_t>(v)];
    if (vertex.kind != CapsVertex::Kind::Boundary) points.push_back(vertex.box.center());
  };
  std::size_t side = 1;  // of the passage by which the arc goes on
  if (!closed) {
    side = passage(start).vertex[0] != kNone ? 1 : 0;
    visit(passage(start).vertex[1 - side]);
  }
  for (int p = start;;) {
    points.push_back(passage(p).box.center());
    if (const int vertex = passage(p).vertex[side]; vertex != kNone) {
      visit(vertex);
      return points;
    }
    const int place = passage(p).places[side];
    p = passage(p).passage[side];
    side = passage(p).places[0] == place ? 1 : 0;
    if (p == start) break;
  }
  points.push_back(points.front());
  return points;
}

/// What the leaves, the passages and the vertices make.
std::vector<CapsEdge> GraphChecker::edges(bool polylines) {
  const int count = static_cast<int>(passages_.size());
  const auto blob = [&](int leaf) { return count + leaf; };
  UnionFind sets(passages_.size() + r_.leaves.size());
  std::vector<std::pair<int, int>> attached;  // what ends at vertices
  std::vector<int> loose;
  for (int p = 0; p < count; ++p)
    for (std::size_t side = 0; side < 2; ++side) {
      const int place = passage(p).places[side];
      if (passage(p).vertex[side] != kNone)
        attached.emplace_back(p, passage(p).vertex[side]);
      else if (passage(p).passage[side] != kNone)
        sets.join(p, passage(p).passage[side]);
      else if (place != kNone && place < leaves_)
        sets.join(p, blob(place));
      else
        loose.push_back(p);
    }
  for (auto [first, second] : open_sides_) {
    if (first >= leaves_) std::swap(first, second);
    if (second < leaves_)
      sets.join(blob(first), blob(second));
    else if (first < leaves_)
      attached.emplace_back(blob(first),
                            vertex_of_region_[static_cast<std::size_t>(second - leaves_)]);
  }
  std::map<int, CapsEdge> found;
  std::map<int, int> start;
  for (int p = 0; p < count; ++p) {
    const int set = sets.find(p);
    found.try_emplace(set, CapsEdge{passage(p).curve, {}, true, {}});
    if (!start.contains(set) || passage(p).vertex[0] != kNone || passage(p).vertex[1] != kNone)
      start[set] = p;
  }
  for (int k = 0; k < leaves_; ++k)
    if (blob_[static_cast<std::size_t>(k)])
      found[sets.find(blob(k))] = {claims_.curves_of(claims_.leaf(k))[0], {}, false, {}};
  for (const int p : loose) found[sets.find(p)].proved = false;
  for (const auto& [item, vertex] : attached) found[sets.find(item)].vertices.push_back(vertex);
  std::vector<CapsEdge> result;
  for (auto& [set, edge] : found) {
    if (edge.proved && polylines)
      edge.polyline = polyline_from(start.at(set), edge.vertices.empty());
    result.push_back(std::move(edge));
  }
  return result;
}

void GraphChecker::compare_edges() {
  const bool partly = r_.answer == CapsClass::Undecided;
  const bool polylines = std::any_of(r_.edges.begin(), r_.edges.end(),
                                     [](const CapsEdge& edge) { return !edge.polyline.empty(); });
  std::map<Key, int> derived;
  for (CapsEdge& edge : edges(polylines)) ++derived[key_of(std::move(edge))];
  for (std::size_t k = 0; k < r_.edges.size() && !claims_.full(); ++k) {
    if (partly && !r_.edges[k].proved) continue;
    const auto found = derived.find(key_of(r_.edges[k]));
    const bool follows = found != derived.end() && found->second > 0;
    claims_.require(follows, "Edge ", k, " does not follow from the leaves and the vertices.");
    if (follows) --found->second;
  }
  if (partly || claims_.full()) return;
  for (const auto& [key, count] : derived)
    claims_.require(count == 0, "An edge of curve ", std::get<0>(key), " is missing.");
}

}  // namespace

void check_caps_graph(CapsClaims& claims, const std::vector<SharedSide>& sides) {
  GraphChecker(claims).check(sides);
}

}  // namespace encase::verification
