// SPDX-License-Identifier: MIT
#include "3d/space_partition.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "3d/certificate_tests.hpp"
#include "3d/cut_net.hpp"
#include "3d/graph_certificate.hpp"
#include "3d/pair_certificate.hpp"
#include "3d/region_sides.hpp"
#include "3d/singular_places.hpp"
#include "common/interval.hpp"
#include "common/subdivision.hpp"

namespace encase {

namespace {

/// A leaf at work.
struct Item {
  int leaf = -1;
  std::vector<int> alive;  ///< the surfaces that may meet it, ascending
  std::vector<Bernstein<3>> nets;
  std::vector<int> bits;   ///< of the arithmetic that the nets come from
  std::vector<int> graph;  ///< the surfaces' certificates, or -1
  std::vector<int> pair;   ///< those of the pairs, in a square
  std::vector<int> sides;  ///< of the region, that cut the leaf's box

  std::size_t size() const { return alive.size(); }
  int& pair_of(std::size_t a, std::size_t b) { return pair[a * size() + b]; }
};

/// A number in [-1, 1) that depends on two doubles only.
double scatter(double a, double b, std::uint64_t salt) {
  std::uint64_t h = std::bit_cast<std::uint64_t>(a) * 0x9e3779b97f4a7c15u + salt;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u + std::bit_cast<std::uint64_t>(b);
  h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(h >> 12) * 0x1p-51 - 1;
}

}  // namespace

struct SpacePartition::State {
  State(const SpaceScene& s, const PartitionLimits& l, Kernel& k)
      : scene(s), limits(l), kernel(k), region_sides(s.region), root(s.region.bounding_box()) {}

  const SpaceScene scene;
  PartitionLimits limits;
  Kernel& kernel;
  const RegionSides region_sides;
  Box<3> root;
  std::vector<Leaf> leaves;
  std::vector<int> parent;  ///< of every leaf: the split, or -1
  std::vector<Plane> planes;
  std::map<std::pair<int, double>, int> plane_at;  ///< the splitting planes, by axis and offset
  std::vector<Split> history;
  std::vector<AbsenceCertificate> absences;
  std::vector<GraphCertificate> graphs;
  std::vector<PairCertificate> pairs;
  std::vector<Box<3>> rows;  ///< of leaves that were left
  std::vector<Bernstein<3>> pool;
  std::int64_t tests = 0;
  int visited = 0;
  bool stopped = false;

  /// What hinders a Listed certificate of a list: its points, and where it is not complete.
  std::vector<std::vector<Box<3>>> obstacles;
  std::map<std::array<int, 2>, std::vector<int>> lists_of;
  /// Where the list of a triple's common points is not complete.
  std::map<std::array<int, 3>, std::vector<Box<3>>> unresolved_triples;

  void prepare();
  Item item_of(int leaf);
  void run(std::vector<Item> level);
  void give_back(Item& item);

  void expand(Item& item, std::size_t a);
  void sharpen(Item& item, std::size_t a);
  void drop_absent(Item& item);
  void remove(Item& item, std::size_t a);
  bool find_graphs(Item& item);
  bool find_pairs(Item& item, bool thorough);
  int listed(const Item& item, std::size_t a, std::size_t b) const;
  bool triples_known(Item& item) const;
  bool certify(Item& item);
  int undefined_surface(const Item& item) const;
  bool seems_singular(const Item& item) const;
  void leave_rows(std::vector<Item>* open);
  void settle(Item& item, CellState state);

  double rounded_cut(const Box<3>& box, int axis, double at) const;
  bool clear(const Item& item, int axis, double at, bool strictly) const;
  bool corners_clear(const Item& item, int axis, double at, bool strictly) const;
  std::optional<double> choose_cut(const Item& item, int axis) const;
  std::optional<double> choose_cut(const Item& item, const CutHint& hint) const;
  bool halve(Item& item, std::vector<Item>* parts);
  void cut_at(Item& item, int axis, double at, std::vector<Item>* parts);
  int plane_of(int axis, double at);
  int branch(int leaf, int axis, double at);
};

void SpacePartition::State::prepare() {
  for (const HalfSpace& side : scene.region.sides)
    planes.push_back(Plane::from_rationals({side[0], side[1], side[2], side[3]}));
  for (std::size_t k = 0; k < scene.critical_points.size(); ++k) {
    const CurveCriticalPoints& list = scene.critical_points[k];
    lists_of[list.surfaces].push_back(static_cast<int>(k));
    obstacles.push_back(list.points);
    const auto open = encase::leaves<3>(list.root, list.tokens, cover::kUnresolved);
    obstacles.back().insert(obstacles.back().end(), open.begin(), open.end());
  }
  for (const TriplePointCover& cover : scene.triple_point_covers)
    unresolved_triples[cover.surfaces] =
        encase::leaves<3>(cover.root, cover.tokens, cover::kUnresolved);
  Leaf leaf;
  leaf.box = root;
  leaf.signs.assign(scene.surfaces.size(), Sign::Zero);
  for (std::size_t k = 0; k < scene.triple_points.size(); ++k)
    if (scene.triple_points[k].box.meets(root)) leaf.triple_points.push_back(static_cast<int>(k));
  leaves.push_back(std::move(leaf));
  parent.push_back(-1);
}

/// What is known of a leaf, with fresh nets.
Item SpacePartition::State::item_of(int index) {
  const Leaf& leaf = leaves[static_cast<std::size_t>(index)];
  Item item;
  item.leaf = index;
  for (std::size_t f = 0; f < leaf.signs.size(); ++f)
    if (leaf.signs[f] == Sign::Zero) item.alive.push_back(static_cast<int>(f));
  item.nets.resize(item.size());
  item.bits.assign(item.size(), kernel.start_bits);
  item.graph.assign(item.size(), -1);
  item.pair.assign(item.size() * item.size(), -1);
  const auto place = [&](int surface) {
    return static_cast<std::size_t>(
        std::lower_bound(item.alive.begin(), item.alive.end(), surface) - item.alive.begin());
  };
  for (const int g : leaf.graphs)
    item.graph[place(graphs[static_cast<std::size_t>(g)].surface)] = g;
  for (const int p : leaf.pairs) {
    const auto& surfaces = pairs[static_cast<std::size_t>(p)].surfaces;
    item.pair_of(place(surfaces[0]), place(surfaces[1])) = p;
  }
  for (std::size_t a = 0; a < item.size(); ++a) expand(item, a);
  bool empty;
  item.sides = region_sides.across(leaf.box, region_sides.all(), &empty);
  return item;
}

void SpacePartition::State::expand(Item& item, std::size_t a) {
  const FilteredFunction<3>& f = scene.surfaces[static_cast<std::size_t>(item.alive[a])];
  f.expand(leaves[static_cast<std::size_t>(item.leaf)].box, f.degree(), item.bits[a], kernel,
           &item.nets[a]);
}

/// Expands a net anew whose radius has become noticeable, with more bits if need be.
void SpacePartition::State::sharpen(Item& item, std::size_t a) {
  Bernstein<3>& net = item.nets[a];
  const auto coarse = [&] { return !(net.radius < 0x1p-32 * largest_coefficient(net)); };
  const int first = item.bits[a];
  for (int bits = first; bits > 0 && coarse(); bits = kernel.next(bits)) {
    const double before = net.radius;
    item.bits[a] = bits;
    expand(item, a);
    if (bits > first && !(net.radius < 0.5 * before)) break;
    if (!scene.surfaces[static_cast<std::size_t>(item.alive[a])].precision_helps(net)) break;
  }
}

void SpacePartition::State::remove(Item& item, std::size_t a) {
  const std::size_t n = item.size();
  std::vector<int> rest;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if (i != a && j != a) rest.push_back(item.pair[i * n + j]);
  item.pair = std::move(rest);
  const auto at = static_cast<std::ptrdiff_t>(a);
  pool.push_back(std::move(item.nets[a]));
  item.nets.erase(item.nets.begin() + at);
  item.bits.erase(item.bits.begin() + at);
  item.graph.erase(item.graph.begin() + at);
  item.alive.erase(item.alive.begin() + at);
}

void SpacePartition::State::drop_absent(Item& item) {
  Leaf& leaf = leaves[static_cast<std::size_t>(item.leaf)];
  for (std::size_t a = item.size(); a-- > 0;) {
    sharpen(item, a);
    const auto sign = sign_on_cube(item.nets[a]);
    if (!sign) continue;
    kernel.count(item.bits[a]);
    leaf.signs[static_cast<std::size_t>(item.alive[a])] = *sign;
    leaf.absences.push_back(static_cast<int>(absences.size()));
    absences.push_back({item.alive[a], leaf.box, *sign});
    remove(item, a);
  }
}

bool SpacePartition::State::find_graphs(Item& item) {
  thread_local NetColumns<5> columns;
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  bool all = true;
  for (std::size_t a = 0; a < item.size(); ++a) {
    if (item.graph[a] >= 0) continue;
    ++tests;
    const auto& f = scene.surfaces[static_cast<std::size_t>(item.alive[a])];
    if (f.is_inclusion())
      field_columns(f.inclusion(), box, kernel, &columns);
    else
      field_columns(item.nets[a], &columns);
    auto certificate = find_graph(columns, box);
    if (!certificate) {
      all = false;
      continue;
    }
    kernel.count(item.bits[a]);
    certificate->surface = item.alive[a];
    item.graph[a] = static_cast<int>(graphs.size());
    graphs.push_back(*certificate);
  }
  return all;
}

/// A list of critical points of a pair that has none in the leaf, or -1.
int SpacePartition::State::listed(const Item& item, std::size_t a, std::size_t b) const {
  const auto lists = lists_of.find({item.alive[a], item.alive[b]});
  if (lists == lists_of.end()) return -1;
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  for (const int list : lists->second) {
    const auto& boxes = obstacles[static_cast<std::size_t>(list)];
    if (std::none_of(boxes.begin(), boxes.end(),
                     [&](const Box<3>& other) { return other.meets(box); }))
      return list;
  }
  return -1;
}

/// `thorough`: also by the costly means.
bool SpacePartition::State::find_pairs(Item& item, bool thorough) {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  int degree = 0;
  for (const Bernstein<3>& net : item.nets) degree = std::max(degree, net.degree[0]);
  thread_local Bernstein<3> raised[2], higher;
  const auto in_degree = [&](std::size_t a, int n, int k) -> const Bernstein<3>& {
    if (item.nets[a].degree[0] == n) return item.nets[a];
    raised[k] = item.nets[a];
    for (int axis = 0; axis < 3; ++axis)
      while (raised[k].degree[static_cast<std::size_t>(axis)] < n) {
        elevate(raised[k], axis, &higher);
        std::swap(raised[k], higher);
      }
    return raised[k];
  };
  bool all = true;
  for (std::size_t a = 0; a < item.size(); ++a)
    for (std::size_t b = a + 1; b < item.size(); ++b) {
      if (item.pair_of(a, b) >= 0) continue;
      const auto& f = scene.surfaces[static_cast<std::size_t>(item.alive[a])];
      const auto& g = scene.surfaces[static_cast<std::size_t>(item.alive[b])];
      const int n = std::max(item.nets[a].degree[0], item.nets[b].degree[0]);
      ++tests;
      std::optional<PairCertificate> certificate =
          find_apart(in_degree(a, n, 0), in_degree(b, n, 1), box, f.scale(), g.scale());
      if (const int list = certificate ? -1 : listed(item, a, b); list >= 0) {
        certificate.emplace();
        certificate->kind = PairCertificate::Kind::Listed;
        certificate->box = box;
        certificate->critical = list;
        certificate->direction = scene.critical_points[static_cast<std::size_t>(list)].direction;
      }
      if (!certificate && thorough) {
        ++tests;
        certificate = find_local(f, g, box, std::max(item.bits[a], item.bits[b]), kernel);
      }
      if (!certificate) {
        all = false;
        continue;
      }
      kernel.count(std::max(item.bits[a], item.bits[b]));
      certificate->surfaces = {item.alive[a], item.alive[b]};
      item.pair_of(a, b) = static_cast<int>(pairs.size());
      pairs.push_back(*certificate);
    }
  return all;
}

/// Whether all common points of three surfaces in the leaf are known.
bool SpacePartition::State::triples_known(Item& item) const {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  const auto meet = [&](std::size_t a, std::size_t b) {
    return pairs[static_cast<std::size_t>(item.pair_of(a, b))].kind != PairCertificate::Kind::Apart;
  };
  for (std::size_t a = 0; a < item.size(); ++a)
    for (std::size_t b = a + 1; b < item.size(); ++b) {
      if (!meet(a, b)) continue;
      for (std::size_t c = b + 1; c < item.size(); ++c) {
        if (!meet(a, c) || !meet(b, c)) continue;
        const auto found = unresolved_triples.find({item.alive[a], item.alive[b], item.alive[c]});
        if (found == unresolved_triples.end()) return false;
        for (const Box<3>& open : found->second)
          if (open.meets(box)) return false;
      }
    }
  return true;
}

bool SpacePartition::State::certify(Item& item) {
  drop_absent(item);
  const bool graphs_found = find_graphs(item);
  // (Of many surfaces most pairs are separated by subdivision, at less cost.)
  if (!graphs_found && item.size() > 8) return false;
  return find_pairs(item, graphs_found) && graphs_found && triples_known(item);
}

/// A surface of an open leaf of which no model exists on the leaf, which is small or lies where the
/// surface's function seems to have no values at all; -1: none.
int SpacePartition::State::undefined_surface(const Item& item) const {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  // (Such places are surfaces as a rule: coarser cells than along curves are as many.)
  const bool small = box.largest_width() <= 4 * limits.singular_width * root.largest_width();
  for (std::size_t a = 0; a < item.size(); ++a) {
    if (std::isfinite(item.nets[a].radius)) continue;
    const int s = item.alive[a];
    bool defined = false;
    for (int corner = 0; corner < 9 && !small && !defined; ++corner) {
      Point<3> p = box.center();
      for (std::size_t i = 0; i < 3 && corner < 8; ++i)
        p[i] = corner >> i & 1 ? box.hi[i] : box.lo[i];
      defined = std::isfinite(
          scene.surfaces[static_cast<std::size_t>(s)].evaluate(p, kernel.start_bits).error);
    }
    if (!defined) return s;
  }
  return -1;
}

/// Whether what is not certified in an open leaf seems to be so because surfaces are not in general
/// position there.
bool SpacePartition::State::seems_singular(const Item& item) const {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  const auto f = [&](std::size_t a) {
    return &scene.surfaces[static_cast<std::size_t>(item.alive[a])];
  };
  const std::size_t n = item.size();
  for (std::size_t a = 0; a < n; ++a)
    if (item.graph[a] < 0 && seem_singular({f(a)}, box)) return true;
  bool all_pairs = true;
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      if (item.pair[a * n + b] >= 0) continue;
      all_pairs = false;
      if (seem_singular({f(a), f(b)}, box)) return true;
    }
  for (std::size_t a = 0; a < n && all_pairs; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = b + 1; c < n; ++c)
        if (seem_singular({f(a), f(b), f(c)}, box)) return true;
  return false;
}

/// Leaves the small boxes that lie in rows along which surfaces seem to be singular: to go on would
/// double their number again and again.
void SpacePartition::State::leave_rows(std::vector<Item>* open) {
  std::vector<std::size_t> places;
  std::vector<Box<3>> boxes;
  for (std::size_t k = 0; k < open->size() && !stopped; ++k) {
    const Box<3>& box = leaves[static_cast<std::size_t>((*open)[k].leaf)].box;
    if (box.largest_width() > limits.singular_width * root.largest_width() ||
        !seems_singular((*open)[k]))
      continue;
    places.push_back(k);
    boxes.push_back(box);
  }
  if (boxes.empty()) return;
  const std::vector<bool> left = in_rows(boxes, rows);
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (!left[k]) continue;
    Item& item = (*open)[places[k]];
    leaves[static_cast<std::size_t>(item.leaf)].in_row = true;
    rows.push_back(boxes[k]);
    settle(item, CellState::Undecided);
    item.leaf = -1;
  }
  std::erase_if(*open, [](const Item& item) { return item.leaf < 0; });
}

void SpacePartition::State::settle(Item& item, CellState state) {
  Leaf& leaf = leaves[static_cast<std::size_t>(item.leaf)];
  leaf.state = state;
  leaf.graphs.clear();
  leaf.pairs.clear();
  for (const int g : item.graph)
    if (g >= 0) leaf.graphs.push_back(g);
  for (std::size_t a = 0; a < item.size(); ++a)
    for (std::size_t b = a + 1; b < item.size(); ++b)
      if (item.pair_of(a, b) >= 0) leaf.pairs.push_back(item.pair_of(a, b));
  give_back(item);
}

void SpacePartition::State::give_back(Item& item) {
  for (Bernstein<3>& net : item.nets) pool.push_back(std::move(net));
  item.nets.clear();
}

/// A coordinate with few digits next to one.
double SpacePartition::State::rounded_cut(const Box<3>& box, int axis, double at) const {
  const double unit = std::ldexp(1.0, std::ilogb(box.width(axis)) - 28);
  return std::round(at / unit) * unit;
}

/// Whether the plane keeps away from the points that are known; `strictly`: also in proportion.
bool SpacePartition::State::clear(const Item& item, int axis, double at, bool strictly) const {
  const Leaf& leaf = leaves[static_cast<std::size_t>(item.leaf)];
  const double margin = strictly ? 0.02 * leaf.box.width(axis) : 0;
  for (const int k : leaf.triple_points) {
    const Box<3>& box = scene.triple_points[static_cast<std::size_t>(k)].box;
    if (box.lo[axis] - margin <= at && at <= box.hi[axis] + margin) return false;
  }
  if (!strictly) return true;
  for (std::size_t a = 0; a < item.size(); ++a)
    for (std::size_t b = a + 1; b < item.size(); ++b) {
      const auto lists = lists_of.find({item.alive[a], item.alive[b]});
      if (lists == lists_of.end()) continue;
      for (const int list : lists->second)
        for (const Box<3>& box : obstacles[static_cast<std::size_t>(list)])
          if (box.meets(leaf.box) && box.lo[axis] - margin <= at && at <= box.hi[axis] + margin)
            return false;
    }
  return true;
}

/// Whether no surface passes through, or with `strictly` near, one of the four corners of the cut.
bool SpacePartition::State::corners_clear(const Item& item, int axis, double at,
                                          bool strictly) const {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  const CutPlace place = cut_place(box.lo[axis], box.hi[axis], at);
  double edge[kMaxDegree + 1];
  for (std::size_t a = 0; a < item.size(); ++a) {
    const Bernstein<3>& net = item.nets[a];
    const auto& f = scene.surfaces[static_cast<std::size_t>(item.alive[a])];
    if (!f.is_polynomial()) {
      // On a large box such a net lacks too much to tell.
      for (int corner = 0; corner < 4; ++corner) {
        Point<3> p;
        p[static_cast<std::size_t>(axis)] = at;
        for (int k = 0; k < 2; ++k) {
          const auto i = static_cast<std::size_t>((axis + 1 + k) % 3);
          p[i] = (corner >> k) % 2 ? box.hi[i] : box.lo[i];
        }
        const auto v = f.evaluate(p, kernel.start_bits);
        // (Where it has no value no certificate of it holds, so no cell there asks for this.)
        if (!std::isfinite(v.error)) continue;
        const double least = strictly ? 0x1p-8 * largest_coefficient(net) : 0;
        if (!(std::fabs(v.value) > std::max(v.error, least))) return false;
      }
      continue;
    }
    const int n = net.degree[0], m = n + 1;
    const int strides[3] = {m * m, m, 1};
    const int stride = strides[axis], u = strides[(axis + 1) % 3], v = strides[(axis + 2) % 3];
    for (const int corner : {0, n * u, n * v, n * (u + v)}) {
      double size = 0;
      for (int k = 0; k <= n; ++k) {
        edge[k] = net.b[static_cast<std::size_t>(corner + k * stride)];
        size = std::max(size, std::fabs(edge[k]));
      }
      for (int r = 1; r <= n; ++r)
        for (int k = 0; k <= n - r; ++k) edge[k] = (1 - place.t) * edge[k] + place.t * edge[k + 1];
      const double error = net.radius + n * (2.1 * place.deviation + 0x1p-51) * size + 0x1p-1000;
      if (!(std::fabs(edge[0]) > 1.01 * error)) return false;
      if (strictly && std::fabs(edge[0]) < 0x1p-8 * largest_coefficient(net)) return false;
    }
  }
  return true;
}

std::optional<double> SpacePartition::State::choose_cut(const Item& item, int axis) const {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  const double lo = box.lo[axis], hi = box.hi[axis];
  for (int attempt = 0; attempt < 24; ++attempt) {
    const double reach = 0.04 + 0.015 * attempt;
    const double jitter = scatter(lo, hi, static_cast<std::uint64_t>(3 * attempt + axis));
    const double at = rounded_cut(box, axis, lo + (0.5 + reach * jitter) * (hi - lo));
    const bool strictly = attempt < 16;
    if (lo < at && at < hi && clear(item, axis, at, strictly) &&
        corners_clear(item, axis, at, strictly))
      return at;
  }
  return std::nullopt;
}

std::optional<double> SpacePartition::State::choose_cut(const Item& item,
                                                        const CutHint& hint) const {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  const double lo = std::max(hint.lo, box.lo[hint.axis]), hi = std::min(hint.hi, box.hi[hint.axis]);
  for (int attempt = 0; attempt < 16; ++attempt) {
    const double jitter = scatter(lo, hi, static_cast<std::uint64_t>(attempt));
    double at = lo + (0.5 + (0.1 + 0.02 * attempt) * jitter) * (hi - lo);
    const double rounded = rounded_cut(box, hint.axis, at);
    if (lo < rounded && rounded < hi) at = rounded;
    if (lo < at && at < hi && clear(item, hint.axis, at, attempt < 8) &&
        corners_clear(item, hint.axis, at, attempt < 8))
      return at;
  }
  return std::nullopt;
}

int SpacePartition::State::plane_of(int axis, double at) {
  const auto [entry, is_new] = plane_at.try_emplace({axis, at}, static_cast<int>(planes.size()));
  if (is_new) {
    Plane plane;
    plane.normal[axis] = 1;
    plane.offset = -at;
    planes.push_back(plane);
  }
  return entry->second;
}

/// Makes a split of a leaf; the lower part keeps its index, that of the upper one is returned.
int SpacePartition::State::branch(int leaf, int axis, double at) {
  const int node = static_cast<int>(history.size()), upper = static_cast<int>(leaves.size());
  const int above = parent[static_cast<std::size_t>(leaf)];
  if (above >= 0) {
    Split& split = history[static_cast<std::size_t>(above)];
    (split.negative == ~leaf ? split.negative : split.positive) = node;
  }
  history.push_back({plane_of(axis, at), ~leaf, ~upper});
  parent[static_cast<std::size_t>(leaf)] = node;
  parent.push_back(node);
  leaves.push_back(leaves[static_cast<std::size_t>(leaf)]);
  for (const int part : {leaf, upper}) {
    Leaf& l = leaves[static_cast<std::size_t>(part)];
    ++l.depth;
    (part == leaf ? l.box.hi : l.box.lo)[axis] = at;
    std::erase_if(l.triple_points, [&](int k) {
      const Box<3>& box = scene.triple_points[static_cast<std::size_t>(k)].box;
      return part == leaf ? box.lo[axis] > at : box.hi[axis] < at;
    });
  }
  return upper;
}

/// Cuts an item in two, or where one part would be empty, shrinks it.
void SpacePartition::State::cut_at(Item& item, int axis, double at, std::vector<Item>* parts) {
  const Box<3> box = leaves[static_cast<std::size_t>(item.leaf)].box;
  Box<3> below = box, above = box;
  below.hi[axis] = above.lo[axis] = at;
  Item upper;
  upper.alive = item.alive;
  upper.bits = item.bits;
  upper.graph = item.graph;
  upper.pair = item.pair;
  upper.nets.resize(item.size());
  bool no_lower = false, no_upper = false;
  upper.sides = region_sides.across(above, item.sides, &no_upper);
  item.sides = region_sides.across(below, item.sides, &no_lower);
  for (std::size_t a = 0; a < item.size(); ++a) {
    if (pool.size() < 2) pool.resize(2);
    Bernstein<3> lower_net = std::move(pool.back());
    pool.pop_back();
    upper.nets[a] = std::move(pool.back());
    pool.pop_back();
    cut(item.nets[a], box, axis, at, &lower_net, &upper.nets[a]);
    std::swap(lower_net, item.nets[a]);
    pool.push_back(std::move(lower_net));
  }
  if (no_lower || no_upper) {
    upper.leaf = item.leaf;
    leaves[static_cast<std::size_t>(item.leaf)].box = no_lower ? above : below;
    parts->push_back(std::move(no_lower ? upper : item));
    return;
  }
  upper.leaf = branch(item.leaf, axis, at);
  parts->push_back(std::move(item));
  parts->push_back(std::move(upper));
}

/// Cuts an item across its longest side, or another one if that cannot be.
bool SpacePartition::State::halve(Item& item, std::vector<Item>* parts) {
  const Box<3>& box = leaves[static_cast<std::size_t>(item.leaf)].box;
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return box.width(a) > box.width(b); });
  if (!(box.width(axes[0]) > limits.smallest * root.largest_width())) return false;
  for (const int axis : axes)
    if (const auto at = choose_cut(item, axis)) {
      cut_at(item, axis, *at, parts);
      return true;
    }
  return false;
}

void SpacePartition::State::run(std::vector<Item> level) {
  while (!level.empty()) {
    std::vector<Item> open, next;
    for (Item& item : level) {
      if (++visited % 16 == 0 && !stopped) stopped = limits.stop && limits.stop();
      if (!stopped && certify(item))
        settle(item, CellState::Certified);
      else if (const int s = undefined_surface(item); s >= 0) {
        leaves[static_cast<std::size_t>(item.leaf)].without_model = s;
        settle(item, CellState::Undecided);
      } else
        open.push_back(std::move(item));
    }
    leave_rows(&open);
    for (Item& item : open)
      if (stopped || static_cast<int>(leaves.size()) >= limits.max_leaves || !halve(item, &next))
        settle(item, CellState::Undecided);
    level.swap(next);
  }
}

SpacePartition::SpacePartition(const SpaceScene& scene, const PartitionLimits& limits,
                               Kernel& kernel)
    : state_(std::make_unique<State>(scene, limits, kernel)) {
  state_->prepare();
}

SpacePartition::~SpacePartition() = default;

void SpacePartition::certify() {
  std::vector<Item> level;
  level.push_back(state_->item_of(0));
  state_->run(std::move(level));
}

bool SpacePartition::split(int leaf, const std::optional<CutHint>& hint) {
  std::vector<Item> parts;
  parts.push_back(state_->item_of(leaf));
  for (std::size_t a = 0; a < parts[0].size(); ++a) state_->sharpen(parts[0], a);
  const std::optional<double> at =
      hint ? state_->choose_cut(parts[0], *hint) : std::optional<double>();
  if (at) {
    Item item = std::move(parts[0]);
    parts.clear();
    state_->cut_at(item, hint->axis, *at, &parts);
  }
  // (A cut that leaves nothing on one side is none.)
  while (parts.size() < 2) {
    Item item = std::move(parts[0]);
    parts.clear();
    if (static_cast<int>(leaves().size()) >= state_->limits.max_leaves ||
        !state_->halve(item, &parts))
      return false;
  }
  state_->run(std::move(parts));
  return true;
}

const std::vector<SpacePartition::Leaf>& SpacePartition::leaves() const { return state_->leaves; }
const std::vector<Plane>& SpacePartition::planes() const { return state_->planes; }
const std::vector<Split>& SpacePartition::history() const { return state_->history; }
const std::vector<AbsenceCertificate>& SpacePartition::absences() const { return state_->absences; }
const std::vector<GraphCertificate>& SpacePartition::graphs() const { return state_->graphs; }
const std::vector<PairCertificate>& SpacePartition::pairs() const { return state_->pairs; }
std::int64_t SpacePartition::tests() const { return state_->tests; }

}  // namespace encase
