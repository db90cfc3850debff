// SPDX-License-Identifier: MIT
#include "encase/surface_vtk.hpp"

#include "surface_blocks.hpp"
#include "vtk_history.hpp"
#include "vtk_multiblock.hpp"

namespace encase {

Status write_vtk(const SurfaceEncasement& encasement, const IntersectionTracing& curves,
                 const std::vector<SurfaceMesh>& meshes, const std::string& directory,
                 bool history) {
  const SurfaceScene scene{encasement, facet_polygons(encasement), curves, meshes};
  const auto fill = [&](std::size_t k, VtkTable* table) {
    return fill_surface_block(scene, k, table);
  };
  const auto step = [&](int cuts, VtkTable* table) {
    return fill_surface_step(encasement, scene.polygons, cuts, table);
  };
  const auto more = [&]() -> Status {
    if (!history) return {};
    return write_steps(directory, static_cast<int>(encasement.history.size()), step);
  };
  return write_multiblock(directory, field_data(encasement),
                          {kSurfaceBlocks.begin(), kSurfaceBlocks.end()}, fill, more);
}

}  // namespace encase
