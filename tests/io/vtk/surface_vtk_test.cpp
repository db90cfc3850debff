// SPDX-License-Identifier: MIT
#include "encase/surface_vtk.hpp"

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

#include "3d/encased_surfaces.hpp"

namespace encase {
namespace {

namespace fs = std::filesystem;

TEST(SurfaceVtk, HoldsCellsFacetsSurfacesCurvesAndPoints) {
  const fs::path directory =
      fs::path(testing::TempDir()) / ("surface-vtk-" + std::to_string(getpid()));
  fs::remove_all(directory);
  const SurfaceEncasement e = encased_surfaces({"x^2+y^2+z^2-1", "x-y/5-1/10", "z-x/7-1/9"}, 2);
  IntersectionTraceOptions tracing;
  tracing.tolerance = 0.01;
  const IntersectionTracing curves = trace(e, tracing).value();
  SurfaceMeshOptions meshing;
  meshing.tolerance = 0.05;
  const auto meshes = mesh(e, meshing).value();
  ASSERT_EQ(write_vtk(e, curves, meshes, directory.string(), true), std::nullopt);
  EXPECT_TRUE(fs::exists(directory / "result.vtm"));
  EXPECT_TRUE(fs::exists(directory / "history.pvd"));

  vtkNew<vtkXMLPolyDataReader> reader;
  const auto read = [&](const std::string& name) {
    reader->SetFileName((directory / name).string().c_str());
    reader->Update();
    return reader->GetOutput();
  };
  const auto integer = [](vtkFieldData* data, const char* name, std::size_t row) {
    auto* array = vtkIntArray::SafeDownCast(data->GetAbstractArray(name));
    return array ? array->GetValue(static_cast<int>(row)) : -1000;
  };
  const auto facets = static_cast<int>(e.facets.size());
  EXPECT_EQ(read("result/facets.vtp")->GetNumberOfCells(), facets);
  EXPECT_EQ(reader->GetOutput()->GetFieldData()->GetNumberOfArrays(), 3);
  std::size_t sides = 0;
  for (const SpaceCell& cell : e.cells) sides += cell.facets.size();
  vtkPolyData* cells = read("result/cells.vtp");
  ASSERT_EQ(cells->GetNumberOfCells(), static_cast<int>(sides));
  EXPECT_EQ(integer(cells->GetCellData(), "sign_s0", 0), static_cast<int>(e.cells[0].signs[0]));
  EXPECT_EQ(integer(cells->GetCellData(), "certified", 0), 1);

  std::size_t triangles = 0;
  for (const SurfaceMesh& surface : meshes) triangles += surface.triangles.size();
  vtkPolyData* surfaces = read("result/surfaces.vtp");
  EXPECT_EQ(surfaces->GetNumberOfCells(), static_cast<int>(triangles));
  EXPECT_NE(surfaces->GetPointData()->GetArray("Normals"), nullptr);
  vtkPolyData* lines = read("result/intersection_curves.vtp");
  EXPECT_EQ(lines->GetNumberOfCells(), static_cast<int>(curves.curves.size()));
  EXPECT_NE(lines->GetPointData()->GetArray("tangent"), nullptr);
  vtkPolyData* points = read("result/points.vtp");
  ASSERT_EQ(points->GetNumberOfPoints(), static_cast<int>(e.triple_points.size()));
  EXPECT_EQ(integer(points->GetPointData(), "third_surface", 0), 2);

  // Before the first cut only what is outside; after the last all facets.
  const int before = static_cast<int>(read("history/step_000.vtp")->GetNumberOfCells());
  EXPECT_LT(before, facets);
  char last[32];
  std::snprintf(last, sizeof last, "history/step_%03zu.vtp", e.history.size());
  EXPECT_EQ(read(last)->GetNumberOfCells(), facets);
  fs::remove_all(directory);
}

}  // namespace
}  // namespace encase
