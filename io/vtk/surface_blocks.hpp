// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "encase/intersection_curves.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"
#include "vtk_table.hpp"

/// The blocks of an encasement of surfaces, docs/vtk.md.
namespace encase {

inline constexpr std::array<const char*, 7> kSurfaceBlocks = {
    "cells",  "facets",           "surfaces",  "intersection_curves",
    "points", "critical_regions", "unresolved"};

/// What the blocks show.
struct SurfaceScene {
  const SurfaceEncasement& encasement;
  std::vector<std::vector<Point<3>>> polygons;  ///< of the facets
  const IntersectionTracing& curves;
  const std::vector<SurfaceMesh>& meshes;
};

/// What is said of the whole.
FieldData field_data(const SurfaceEncasement& encasement);

/// The corners of all facets, rounded.
std::vector<std::vector<Point<3>>> facet_polygons(const SurfaceEncasement& encasement);

/// Fills the table of an entry of kSurfaceBlocks.
vtkPolyData* fill_surface_block(const SurfaceScene& scene, std::size_t block, VtkTable* table);

/// The facets between pieces after so many cuts of the history.
vtkPolyData* fill_surface_step(const SurfaceEncasement& encasement,
                               const std::vector<std::vector<Point<3>>>& polygons, int cuts,
                               VtkTable* table);

}  // namespace encase
