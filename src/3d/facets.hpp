// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "3d/facet_places.hpp"
#include "common/filtered_function.hpp"
#include "common/kernel.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// Why a facet could not be certified.
struct FacetTrouble {
  Outcome outcome = Outcome::Undecided;  ///< Degenerate or Undecided
  std::string reason;
};

/// A facet, and what is wrong with it if it is not certified.
struct EncasedFacet {
  Facet facet;
  Box<3> extent;         ///< its place's
  bool is_open = false;  ///< it has curves, and is not encased yet
  std::optional<FacetTrouble> trouble;
};

/// Encases facets in their planes. A facet that was encased before, of the same polygon and
/// surfaces, is taken from there.
class FacetEncaser {
 public:
  /// The references must outlive this; `planes` may grow.
  FacetEncaser(const std::vector<Surface>& surfaces, const std::vector<Plane>& planes,
               EncaseOptions options, Kernel& kernel)
      : surfaces_(surfaces), options_(std::move(options)), kernel_(kernel), charts_(planes) {}

  PlaneCharts& charts() { return charts_; }

  /// The facet at a place, with the surfaces that may meet it: encased already, or to be.
  EncasedFacet facet_at(FacetPlace place, const std::vector<int>& surfaces);
  /// Encases those that are not yet. `for_all(count, work)` calls work(i) for 0 <= i < count, each
  /// once, on any threads.
  void encase(std::vector<EncasedFacet>& facets,
              const std::function<void(int, const std::function<void(int)>&)>& for_all);
  /// Takes back facets that may be asked for again.
  void recycle(std::vector<EncasedFacet> facets);

  std::int64_t encased() const { return encased_; }
  const DecisionCounts& decisions() const { return decisions_; }

 private:
  struct OnPlane {
    Function<2> function;
    std::optional<FilteredFunction<2>> filtered;  ///< unless it is constant
    /// Of a function that is constant on the plane; Zero: zero, or not told.
    std::optional<Sign> constant;
  };
  const OnPlane& restricted(int plane, int surface);
  std::optional<FacetTrouble> encase(Facet* facet, DecisionCounts* decisions) const;

  using Key = std::tuple<int, Point<3>, Point<3>, std::vector<int>>;
  const std::vector<Surface>& surfaces_;
  const EncaseOptions options_;
  Kernel& kernel_;
  PlaneCharts charts_;
  std::map<std::array<int, 2>, OnPlane> restricted_;
  std::map<Key, EncasedFacet> earlier_;
  DecisionCounts decisions_;
  std::int64_t encased_ = 0;
};

}  // namespace encase
