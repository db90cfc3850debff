// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "3d/region_sides.hpp"
#include "3d/space_partition.hpp"
#include "common/bernstein.hpp"

namespace encase {

/// A leaf at work.
struct LeafAtHand {
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

/// A partition at work.
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

  // The work, level by level: space_partition.cpp.
  void prepare();
  LeafAtHand item_of(int leaf);
  void run(std::vector<LeafAtHand> level);
  void leave_rows(std::vector<LeafAtHand>* open);
  void settle(LeafAtHand& item, CellState state);
  void give_back(LeafAtHand& item);

  // What is known of a leaf: leaf_certificates.cpp.
  void expand(LeafAtHand& item, std::size_t a);
  void sharpen(LeafAtHand& item, std::size_t a);
  void drop_absent(LeafAtHand& item);
  void remove(LeafAtHand& item, std::size_t a);
  bool find_graphs(LeafAtHand& item);
  bool find_pairs(LeafAtHand& item, bool thorough);
  int listed(const LeafAtHand& item, std::size_t a, std::size_t b) const;
  bool triples_known(LeafAtHand& item) const;
  bool certify(LeafAtHand& item);
  int undefined_surface(const LeafAtHand& item) const;
  bool seems_singular(const LeafAtHand& item) const;

  // Where a leaf is cut: leaf_cuts.cpp.
  double rounded_cut(const Box<3>& box, int axis, double at) const;
  bool clear(const LeafAtHand& item, int axis, double at, bool strictly) const;
  bool corners_clear(const LeafAtHand& item, int axis, double at, bool strictly) const;
  std::optional<double> choose_cut(const LeafAtHand& item, int axis) const;
  std::optional<double> choose_cut(const LeafAtHand& item, const CutHint& hint) const;
  bool halve(LeafAtHand& item, std::vector<LeafAtHand>* parts);
  void cut_at(LeafAtHand& item, int axis, double at, std::vector<LeafAtHand>* parts);
  int plane_of(int axis, double at);
  int branch(int leaf, int axis, double at);
};

}  // namespace encase
