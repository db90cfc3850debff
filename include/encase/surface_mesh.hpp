// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "encase/result.hpp"
#include "encase/surface_encasement.hpp"

namespace encase {

/// A surface as triangles, glued from the patches of its cells. docs/meshes.md says how.
struct SurfaceMesh {
  int surface = -1;
  std::vector<Point<3>> points;   ///< used by some triangle each
  std::vector<Point<3>> normals;  ///< of the surface at the points: unit gradients, up to rounding
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from where f > 0
  std::vector<int> cells;                     ///< of every triangle
  /// Proved: no point of the triangle is farther than this from the surface, in input units.
  /// Infinite: nothing is proved.
  std::vector<double> distances;
  /// Proved: the angle between the triangle's normal and the surface's gradient is at no point over
  /// the triangle, up to its distance from it, larger, in radians. Infinite: nothing is proved.
  std::vector<double> angles;

  double tolerance = 0;  ///< as asked
  double distance = 0;   ///< the largest one
  double angle = 0;      ///< the largest one
  /// Proved: no point of the surface in the region used is farther than this from the mesh, in
  /// input units. Infinite: nothing is proved.
  double distance_to_mesh = std::numeric_limits<double>::infinity();
  /// Proved: an isotopy of the region used, along which its sides stay as they are and no point of
  /// the mesh goes farther than `distance_to_mesh`, takes the mesh to the surface in it.
  bool isotopic = false;
  /// Proved: in cells in which the surface does not meet another one, its triangles do not meet
  /// those of that one.
  bool apart = false;
  int euler = 0;                 ///< points - edges + triangles
  bool within_tolerance = true;  ///< distances and angles are at most what was asked
  /// Every cell that may meet the surface is certified and has its patches here.
  bool complete = true;
};

struct SurfaceMeshOptions {
  double tolerance = 1e-3;  ///< > 0, in input units
  /// The largest angle between triangle and surface normals, in radians; so adjacent triangles
  /// turn by at most twice this. > 0.
  double angle = 0.2;
  int max_triangles = 4000000;  ///< of all surfaces; no more are made
  /// As EncaseOptions'; false ends the meshing, which is then Undecided.
  std::function<bool(const char* stage, double done)> progress;
};

/// Meshes of all surfaces. Neighbouring patches share the points on the facet between them: the
/// mesh has boundary edges on the region's boundary only (and next to cells that are not
/// certified). BadInput if the tolerance or angle is not a positive number. Deterministic. Cost:
/// seven to ten microseconds a triangle.
Result<std::vector<SurfaceMesh>> mesh(const SurfaceEncasement& encasement,
                                      const SurfaceMeshOptions& options = {});

/// What contradicts a mesh of an encasement's surface, in a sentence; empty if nothing does. Edges
/// have one or two triangles, which run through it in opposite directions; boundary edges lie on
/// the region's boundary or next to cells that are not certified; triangles lie in their cells;
/// Euler's characteristic is that of the patches; and all distances, both ways, and angles are
/// proved again.
std::string check(const SurfaceMesh& mesh, const SurfaceEncasement& encasement);

/// What contradicts any of the meshes of an encasement's surfaces; and those said to be apart are
/// proved so again.
std::string check(const std::vector<SurfaceMesh>& meshes, const SurfaceEncasement& encasement);

}  // namespace encase
