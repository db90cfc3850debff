// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "2d/verify_claims.hpp"
#include "3d/facet_places.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/verify.hpp"

/// The claims of an encasement of surfaces, group by group in the order in which `verify` re-proves
/// them. What is asked are statements about single boxes (`certificate_tests.hpp`), exact
/// arithmetic, the verification of the facets' encasements, and the reading of a cell from facets
/// that are proved (`cell_reading.hpp`), which searches for nothing.
namespace encase::verification {

/// What all checks share.
struct SpaceClaims : Reporter {
  SpaceClaims(const SurfaceEncasement& e, const VerifyOptions& o)
      : Reporter(o), result(e), options(o), charts(e.planes) {
    kernel.max_bits = o.max_bits;
  }

  const SpaceCell& cell(int index) const { return result.cells[static_cast<std::size_t>(index)]; }
  const FilteredFunction<3>& surface(int index) const {
    return surfaces[static_cast<std::size_t>(index)];
  }

  const SurfaceEncasement& result;
  VerifyOptions options;
  std::vector<FilteredFunction<3>> surfaces;
  SolidRegion region;            ///< found by check_space_regions
  Box<3> root;                   ///< around it; likewise
  std::vector<Box<3>> leaf_box;  ///< of every cell, from the history; by replay_space_history
  PlaneCharts charts;
  Kernel kernel;
};

/// Every index is in range, every number finite, every box ordered, every enumerator named. All
/// later checks rely on it: false ends the verification.
bool check_space_structure(SpaceClaims& claims);

/// The surfaces are square-free, pairwise coprime, and together have the zeros of the input.
void check_surfaces(SpaceClaims& claims);

/// The regions are polyhedra, the region used contains the other one and exceeds it by at most
/// 2^-30 of its diameter; its sides are the first planes. False: no partition makes sense.
bool check_space_regions(SpaceClaims& claims);

/// The splits cut the region used into the cells, each of which has an interior and lies in its
/// box. False: nothing else makes sense.
bool replay_space_history(SpaceClaims& claims);

/// The lists of triple points and of critical points are complete, and are what they claim; each
/// triple point lies in the interior of the cell it names.
void check_point_lists(SpaceClaims& claims);

/// Each certificate's inequality holds on its box.
void check_certificates(SpaceClaims& claims);

/// The facets are those of the partition; the encasement of each is that of the surfaces on it, and
/// is certified where a certified cell needs it; their points are numbered as they are. False: no
/// cell can be read.
bool check_facets(SpaceClaims& claims);

/// Every certified cell has certificates for all its surfaces and pairs, and its patches and arcs
/// are what is read from its facets.
void check_space_cells(SpaceClaims& claims);

/// What holds of the patches and arcs of all cells however they are read: every edge of a surface
/// on a facet is in one loop of each cell beside it, every crossing on it is the end of one arc
/// there, and every triple point is on three arcs; loops are closed, arcs end on those of their
/// patches, and on a disc two arcs cross as often, by parity, as their ends on its rim say.
void check_space_gluing(SpaceClaims& claims);

}  // namespace encase::verification
