// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "3d/mesh_corner.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/surface_mesh.hpp"

namespace encase {

/// The sides of the region in which a mesh's points on the boundary lie, for every point; nothing
/// if an edge of the boundary lies in none, or a point in more than two.
std::optional<std::vector<PointSides>> sides_of_points(const SurfaceMesh& mesh,
                                                       const MeshCorners& corners);

/// Whether a mesh with these corners, all triangles of which have at most this way
/// (TriangleBounds), is proved to come as near as that to all points of its surface in the region
/// used. docs/meshes.md has the argument.
bool covers_surface(const SurfaceMesh& mesh, const SurfaceEncasement& encasement,
                    const MeshCorners& maker, const std::vector<Corner>& corners, double way);

/// Whether such a mesh is also proved to be isotopic to the surface: no two triangles meet but in
/// common corners and edges.
bool is_embedded(const SurfaceMesh& mesh, const MeshCorners& maker);

}  // namespace encase
