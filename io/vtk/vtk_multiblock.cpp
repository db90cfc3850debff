// SPDX-License-Identifier: MIT
#include "vtk_multiblock.hpp"

#include <fmt/format.h>
#include <vtkErrorCode.h>
#include <vtkXMLPolyDataWriter.h>

#include <filesystem>
#include <iterator>

#include "encase/atomic_file.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;

Error io_error(const std::string& message) { return {Error::Code::Io, message}; }

/// Text in VTK's ASCII form: the codes of its bytes, with a zero at each string's end.
void put_field_data(const FieldData& field_data, std::string* out) {
  for (const auto& [name, values] : field_data) {
    fmt::format_to(
        std::back_inserter(*out),
        "    <Array type=\"String\" Name=\"{}\" NumberOfTuples=\"{}\" format=\"ascii\">\n", name,
        values.size());
    for (const std::string& value : values) {
      for (const char c : value) *out += std::to_string(static_cast<int>(c)) + " ";
      *out += "0\n";
    }
    *out += "    </Array>\n";
  }
}

std::string multiblock_file(const VtkResult& result) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t k = 0; k < result.blocks.size(); ++k)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet index=\"{}\" name=\"{}\" file=\"result/{}.vtp\"/>\n", k,
                   result.blocks[k].name, result.blocks[k].name);
  out += "  </vtkMultiBlockDataSet>\n  <FieldData>\n";
  put_field_data(result.about, &out);
  put_field_data(result.about_all, &out);
  return out + "  </FieldData>\n</VTKFile>\n";
}

/// Removes a file of an earlier run that would refer to files of this one.
Status remove_old(const std::string& path) {
  std::error_code failure;
  fs::remove(path, failure);
  if (failure) return io_error("cannot replace '" + path + "': " + failure.message());
  return std::nullopt;
}

}  // namespace

Status write_data_set(vtkPolyData* data, const std::string& directory, const std::string& name,
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

Status write_multiblock(const std::string& directory, const VtkResult& result) {
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
    for (const VtkBlock& block : result.blocks) {
      VtkTable table;
      table.place_on(result.chart);
      block.fill(&table);
      if (Status bad = write_data_set(table.finish(result.about, block.rows_of), files.temporary(),
                                      std::string(block.name) + ".vtp", directory + "/result"))
        return bad;
    }
    for (const char* index : {"/result.vtm", "/history.pvd"})
      if (Status bad = remove_old(directory + index)) return bad;
    if (Status bad = files.commit()) return bad;
    if (Status bad = result.write_more()) return bad;
    return write_file(directory + "/result.vtm", multiblock_file(result));
  };
  Status status = write_all();
  // A directory that was made for the result goes with it.
  if (status && is_new) fs::remove_all(directory, failure);
  return status;
}

Status write_steps_file(const std::string& path, const std::vector<VtkStep>& steps) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const VtkStep& step : steps)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{}\"/>\n", step.time,
                   step.file);
  return write_file(path, out + "  </Collection>\n</VTKFile>\n");
}

}  // namespace encase
