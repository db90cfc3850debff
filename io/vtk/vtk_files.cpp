// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "2d/history.hpp"
#include "encase/atomic_file.hpp"
#include "encase/vtk.hpp"
#include "vtk_blocks.hpp"
#include "vtk_history.hpp"
#include "vtk_multiblock.hpp"
#include "vtk_table.hpp"

namespace encase {
namespace {

vtkPolyData* fill_step(const Encasement& e, const std::vector<std::vector<Point<2>>>& polygons,
                       int cuts, VtkTable* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* depth = table->integers("depth");
  vtkIntArray* certified = table->integers("certified");
  for (const HistoryPiece& piece : pieces_after(e, cuts)) {
    const bool final = piece.cell >= 0;
    const std::vector<Point<2>> points =
        final ? cell_corners(e.cells[piece.cell]) : polygons[piece.split];
    if (points.size() < 3) continue;
    table->polygon(points);
    id->InsertNextValue(final ? piece.cell : -1);
    kind->InsertNextValue(final ? cell_kind(e.cells[piece.cell]) : -1);
    depth->InsertNextValue(piece.depth);
    certified->InsertNextValue(final && is_certified(e.cells[piece.cell]));
  }
  return table->finish(e, false);
}

Status write_history(const Encasement& e, const PlaneChart* chart, const std::string& directory) {
  const auto polygons = history_polygons(e);
  return write_steps(directory, static_cast<int>(e.history.size()), [&](int cuts, VtkTable* table) {
    table->place_on(chart);
    return fill_step(e, polygons, cuts, table);
  });
}

/// `chart`: of the plane in which the encasement is; none: z = 0.
Status write_result(const Encasement& encasement, const PlaneChart* chart, FieldData about,
                    const std::string& directory, bool history) {
  const Result<VtkScene> scene = make_vtk_scene(encasement);
  if (!scene) return scene.error();
  const auto fill = [&](std::size_t k, VtkTable* table) {
    table->place_on(chart);
    return fill_block(scene.value(), k, table);
  };
  const auto more = [&]() -> Status {
    return history ? write_history(encasement, chart, directory) : std::nullopt;
  };
  return write_multiblock(directory, about, {kVtkBlocks.begin(), kVtkBlocks.end()}, fill, more);
}

/// What is said of a slice: also its plane, as "a b c d".
FieldData field_data(const Slice& slice) {
  FieldData about = encase::field_data(slice.encasement);
  std::string plane;
  for (const Rational& c : slice.source.chart.plane())
    plane += (plane.empty() ? "" : " ") + c.get_str();
  about.push_back({"plane", {plane}});
  return about;
}

std::string slice_name(std::size_t k) { return fmt::format("slice_{:03}", k); }

std::string series_file(const std::vector<Slice>& slices) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t k = 0; k < slices.size(); ++k)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}/result.vtm\"/>\n",
                   k, slice_name(k));
  return out + "  </Collection>\n</VTKFile>\n";
}

}  // namespace

Status write_vtk(const Encasement& encasement, const std::string& directory, bool history) {
  return write_result(encasement, nullptr, encase::field_data(encasement), directory, history);
}

Status write_vtk(const Slice& slice, const std::string& directory, bool history) {
  return write_result(slice.encasement, &slice.source.chart, field_data(slice), directory, history);
}

Status write_vtk(const std::vector<Slice>& slices, const std::string& directory) {
  std::error_code failure;
  std::filesystem::create_directory(directory, failure);
  if (failure)
    return Error{Error::Code::Io,
                 "cannot make the directory '" + directory + "': " + failure.message()};
  std::filesystem::remove(directory + "/slices.pvd", failure);
  for (std::size_t k = 0; k < slices.size(); ++k)
    if (Status bad = write_vtk(slices[k], directory + "/" + slice_name(k))) return bad;
  return write_file(directory + "/slices.pvd", series_file(slices));
}

}  // namespace encase
