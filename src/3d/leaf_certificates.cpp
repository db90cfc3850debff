// SPDX-License-Identifier: MIT
// What is proved of a leaf of a partition of space, and what hinders proofs.
#include <algorithm>
#include <cmath>
#include <utility>

#include "3d/certificate_tests.hpp"
#include "3d/graph_certificate.hpp"
#include "3d/pair_certificate.hpp"
#include "3d/singular_places.hpp"
#include "3d/space_partition_state.hpp"

namespace encase {

void SpacePartition::State::expand(LeafAtHand& item, std::size_t a) {
  const FilteredFunction<3>& f = scene.surfaces[static_cast<std::size_t>(item.alive[a])];
  f.expand(leaves[static_cast<std::size_t>(item.leaf)].box, f.degree(), item.bits[a], kernel,
           &item.nets[a]);
}

/// Expands a net anew whose radius has become noticeable, with more bits if need be.
void SpacePartition::State::sharpen(LeafAtHand& item, std::size_t a) {
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

void SpacePartition::State::remove(LeafAtHand& item, std::size_t a) {
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

void SpacePartition::State::drop_absent(LeafAtHand& item) {
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

bool SpacePartition::State::find_graphs(LeafAtHand& item) {
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
int SpacePartition::State::listed(const LeafAtHand& item, std::size_t a, std::size_t b) const {
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
bool SpacePartition::State::find_pairs(LeafAtHand& item, bool thorough) {
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
bool SpacePartition::State::triples_known(LeafAtHand& item) const {
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

bool SpacePartition::State::certify(LeafAtHand& item) {
  drop_absent(item);
  const bool graphs_found = find_graphs(item);
  // (Of many surfaces most pairs are separated by subdivision, at less cost.)
  if (!graphs_found && item.size() > 8) return false;
  return find_pairs(item, graphs_found) && graphs_found && triples_known(item);
}

/// A surface of an open leaf of which no model exists on the leaf, which is small or lies where the
/// surface's function seems to have no values at all; -1: none.
int SpacePartition::State::undefined_surface(const LeafAtHand& item) const {
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
bool SpacePartition::State::seems_singular(const LeafAtHand& item) const {
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

}  // namespace encase
