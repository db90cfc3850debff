// SPDX-License-Identifier: MIT
// The planes that cut leaves of a partition of space.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "3d/cut_net.hpp"
#include "3d/space_partition_state.hpp"

namespace encase {

namespace {

/// A number in [-1, 1) that depends on two doubles only.
double scatter(double a, double b, std::uint64_t salt) {
  std::uint64_t h = std::bit_cast<std::uint64_t>(a) * 0x9e3779b97f4a7c15u + salt;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u + std::bit_cast<std::uint64_t>(b);
  h = (h ^ (h >> 32)) * 0x94d049bb133111ebu;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(h >> 12) * 0x1p-51 - 1;
}

}  // namespace

/// A coordinate with few digits next to one.
double SpacePartition::State::rounded_cut(const Box<3>& box, int axis, double at) const {
  const double unit = std::ldexp(1.0, std::ilogb(box.width(axis)) - 28);
  return std::round(at / unit) * unit;
}

/// Whether the plane keeps away from the points that are known; `strictly`: also in proportion.
bool SpacePartition::State::clear(const LeafAtHand& item, int axis, double at,
                                  bool strictly) const {
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
bool SpacePartition::State::corners_clear(const LeafAtHand& item, int axis, double at,
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

std::optional<double> SpacePartition::State::choose_cut(const LeafAtHand& item, int axis) const {
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

std::optional<double> SpacePartition::State::choose_cut(const LeafAtHand& item,
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
void SpacePartition::State::cut_at(LeafAtHand& item, int axis, double at,
                                   std::vector<LeafAtHand>* parts) {
  const Box<3> box = leaves[static_cast<std::size_t>(item.leaf)].box;
  Box<3> below = box, above = box;
  below.hi[axis] = above.lo[axis] = at;
  LeafAtHand upper;
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
bool SpacePartition::State::halve(LeafAtHand& item, std::vector<LeafAtHand>* parts) {
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

}  // namespace encase
