// SPDX-License-Identifier: MIT
// Step 1 of an encasement of surfaces: sanity.
#include <utility>

#include "3d/surface_encaser.hpp"
#include "common/input_functions.hpp"

namespace encase {

Status SurfaceEncaser::check_input() const {
  if (result_.region.corners.size() < 4)
    return Error{Error::Code::BadInput, "the region is no polyhedron"};
  if (Status bad =
          check_functions(result_.input, result_.region.bounding_box(), result_.perturbation))
    return bad;
  if (!(options_.singular_width > 0))
    return Error{Error::Code::BadInput,
                 "the width of cells along singular curves must be positive"};
  return std::nullopt;
}

void SurfaceEncaser::separate_components() {
  if (result_.perturbation > 0)
    perturb_functions(&result_.input, 0, result_.perturbation, result_.seed);
  SeparateFunctions<3> separate = separate_functions(result_.input);
  for (SeparateFunction<3>& f : separate.functions) {
    surfaces_.emplace_back(f.function);
    result_.surfaces.push_back({std::move(f.name), std::move(f.function), std::move(f.sources)});
  }
  for (ComponentNote& note : separate.notes) {
    UnresolvedInSpace entry;
    entry.kind = note.kind;
    entry.surfaces = std::move(note.inputs);
    entry.proved = true;
    entry.reason = std::move(note.reason);
    result_.degenerate.push_back(std::move(entry));
  }
  notes_ = result_.degenerate.size();
}

}  // namespace encase
