// SPDX-License-Identifier: MIT
#include "encase/surface_vtk.hpp"

#include "io/names.hpp"
#include "surface_blocks.hpp"
#include "vtk_history.hpp"
#include "vtk_multiblock.hpp"
#include "vtk_parts.hpp"

namespace encase {

Status write_vtk(const SurfaceEncasement& encasement, const IntersectionTracing& curves,
                 const std::vector<SurfaceMesh>& meshes, const std::string& directory,
                 bool history) {
  const SurfaceScene scene{encasement, facet_polygons(encasement), curves, meshes};
  VtkResult files;
  files.about = field_data_of(name_of(kOutcomes, encasement.outcome), encasement.input);
  files.blocks = surface_blocks(scene);
  if (history)
    files.write_more = [&] {
      return write_steps(directory, static_cast<int>(encasement.history.size()), files.about,
                         [&](int cuts, VtkTable* table) {
                           fill_surface_step(encasement, scene.polygons, cuts, table);
                         });
    };
  return write_multiblock(directory, files);
}

}  // namespace encase
