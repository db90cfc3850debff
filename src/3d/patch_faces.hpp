// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "encase/surface_encasement.hpp"

namespace encase {

/// Which sign, as an index: 0 negative, 1 positive.
inline int side_index(Sign sign) { return sign == Sign::Positive ? 1 : 0; }

/// The faces into which the arcs cut the patches of a cell.
struct PatchFaces {
  std::vector<int> patch_of;              ///< of every face
  std::vector<std::vector<int>> at_loop;  ///< for every patch and edge of its loop the face there
  std::vector<int> of_sphere;             ///< for every patch its face, if it is a sphere, else -1
  /// An arc between two of its triple points or ends.
  struct ArcPiece {
    std::vector<Sign> signs;  ///< of every surface; Zero for the two that meet along it
    /// sides[i][s]: the face on the patch of the arc's surface i, where the other one has sign s.
    std::array<std::array<int, 2>, 2> sides{};
  };
  std::vector<std::vector<ArcPiece>> arc_pieces;  ///< of every arc
};

/// What is looked up of an encasement's facets.
class FacetTables {
 public:
  explicit FacetTables(const SurfaceEncasement& encasement);

  /// The sign of a surface on a face of a facet's arrangement (0, if that has none).
  Sign sign(int facet, int face, int surface) const;
  /// The sign of another surface along a half-edge on a surface.
  Sign sign_along(const FacetEdge& edge, int surface) const;
  /// The signs of all surfaces around a point where two meet a facet; Zero for these.
  std::vector<Sign> signs_around(int facet_point) const;
  /// The facet points at which a half-edge begins and ends; -1 on a loop without vertices.
  std::array<int, 2> ends(const FacetEdge& edge) const;

 private:
  struct Corner {
    int facet = -1;
    int vertex = -1;
  };
  const SurfaceEncasement& e_;
  std::vector<Corner> crossings_;  ///< of every facet point within a facet
};

/// Cuts the patches of a certified cell; a sentence in `fault` if its parts do not fit together.
PatchFaces cut_patches(const SurfaceEncasement& encasement, const FacetTables& facets, int cell,
                       std::string* fault);

}  // namespace encase
