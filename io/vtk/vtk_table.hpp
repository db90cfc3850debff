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
#include <tuple>
#include <utility>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/slice.hpp"

namespace encase {

/// What every file says about the result as a whole: names and values.
using FieldData = std::vector<std::pair<const char*, std::vector<std::string>>>;

/// A column of attributes: what it holds, and its name.
template <class Array>
struct VtkColumn {
  std::string name;
};
/// (Also of indices, enumerators and truth values.)
inline VtkColumn<vtkIntArray> integer(const std::string& name) { return {name}; }
inline VtkColumn<vtkDoubleArray> number(const std::string& name) { return {name}; }
inline VtkColumn<vtkStringArray> text(const std::string& name) { return {name}; }

/// Adds rows to columns: a value for each.
template <class... Arrays>
class VtkRows {
 public:
  explicit VtkRows(Arrays*... arrays) : arrays_(arrays...) {}

  template <class... Values>
  void operator()(const Values&... values) const {
    static_assert(sizeof...(Values) == sizeof...(Arrays), "a value for each column");
    std::apply([&](Arrays*... arrays) { (put(arrays, values), ...); }, arrays_);
  }

 private:
  template <class Value>
  static void put(vtkIntArray* array, const Value& value) {
    array->InsertNextValue(static_cast<int>(value));
  }
  static void put(vtkDoubleArray* array, double value) { array->InsertNextValue(value); }
  static void put(vtkStringArray* array, const std::string& value) {
    array->InsertNextValue(value.c_str());
  }
  std::tuple<Arrays*...> arrays_;
};

/// Whether the rows of a table belong to its primitives or to its points.
enum class VtkRowsOf { Primitives, Points };

/// A data set with attributes for each of its primitives or points, filled row by row.
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

  /// Makes columns; each primitive needs a row of them.
  template <class... Arrays>
  VtkRows<Arrays...> columns(const VtkColumn<Arrays>&... columns) {
    return VtkRows<Arrays...>{add(columns)...};  // (Braces: from the first to the last.)
  }

  /// A vector for each point, whatever the others belong to.
  vtkDoubleArray* point_vectors(const std::string& name) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfComponents(3);
    point_vectors_.emplace_back(array);
    return array;
  }

  vtkPolyData* finish(const FieldData& about, VtkRowsOf of);

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
  Array* add(const VtkColumn<Array>& column) {
    vtkNew<Array> array;
    array->SetName(column.name.c_str());
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
