// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "encase/arrangement.hpp"
#include "encase/vtk.hpp"
#include "tests/sample_encasements.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;

class VtkFiles : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::path(testing::TempDir()) / ("encase-vtk-" + std::to_string(getpid()));
    fs::remove_all(directory_);
    fs::create_directories(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  static std::string text(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  vtkPolyData* read(const std::string& name) {
    reader_->SetFileName(path(name).c_str());
    reader_->Update();
    return reader_->GetOutput();
  }
  static int integer(vtkFieldData* data, const char* name, int row) {
    auto* array = vtkIntArray::SafeDownCast(data->GetAbstractArray(name));
    if (array) return array->GetValue(row);
    ADD_FAILURE() << name;
    return -1000;
  }
  static std::string string(vtkFieldData* data, const char* name, int row) {
    auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
    if (array) return array->GetValue(row);
    ADD_FAILURE() << name;
    return "";
  }

  fs::path directory_;
  vtkNew<vtkXMLPolyDataReader> reader_;
};

TEST_F(VtkFiles, HoldCellsWithTheirAttributes) {
  Encasement e = sample::circle_and_line();
  e.cells[1].state = CellState::Degenerate;
  ASSERT_FALSE(write_vtk(e, path("out")));
  vtkPolyData* cells = read("out/result/cells.vtp");
  ASSERT_EQ(cells->GetNumberOfPolys(), 3);
  EXPECT_EQ(cells->GetPoints()->GetDataType(), VTK_DOUBLE);
  vtkFieldData* data = cells->GetCellData();
  std::vector<std::string> names;
  for (int k = 0; k < data->GetNumberOfArrays(); ++k) names.push_back(data->GetArrayName(k));
  EXPECT_EQ(names, (std::vector<std::string>{"id", "kind", "curve", "curve_name", "crossing",
                                             "depth", "certified", "sign_circle", "sign_line"}));
  for (int k = 0; k < 3; ++k) EXPECT_EQ(integer(data, "id", k), k);
  EXPECT_EQ(integer(data, "kind", 0), 2);
  EXPECT_EQ(integer(data, "kind", 1), 4);
  EXPECT_EQ(integer(data, "kind", 2), 0);
  EXPECT_EQ(integer(data, "certified", 0), 1);
  EXPECT_EQ(integer(data, "certified", 1), 0);
  EXPECT_EQ(integer(data, "depth", 2), 2);
  EXPECT_EQ(integer(data, "crossing", 0), 1);
  // Both curves run through cell 0; cell 2 is outside the circle and above the line.
  EXPECT_EQ(integer(data, "sign_circle", 0), 0);
  EXPECT_EQ(integer(data, "sign_circle", 2), 1);
  EXPECT_EQ(integer(data, "sign_line", 2), 1);
  EXPECT_EQ(string(data, "curve_name", 0), "circle, line");
  EXPECT_EQ(string(cells->GetFieldData(), "status", 0), "certified");
  EXPECT_EQ(string(cells->GetFieldData(), "input", 0).rfind("circle: ", 0), 0u);
}

TEST_F(VtkFiles, HoldCurvesAndCrossings) {
  const Encasement e = sample::circle_and_line();
  ASSERT_FALSE(write_vtk(e, path("out")));
  vtkPolyData* curves = read("out/result/curves.vtp");
  ASSERT_EQ(curves->GetNumberOfLines(), 2);
  EXPECT_EQ(integer(curves->GetCellData(), "kind", 0), 1);
  EXPECT_EQ(integer(curves->GetCellData(), "kind", 1), 0);
  EXPECT_EQ(string(curves->GetCellData(), "curve_name", 1), "line");
  vtkPolyData* points = read("out/result/points.vtp");
  ASSERT_EQ(points->GetNumberOfVerts(), 2);
  double at[3];
  points->GetPoint(1, at);
  EXPECT_EQ(at[0], e.crossings[1].point[0]);
  EXPECT_EQ(at[1], e.crossings[1].point[1]);
  EXPECT_EQ(integer(points->GetPointData(), "cell", 1), 0);
  vtkPolyData* critical = read("out/result/critical_regions.vtp");
  ASSERT_EQ(critical->GetNumberOfPolys(), 1);
  EXPECT_EQ(integer(critical->GetCellData(), "kind", 0), -1);
}

TEST_F(VtkFiles, HoldFacesAsTriangles) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  ASSERT_FALSE(write_vtk(e, path("out")));
  vtkPolyData* faces = read("out/result/faces.vtp");
  vtkFieldData* data = faces->GetCellData();
  std::vector<double> areas(a.faces.size());
  std::set<int> pieces;
  for (int k = 0; k < faces->GetNumberOfPolys(); ++k) {
    const int piece = integer(data, "piece", k);
    pieces.insert(piece);
    const int face = integer(data, "id", k);
    ASSERT_GT(face, 0);
    ASSERT_LT(face, static_cast<int>(a.faces.size()));
    EXPECT_EQ(integer(data, "certified", k), 1);
    EXPECT_EQ(a.pieces[piece].face, face);
    EXPECT_EQ(integer(data, "cell", k), a.pieces[piece].cell);
    EXPECT_EQ(integer(data, "sign_circle", k), static_cast<int>(a.faces[face].signs[0]));
    EXPECT_EQ(integer(data, "sign_line", k), static_cast<int>(a.faces[face].signs[1]));
    vtkPoints* corners = faces->GetCell(k)->GetPoints();
    ASSERT_EQ(corners->GetNumberOfPoints(), 3);
    double p[3], q[3], r[3];
    corners->GetPoint(0, p);
    corners->GetPoint(1, q);
    corners->GetPoint(2, r);
    const double area = ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
    EXPECT_GT(area, -1e-15);
    areas[face] += area;
  }
  EXPECT_EQ(pieces.size(), 9u);
  double disc = 0, all = 0;
  for (std::size_t f = 1; f < areas.size(); ++f) {
    EXPECT_GT(areas[f], 0.1);
    all += areas[f];
    if (a.faces[f].signs[0] == Sign::Negative) disc += areas[f];
  }
  EXPECT_NEAR(all, 4, 1e-12);
  EXPECT_NEAR(disc, std::acos(-1.0) / 2, 1e-3);
}

TEST_F(VtkFiles, HoldEdgesAndVertices) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  ASSERT_FALSE(write_vtk(e, path("out")));
  vtkPolyData* edges = read("out/result/edges.vtp");
  ASSERT_EQ(edges->GetNumberOfLines(), 11);
  vtkFieldData* data = edges->GetCellData();
  for (int k = 0; k < 11; ++k) {
    EXPECT_EQ(integer(data, "id", k), k);
    EXPECT_EQ(integer(data, "curve", k), a.edges[k].curve);
    EXPECT_EQ(integer(data, "kind", k), a.edges[k].curve < 0 ? 2 : 0);
    EXPECT_EQ(integer(data, "left_face", k), a.faces_at(k)[0]);
    EXPECT_EQ(integer(data, "right_face", k), a.faces_at(k)[1]);
  }
  vtkPolyData* vertices = read("out/result/vertices.vtp");
  ASSERT_EQ(vertices->GetNumberOfVerts(), 8);
  for (int k = 0; k < 8; ++k) {
    double at[3];
    vertices->GetPoint(k, at);
    EXPECT_EQ(at[0], a.vertices[k].point[0]);
    EXPECT_EQ(at[1], a.vertices[k].point[1]);
    EXPECT_EQ(integer(vertices->GetPointData(), "kind", k), static_cast<int>(a.vertices[k].kind));
  }
  EXPECT_EQ(string(vertices->GetPointData(), "kind_name", 0), "corner");
  EXPECT_EQ(integer(vertices->GetPointData(), "curve", 0), -1);
  EXPECT_EQ(string(vertices->GetPointData(), "curve_name", 7), "circle, line");
}

TEST_F(VtkFiles, HoldALabelForEveryPart) {
  const Encasement e = sample::circle_and_line();
  const Arrangement a = arrange(e).value();
  const PointLocator locator(e, a);
  ASSERT_FALSE(write_vtk(e, path("out")));
  vtkPolyData* labels = read("out/result/labels.vtp");
  const auto parts = a.faces.size() - 1 + a.edges.size() + a.vertices.size();
  ASSERT_EQ(labels->GetNumberOfVerts(), static_cast<vtkIdType>(parts));
  std::set<std::string> names;
  for (int k = 0; k < static_cast<int>(parts); ++k) {
    const int id = integer(labels->GetPointData(), "id", k);
    const int kind = integer(labels->GetPointData(), "kind", k);
    const std::string name = string(labels->GetPointData(), "label", k);
    EXPECT_EQ(name, std::string(1, "fev"[kind]) + std::to_string(id));
    names.insert(name);
    double at[3];
    labels->GetPoint(k, at);
    if (kind == 0) {
      EXPECT_EQ(locator.locate(Point<2>{at[0], at[1]}),
                (Arrangement::Feature{Arrangement::Feature::Kind::Face, id}));
    }
    if (kind == 1 && a.edges[id].curve == 0) {
      EXPECT_NEAR(std::hypot(at[0], at[1]), std::sqrt(0.5), 1e-3);
    }
  }
  EXPECT_EQ(names.size(), parts);
}

TEST_F(VtkFiles, HaveNoFacesWhereTheAnswerIsNotCertified) {
  Encasement e = sample::circle_and_line();
  e.outcome = Outcome::Undecided;
  ASSERT_FALSE(write_vtk(e, path("out")));
  for (const char* name : {"faces", "edges", "vertices", "labels"})
    EXPECT_EQ(read("out/result/" + std::string(name) + ".vtp")->GetNumberOfCells(), 0) << name;
  EXPECT_EQ(read("out/result/curves.vtp")->GetNumberOfLines(), 2);
}

TEST_F(VtkFiles, GiveEveryCurveASignArrayOfItsOwnPlainName) {
  Encasement e = sample::circle_and_line();
  e.curves[0].name = "a<\"é\">&";
  e.curves[1].name = "a<\"e\"!>&";
  e.curves[1].name = "a______&";
  ASSERT_FALSE(write_vtk(e, path("out")));
  vtkPolyData* cells = read("out/result/cells.vtp");
  EXPECT_EQ(integer(cells->GetCellData(), "sign_a_______", 2), 1);
  EXPECT_EQ(integer(cells->GetCellData(), "sign_a________1", 2), 1);
  EXPECT_EQ(string(cells->GetCellData(), "curve_name", 0), "a<\"é\">&, a______&");
}

TEST_F(VtkFiles, ShowTheHistoryInOrder) {
  const Encasement e = sample::circle_and_line();
  ASSERT_FALSE(write_vtk(e, path("out"), true));
  const std::string index = text(path("out/history.pvd"));
  for (const char* step : {"step_000", "step_001", "step_002"})
    EXPECT_NE(index.find(step), std::string::npos);
  EXPECT_EQ(index.find("step_003"), std::string::npos);
  EXPECT_EQ(read("out/history/step_000.vtp")->GetNumberOfPolys(), 1);
  vtkPolyData* middle = read("out/history/step_001.vtp");
  ASSERT_EQ(middle->GetNumberOfPolys(), 2);
  EXPECT_EQ(integer(middle->GetCellData(), "id", 0), 0);
  EXPECT_EQ(integer(middle->GetCellData(), "id", 1), -1);
  EXPECT_EQ(read("out/history/step_002.vtp")->GetNumberOfPolys(), 3);
}

TEST_F(VtkFiles, ShowAtMostTwoHundredStepsWithTheFirstAndTheLast) {
  // 1000 cuts by vertical lines, each cutting off a strip on the left.
  Encasement e = sample::circle_and_line();
  e.curves.clear();
  e.crossings.clear();
  e.critical_regions.clear();
  e.line_crossings.clear();
  e.lines.resize(4);
  e.cells.clear();
  e.history.clear();
  for (int k = 0; k <= 1000; ++k) {
    const double x = -1 + 2 * k / 1001.0, next = k == 1000 ? 1 : -1 + 2 * (k + 1) / 1001.0;
    const int left = k == 0 ? 3 : 3 + k, right = k == 1000 ? 1 : 4 + k;
    Cell cell;
    cell.state = CellState::Certified;
    cell.vertices = {sample::corner(left, 0, x, -1), sample::corner(0, right, next, -1),
                     sample::corner(right, 2, next, 1), sample::corner(2, left, x, 1)};
    e.cells.push_back(cell);
    if (k == 1000) break;
    e.lines.push_back(sample::line(1, 0, -next));
    e.history.push_back({right, ~k, k == 999 ? ~1000 : k + 1});
  }
  ASSERT_FALSE(write_vtk(e, path("out"), true));
  const fs::directory_iterator files(path("out/history"));
  EXPECT_EQ(std::distance(files, fs::directory_iterator()), 200);
  const std::string index = text(path("out/history.pvd"));
  EXPECT_NE(index.find("timestep=\"0\""), std::string::npos);
  EXPECT_NE(index.find("timestep=\"1000\""), std::string::npos);
  EXPECT_EQ(read("out/history/step_199.vtp")->GetNumberOfPolys(), 1001);
}

TEST_F(VtkFiles, ReplaceAnEarlierRunAndItsHistory) {
  const Encasement e = sample::circle_and_line();
  ASSERT_FALSE(write_vtk(e, path("out"), true));
  std::ofstream(path("out/result/other.txt")) << "mine";
  const std::string before = text(path("out/result/cells.vtp"));
  ASSERT_FALSE(write_vtk(e, path("out")));
  EXPECT_EQ(text(path("out/result/cells.vtp")), before);
  EXPECT_FALSE(fs::exists(path("out/history.pvd")));
  EXPECT_TRUE(fs::exists(path("out/result/other.txt")));
  for (const auto& entry : fs::directory_iterator(path("out")))
    EXPECT_NE(entry.path().filename().string()[0], '.') << entry.path();
}

TEST_F(VtkFiles, AreWrittenForAnEmptyResult) {
  Encasement e;
  e.region = e.region_used = sample::square();
  ASSERT_FALSE(write_vtk(e, path("out"), true));
  EXPECT_EQ(read("out/result/cells.vtp")->GetNumberOfCells(), 0);
}

TEST_F(VtkFiles, AreAbsentWhereTheDiskIsTooSmall) {
  // Files of this process may not grow beyond 3000 bytes: less than cells.vtp has.
  struct sigaction ignore = {}, old_action;
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &ignore, &old_action);
  rlimit old_limit, limit;
  getrlimit(RLIMIT_FSIZE, &old_limit);
  limit = old_limit;
  limit.rlim_cur = 3000;
  setrlimit(RLIMIT_FSIZE, &limit);
  testing::internal::CaptureStderr();
  const Status status = write_vtk(sample::circle_and_line(), path("out"));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  sigaction(SIGXFSZ, &old_action, nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, Error::Code::Io);
  EXPECT_NE(status->message.find("cells.vtp"), std::string::npos) << status->message;
  EXPECT_TRUE(fs::is_empty(directory_));
}

TEST_F(VtkFiles, AreAbsentAfterAFailure) {
  const Encasement e = sample::circle_and_line();
  Status status = write_vtk(e, path("no/out"));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->code, Error::Code::Io);
  std::ofstream(path("file")) << "x";
  status = write_vtk(e, path("file"));
  ASSERT_TRUE(status);
  // A file stands where the blocks should go.
  fs::create_directory(path("out"));
  std::ofstream(path("out/result")) << "x";
  testing::internal::CaptureStderr();
  status = write_vtk(e, path("out"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_TRUE(status);
  EXPECT_FALSE(fs::exists(path("out/result.vtm")));
  EXPECT_EQ(std::distance(fs::directory_iterator(path("out")), fs::directory_iterator()), 1);
}

TEST_F(VtkFiles, PlaceSlicesInSpace) {
  const auto x = Polynomial<3>::variable(0), y = Polynomial<3>::variable(1),
             z = Polynomial<3>::variable(2);
  const std::vector<NamedSurface> ball{
      {"ball", x * x + y * y + z * z - Polynomial<3>::constant(1)}};
  const Polyhedron cube = make_box({-2, -2, -2}, {2, 2, 2}).value();
  std::vector<Slice> slices;
  for (const auto& plane : parallel_planes(cube, {1, 2, 3}, 3))
    slices.push_back(slice(ball, cube, plane).value());
  ASSERT_FALSE(write_vtk(slices[1], path("one")));
  vtkPolyData* curves = read("one/result/curves.vtp");
  ASSERT_GT(curves->GetNumberOfPoints(), 8);
  for (vtkIdType k = 0; k < curves->GetNumberOfPoints(); ++k) {
    double p[3];
    curves->GetPoint(k, p);
    EXPECT_NEAR(p[0] + 2 * p[1] + 3 * p[2], 0, 1e-12);
    EXPECT_NEAR(p[0] * p[0] + p[1] * p[1] + p[2] * p[2], 1, 1e-3);
  }
  EXPECT_NE(text(path("one/result.vtm")).find("Name=\"plane\""), std::string::npos);
  ASSERT_FALSE(write_vtk(slices, path("three")));
  const std::string series = text(path("three/slices.pvd"));
  for (const char* name : {"slice_000", "slice_001", "slice_002"}) {
    EXPECT_NE(series.find(name), std::string::npos);
    EXPECT_TRUE(fs::exists(path("three/" + std::string(name) + "/result.vtm")));
  }
  EXPECT_TRUE(write_vtk(slices, path("missing/three")));
}

}  // namespace
}  // namespace encase
