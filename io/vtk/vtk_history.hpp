// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "encase/result.hpp"
#include "vtk_table.hpp"

namespace encase {

/// Writes the time steps of a splitting in `cuts` cuts, at most 200 of them evenly chosen, as
/// `directory`/history/step_NNN.vtp, then `directory`/history.pvd. `fill` fills the table of
/// what there is after a number of cuts.
Status write_steps(const std::string& directory, int cuts, const FieldData& about,
                   const std::function<void(int, VtkTable*)>& fill);

}  // namespace encase
