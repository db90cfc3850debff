// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "3d/mesh_cover.hpp"
#include "3d/space_vectors.hpp"
#include "3d/triangle_bounds.hpp"
#include "3d/triangles_apart.hpp"
#include "encase/surface_mesh.hpp"
#include "encase/surface_topology.hpp"

namespace encase {

namespace {

std::string triangle_name(std::size_t k) { return "triangle " + std::to_string(k); }

/// Whether an edge lies in a side of the region used, up to rounding.
bool on_boundary(const Point<3>& p, const Point<3>& q, const SurfaceEncasement& e) {
  const double size = e.region_used.bounding_box().largest_width();
  for (std::size_t k = 0; k < e.region_used.sides.size(); ++k) {
    const Plane& plane = e.planes[k];
    const auto away = [&](const Point<3>& at) {
      double sum = plane.offset;
      for (int i = 0; i < 3; ++i) sum += plane.normal[i] * at[i];
      return std::fabs(sum) / std::hypot(plane.normal[0], plane.normal[1], plane.normal[2]);
    };
    if (away(p) <= 0x1p-40 * size && away(q) <= 0x1p-40 * size) return true;
  }
  return false;
}

std::string check_edges(const SurfaceMesh& mesh, const SurfaceEncasement& e) {
  std::map<std::pair<int, int>, int> half_edges;
  std::set<std::pair<int, int>> edges;
  std::set<int> used;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles[k][i], b = mesh.triangles[k][(i + 1) % 3];
      if (a < 0 || a >= static_cast<int>(mesh.points.size()) || a == b)
        return triangle_name(k) + " has a corner that is none";
      if (!half_edges.emplace(std::pair(a, b), static_cast<int>(k)).second)
        return triangle_name(k) + " and another one run along an edge in the same direction";
      edges.insert(std::minmax(a, b));
      used.insert(a);
    }
  if (used.size() != mesh.points.size()) return "a point belongs to no triangle";
  for (const auto& [edge, triangle] : half_edges)
    if (mesh.complete && !half_edges.contains({edge.second, edge.first}) &&
        !on_boundary(mesh.points[edge.first], mesh.points[edge.second], e))
      return triangle_name(triangle) + " ends within the region";
  const int euler = static_cast<int>(used.size()) - static_cast<int>(edges.size()) +
                    static_cast<int>(mesh.triangles.size());
  if (euler != mesh.euler) return "Euler's characteristic is not that of the triangles";
  if (mesh.complete && euler != surface_topology(e)[mesh.surface].euler)
    return "Euler's characteristic is not that of the patches";
  return "";
}

/// Whether triangles lie in the cells that they name, up to rounding.
std::string check_cells(const SurfaceMesh& mesh, const SurfaceEncasement& e) {
  const double slack = 0x1p-40 * e.region_used.bounding_box().largest_width();
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Box<3> box = inflated(e.cells[mesh.cells[k]].box, slack);
    for (const int p : mesh.triangles[k])
      if (!box.contains(mesh.points[p])) return triangle_name(k) + " leaves its cell";
  }
  return "";
}

std::string check_bounds(const SurfaceMesh& mesh, const SurfaceEncasement& e) {
  const FilteredFunction<3> function(e.surfaces[mesh.surface].function);
  const SurfaceBounds bounds(function, e.region_used.bounding_box().largest_width());
  Kernel kernel;
  SurfaceModels models(bounds, kernel);
  const MeshCorners maker(e, bounds);
  const auto sides = sides_of_points(mesh, maker);
  std::vector<Corner> corners;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    corners.push_back(maker.corner(mesh.points[k], sides ? (*sides)[k] : kWithin));
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
    if (!(length(mesh.normals[k] - unit(function.gradient(mesh.points[k]))) < 0x1p-20))
      return "the normal at point " + std::to_string(k) + " is not the surface's";
  double way = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const auto& [p, q, r] = mesh.triangles[k];
    const TriangleBounds proved =
        bound_triangle(models, {corners[p], corners[q], corners[r]}, mesh.tolerance, maker.moved());
    way = std::max(way, proved.way);
    if (!(proved.distance <= mesh.distances[k]))
      return "the distance of " + triangle_name(k) + " is not proved";
    if (!(proved.angle <= mesh.angles[k]))
      return "the angle of " + triangle_name(k) + " is not proved";
    if (mesh.distances[k] > mesh.distance || mesh.angles[k] > mesh.angle)
      return triangle_name(k) + " is farther away or steeper than the mesh says";
  }
  const bool covered = sides && covers_surface(mesh, e, maker, corners, way);
  if (std::isfinite(mesh.distance_to_mesh) && !(covered && way <= mesh.distance_to_mesh))
    return "the surface's distance from the mesh is not proved";
  if (mesh.isotopic && !(covered && is_embedded(mesh, maker)))
    return "that mesh and surface are isotopic is not proved";
  return "";
}

bool have_an_arc(const SpaceCell& cell, int surface, int other) {
  const std::array<int, 2> pair{std::min(surface, other), std::max(surface, other)};
  return std::any_of(cell.arcs.begin(), cell.arcs.end(),
                     [&](const SurfaceArc& arc) { return arc.surfaces == pair; });
}

/// Whether triangles of two meshes do not meet in cells in which the surfaces do not.
bool are_apart(const SurfaceMesh& mesh, const SurfaceMesh& other, const SurfaceEncasement& e) {
  std::vector<Point<3>> points = mesh.points;
  points.insert(points.end(), other.points.begin(), other.points.end());
  const int offset = static_cast<int>(mesh.points.size());
  std::vector<std::vector<std::array<int, 3>>> triangles(e.cells.size());
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    triangles[mesh.cells[k]].push_back(mesh.triangles[k]);
  std::vector<int> first;
  for (const auto& of_cell : triangles) first.push_back(static_cast<int>(of_cell.size()));
  for (std::size_t k = 0; k < other.triangles.size(); ++k) {
    const auto& [p, q, r] = other.triangles[k];
    triangles[other.cells[k]].push_back({p + offset, q + offset, r + offset});
  }
  const double margin = 0x1p-40 * e.region_used.bounding_box().largest_width();
  for (std::size_t c = 0; c < e.cells.size(); ++c)
    if (!have_an_arc(e.cells[c], mesh.surface, other.surface) &&
        !near_triangles(points, triangles[c], margin, first[c]).empty())
      return false;
  return true;
}

}  // namespace

std::string check(const std::vector<SurfaceMesh>& meshes, const SurfaceEncasement& encasement) {
  for (const SurfaceMesh& mesh : meshes)
    if (std::string objection = check(mesh, encasement); !objection.empty()) return objection;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (std::size_t j = i + 1; j < meshes.size(); ++j)
      if (meshes[i].apart && meshes[j].apart && !are_apart(meshes[i], meshes[j], encasement))
        return "that meshes are apart where the surfaces are is not proved";
  return "";
}

std::string check(const SurfaceMesh& mesh, const SurfaceEncasement& encasement) {
  const std::size_t count = mesh.triangles.size();
  if (mesh.surface < 0 || mesh.surface >= static_cast<int>(encasement.surfaces.size()))
    return "the surface is none of the encasement";
  if (mesh.cells.size() != count || mesh.distances.size() != count || mesh.angles.size() != count ||
      mesh.normals.size() != mesh.points.size())
    return "the lists do not have the same length";
  for (std::size_t k = 0; k < count; ++k)
    if (mesh.cells[k] < 0 || mesh.cells[k] >= static_cast<int>(encasement.cells.size()))
      return triangle_name(k) + " lies in no cell";
  if (mesh.complete && !surface_topology(encasement)[mesh.surface].complete)
    return "cells without certificate may meet the surface";
  if (mesh.within_tolerance && !(mesh.distance <= mesh.tolerance))
    return "the distance is larger than the tolerance";
  for (const auto& look : {check_edges, check_cells, check_bounds})
    if (std::string objection = look(mesh, encasement); !objection.empty()) return objection;
  return "";
}

}  // namespace encase
