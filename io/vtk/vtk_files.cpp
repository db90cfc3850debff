// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <vtkErrorCode.h>
#include <vtkXMLPolyDataWriter.h>

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
#include "vtk_table.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxSteps = 200;

Error io_error(const std::string& message) { return {Error::Code::Io, message}; }

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

/// Writes one data set; `shown` is what errors call the directory.
Status write(vtkPolyData* data, const std::string& directory, const std::string& name,
             const std::string& shown) {
  // Into memory first: VTK's own files are incomplete where a disk is full, and its messages go to
  // the terminal.
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->SetCompressorTypeToZLib();
  writer->SetByteOrderToLittleEndian();
  if (writer->Write() != 1 || writer->GetErrorCode() != vtkErrorCode::NoError)
    return Error{Error::Code::Internal, "VTK failed to write '" + shown + "/" + name + "'"};
  const Status status = write_file(directory + "/" + name, writer->GetOutputString());
  if (!status) return status;
  // The file's place in the end, not the temporary one.
  const std::size_t why = status->message.rfind(": ");
  return io_error("cannot write '" + shown + "/" + name + "'" + status->message.substr(why));
}

Status write_blocks(const Encasement& e, const std::string& directory, const std::string& shown) {
  const Result<VtkScene> scene = make_vtk_scene(e);
  if (!scene) return scene.error();
  for (std::size_t k = 0; k < kVtkBlocks.size(); ++k) {
    VtkTable table;
    if (Status bad = write(fill_block(scene.value(), k, &table), directory,
                           std::string(kVtkBlocks[k]) + ".vtp", shown))
      return bad;
  }
  return std::nullopt;
}

std::string multiblock_file(const Encasement& encasement) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t k = 0; k < kVtkBlocks.size(); ++k)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet index=\"{}\" name=\"{}\" file=\"result/{}.vtp\"/>\n", k,
                   kVtkBlocks[k], kVtkBlocks[k]);
  out += "  </vtkMultiBlockDataSet>\n  <FieldData>\n";
  // Text in VTK's ASCII form: the codes of its bytes, with a zero at each string's end.
  for (const auto& [name, values] : field_data(encasement)) {
    fmt::format_to(
        std::back_inserter(out),
        "    <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n", name,
        values.size());
    for (const std::string& value : values) {
      for (const char c : value) out += std::to_string(static_cast<int>(c)) + " ";
      out += "0\n";
    }
    out += "    </Array>\n";
  }
  return out + "  </FieldData>\n</VTKFile>\n";
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
    if (Status bad = write(fill_step(e, polygons, cuts[k], &table), files.temporary(),
                           step_name(static_cast<int>(k)), directory + "/history"))
      return bad;
  }
  if (Status bad = files.commit()) return bad;
  return write_file(directory + "/history.pvd", collection_file(cuts));
}

/// Removes a file of an earlier run that would refer to files of this one.
Status remove_old(const std::string& path) {
  std::error_code failure;
  fs::remove(path, failure);
  if (failure) return io_error("cannot replace '" + path + "': " + failure.message());
  return std::nullopt;
}

}  // namespace

Status write_vtk(const Encasement& encasement, const std::string& directory, bool history) {
  std::error_code failure;
  const bool is_new = fs::create_directory(directory, failure);
  if (failure)
    return io_error("cannot make the directory '" + directory + "': " + failure.message());
  if (!fs::is_directory(directory, failure))
    return io_error("cannot write in '" + directory + "': it is not a directory");

  const auto write_all = [&]() -> Status {
    auto made = AtomicDirectory::create(directory + "/result");
    if (!made) return made.error();
    AtomicDirectory files = std::move(made).value();
    if (Status bad = write_blocks(encasement, files.temporary(), directory + "/result")) return bad;
    for (const char* index : {"/result.vtm", "/history.pvd"})
      if (Status bad = remove_old(directory + index)) return bad;
    if (Status bad = files.commit()) return bad;
    if (history)
      if (Status bad = write_history(encasement, directory)) return bad;
    return write_file(directory + "/result.vtm", multiblock_file(encasement));
  };
  Status status = write_all();
  // A directory that was made for the result goes with it.
  if (status && is_new) fs::remove_all(directory, failure);
  return status;
}

}  // namespace encase
