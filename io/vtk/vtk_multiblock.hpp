// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "encase/result.hpp"
#include "vtk_table.hpp"

namespace encase {

/// Writes one data set as `directory`/`name`; `shown` is what errors call the directory.
Status write_data_set(vtkPolyData* data, const std::string& directory, const std::string& name,
                      const std::string& shown);

/// Writes the data sets that `fill` makes of the blocks' numbers in `directory`/result, then what
/// `more` writes, then `directory`/result.vtm. The directory is made if its parent exists. The .vtm
/// appears when all is complete; it and history.pvd of an earlier run are removed first.
Status write_multiblock(const std::string& directory, const FieldData& field_data,
                        const std::vector<const char*>& blocks,
                        const std::function<vtkPolyData*(std::size_t, VtkTable*)>& fill,
                        const std::function<Status()>& more);

}  // namespace encase
