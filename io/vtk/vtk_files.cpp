// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "2d/history.hpp"
#include "encase/atomic_file.hpp"
#include "encase/vtk.hpp"
#include "vtk_blocks.hpp"
#include "vtk_multiblock.hpp"
#include "vtk_table.hpp"

namespace encase {
namespace {

constexpr int kMaxSteps = 200;

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

std::string step_name(int step) { return fmt::format("step_{:03}.vtp", step); }

/// The numbers of cuts at which the history is shown: the first, the last, and evenly between.
std::vector<int> shown_cuts(int cuts) {
  const int steps = std::min(cuts + 1, kMaxSteps);
  std::vector<int> shown;
  for (int k = 0; k < steps; ++k)
    shown.push_back(steps == 1 ? 0
                               : static_cast<int>(static_cast<long long>(cuts) * k / (steps - 1)));
  return shown;
}

std::string collection_file(const std::vector<int>& cuts) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t k = 0; k < cuts.size(); ++k)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"history/{}\"/>\n",
                   cuts[k], step_name(static_cast<int>(k)));
  return out + "  </Collection>\n</VTKFile>\n";
}

Status write_history(const Encasement& e, const std::string& directory) {
  auto made = AtomicDirectory::create(directory + "/history");
  if (!made) return made.error();
  AtomicDirectory files = std::move(made).value();
  const auto polygons = history_polygons(e);
  const std::vector<int> cuts = shown_cuts(static_cast<int>(e.history.size()));
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    VtkTable table;
    if (Status bad = write_data_set(fill_step(e, polygons, cuts[k], &table), files.temporary(),
                                    step_name(static_cast<int>(k)), directory + "/history"))
      return bad;
  }
  if (Status bad = files.commit()) return bad;
  return write_file(directory + "/history.pvd", collection_file(cuts));
}

}  // namespace

Status write_vtk(const Encasement& encasement, const std::string& directory, bool history) {
  const Result<VtkScene> scene = make_vtk_scene(encasement);
  if (!scene) return scene.error();
  const auto fill = [&](std::size_t k, VtkTable* table) {
    return fill_block(scene.value(), k, table);
  };
  const auto more = [&]() -> Status {
    return history ? write_history(encasement, directory) : std::nullopt;
  };
  return write_multiblock(directory, field_data(encasement), {kVtkBlocks.begin(), kVtkBlocks.end()},
                          fill, more);
}

}  // namespace encase
