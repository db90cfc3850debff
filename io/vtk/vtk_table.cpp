// SPDX-License-Identifier: MIT
#include "vtk_table.hpp"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include "encase/version.hpp"
#include "io/names.hpp"

namespace encase {

FieldData field_data(const Encasement& encasement) {
  std::vector<std::string> input;
  for (const NamedCurve& curve : encasement.input)
    input.push_back(curve.name + ": " + curve.function.to_string());
  return {{"status", {name_of(kOutcomes, encasement.outcome)}},
          {"input", input},
          {"version", {std::string("encase ") + kVersion}}};
}

vtkPolyData* VtkTable::finish(const FieldData& about, bool of_points) {
  data_->SetVerts(vertices_);
  data_->SetLines(lines_);
  data_->SetPolys(polygons_);
  for (vtkAbstractArray* array : arrays_)
    (of_points ? static_cast<vtkFieldData*>(data_->GetPointData()) : data_->GetCellData())
        ->AddArray(array);
  for (vtkAbstractArray* array : point_vectors_) data_->GetPointData()->AddArray(array);
  for (const auto& [name, values] : about) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& value : values) array->InsertNextValue(value.c_str());
    data_->GetFieldData()->AddArray(array);
  }
  return data_;
}

}  // namespace encase
