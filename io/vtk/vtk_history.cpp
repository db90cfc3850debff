// SPDX-License-Identifier: MIT
#include "vtk_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
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

std::string collection_file(const std::vector<int>& cuts) {
  std::string out =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t k = 0; k < cuts.size(); ++k)
    fmt::format_to(std::back_inserter(out),
                   "    <DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"history/{}\"/>\n",
                   cuts[k], step_name(static_cast<int>(k)));
  return out + "  </Collection>\n</VTKFile>\n";
}

}  // namespace

Status write_steps(const std::string& directory, int cuts,
                   const std::function<vtkPolyData*(int, VtkTable*)>& fill) {
  auto made = AtomicDirectory::create(directory + "/history");
  if (!made) return made.error();
  AtomicDirectory files = std::move(made).value();
  const std::vector<int> shown = shown_cuts(cuts);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    VtkTable table;
    if (Status bad = write_data_set(fill(shown[k], &table), files.temporary(),
                                    step_name(static_cast<int>(k)), directory + "/history"))
      return bad;
  }
  if (Status bad = files.commit()) return bad;
  return write_file(directory + "/history.pvd", collection_file(shown));
}

}  // namespace encase
