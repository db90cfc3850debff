// SPDX-License-Identifier: MIT
#include "surface_blocks.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "encase/version.hpp"
#include "io/names.hpp"

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

template <class Surfaces>
std::string names_of(const SurfaceEncasement& e, const Surfaces& surfaces) {
  std::string names;
  for (const int k : surfaces) names += (names.empty() ? "" : ", ") + e.surfaces[k].name;
  return names;
}

/// Array names for the surfaces' signs: their names in plain ASCII, all different.
std::vector<std::string> sign_names(const SurfaceEncasement& e) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < e.surfaces.size(); ++k) {
    std::string name = "sign_";
    for (const char c : e.surfaces[k].name) {
      const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      name += plain ? c : '_';
    }
    if (!seen.insert(name).second) {
      name += "_" + std::to_string(k);
      seen.insert(name);
    }
    names.push_back(name);
  }
  return names;
}

/// Every cell as the polygons around it.
vtkPolyData* fill_cells(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* depth = table->integers("depth");
  vtkIntArray* certified = table->integers("certified");
  std::vector<vtkIntArray*> signs;
  for (const std::string& name : sign_names(e)) signs.push_back(table->integers(name));
  for (std::size_t k = 0; k < e.cells.size(); ++k) {
    const SpaceCell& cell = e.cells[k];
    for (const int f : cell.facets) {
      // Counter-clockwise seen from outside the cell.
      std::vector<Point<3>> polygon = scene.polygons[f];
      if (e.facets[f].cells[1] == static_cast<int>(k)) std::reverse(polygon.begin(), polygon.end());
      table->polygon(polygon);
      id->InsertNextValue(static_cast<int>(k));
      kind->InsertNextValue(kind_of(cell));
      depth->InsertNextValue(cell.depth);
      certified->InsertNextValue(cell.state == CellState::Certified);
      for (std::size_t s = 0; s < signs.size(); ++s)
        signs[s]->InsertNextValue(s < cell.signs.size() ? static_cast<int>(cell.signs[s]) : 0);
    }
  }
  return table->finish(field_data(e), false);
}

vtkPolyData* fill_facets(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* plane = table->integers("plane");
  vtkIntArray* negative = table->integers("negative_cell");
  vtkIntArray* positive = table->integers("positive_cell");
  vtkIntArray* count = table->integers("surface_count");
  vtkStringArray* name = table->strings("surface_name");
  vtkIntArray* certified = table->integers("certified");
  for (std::size_t k = 0; k < e.facets.size(); ++k) {
    const Facet& facet = e.facets[k];
    table->polygon(scene.polygons[k]);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(facet.cells[0] < 0 || facet.cells[1] < 0);
    plane->InsertNextValue(facet.plane);
    negative->InsertNextValue(facet.cells[0]);
    positive->InsertNextValue(facet.cells[1]);
    count->InsertNextValue(static_cast<int>(facet.surfaces.size()));
    name->InsertNextValue(names_of(e, facet.surfaces).c_str());
    certified->InsertNextValue(facet.surfaces.empty() ||
                               facet.encasement.outcome == Outcome::Certified);
  }
  return table->finish(field_data(e), false);
}

vtkPolyData* fill_surfaces(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* surface = table->integers("surface");
  vtkStringArray* name = table->strings("surface_name");
  vtkIntArray* cell = table->integers("cell");
  vtkDoubleArray* distance = table->doubles("distance");
  vtkDoubleArray* angle = table->doubles("angle");
  vtkIntArray* certified = table->integers("certified");
  vtkDoubleArray* normals = table->point_vectors("Normals");
  int before = 0, count = 0;
  for (const SurfaceMesh& mesh : scene.meshes) {
    table->points(mesh.points);
    for (const Point<3>& normal : mesh.normals) normals->InsertNextTuple(normal.data());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& [p, q, r] = mesh.triangles[k];
      table->triangle({before + p, before + q, before + r});
      id->InsertNextValue(count++);
      surface->InsertNextValue(mesh.surface);
      name->InsertNextValue(e.surfaces[mesh.surface].name.c_str());
      cell->InsertNextValue(mesh.cells[k]);
      distance->InsertNextValue(mesh.distances[k]);
      angle->InsertNextValue(mesh.angles[k]);
      certified->InsertNextValue(std::isfinite(mesh.distances[k]));
    }
    before += static_cast<int>(mesh.points.size());
  }
  return table->finish(field_data(e), false);
}

vtkPolyData* fill_curves(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* surface = table->integers("surface");
  vtkIntArray* second = table->integers("second_surface");
  vtkStringArray* name = table->strings("surface_name");
  vtkDoubleArray* distance = table->doubles("distance");
  vtkIntArray* certified = table->integers("certified");
  vtkDoubleArray* tangent = table->point_vectors("tangent");
  vtkDoubleArray* normal = table->point_vectors("normal");
  vtkDoubleArray* second_normal = table->point_vectors("second_normal");
  for (std::size_t k = 0; k < scene.curves.curves.size(); ++k) {
    const TracedIntersection& traced = scene.curves.curves[k];
    table->polyline(traced.points);
    double largest = 0;
    for (const double d : traced.distances) largest = std::max(largest, d);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(traced.curve.closed);
    surface->InsertNextValue(traced.curve.surfaces[0]);
    second->InsertNextValue(traced.curve.surfaces[1]);
    name->InsertNextValue(names_of(e, traced.curve.surfaces).c_str());
    distance->InsertNextValue(largest);
    certified->InsertNextValue(std::isfinite(largest));
    for (std::size_t i = 0; i < traced.points.size(); ++i) {
      tangent->InsertNextTuple(traced.tangents[i].data());
      normal->InsertNextTuple(traced.normals[i][0].data());
      second_normal->InsertNextTuple(traced.normals[i][1].data());
    }
  }
  return table->finish(field_data(e), false);
}

vtkPolyData* fill_points(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  std::array<vtkIntArray*, 3> surface = {table->integers("surface"),
                                         table->integers("second_surface"),
                                         table->integers("third_surface")};
  vtkStringArray* name = table->strings("surface_name");
  vtkIntArray* cell = table->integers("cell");
  vtkDoubleArray* radius = table->doubles("radius");
  vtkIntArray* certified = table->integers("certified");
  for (std::size_t k = 0; k < e.triple_points.size(); ++k) {
    const TriplePoint& t = e.triple_points[k];
    table->vertex(t.point);
    id->InsertNextValue(static_cast<int>(k));
    for (int i = 0; i < 3; ++i) surface[i]->InsertNextValue(t.surfaces[i]);
    name->InsertNextValue(names_of(e, t.surfaces).c_str());
    cell->InsertNextValue(t.cell);
    radius->InsertNextValue(0.5 * t.box.largest_width());
    certified->InsertNextValue(1);
  }
  return table->finish(field_data(e), true);
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
vtkPolyData* fill_critical_regions(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* surface = table->integers("surface");
  vtkIntArray* second = table->integers("second_surface");
  vtkStringArray* name = table->strings("surface_name");
  vtkIntArray* certified = table->integers("certified");
  int count = 0;
  for (const CurveCriticalPoints& critical : e.critical_points)
    for (const Box<3>& box : critical.points) {
      for (const auto& side : sides_of(box)) {
        table->polygon(side);
        id->InsertNextValue(count);
        surface->InsertNextValue(critical.surfaces[0]);
        second->InsertNextValue(critical.surfaces[1]);
        name->InsertNextValue(names_of(e, critical.surfaces).c_str());
        certified->InsertNextValue(1);
      }
      ++count;
    }
  return table->finish(field_data(e), false);
}

vtkPolyData* fill_unresolved(const SurfaceScene& scene, VtkTable* table) {
  const SurfaceEncasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkStringArray* kind_name = table->strings("kind_name");
  vtkStringArray* name = table->strings("surface_name");
  vtkStringArray* reason = table->strings("reason");
  vtkIntArray* certified = table->integers("certified");
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
        id->InsertNextValue(count);
        kind->InsertNextValue(static_cast<int>(place.kind));
        kind_name->InsertNextValue(name_of(kUnresolvedKinds, place.kind));
        name->InsertNextValue(names_input_curves(place.kind) ? ""
                                                             : names_of(e, place.surfaces).c_str());
        reason->InsertNextValue(place.reason.c_str());
        certified->InsertNextValue(0);
      }
      ++count;
    }
  return table->finish(field_data(e), false);
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

FieldData field_data(const SurfaceEncasement& encasement) {
  std::vector<std::string> input;
  for (const NamedSurface& surface : encasement.input)
    input.push_back(surface.name + ": " + surface.function.to_string());
  return {{"status", {name_of(kOutcomes, encasement.outcome)}},
          {"input", input},
          {"version", {std::string("encase ") + kVersion}}};
}

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

vtkPolyData* fill_surface_block(const SurfaceScene& scene, std::size_t block, VtkTable* table) {
  constexpr std::array<vtkPolyData* (*)(const SurfaceScene&, VtkTable*), kSurfaceBlocks.size()>
      kFill = {fill_cells,  fill_facets,           fill_surfaces,  fill_curves,
               fill_points, fill_critical_regions, fill_unresolved};
  return kFill[block](scene, table);
}

vtkPolyData* fill_surface_step(const SurfaceEncasement& e,
                               const std::vector<std::vector<Point<3>>>& polygons, int cuts,
                               VtkTable* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* plane = table->integers("plane");
  vtkIntArray* kind = table->integers("kind");
  const std::vector<int> pieces = pieces_after(e, cuts);
  for (std::size_t k = 0; k < e.facets.size(); ++k) {
    const auto& [a, b] = e.facets[k].cells;
    const bool outer = a < 0 || b < 0;
    if (!outer && pieces[a] == pieces[b]) continue;
    table->polygon(polygons[k]);
    id->InsertNextValue(static_cast<int>(k));
    plane->InsertNextValue(e.facets[k].plane);
    kind->InsertNextValue(outer);
  }
  return table->finish(field_data(e), false);
}

}  // namespace encase
