// SPDX-License-Identifier: MIT
#include "vtk_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "encase/atomic_file.hpp"
#include "vtk_multiblock.hpp"

namespace encase {
namespace {

constexpr int kMaxSteps = 200;

std::string step_name(int step) { return fmt::format("step_{:03}.vtp", step); }

/// The numbers of cuts at which the history is shown: the first, the last, and evenly between.
std::vector<int> shown_cuts(int cuts) {
  const int steps = std::min(cuts + 1, kMaxSteps);
  std::vector<int> shown;
  for (int k = 0; k < steps; ++k)
    shown.push_back(steps == 1 ? 0
                               : static_cast<int>(static_cast<long long>(cuts) * k / (steps - 1)));
  return shown;
}

}  // namespace

Status write_steps(const std::string& directory, int cuts, const FieldData& about,
                   const std::function<void(int, VtkTable*)>& fill) {
  auto made = AtomicDirectory::create(directory + "/history");
  if (!made) return made.error();
  AtomicDirectory files = std::move(made).value();
  std::vector<VtkStep> steps;
  for (const int shown : shown_cuts(cuts)) {
    const std::string name = step_name(static_cast<int>(steps.size()));
    VtkTable table;
    fill(shown, &table);
    if (Status bad = write_data_set(table.finish(about, VtkRowsOf::Primitives), files.temporary(),
                                    name, directory + "/history"))
      return bad;
    steps.push_back({shown, "history/" + name});
  }
  if (Status bad = files.commit()) return bad;
  return write_steps_file(directory + "/history.pvd", steps);
}

}  // namespace encase
