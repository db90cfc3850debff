// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "encase/surface_encasement.hpp"

/// The arrangement of surfaces in a convex polyhedron: the regions into which they divide it, the
/// faces into which they cut each other, and how these border on each other, read off a certified
/// encasement. docs/space-arrangement.md says how and why it is exact.
namespace encase {

/// All indices refer to lists here or in the encasement.
struct SpaceArrangement {
  /// A patch of a cell.
  struct PatchOfCell {
    int cell = -1;
    int patch = -1;
    bool operator==(const PatchOfCell&) const = default;
  };

  /// A connected component of a surface in the region used.
  struct Component {
    int surface = -1;
    bool closed = false;  ///< it does not meet the region's boundary
    int euler = 0;        ///< its Euler characteristic, as a surface (with boundary, if not closed)
    std::vector<PatchOfCell> patches;
    bool operator==(const Component&) const = default;
  };

  /// A maximal connected part of a surface without points of other surfaces.
  struct Face {
    int surface = -1;
    int component = -1;
    std::array<int, 2> regions{-1, -1};  ///< where the surface's function is negative, and positive
    bool operator==(const Face&) const = default;
  };

  /// A maximal connected open set without points of surfaces.
  struct Region {
    std::vector<Sign> signs;        ///< of every surface
    std::vector<int> faces;         ///< on its boundary, ascending
    bool touches_boundary = false;  ///< that of the region used
    std::vector<int> cells;         ///< that it meets, ascending
    bool operator==(const Region&) const = default;
  };

  /// The regions that share a face with a region, each once, ascending.
  std::vector<int> neighbours(int region) const;

  std::vector<Component> components;  ///< in the order of the surfaces
  std::vector<Face> faces;
  std::vector<Region> regions;
  /// For every facet and face of its arrangement (one, if no surface meets it) the region in which
  /// it lies; -1 for the outside face.
  std::vector<std::vector<int>> region_of_facet;
  bool operator==(const SpaceArrangement&) const = default;
};

/// The arrangement of an encasement's surfaces. Degenerate or Undecided if the encasement is,
/// Undecided too where a function that is no polynomial has no proved sign on a facet on which it
/// is constant; Internal if its parts do not fit together, as in one that `verify` objects to.
/// Cost: about that of reading the encasement.
Result<SpaceArrangement> arrange(const SurfaceEncasement& encasement);

/// Re-proves the encasement, and that the arrangement is that of it, entry by entry, as `arrange`
/// derives it from the facts that were proved.
Verification verify(const SurfaceEncasement& encasement, const SpaceArrangement& arrangement,
                    const VerifyOptions& options = {});

/// Tells in which region points lie. Refers to the encasement and the arrangement, which must
/// outlive it.
class RegionLocator {
 public:
  RegionLocator(const SurfaceEncasement& encasement, const SpaceArrangement& arrangement);
  ~RegionLocator();
  RegionLocator(RegionLocator&&) noexcept;
  RegionLocator& operator=(RegionLocator&&) noexcept;

  struct Place {
    enum class Kind {
      Region,
      OnSurface,  ///< at least one surface passes through the point
      Outside,    ///< of the region used
      Undecided
    };
    Kind kind = Kind::Undecided;
    int region = -1;            ///< of Region
    std::vector<int> surfaces;  ///< through the point, ascending
  };
  /// Exact. Undecided where a function that is no polynomial has no proved sign, or where several
  /// regions with the same signs meet a cell and no straight way to its boundary tells them apart.
  Place locate(const RationalPoint<3>& point) const;

 private:
  struct Tables;
  std::unique_ptr<const Tables> tables_;
};

}  // namespace encase
