// SPDX-License-Identifier: MIT
#include "encase/caps_vtk.hpp"

#include <string>
#include <vector>

#include "io/names.hpp"
#include "vtk_multiblock.hpp"
#include "vtk_parts.hpp"

namespace encase {
namespace {

int first_of(const std::vector<int>& curves) { return curves.empty() ? -1 : curves[0]; }

void fill_leaves(const CapsResult& r, VtkTable* table) {
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("depth"), integer("region"),
                     integer("curve_count"), integer("curve"), text("curve_name"));
  for (std::size_t k = 0; k < r.leaves.size(); ++k) {
    const CapsLeaf& leaf = r.leaves[k];
    const std::vector<int>& curves = r.curve_sets[static_cast<std::size_t>(leaf.curves)];
    table->rectangle(leaf.box);
    add(k, leaf.label, leaf.depth, leaf.region, curves.size(), first_of(curves),
        names_of(r.curves, curves));
  }
}

void fill_curves(const CapsResult& r, VtkTable* table) {
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("curve"), text("curve_name"));
  for (std::size_t k = 0; k < r.edges.size(); ++k) {
    const CapsEdge& edge = r.edges[k];
    if (edge.polyline.empty()) continue;
    table->polyline(edge.polyline);
    add(k, edge.vertices.empty(), edge.curve, r.curves[static_cast<std::size_t>(edge.curve)].name);
  }
}

void fill_vertices(const CapsResult& r, VtkTable* table) {
  const auto add = table->columns(integer("id"), integer("kind"), text("kind_name"),
                                  integer("curve"), text("curve_name"), number("width"));
  for (std::size_t k = 0; k < r.vertices.size(); ++k) {
    const CapsVertex& vertex = r.vertices[k];
    table->vertex(vertex.box.center());
    add(k, vertex.kind, name_of(kCapsVertexKinds, vertex.kind), first_of(vertex.curves),
        names_of(r.curves, vertex.curves), vertex.box.largest_width());
  }
}

}  // namespace

Status write_vtk(const CapsResult& result, const std::string& directory) {
  using enum VtkRowsOf;
  VtkResult files;
  files.about = field_data_of(name_of(kCapsClasses, result.answer), result.curves);
  files.blocks = {block_of(result, "leaves", Primitives, fill_leaves),
                  block_of(result, "curves", Primitives, fill_curves),
                  block_of(result, "vertices", Points, fill_vertices)};
  return write_multiblock(directory, files);
}

}  // namespace encase
