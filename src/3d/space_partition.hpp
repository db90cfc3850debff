// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "common/filtered_function.hpp"
#include "common/kernel.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// What is known of the surfaces before space is partitioned.
struct SpaceScene {
  const std::vector<FilteredFunction<3>>& surfaces;
  const Polyhedron& region;  ///< the region used
  const std::vector<TriplePoint>& triple_points;
  const std::vector<TriplePointCover>& triple_point_covers;
  const std::vector<CurveCriticalPoints>& critical_points;
};

struct PartitionLimits {
  int max_leaves = 20000;
  /// Asked now and then; true ends the work, and what is open becomes Undecided.
  std::function<bool()> stop;
  double smallest = 0x1p-36;  ///< leaves are split down to this part of the region's size
  /// And those in a row along which surfaces seem to be singular only down to this part.
  double singular_width = 0x1p-6;
};

/// Where a leaf had better be cut: between two values of a coordinate.
struct CutHint {
  int axis = 0;
  double lo = 0;
  double hi = 0;
};

/// A binary partition of the region by axis-parallel planes, every leaf of which carries
/// certificates for all surfaces that may meet it and for all pairs of them, or is Undecided.
/// Certificates hold on a box that contains the leaf; leaves inherit those of their ancestors.
/// No corner of a leaf's box lies on a surface that may meet the leaf (but corners of the root),
/// and the box of every triple point in a certified leaf lies in the interior of the leaf's box, or
/// crosses only sides of the region.
class SpacePartition {
 public:
  struct Leaf {
    Box<3> box;                              ///< the leaf is its part of the region; not empty
    int depth = 0;                           ///< number of splits above it
    CellState state = CellState::Undecided;  ///< Certified or Undecided
    bool in_row = false;                     ///< Undecided, and left as one of a row
    int without_model = -1;     ///< Undecided, and left because this surface seems undefined there
    std::vector<Sign> signs;    ///< of every surface; Zero: it may meet the leaf
    std::vector<int> absences;  ///< in `absences()`, one for every sign that is not Zero
    std::vector<int> graphs;    ///< in `graphs()`, one for every sign that is Zero
    std::vector<int> pairs;     ///< in `pairs()`, one for every pair with signs Zero
    std::vector<int> triple_points;  ///< of those given
  };

  /// Keeps the references in the scene. One leaf, not certified yet.
  SpacePartition(const SpaceScene& scene, const PartitionLimits& limits, Kernel& kernel);
  ~SpacePartition();

  /// Splits until every leaf is certified, too small, or a limit is reached.
  void certify();
  /// Splits a leaf once more, near the middle or where `hint` says, and certifies the parts (which
  /// may split them again). False if it cannot be split. Of the parts one keeps the leaf's index,
  /// the others are appended to leaves().
  bool split(int leaf, const std::optional<CutHint>& hint = std::nullopt);

  const std::vector<Leaf>& leaves() const;
  /// The sides of the region in order, then the splitting planes.
  const std::vector<Plane>& planes() const;
  /// The splits; a child ~k is leaf k.
  const std::vector<Split>& history() const;
  const std::vector<AbsenceCertificate>& absences() const;
  const std::vector<GraphCertificate>& graphs() const;
  const std::vector<PairCertificate>& pairs() const;
  /// How often a certificate was tried to be found.
  std::int64_t tests() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace encase
