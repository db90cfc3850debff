// SPDX-License-Identifier: MIT
#include "encase/caps_vtk.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>
#include <string>

#include "encase/curves_file.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;

TEST(CapsVtk, HoldsLeavesCurvesAndVertices) {
  const fs::path directory =
      fs::path(testing::TempDir()) / ("caps-vtk-" + std::to_string(getpid()));
  fs::remove_all(directory);
  const CurvesFile file = read_curves("region: -2 2 -2 2\nx^2+y^2 = 1\ny = x/3\n", "test").value();
  CapsOptions options;
  options.epsilon = 1e-4;
  options.self_crossings = true;
  const CapsResult r = caps(file.curves, *file.region, options).value();
  ASSERT_EQ(write_vtk(r, directory.string()), std::nullopt);
  EXPECT_TRUE(fs::exists(directory / "result.vtm"));

  vtkNew<vtkXMLPolyDataReader> reader;
  const auto read = [&](const char* name) {
    reader->SetFileName((directory / "result" / name).string().c_str());
    reader->Update();
    return reader->GetOutput();
  };
  const auto integer = [](vtkFieldData* data, const char* name, std::size_t row) {
    auto* array = vtkIntArray::SafeDownCast(data->GetAbstractArray(name));
    return array ? array->GetValue(static_cast<int>(row)) : -1000;
  };
  vtkPolyData* leaves = read("leaves.vtp");
  ASSERT_EQ(leaves->GetNumberOfCells(), static_cast<int>(r.leaves.size()));
  for (std::size_t k = 0; k < r.leaves.size(); ++k) {
    EXPECT_EQ(integer(leaves->GetCellData(), "kind", k), static_cast<int>(r.leaves[k].label));
    EXPECT_EQ(integer(leaves->GetCellData(), "depth", k), r.leaves[k].depth);
    EXPECT_EQ(integer(leaves->GetCellData(), "region", k), r.leaves[k].region);
  }
  EXPECT_EQ(leaves->GetFieldData()->GetNumberOfArrays(), 3);
  EXPECT_EQ(read("curves.vtp")->GetNumberOfCells(), static_cast<int>(r.edges.size()));
  vtkPolyData* vertices = read("vertices.vtp");
  ASSERT_EQ(vertices->GetNumberOfPoints(), static_cast<int>(r.vertices.size()));
  for (std::size_t k = 0; k < r.vertices.size(); ++k)
    EXPECT_EQ(integer(vertices->GetPointData(), "kind", k), static_cast<int>(r.vertices[k].kind));
  fs::remove_all(directory);

  const Status status = write_vtk(r, "/nowhere/at/all");
  ASSERT_TRUE(status.has_value());
  EXPECT_EQ(status->code, Error::Code::Io);
}

}  // namespace
}  // namespace encase
