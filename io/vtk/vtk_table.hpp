// SPDX-License-Identifier: MIT
#pragma once

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "encase/encasement.hpp"
#include "encase/slice.hpp"

namespace encase {

/// What every file says about the result as a whole: names and values.
using FieldData = std::vector<std::pair<const char*, std::vector<std::string>>>;
FieldData field_data(const Encasement& encasement);

/// A data set with attributes for each of its points or cells, filled row by row.
class VtkTable {
 public:
  VtkTable() {
    points_->SetDataTypeToDouble();
    data_->SetPoints(points_);
  }

  /// All points that follow are given in the coordinates of a plane, and lie on it.
  void place_on(const PlaneChart* chart) { chart_ = chart; }

  /// Points for triangles that share them.
  void points(const std::vector<Point<2>>& all) {
    for (const Point<2>& p : all) point(p);
  }
  void triangle(const std::array<int, 3>& corners) {
    polygons_->InsertNextCell(3);
    for (const int k : corners) polygons_->InsertCellPoint(k);
  }
  /// Primitives with points of their own.
  void polygon(const std::vector<Point<2>>& corners) { primitive<2>(polygons_, corners); }
  void polyline(const std::vector<Point<2>>& line) { primitive<2>(lines_, line); }
  void vertex(const Point<2>& p) { primitive<2>(vertices_, {p}); }
  void rectangle(const Box<2>& b) {
    primitive<2>(polygons_,
                 {{b.lo[0], b.lo[1]}, {b.hi[0], b.lo[1]}, {b.hi[0], b.hi[1]}, {b.lo[0], b.hi[1]}});
  }

  /// The same in space.
  void points(const std::vector<Point<3>>& all) {
    for (const Point<3>& p : all) point(p);
  }
  void polygon(const std::vector<Point<3>>& corners) { primitive<3>(polygons_, corners); }
  void polyline(const std::vector<Point<3>>& line) { primitive<3>(lines_, line); }
  void vertex(const Point<3>& p) { primitive<3>(vertices_, {p}); }

  vtkIntArray* integers(const std::string& name) { return add<vtkIntArray>(name); }
  vtkDoubleArray* doubles(const std::string& name) { return add<vtkDoubleArray>(name); }
  vtkStringArray* strings(const std::string& name) { return add<vtkStringArray>(name); }

  /// A vector for each point, whatever the others belong to.
  vtkDoubleArray* point_vectors(const std::string& name) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(3);
    point_vectors_.emplace_back(array);
    return array;
  }

  /// The data set; attributes belong to its points if `of_points`, else to its cells.
  vtkPolyData* finish(const FieldData& field_data, bool of_points);
  vtkPolyData* finish(const Encasement& encasement, bool of_points) {
    return finish(field_data(encasement), of_points);
  }

 private:
  vtkIdType point(const Point<2>& p) {
    return point(chart_ ? chart_->lift(p) : Point<3>{p[0], p[1], 0});
  }
  vtkIdType point(const Point<3>& p) { return points_->InsertNextPoint(p.data()); }
  template <int D>
  void primitive(vtkCellArray* list, const std::vector<Point<D>>& points) {
    list->InsertNextCell(static_cast<int>(points.size()));
    for (const Point<D>& p : points) list->InsertCellPoint(point(p));
  }
  template <class Array>
  Array* add(const std::string& name) {
    vtkNew<Array> array;
    array->SetName(name.c_str());
    arrays_.emplace_back(array);
    return array;
  }
  const PlaneChart* chart_ = nullptr;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> vertices_, lines_, polygons_;
  std::vector<vtkSmartPointer<vtkAbstractArray>> arrays_, point_vectors_;
};

}  // namespace encase
