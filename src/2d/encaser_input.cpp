// SPDX-License-Identifier: MIT
// Step 1 of an encasement: sanity.
#include "2d/encaser.hpp"

#include <utility>

#include "common/input_functions.hpp"

namespace encase {

Status Encaser::check_input() const {
  const Region& region = result_.region;
  if (!region.plane && region.corners.size() < 3)
    return Error{Error::Code::BadInput, "the region has fewer than three corners"};
  for (const NamedCurve& curve : result_.input)
    if (region.plane && !curve.function.is_polynomial())
      return Error{Error::Code::BadInput, "curve '" + curve.name +
                                              "' is no polynomial: it can be encased in a bounded "
                                              "region, not in the plane"};
  const Box<2> box = region.plane ? Box<2>{} : region.bounding_box();
  return check_functions(result_.input, box, result_.perturbation);
}

void Encaser::separate_components() {
  if (result_.perturbation > 0)
    perturb_functions(&result_.input, perturbed_, result_.perturbation, result_.seed);
  SeparateFunctions<2> separate = separate_functions(result_.input);
  for (SeparateFunction<2>& f : separate.functions) {
    polynomials_.emplace_back(f.function);
    result_.curves.push_back({std::move(f.name), std::move(f.function), std::move(f.sources)});
  }
  for (ComponentNote& note : separate.notes) {
    Unresolved entry;
    entry.kind = note.kind;
    entry.curves = std::move(note.inputs);
    entry.proved = true;
    entry.reason = std::move(note.reason);
    result_.degenerate.push_back(std::move(entry));
  }
}

void Encaser::take_curves(const std::vector<const FilteredFunction<2>*>& prepared) {
  for (std::size_t k = 0; k < prepared.size(); ++k) {
    const NamedCurve& curve = result_.input[k];
    result_.curves.push_back({curve.name, curve.function, {static_cast<int>(k)}});
    polynomials_.push_back(*prepared[k]);
  }
}

}  // namespace encase
