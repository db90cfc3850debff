// SPDX-License-Identifier: MIT
#include "surface_blocks.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "io/names.hpp"
#include "vtk_parts.hpp"

namespace encase {
namespace {

/// The kinds of cells; docs/vtk.md.
enum CellKind { kEmpty, kOneSurface, kSeveral, kMeeting, kDegenerate, kUndecided };

int kind_of(const SpaceCell& cell) {
  if (cell.state == CellState::Degenerate) return kDegenerate;
  if (cell.state != CellState::Certified) return kUndecided;
  if (!cell.arcs.empty()) return kMeeting;
  std::set<int> surfaces;
  for (const SurfacePatch& patch : cell.patches) surfaces.insert(patch.surface);
  return surfaces.empty() ? kEmpty : surfaces.size() == 1 ? kOneSurface : kSeveral;
}

/// Every cell as the polygons around it.
void fill_cells(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("depth"), integer("certified"));
  const SignColumns add_signs(e.surfaces, table);
  for (std::size_t k = 0; k < e.cells.size(); ++k) {
    const SpaceCell& cell = e.cells[k];
    for (const int f : cell.facets) {
      // Counter-clockwise seen from outside the cell.
      std::vector<Point<3>> polygon = scene.polygons[f];
      if (e.facets[f].cells[1] == static_cast<int>(k)) std::reverse(polygon.begin(), polygon.end());
      table->polygon(polygon);
      add(k, kind_of(cell), cell.depth, cell.state == CellState::Certified);
      add_signs(cell.signs);
    }
  }
}

void fill_facets(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("plane"), integer("negative_cell"),
                     integer("positive_cell"), integer("surface_count"), text("surface_name"),
                     integer("certified"));
  for (std::size_t k = 0; k < e.facets.size(); ++k) {
    const Facet& facet = e.facets[k];
    table->polygon(scene.polygons[k]);
    add(k, facet.cells[0] < 0 || facet.cells[1] < 0, facet.plane, facet.cells[0], facet.cells[1],
        facet.surfaces.size(), names_of(e.surfaces, facet.surfaces),
        facet.surfaces.empty() || facet.encasement.outcome == Outcome::Certified);
  }
}

void fill_surfaces(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("surface"), text("surface_name"), integer("cell"),
                     number("distance"), number("angle"), integer("certified"));
  vtkDoubleArray* normals = table->point_vectors("Normals");
  int before = 0, count = 0;
  for (const SurfaceMesh& mesh : scene.meshes) {
    table->points(mesh.points);
    for (const Point<3>& normal : mesh.normals) normals->InsertNextTuple(normal.data());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& [p, q, r] = mesh.triangles[k];
      table->triangle({before + p, before + q, before + r});
      add(count++, mesh.surface, e.surfaces[mesh.surface].name, mesh.cells[k], mesh.distances[k],
          mesh.angles[k], std::isfinite(mesh.distances[k]));
    }
    before += static_cast<int>(mesh.points.size());
  }
}

void fill_curves(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("surface"), integer("second_surface"),
                     text("surface_name"), number("distance"), integer("certified"));
  vtkDoubleArray* tangent = table->point_vectors("tangent");
  vtkDoubleArray* normal = table->point_vectors("normal");
  vtkDoubleArray* second_normal = table->point_vectors("second_normal");
  for (std::size_t k = 0; k < scene.curves.curves.size(); ++k) {
    const TracedIntersection& traced = scene.curves.curves[k];
    table->polyline(traced.points);
    double largest = 0;
    for (const double d : traced.distances) largest = std::max(largest, d);
    add(k, traced.curve.closed, traced.curve.surfaces[0], traced.curve.surfaces[1],
        names_of(e.surfaces, traced.curve.surfaces), largest, std::isfinite(largest));
    for (std::size_t i = 0; i < traced.points.size(); ++i) {
      tangent->InsertNextTuple(traced.tangents[i].data());
      normal->InsertNextTuple(traced.normals[i][0].data());
      second_normal->InsertNextTuple(traced.normals[i][1].data());
    }
  }
}

void fill_points(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add = table->columns(integer("id"), integer("surface"), integer("second_surface"),
                                  integer("third_surface"), text("surface_name"), integer("cell"),
                                  number("radius"), integer("certified"));
  for (std::size_t k = 0; k < e.triple_points.size(); ++k) {
    const TriplePoint& t = e.triple_points[k];
    table->vertex(t.point);
    add(k, t.surfaces[0], t.surfaces[1], t.surfaces[2], names_of(e.surfaces, t.surfaces), t.cell,
        0.5 * t.box.largest_width(), 1);
  }
}

/// The six sides of a box.
std::vector<std::vector<Point<3>>> sides_of(const Box<3>& box) {
  std::vector<std::vector<Point<3>>> sides;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::vector<Point<3>> side;
      for (const auto& [s, t] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
        Point<3> p;
        p[axis] = upper ? box.hi[axis] : box.lo[axis];
        p[u] = s ? box.hi[u] : box.lo[u];
        p[v] = t ? box.hi[v] : box.lo[v];
        side.push_back(p);
      }
      if (!upper) std::reverse(side.begin(), side.end());
      sides.push_back(side);
    }
  return sides;
}

/// The boxes of the curves' critical points.
void fill_critical_regions(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add = table->columns(integer("id"), integer("surface"), integer("second_surface"),
                                  text("surface_name"), integer("certified"));
  int count = 0;
  for (const CurveCriticalPoints& critical : e.critical_points)
    for (const Box<3>& box : critical.points) {
      for (const auto& side : sides_of(box)) {
        table->polygon(side);
        add(count, critical.surfaces[0], critical.surfaces[1],
            names_of(e.surfaces, critical.surfaces), 1);
      }
      ++count;
    }
}

void fill_unresolved(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  const auto add = table->columns(integer("id"), integer("kind"), text("kind_name"),
                                  text("surface_name"), text("reason"), integer("certified"));
  int count = 0;
  for (const auto* places : {&e.degenerate, &e.undecided})
    for (const UnresolvedInSpace& place : *places) {
      if (!place.has_box) continue;
      // The cells that are not certified because of it, rather than one box around a long curve.
      std::vector<std::vector<Point<3>>> sides;
      for (const int cell : place.cells)
        for (const auto& side : sides_of(e.cells[cell].box)) sides.push_back(side);
      if (sides.empty())
        for (const auto& side : sides_of(place.box)) sides.push_back(side);
      for (const auto& side : sides) {
        table->polygon(side);
        add(count, place.kind, name_of(kUnresolvedKinds, place.kind),
            names_input_curves(place.kind) ? "" : names_of(e.surfaces, place.surfaces),
            place.reason, 0);
      }
      ++count;
    }
}

/// Of every cell the piece it is a part of after so many cuts: an entry of the history, or the
/// cell as ~cell.
std::vector<int> pieces_after(const SurfaceEncasement& e, int cuts) {
  std::vector<int> parent(e.history.size(), -1), of_cell(e.cells.size(), -1);
  for (std::size_t k = 0; k < e.history.size(); ++k)
    for (const int child : {e.history[k].negative, e.history[k].positive})
      (child >= 0 ? parent[child] : of_cell[~child]) = static_cast<int>(k);
  std::vector<int> pieces;
  for (std::size_t c = 0; c < e.cells.size(); ++c) {
    int piece = ~static_cast<int>(c);
    for (int node = of_cell[c]; node >= 0; node = parent[node])
      if (node >= cuts) piece = node;
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace

std::vector<std::vector<Point<3>>> facet_polygons(const SurfaceEncasement& encasement) {
  std::vector<std::vector<Point<3>>> polygons;
  for (const Facet& facet : encasement.facets) {
    const PlaneChart chart(encasement.planes[facet.plane].exact());
    auto& polygon = polygons.emplace_back();
    for (const RationalPoint<2>& corner : facet.polygon.corners) {
      const RationalPoint<3> p = chart.lift(corner);
      polygon.push_back({nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])});
    }
  }
  return polygons;
}

std::vector<VtkBlock> surface_blocks(const SurfaceScene& scene) {
  using enum VtkRowsOf;
  return {block_of(scene, "cells", Primitives, fill_cells),
          block_of(scene, "facets", Primitives, fill_facets),
          block_of(scene, "surfaces", Primitives, fill_surfaces),
          block_of(scene, "intersection_curves", Primitives, fill_curves),
          block_of(scene, "points", Points, fill_points),
          block_of(scene, "critical_regions", Primitives, fill_critical_regions),
          block_of(scene, "unresolved", Primitives, fill_unresolved)};
}

void fill_surface_step(const SurfaceEncasement& e,
                       const std::vector<std::vector<Point<3>>>& polygons, int cuts,
                       VtkTable* table) {
  const auto add = table->columns(integer("id"), integer("plane"), integer("kind"));
  const std::vector<int> pieces = pieces_after(e, cuts);
  for (std::size_t k = 0; k < e.facets.size(); ++k) {
    const auto& [a, b] = e.facets[k].cells;
    const bool outer = a < 0 || b < 0;
    if (!outer && pieces[a] == pieces[b]) continue;
    table->polygon(polygons[k]);
    add(k, e.facets[k].plane, outer);
  }
}

}  // namespace encase
