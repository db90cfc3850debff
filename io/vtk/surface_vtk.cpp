// SPDX-License-Identifier: MIT
#include "encase/surface_vtk.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "encase/atomic_file.hpp"
#include "surface_blocks.hpp"
#include "vtk_history.hpp"
#include "vtk_multiblock.hpp"

namespace encase {
namespace {

/// Between a curve or surface and what stands for it, as a part of the region's size.
constexpr double kTolerance = 1e-3;

Status write_history(const SurfaceEncasement& e, const std::vector<std::vector<Point<3>>>& polygons,
                     const std::string& directory) {
  return write_steps(directory, static_cast<int>(e.history.size()), [&](int cuts, VtkTable* table) {
    return fill_surface_step(e, polygons, cuts, table);
  });
}

}  // namespace

Status write_vtk(const SurfaceEncasement& encasement, const std::string& directory,
                 const SurfaceVtkOptions& options) {
  const double size = encasement.region_used.bounding_box().largest_width();
  const double tolerance = options.tolerance > 0 ? options.tolerance : kTolerance * size;
  IntersectionTraceOptions tracing;
  tracing.tolerance = tolerance;
  auto curves = trace(encasement, tracing);
  if (!curves) return curves.error();
  SurfaceMeshOptions meshing;
  meshing.tolerance = tolerance;
  auto meshes = mesh(encasement, meshing);
  if (!meshes) return meshes.error();
  const SurfaceScene scene{encasement, facet_polygons(encasement), std::move(curves).value(),
                           std::move(meshes).value()};
  const auto fill = [&](std::size_t k, VtkTable* table) {
    return fill_surface_block(scene, k, table);
  };
  const auto more = [&]() -> Status {
    return options.history ? write_history(encasement, scene.polygons, directory) : std::nullopt;
  };
  return write_multiblock(directory, field_data(encasement),
                          {kSurfaceBlocks.begin(), kSurfaceBlocks.end()}, fill, more);
}

}  // namespace encase
