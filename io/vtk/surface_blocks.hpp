// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"
#include "vtk_multiblock.hpp"

/// The blocks of an encasement of surfaces, docs/vtk.md.
namespace encase {

/// What the blocks show.
struct SurfaceScene {
  const SurfaceEncasement& encasement;
  std::vector<std::vector<Point<3>>> polygons;  ///< of the facets
  const IntersectionTracing& curves;
  const std::vector<SurfaceMesh>& meshes;
};

/// The corners of all facets, rounded.
std::vector<std::vector<Point<3>>> facet_polygons(const SurfaceEncasement& encasement);

/// The scene must outlive them.
std::vector<VtkBlock> surface_blocks(const SurfaceScene& scene);

/// The facets between pieces after so many cuts of the history.
void fill_surface_step(const SurfaceEncasement& encasement,
                       const std::vector<std::vector<Point<3>>>& polygons, int cuts,
                       VtkTable* table);

}  // namespace encase
