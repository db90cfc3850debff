// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encase/result.hpp"
#include "vtk_table.hpp"

namespace encase {

/// A data set of a result, with columns for its primitives or points.
struct VtkBlock {
  const char* name;
  VtkRowsOf rows_of;
  std::function<void(VtkTable*)> fill;
};

/// A block of what `fill` shows of a scene, which must outlive it.
template <class Scene>
VtkBlock block_of(const Scene& scene, const char* name, VtkRowsOf rows_of,
                  void (*fill)(const Scene&, VtkTable*)) {
  return {name, rows_of, [&scene, fill](VtkTable* table) { fill(scene, table); }};
}

/// What is written of a result.
struct VtkResult {
  FieldData about;        ///< in every file
  FieldData about_all{};  ///< and in the .vtm alone
  /// Of the plane in whose coordinates points of the plane are; none: z = 0.
  const PlaneChart* chart = nullptr;
  std::vector<VtkBlock> blocks;
  std::function<Status()> write_more = [] { return Status(); };  ///< of the blocks' directory
};

/// Writes one data set as `directory`/`name`; `shown` is what errors call the directory.
Status write_data_set(vtkPolyData* data, const std::string& directory, const std::string& name,
                      const std::string& shown);

/// Writes the blocks in `directory`/result, then what `write_more` writes, then
/// `directory`/result.vtm. The directory is made if its parent exists. The .vtm appears when all is
/// complete; it and history.pvd of an earlier run are removed first.
Status write_multiblock(const std::string& directory, const VtkResult& result);

/// A time step of a .pvd file.
struct VtkStep {
  int time;
  std::string file;  ///< relative to the .pvd's directory
};
Status write_steps_file(const std::string& path, const std::vector<VtkStep>& steps);

}  // namespace encase
