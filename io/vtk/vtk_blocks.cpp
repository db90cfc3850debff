// SPDX-License-Identifier: MIT
#include "vtk_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "2d/clearing.hpp"
#include "2d/ear_cutting.hpp"
#include "io/names.hpp"

namespace encase {
namespace {

/// Between a curve and its polyline, as a part of the region's size.
constexpr double kTolerance = 1e-4;

/// The kinds of cells; docs/vtk.md.
enum CellKind { kEmpty, kOneCurve, kCrossing, kRelaxed, kDegenerate, kUndecided };

/// The names of curves, with commas.
std::string names_of(const Encasement& e, const std::vector<int>& curves) {
  std::string names;
  for (const int curve : curves) names += (names.empty() ? "" : ", ") + e.curves[curve].name;
  return names;
}

/// Array names for the curves' signs: their names in plain ASCII, all different.
std::vector<std::string> sign_names(const Encasement& encasement) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < encasement.curves.size(); ++k) {
    std::string name = "sign_";
    for (const char c : encasement.curves[k].name) {
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

vtkPolyData* fill_cells(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* crossing = table->integers("crossing");
  vtkIntArray* depth = table->integers("depth");
  vtkIntArray* certified = table->integers("certified");
  std::vector<vtkIntArray*> signs;
  for (const std::string& name : sign_names(e)) signs.push_back(table->integers(name));
  CellSigns cell_signs(e);
  for (std::size_t k = 0; k < e.cells.size(); ++k) {
    const Cell& cell = e.cells[k];
    table->polygon(cell_corners(cell));
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(cell_kind(cell));
    const int only = cell.branches.size() == 1 ? cell.branches[0].curve : -1;
    curve->InsertNextValue(only);
    std::vector<int> curves;
    for (const Branch& branch : cell.branches) curves.push_back(branch.curve);
    curve_name->InsertNextValue(names_of(e, curves).c_str());
    crossing->InsertNextValue(cell.crossing);
    depth->InsertNextValue(cell.depth);
    certified->InsertNextValue(is_certified(cell));
    const std::vector<int> values = cell_signs.of(cell);
    for (std::size_t c = 0; c < signs.size(); ++c) signs[c]->InsertNextValue(values[c]);
  }
  return table->finish(e, false);
}

vtkPolyData* fill_curves(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* certified = table->integers("certified");
  int count = 0;
  for (const auto& [of, line] : scene.curves) {
    table->polyline(line);
    id->InsertNextValue(count++);
    kind->InsertNextValue(line.size() > 2 && line.front() == line.back());
    curve->InsertNextValue(of);
    curve_name->InsertNextValue(e.curves[of].name.c_str());
    certified->InsertNextValue(1);
  }
  return table->finish(e, false);
}

vtkPolyData* fill_points(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkIntArray* second = table->integers("second_curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* cell = table->integers("cell");
  vtkIntArray* depth = table->integers("depth");
  vtkDoubleArray* radius = table->doubles("radius");
  vtkIntArray* certified = table->integers("certified");
  for (std::size_t k = 0; k < e.crossings.size(); ++k) {
    const Crossing& crossing = e.crossings[k];
    table->vertex(crossing.point);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(static_cast<int>(crossing.location));
    curve->InsertNextValue(crossing.curves[0]);
    second->InsertNextValue(crossing.curves[1]);
    curve_name->InsertNextValue(names_of(e, {crossing.curves[0], crossing.curves[1]}).c_str());
    cell->InsertNextValue(crossing.cell);
    depth->InsertNextValue(crossing.cell >= 0 ? e.cells[crossing.cell].depth : -1);
    radius->InsertNextValue(0.5 * crossing.box.largest_width());
    certified->InsertNextValue(1);
  }
  return table->finish(e, true);
}

vtkPolyData* fill_critical_regions(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* certified = table->integers("certified");
  for (std::size_t k = 0; k < e.critical_regions.size(); ++k) {
    const CriticalRegion& region = e.critical_regions[k];
    for (const Box<2>& box : region.boxes) {
      table->rectangle(box);
      id->InsertNextValue(static_cast<int>(k));
      kind->InsertNextValue(static_cast<int>(region.sign));
      curve->InsertNextValue(region.curve);
      curve_name->InsertNextValue(e.curves[region.curve].name.c_str());
      certified->InsertNextValue(1);
    }
  }
  return table->finish(e, false);
}

vtkPolyData* fill_unresolved(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkStringArray* kind_name = table->strings("kind_name");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkStringArray* reason = table->strings("reason");
  vtkIntArray* certified = table->integers("certified");
  int count = 0;
  for (const auto* places : {&e.degenerate, &e.undecided}) {
    for (const Unresolved& place : *places) {
      if (!place.has_box) continue;
      table->rectangle(place.box);
      id->InsertNextValue(count++);
      kind->InsertNextValue(static_cast<int>(place.kind));
      kind_name->InsertNextValue(name_of(kUnresolvedKinds, place.kind));
      curve->InsertNextValue(place.curves.size() == 1 ? place.curves[0] : -1);
      std::string names;
      for (const int c : place.curves)
        if (c >= 0 && c < static_cast<int>(e.curves.size()))
          names += (names.empty() ? "" : ", ") + e.curves[c].name;
      curve_name->InsertNextValue(names.c_str());
      reason->InsertNextValue(place.reason.c_str());
      certified->InsertNextValue(0);
    }
  }
  return table->finish(e, false);
}

/// The triangles of which a face is the union, with the signs of the face: not every reader fills
/// polygons with a dent rightly.
vtkPolyData* fill_faces(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* piece = table->integers("piece");
  vtkIntArray* cell = table->integers("cell");
  vtkIntArray* certified = table->integers("certified");
  std::vector<vtkIntArray*> signs;
  for (const std::string& name : sign_names(e)) signs.push_back(table->integers(name));
  if (!scene.arrangement) return table->finish(e, false);
  const Arrangement& a = *scene.arrangement;
  table->points(scene.pieces.points);
  for (std::size_t k = 0; k < a.pieces.size(); ++k) {
    const std::vector<Sign>& of_face = a.faces[a.pieces[k].face].signs;
    for (const auto& triangle : cut_ears(scene.pieces.points, scene.pieces.pieces[k])) {
      table->triangle(triangle);
      id->InsertNextValue(a.pieces[k].face);
      piece->InsertNextValue(static_cast<int>(k));
      cell->InsertNextValue(a.pieces[k].cell);
      certified->InsertNextValue(1);
      for (std::size_t c = 0; c < signs.size(); ++c)
        signs[c]->InsertNextValue(static_cast<int>(of_face[c]));
    }
  }
  return table->finish(e, false);
}

vtkPolyData* fill_edges(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* left = table->integers("left_face");
  vtkIntArray* right = table->integers("right_face");
  vtkIntArray* certified = table->integers("certified");
  for (std::size_t k = 0; k < scene.edges.size(); ++k) {
    const Arrangement& a = *scene.arrangement;
    const auto edge = static_cast<int>(k);
    const int on = a.edges[k].curve;
    table->polyline(scene.edges[k]);
    id->InsertNextValue(edge);
    kind->InsertNextValue(on < 0 ? 2 : a.half_edges[2 * k].origin < 0 ? 1 : 0);
    curve->InsertNextValue(on);
    curve_name->InsertNextValue(on < 0 ? "" : e.curves[on].name.c_str());
    left->InsertNextValue(a.faces_at(edge)[0]);
    right->InsertNextValue(a.faces_at(edge)[1]);
    certified->InsertNextValue(1);
  }
  return table->finish(e, false);
}

/// The curves through a vertex.
std::vector<int> curves_at(const Encasement& e, const Arrangement::Vertex& vertex) {
  if (vertex.kind == Arrangement::Vertex::Kind::Corner) return {};
  if (vertex.kind == Arrangement::Vertex::Kind::OnBoundary)
    return {e.line_crossings[vertex.index].curve};
  const std::array<int, 2>& curves = e.crossings[vertex.index].curves;
  return {curves.begin(), curves.end()};
}

vtkPolyData* fill_vertices(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkStringArray* kind_name = table->strings("kind_name");
  vtkIntArray* curve = table->integers("curve");
  vtkIntArray* second = table->integers("second_curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* certified = table->integers("certified");
  if (!scene.arrangement) return table->finish(e, true);
  for (std::size_t k = 0; k < scene.arrangement->vertices.size(); ++k) {
    const Arrangement::Vertex& vertex = scene.arrangement->vertices[k];
    const std::vector<int> curves = curves_at(e, vertex);
    table->vertex(vertex.point);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(static_cast<int>(vertex.kind));
    kind_name->InsertNextValue(name_of(kVertexKinds, vertex.kind));
    curve->InsertNextValue(curves.empty() ? -1 : curves[0]);
    second->InsertNextValue(curves.size() < 2 ? -1 : curves[1]);
    curve_name->InsertNextValue(names_of(e, curves).c_str());
    certified->InsertNextValue(1);
  }
  return table->finish(e, true);
}

/// The point halfway along a polyline.
Point<2> middle_of(const Polyline& line) {
  const auto length = [&](std::size_t k) {
    return std::hypot(line[k][0] - line[k - 1][0], line[k][1] - line[k - 1][1]);
  };
  double left = 0;
  for (std::size_t k = 1; k < line.size(); ++k) left += 0.5 * length(k);
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double here = length(k), part = here > 0 ? left / here : 0;
    if (left <= here)
      return {line[k - 1][0] + part * (line[k][0] - line[k - 1][0]),
              line[k - 1][1] + part * (line[k][1] - line[k - 1][1])};
    left -= here;
  }
  return line.back();
}

/// A point with a name for every face, where it is widest, every edge and every vertex.
vtkPolyData* fill_labels(const VtkScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkStringArray* label = table->strings("label");
  vtkIntArray* certified = table->integers("certified");
  if (!scene.arrangement) return table->finish(e, true);
  const auto put = [&](int of_kind, std::size_t k, const Point<2>& at) {
    table->vertex(at);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(of_kind);
    label->InsertNextValue(("fev"[of_kind] + std::to_string(k)).c_str());
    certified->InsertNextValue(1);
  };
  const Arrangement& a = *scene.arrangement;
  const double precision = kTolerance * e.region_used.bounding_box().largest_width();
  for (std::size_t k = 0; k < a.faces.size(); ++k) {
    if (a.faces[k].outer < 0) continue;
    const Clearing clearing = largest_clearing(boundaries(a, scene.edges, a.faces[k]), precision);
    if (clearing.radius > 0) put(0, k, clearing.center);
  }
  for (std::size_t k = 0; k < a.edges.size(); ++k) put(1, k, middle_of(scene.edges[k]));
  for (std::size_t k = 0; k < a.vertices.size(); ++k) put(2, k, a.vertices[k].point);
  return table->finish(e, true);
}

/// The curves' components, from the edges along them.
std::vector<std::pair<int, Polyline>> curves_along(const Arrangement& a,
                                                   const std::vector<Polyline>& edges) {
  std::vector<std::pair<int, Polyline>> curves;
  for (const Arrangement::CurveComponent& component : a.curve_components) {
    Polyline line;
    for (const int h : component.half_edges) {
      Polyline part = edges[Arrangement::edge_of(h)];
      if (h % 2 == 1) std::reverse(part.begin(), part.end());
      line.insert(line.end(), part.begin() + (line.empty() ? 0 : 1), part.end());
    }
    curves.emplace_back(component.curve, std::move(line));
  }
  return curves;
}

}  // namespace

int cell_kind(const Cell& cell) {
  if (cell.state == CellState::Degenerate) return kDegenerate;
  if (cell.state == CellState::Undecided) return kUndecided;
  if (cell.state == CellState::Relaxed) return kRelaxed;
  if (cell.crossing >= 0) return kCrossing;
  return cell.branches.empty() ? kEmpty : kOneCurve;
}

std::vector<Point<2>> cell_corners(const Cell& cell) {
  std::vector<Point<2>> points;
  for (const Vertex& vertex : cell.vertices)
    if (vertex.line_in != vertex.line_out) points.push_back(vertex.point);
  return points;
}

Result<VtkScene> make_vtk_scene(const Encasement& e) {
  VtkScene scene{e, std::nullopt, {}, {}, {}};
  const double tolerance = kTolerance * e.region_used.bounding_box().largest_width();
  Result<Arrangement> arranged = arrange(e);
  if (!arranged) {
    for (int k = 0; k < static_cast<int>(e.curves.size()); ++k)
      for (Polyline& line : trace_curve(e, k, tolerance))
        scene.curves.emplace_back(k, std::move(line));
    return scene;
  }
  scene.arrangement = std::move(arranged).value();
  scene.edges = trace_edges(e, *scene.arrangement, tolerance);
  scene.curves = curves_along(*scene.arrangement, scene.edges);
  Result<PieceComplex> pieces = make_piece_complex(e, *scene.arrangement, scene.edges);
  if (!pieces) return pieces.error();
  scene.pieces = std::move(pieces).value();
  return scene;
}

vtkPolyData* fill_block(const VtkScene& scene, std::size_t block, VtkTable* table) {
  constexpr std::array<vtkPolyData* (*)(const VtkScene&, VtkTable*), kVtkBlocks.size()> kFill = {
      fill_cells, fill_curves,   fill_points, fill_critical_regions, fill_unresolved, fill_faces,
      fill_edges, fill_vertices, fill_labels};
  return kFill[block](scene, table);
}

}  // namespace encase
