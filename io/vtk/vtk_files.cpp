// SPDX-License-Identifier: MIT
#include "encase/vtk.hpp"

#include <fmt/format.h>
#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "2d/cell_complex.hpp"
#include "2d/history.hpp"
#include "2d/trace.hpp"
#include "common/filtered_polynomial.hpp"
#include "common/kernel.hpp"
#include "encase/atomic_file.hpp"
#include "encase/version.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxSteps = 200;
/// Between a curve and its polyline, as a part of the region's size.
constexpr double kTolerance = 1e-4;

Error io_error(const std::string& message) { return {Error::Code::Io, message}; }

const char* text(Outcome outcome) {
  switch (outcome) {
    case Outcome::Certified:
      return "certified";
    case Outcome::Degenerate:
      return "degenerate";
    case Outcome::Undecided:
      break;
  }
  return "undecided";
}

const char* text(Unresolved::Kind kind) {
  switch (kind) {
    case Unresolved::Kind::Contact:
      return "contact";
    case Unresolved::Kind::SingularPoint:
      return "singular_point";
    case Unresolved::Kind::Concurrency:
      return "concurrency";
    case Unresolved::Kind::SharedComponent:
      return "shared_component";
    case Unresolved::Kind::RepeatedComponent:
      return "repeated_component";
    case Unresolved::Kind::Infinity:
      return "infinity";
    case Unresolved::Kind::Budget:
      break;
  }
  return "budget";
}

/// The kinds of cells, points and curves; docs/vtk.md.
enum CellKind { kEmpty, kOneCurve, kCrossing, kRelaxed, kDegenerate, kUndecided };

CellKind kind_of(const Cell& cell) {
  if (cell.state == CellState::Degenerate) return kDegenerate;
  if (cell.state == CellState::Undecided) return kUndecided;
  if (cell.state == CellState::Relaxed) return kRelaxed;
  if (cell.crossing >= 0) return kCrossing;
  return cell.branches.empty() ? kEmpty : kOneCurve;
}

bool is_certified(const Cell& cell) {
  return cell.state == CellState::Certified || cell.state == CellState::Relaxed;
}

/// What every file says about the result as a whole: names and values.
std::vector<std::pair<const char*, std::vector<std::string>>> field_data(
    const Encasement& encasement) {
  std::vector<std::string> input;
  for (const NamedCurve& curve : encasement.input)
    input.push_back(curve.name + ": " + curve.polynomial.to_string());
  return {{"status", {text(encasement.outcome)}},
          {"input", input},
          {"version", {std::string("encase ") + kVersion}}};
}

/// A data set with attributes for each of its points or cells, filled row by row.
class Table {
 public:
  Table() {
    points_->SetDataTypeToDouble();
    data_->SetPoints(points_);
  }

  vtkIdType point(const Point<2>& p) { return points_->InsertNextPoint(p[0], p[1], 0); }
  void polygon(const std::vector<Point<2>>& corners) { primitive(polygons_, corners); }
  void polyline(const std::vector<Point<2>>& line) { primitive(lines_, line); }
  void vertex(const Point<2>& p) { primitive(vertices_, {p}); }
  void rectangle(const Box<2>& b) {
    polygon({{b.lo[0], b.lo[1]}, {b.hi[0], b.lo[1]}, {b.hi[0], b.hi[1]}, {b.lo[0], b.hi[1]}});
  }

  vtkIntArray* integers(const std::string& name) { return add<vtkIntArray>(name); }
  vtkDoubleArray* doubles(const std::string& name) { return add<vtkDoubleArray>(name); }
  vtkStringArray* strings(const std::string& name) { return add<vtkStringArray>(name); }

  /// The data set; attributes belong to its points if `of_points`, else to its cells.
  vtkPolyData* finish(const Encasement& encasement, bool of_points) {
    data_->SetVerts(vertices_);
    data_->SetLines(lines_);
    data_->SetPolys(polygons_);
    for (vtkAbstractArray* array : arrays_)
      (of_points ? static_cast<vtkFieldData*>(data_->GetPointData()) : data_->GetCellData())
          ->AddArray(array);
    add_field_data(encasement);
    return data_;
  }

 private:
  void primitive(vtkCellArray* list, const std::vector<Point<2>>& points) {
    list->InsertNextCell(static_cast<int>(points.size()));
    for (const Point<2>& p : points) list->InsertCellPoint(point(p));
  }
  template <class Array>
  Array* add(const std::string& name) {
    vtkNew<Array> array;
    array->SetName(name.c_str());
    arrays_.emplace_back(array);
    return array;
  }
  void add_field_data(const Encasement& encasement) {
    for (const auto& [name, values] : field_data(encasement)) {
      vtkNew<vtkStringArray> array;
      array->SetName(name);
      for (const std::string& value : values) array->InsertNextValue(value.c_str());
      data_->GetFieldData()->AddArray(array);
    }
  }

  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> vertices_, lines_, polygons_;
  std::vector<vtkSmartPointer<vtkAbstractArray>> arrays_;
};

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

/// The sign each curve's polynomial has on the whole cell, 0 where it has none or none is
/// certified.
class CellSigns {
 public:
  explicit CellSigns(const Encasement& encasement) : encasement_(encasement) {
    for (const Curve& curve : encasement.curves) polynomials_.emplace_back(curve.polynomial);
  }
  std::vector<int> of(const Cell& cell) {
    std::vector<int> signs(polynomials_.size(), 0);
    if (!is_certified(cell)) return signs;
    const RationalPoint<2> vertex = exact_point(encasement_.lines, cell.vertices.front());
    for (std::size_t k = 0; k < signs.size(); ++k) {
      const bool present = std::any_of(cell.word.begin(), cell.word.end(), [&](int crossing) {
        return encasement_.line_crossings[crossing].curve == static_cast<int>(k);
      });
      if (!present) signs[k] = static_cast<int>(polynomials_[k].sign_at(vertex, kernel_));
    }
    return signs;
  }

 private:
  const Encasement& encasement_;
  std::vector<FilteredPolynomial<2>> polynomials_;
  Kernel kernel_;
};

/// The corners of a cell, without the cuts that lie within an edge.
std::vector<Point<2>> corners(const Cell& cell) {
  std::vector<Point<2>> points;
  for (const Vertex& vertex : cell.vertices)
    if (vertex.line_in != vertex.line_out) points.push_back(vertex.point);
  return points;
}

vtkPolyData* fill_cells(const Encasement& e, Table* table) {
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
    table->polygon(corners(cell));
    id->InsertNextValue(static_cast<int>(k));
    kind->InsertNextValue(kind_of(cell));
    const int only = cell.branches.size() == 1 ? cell.branches[0].curve : -1;
    curve->InsertNextValue(only);
    std::string names;
    for (const Branch& branch : cell.branches)
      names += (names.empty() ? "" : ", ") + e.curves[branch.curve].name;
    curve_name->InsertNextValue(names.c_str());
    crossing->InsertNextValue(cell.crossing);
    depth->InsertNextValue(cell.depth);
    certified->InsertNextValue(is_certified(cell));
    const std::vector<int> values = cell_signs.of(cell);
    for (std::size_t c = 0; c < signs.size(); ++c) signs[c]->InsertNextValue(values[c]);
  }
  return table->finish(e, false);
}

vtkPolyData* fill_curves(const Encasement& e, Table* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* curve = table->integers("curve");
  vtkStringArray* curve_name = table->strings("curve_name");
  vtkIntArray* certified = table->integers("certified");
  const double tolerance = kTolerance * e.region_used.bounding_box().largest_width();
  int count = 0;
  for (std::size_t k = 0; k < e.curves.size(); ++k) {
    for (const Polyline& line : trace_curve(e, static_cast<int>(k), tolerance)) {
      table->polyline(line);
      id->InsertNextValue(count++);
      kind->InsertNextValue(line.size() > 2 && line.front() == line.back());
      curve->InsertNextValue(static_cast<int>(k));
      curve_name->InsertNextValue(e.curves[k].name.c_str());
      certified->InsertNextValue(1);
    }
  }
  return table->finish(e, false);
}

vtkPolyData* fill_points(const Encasement& e, Table* table) {
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
    const std::string names =
        e.curves[crossing.curves[0]].name + ", " + e.curves[crossing.curves[1]].name;
    curve_name->InsertNextValue(names.c_str());
    cell->InsertNextValue(crossing.cell);
    depth->InsertNextValue(crossing.cell >= 0 ? e.cells[crossing.cell].depth : -1);
    radius->InsertNextValue(0.5 * crossing.box.largest_width());
    certified->InsertNextValue(1);
  }
  return table->finish(e, true);
}

vtkPolyData* fill_critical_regions(const Encasement& e, Table* table) {
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

vtkPolyData* fill_unresolved(const Encasement& e, Table* table) {
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
      kind_name->InsertNextValue(text(place.kind));
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

vtkPolyData* fill_step(const Encasement& e, const std::vector<std::vector<Point<2>>>& polygons,
                       int cuts, Table* table) {
  vtkIntArray* id = table->integers("id");
  vtkIntArray* kind = table->integers("kind");
  vtkIntArray* depth = table->integers("depth");
  vtkIntArray* certified = table->integers("certified");
  for (const HistoryPiece& piece : pieces_after(e, cuts)) {
    const bool final = piece.cell >= 0;
    const std::vector<Point<2>> points =
        final ? corners(e.cells[piece.cell]) : polygons[piece.split];
    if (points.size() < 3) continue;
    table->polygon(points);
    id->InsertNextValue(final ? piece.cell : -1);
    kind->InsertNextValue(final ? kind_of(e.cells[piece.cell]) : -1);
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

constexpr std::array<const char*, 5> kBlocks = {"cells", "curves", "points", "critical_regions",
                                                "unresolved"};

Status write_blocks(const Encasement& e, const std::string& directory, const std::string& shown) {
  constexpr std::array kFill = {fill_cells, fill_curves, fill_points, fill_critical_regions,
                                fill_unresolved};
  for (std::size_t k = 0; k < kBlocks.size(); ++k) {
    Table table;
    if (Status bad = write(kFill[k](e, &table), directory, std::string(kBlocks[k]) + ".vtp", shown))
      return bad;
  }
  return std::nullopt;
}

std::string multiblock_file(const Encasement& encasement) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <vtkMultiBlockDataSet>\n";
  for (std::size_t k = 0; k < kBlocks.size(); ++k)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet index=\"{}\" name=\"{}\" file=\"result/{}.vtp\"/>\n", k,
                   kBlocks[k], kBlocks[k]);
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
    Table table;
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
