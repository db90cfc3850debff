// SPDX-License-Identifier: MIT
#include "curve_blocks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "2d/clearing.hpp"
#include "2d/ear_cutting.hpp"
#include "io/names.hpp"
#include "vtk_parts.hpp"

namespace encase {
namespace {

/// Between a curve and its polyline, as a part of the region's size.
constexpr double kTolerance = 1e-4;

/// The kinds of cells; docs/vtk.md.
enum CellKind { kEmpty, kOneCurve, kCrossing, kRelaxed, kDegenerate, kUndecided };

void fill_cells(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("curve"), text("curve_name"),
                     integer("crossing"), integer("depth"), integer("certified"));
  const SignColumns add_signs(e.curves, table);
  CellSigns cell_signs(e);
  for (std::size_t k = 0; k < e.cells.size(); ++k) {
    const Cell& cell = e.cells[k];
    table->polygon(cell_corners(cell));
    const int only = cell.branches.size() == 1 ? cell.branches[0].curve : -1;
    std::vector<int> curves;
    for (const Branch& branch : cell.branches) curves.push_back(branch.curve);
    add(k, cell_kind(cell), only, names_of(e.curves, curves), cell.crossing, cell.depth,
        is_certified(cell));
    add_signs(cell_signs.of(cell));
  }
}

void fill_curves(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add = table->columns(integer("id"), integer("kind"), integer("curve"),
                                  text("curve_name"), integer("certified"));
  int count = 0;
  for (const auto& [of, line] : scene.curves) {
    table->polyline(line);
    add(count++, line.size() > 2 && line.front() == line.back(), of, e.curves[of].name, 1);
  }
}

void fill_points(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add = table->columns(integer("id"), integer("kind"), integer("curve"),
                                  integer("second_curve"), text("curve_name"), integer("cell"),
                                  integer("depth"), number("radius"), integer("certified"));
  for (std::size_t k = 0; k < e.crossings.size(); ++k) {
    const Crossing& crossing = e.crossings[k];
    table->vertex(crossing.point);
    add(k, crossing.location, crossing.curves[0], crossing.curves[1],
        names_of(e.curves, crossing.curves), crossing.cell,
        crossing.cell >= 0 ? e.cells[crossing.cell].depth : -1, 0.5 * crossing.box.largest_width(),
        1);
  }
}

void fill_critical_regions(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add = table->columns(integer("id"), integer("kind"), integer("curve"),
                                  text("curve_name"), integer("certified"));
  for (std::size_t k = 0; k < e.critical_regions.size(); ++k) {
    const CriticalRegion& region = e.critical_regions[k];
    for (const Box<2>& box : region.boxes) {
      table->rectangle(box);
      add(k, region.sign, region.curve, e.curves[region.curve].name, 1);
    }
  }
}

void fill_unresolved(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), text("kind_name"), integer("curve"),
                     text("curve_name"), text("reason"), integer("certified"));
  int count = 0;
  for (const auto* places : {&e.degenerate, &e.undecided}) {
    for (const Unresolved& place : *places) {
      if (!place.has_box) continue;
      table->rectangle(place.box);
      add(count++, place.kind, name_of(kUnresolvedKinds, place.kind),
          place.curves.size() == 1 ? place.curves[0] : -1, names_of(e.curves, place.curves),
          place.reason, 0);
    }
  }
}

/// The triangles of which a face is the union, with the signs of the face: not every reader fills
/// polygons with a dent rightly.
void fill_faces(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("piece"), integer("cell"), integer("certified"));
  const SignColumns add_signs(e.curves, table);
  if (!scene.arrangement) return;
  const Arrangement& a = *scene.arrangement;
  table->points(scene.pieces.points);
  for (std::size_t k = 0; k < a.pieces.size(); ++k) {
    for (const auto& triangle : cut_ears(scene.pieces.points, scene.pieces.pieces[k])) {
      table->triangle(triangle);
      add(a.pieces[k].face, k, a.pieces[k].cell, 1);
      add_signs(a.faces[a.pieces[k].face].signs);
    }
  }
}

void fill_edges(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("curve"), text("curve_name"),
                     integer("left_face"), integer("right_face"), integer("certified"));
  for (std::size_t k = 0; k < scene.edges.size(); ++k) {
    const Arrangement& a = *scene.arrangement;
    const auto edge = static_cast<int>(k);
    const int on = a.edges[k].curve;
    table->polyline(scene.edges[k]);
    const int kind = on < 0 ? 2 : a.half_edges[2 * k].origin < 0 ? 1 : 0;
    add(edge, kind, on, on < 0 ? "" : e.curves[on].name, a.faces_at(edge)[0], a.faces_at(edge)[1],
        1);
  }
}

/// The curves through a vertex.
std::vector<int> curves_at(const Encasement& e, const Arrangement::Vertex& vertex) {
  if (vertex.kind == Arrangement::Vertex::Kind::Corner) return {};
  if (vertex.kind == Arrangement::Vertex::Kind::OnBoundary)
    return {e.line_crossings[vertex.index].curve};
  const std::array<int, 2>& curves = e.crossings[vertex.index].curves;
  return {curves.begin(), curves.end()};
}

void fill_vertices(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), text("kind_name"), integer("curve"),
                     integer("second_curve"), text("curve_name"), integer("certified"));
  if (!scene.arrangement) return;
  for (std::size_t k = 0; k < scene.arrangement->vertices.size(); ++k) {
    const Arrangement::Vertex& vertex = scene.arrangement->vertices[k];
    const std::vector<int> curves = curves_at(e, vertex);
    table->vertex(vertex.point);
    add(k, vertex.kind, name_of(kVertexKinds, vertex.kind), curves.empty() ? -1 : curves[0],
        curves.size() < 2 ? -1 : curves[1], names_of(e.curves, curves), 1);
  }
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
void fill_labels(const CurveScene& scene, VtkTable* table) {
  const Encasement& e = scene.encasement;
  const auto add =
      table->columns(integer("id"), integer("kind"), text("label"), integer("certified"));
  if (!scene.arrangement) return;
  const auto put = [&](int of_kind, std::size_t k, const Point<2>& at) {
    table->vertex(at);
    add(k, of_kind, "fev"[of_kind] + std::to_string(k), 1);
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

Result<CurveScene> make_curve_scene(const Encasement& e) {
  CurveScene scene{e, std::nullopt, {}, {}, {}};
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

std::vector<VtkBlock> curve_blocks(const CurveScene& scene) {
  using enum VtkRowsOf;
  return {block_of(scene, "cells", Primitives, fill_cells),
          block_of(scene, "curves", Primitives, fill_curves),
          block_of(scene, "points", Points, fill_points),
          block_of(scene, "critical_regions", Primitives, fill_critical_regions),
          block_of(scene, "unresolved", Primitives, fill_unresolved),
          block_of(scene, "faces", Primitives, fill_faces),
          block_of(scene, "edges", Primitives, fill_edges),
          block_of(scene, "vertices", Points, fill_vertices),
          block_of(scene, "labels", Points, fill_labels)};
}

}  // namespace encase
