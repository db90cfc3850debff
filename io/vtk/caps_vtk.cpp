// SPDX-License-Identifier: MIT
#include "encase/caps_vtk.hpp"

#include <string>
#include <vector>

#include "encase/version.hpp"
#include "io/names.hpp"
#include "vtk_multiblock.hpp"
#include "vtk_table.hpp"

namespace encase {
namespace {

/// The names of curves, with commas.
std::string names_of(const CapsResult& r, const std::vector<int>& curves) {
  std::string names;
  for (const int c : curves)
    names += (names.empty() ? "" : ", ") + r.curves[static_cast<std::size_t>(c)].name;
  return names;
}

int first_of(const std::vector<int>& curves) { return curves.empty() ? -1 : curves[0]; }

void fill_leaves(const CapsResult& r, VtkTable* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* depth = table->integers("depth");
  vtkIntArray* region = table->integers("region");
  vtkIntArray* count = table->integers("curve_count");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  for (std::size_t k = 0; k < r.leaves.size(); ++k) {
    const CapsLeaf& leaf = r.leaves[k];
    const std::vector<int>& curves = r.curve_sets[static_cast<std::size_t>(leaf.curves)];
    table->rectangle(leaf.box);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(static_cast<int>(leaf.label));
    depth->InsertNextValue(leaf.depth);
    region->InsertNextValue(leaf.region);
    count->InsertNextValue(static_cast<int>(curves.size()));
    curve->InsertNextValue(first_of(curves));
    curve_name->InsertNextValue(names_of(r, curves).c_str());
  }
}

void fill_curves(const CapsResult& r, VtkTable* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  for (std::size_t k = 0; k < r.edges.size(); ++k) {
    const CapsEdge& edge = r.edges[k];
    if (edge.polyline.empty()) continue;
    table->polyline(edge.polyline);
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(edge.vertices.empty());
    curve->InsertNextValue(edge.curve);
    curve_name->InsertNextValue(names_of(r, {edge.curve}).c_str());
  }
}

void fill_vertices(const CapsResult& r, VtkTable* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkStringArray* kind_name = table->strings("kind_name");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkDoubleArray* width = table->doubles("width");
  for (std::size_t k = 0; k < r.vertices.size(); ++k) {
    const CapsVertex& vertex = r.vertices[k];
    table->vertex(vertex.box.center());
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(static_cast<int>(vertex.kind));
    kind_name->InsertNextValue(name_of(kCapsVertexKinds, vertex.kind));
    curve->InsertNextValue(first_of(vertex.curves));
    curve_name->InsertNextValue(names_of(r, vertex.curves).c_str());
    width->InsertNextValue(vertex.box.largest_width());
  }
}

}  // namespace

Status write_vtk(const CapsResult& result, const std::string& directory) {
  std::vector<std::string> input;
  for (const NamedCurve& curve : result.curves)
    input.push_back(curve.name + ": " + curve.function.to_string());
  const FieldData about{{"status", {name_of(kCapsClasses, result.answer)}},
                        {"input", input},
                        {"version", {std::string("encase ") + kVersion}}};
  const auto fill = [&](std::size_t block, VtkTable* table) {
    if (block == 0) fill_leaves(result, table);
    if (block == 1) fill_curves(result, table);
    if (block == 2) fill_vertices(result, table);
    return table->finish(about, block == 2);
  };
  return write_multiblock(directory, about, {"leaves", "curves", "vertices"}, fill,
                          []() -> Status { return {}; });
}

}  // namespace encase
