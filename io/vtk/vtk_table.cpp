// SPDX-License-Identifier: MIT
#include "vtk_table.hpp"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

namespace encase {

vtkPolyData* VtkTable::finish(const FieldData& about, VtkRowsOf of) {
  data_->SetVerts(vertices_);
  data_->SetLines(lines_);
  data_->SetPolys(polygons_);
  for (vtkAbstractArray* array : arrays_)
    (of == VtkRowsOf::Points ? static_cast<vtkFieldData*>(data_->GetPointData())
                             : data_->GetCellData())
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
