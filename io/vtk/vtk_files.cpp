// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "2d/history.hpp"
#include "curve_blocks.hpp"
#include "encase/vtk.hpp"
#include "io/names.hpp"
#include "vtk_history.hpp"
#include "vtk_multiblock.hpp"
#include "vtk_parts.hpp"

namespace encase {
namespace {

void fill_step(const Encasement& e, const std::vector<std::vector<Point<2>>>& polygons, int cuts,
               VtkTable* table) {
  const auto add =
      table->columns(integer("id"), integer("kind"), integer("depth"), integer("certified"));
  for (const HistoryPiece& piece : pieces_after(e, cuts)) {
    const bool final = piece.cell >= 0;
    const std::vector<Point<2>> points =
        final ? cell_corners(e.cells[piece.cell]) : polygons[piece.split];
    if (points.size() < 3) continue;
    table->polygon(points);
    add(final ? piece.cell : -1, final ? cell_kind(e.cells[piece.cell]) : -1, piece.depth,
        final && is_certified(e.cells[piece.cell]));
  }
}

/// `chart`: of the plane in which the encasement is; none: z = 0.
Status write_result(const Encasement& e, const PlaneChart* chart, FieldData about_all,
                    const std::string& directory, bool history) {
  const Result<CurveScene> scene = make_curve_scene(e);
  if (!scene) return scene.error();
  VtkResult files;
  files.about = field_data_of(name_of(kOutcomes, e.outcome), e.input);
  files.about_all = std::move(about_all);
  files.chart = chart;
  files.blocks = curve_blocks(scene.value());
  if (history)
    files.write_more = [&] {
      const auto polygons = history_polygons(e);
      return write_steps(directory, static_cast<int>(e.history.size()), files.about,
                         [&](int cuts, VtkTable* table) {
                           table->place_on(chart);
                           fill_step(e, polygons, cuts, table);
                         });
    };
  return write_multiblock(directory, files);
}

/// The plane of a slice, as "a b c d".
FieldData plane_of(const Slice& slice) {
  std::string plane;
  for (const Rational& c : slice.source.chart.plane())
    plane += (plane.empty() ? "" : " ") + c.get_str();
  return {{"plane", {plane}}};
}

std::string slice_name(std::size_t k) { return fmt::format("slice_{:03}", k); }

}  // namespace

Status write_vtk(const Encasement& encasement, const std::string& directory, bool history) {
  return write_result(encasement, nullptr, {}, directory, history);
}

Status write_vtk(const Slice& slice, const std::string& directory, bool history) {
  return write_result(slice.encasement, &slice.source.chart, plane_of(slice), directory, history);
}

Status write_vtk(const std::vector<Slice>& slices, const std::string& directory) {
  std::error_code failure;
  std::filesystem::create_directory(directory, failure);
  if (failure)
    return Error{Error::Code::Io,
                 "cannot make the directory '" + directory + "': " + failure.message()};
  std::filesystem::remove(directory + "/slices.pvd", failure);
  std::vector<VtkStep> steps;
  for (std::size_t k = 0; k < slices.size(); ++k) {
    if (Status bad = write_vtk(slices[k], directory + "/" + slice_name(k))) return bad;
    steps.push_back({static_cast<int>(k), slice_name(k) + "/result.vtm"});
  }
  return write_steps_file(directory + "/slices.pvd", steps);
}

}  // namespace encase
