// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "3d/cell_reading.hpp"
#include "3d/facets.hpp"
#include "3d/space_partition.hpp"
#include "common/filtered_function.hpp"
#include "common/root_isolation.hpp"
#include "common/run_clock.hpp"
#include "common/subdivision.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// One run of `encase`; the members are called in the order of their numbers.
class SurfaceEncaser {
 public:
  SurfaceEncaser(const std::vector<NamedSurface>& input, const Polyhedron& region,
                 const SurfaceOptions& options);

  Status check_input() const;      // 1. sanity
  void separate_components();      // 1. perturbation; shared and repeated components
  void use_region(int attempt);    // 2. the region, or a slightly larger one
  bool isolate_triple_points();    // 3. common points of three surfaces
  void isolate_critical_points();  // 3. and where curves turn back
  void partition();                // 4. cells with certificates
  bool read_cells(bool last);      // 5. facets, what they have in common, patches and arcs
  void finish();                   // 6. the result
  SurfaceEncasement take_result() { return std::move(result_); }

 private:
  bool out_of_budget();
  bool stop(const char* stage);
  void share_out(int count, const std::function<void(int, Kernel&)>& work);
  SubdivisionLimits limits(const char* stage);
  void leave_open(UnresolvedInSpace* entry) const;
  void add_unresolved(UnresolvedInSpace entry);
  void report_boxes(const std::vector<Box<3>>& boxes, UnresolvedInSpace entry,
                    const std::string& diagnosis);
  void find_apart_pairs();
  bool add_triple_points(RootIsolation<3> roots, const std::array<int, 3>& surfaces);
  bool gradients_are_parallel(int f, int g) const;
  void encase_facets();
  /// Reads all cells, those first that were not read before; false if some were ambiguous and have
  /// been split.
  bool read_all();
  void read(const ReadingScene& scene, int cell);
  bool split_ambiguous();
  bool facets_fail() const;
  void leave(int cell, Outcome outcome, std::string reason);
  struct Diagnosis {
    Unresolved::Kind kind;
    std::vector<int> surfaces;
    std::string reason;
  };
  Diagnosis diagnose(int cell) const;
  UnresolvedInSpace why_not_certified(int cell) const;
  /// A cell that is not certified.
  struct OpenCell {
    int cell;
    UnresolvedInSpace why;
  };
  void report_cells();
  void report_places(const std::vector<OpenCell>& open);
  void take_cells();

  /// What became of a leaf.
  struct Cell {
    Reading reading;
    bool is_settled = false;  ///< was read, and was not ambiguous
    bool is_current = false;  ///< was read from the facets as they are numbered now
    std::vector<int> facets;
    std::optional<Outcome> trouble;  ///< Degenerate or Undecided: it is not certified
    std::string reason;
  };

  const SurfaceOptions& options_;
  RunClock clock_;
  Kernel kernel_;
  SurfaceEncasement result_;
  std::vector<FilteredFunction<3>> surfaces_;
  std::vector<FilteredFunction<3>> directions_;  ///< of the lists of critical points
  SolidRegion region_;
  std::vector<Plane> sides_;
  std::set<std::array<int, 2>> apart_;  ///< pairs without common points in the region
  std::vector<char> inside_;            ///< whether a triple point lies in the region used
  std::size_t notes_ = 0;  ///< entries of `degenerate` that do not depend on the region used
  std::unique_ptr<SpaceScene> scene_;
  std::unique_ptr<SpacePartition> partition_;
  std::unique_ptr<FacetEncaser> encaser_;
  std::vector<EncasedFacet> facets_;
  std::vector<FacetPoint> points_;
  std::vector<Cell> cells_;
  std::mutex mutex_;  ///< of what follows
  bool is_stopped_ = false;
  std::string budget_;  ///< the sentence that tells which ran out; empty if none did
};

}  // namespace encase
