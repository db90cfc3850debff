// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>

#include "3d/surface_encaser.hpp"
#include "common/components.hpp"
#include "common/filtered_inclusion.hpp"
#include "common/perturb.hpp"

namespace encase {

namespace {

Status bad_input(std::string message) {
  return Status(Error{Error::Code::BadInput, std::move(message)});
}

Status check(const NamedSurface& surface, const Box<3>& box) {
  const std::string name = "surface '" + surface.name + "'";
  if (surface.function.is_inclusion()) {
    const auto trouble = complaint(surface.function.inclusion(), box);
    return trouble ? bad_input("the inclusion function of " + name + " " + *trouble) : std::nullopt;
  }
  if (!surface.function.is_polynomial()) {
    const Expression& f = surface.function.expression();
    if (!f.uses(0) && !f.uses(1) && !f.uses(2))
      return bad_input(name + " is a constant: it has no x, y or z");
    return std::nullopt;
  }
  const Polynomial<3>& f = surface.function.polynomial();
  if (f.is_zero()) return bad_input(name + " is the zero polynomial: every point lies on it");
  if (f.is_constant()) return bad_input(name + " is a constant: no point lies on it");
  if (f.degree() > kMaxDegree)
    return bad_input(name + " has degree " + std::to_string(f.degree()) + ", above the limit of " +
                     std::to_string(kMaxDegree));
  return std::nullopt;
}

}  // namespace

Status SurfaceEncaser::check_input() const {
  if (result_.region.corners.size() < 4) return bad_input("the region is no polyhedron");
  for (const NamedSurface& surface : result_.input)
    if (Status bad = check(surface, result_.region.bounding_box())) return bad;
  if (!(result_.perturbation >= 0) || !std::isfinite(result_.perturbation))
    return bad_input("the perturbation must be a number that is not negative");
  for (const NamedSurface& surface : result_.input)
    if (result_.perturbation > 0 && !surface.function.is_polynomial())
      return bad_input("surface '" + surface.name +
                       "' is no polynomial: only those can be perturbed");
  if (!(options_.singular_width > 0))
    return bad_input("the width of cells along singular curves must be positive");
  return std::nullopt;
}

void SurfaceEncaser::separate_components() {
  if (result_.perturbation > 0) {
    std::mt19937_64 generator(result_.seed);
    for (NamedSurface& surface : result_.input)
      surface.function = perturb(surface.function.polynomial(), result_.perturbation, generator);
  }
  separate_polynomials();
  separate_others();
  for (const Surface& surface : result_.surfaces) surfaces_.emplace_back(surface.function);
  notes_ = result_.degenerate.size();
}

void SurfaceEncaser::separate_polynomials() {
  std::vector<Polynomial<3>> inputs;
  std::vector<int> input_of;
  for (std::size_t k = 0; k < result_.input.size(); ++k)
    if (result_.input[k].function.is_polynomial()) {
      inputs.push_back(result_.input[k].function.polynomial());
      input_of.push_back(static_cast<int>(k));
    }
  std::vector<int> used(result_.input.size(), 0);
  for (BaseElement<3>& element : coprime_square_free_base(inputs)) {
    Surface surface;
    UnresolvedInSpace note;
    note.proved = true;
    for (const auto& source : element.sources) {
      const int index = input_of[static_cast<std::size_t>(source.index)];
      const NamedSurface& from = result_.input[static_cast<std::size_t>(index)];
      surface.sources.push_back(index);
      surface.name += (surface.name.empty() ? "" : " & ") + from.name;
      note.surfaces.push_back(index);
      if (source.multiplicity == 1) continue;
      UnresolvedInSpace repeated = note;
      repeated.kind = Unresolved::Kind::RepeatedComponent;
      repeated.surfaces = {index};
      repeated.reason = "surface '" + from.name + "' contains the component " +
                        element.polynomial.to_string() + " = 0 " +
                        std::to_string(source.multiplicity) + " times; it is encased once";
      result_.degenerate.push_back(std::move(repeated));
    }
    int& count = used[static_cast<std::size_t>(surface.sources[0])];
    if (element.sources.size() > 1) {
      note.kind = Unresolved::Kind::SharedComponent;
      note.reason = "surfaces '" + surface.name + "' share the component " +
                    element.polynomial.to_string() + " = 0; it is encased as one surface";
      result_.degenerate.push_back(std::move(note));
    } else if (++count > 1) {
      surface.name += " (" + std::to_string(count) + ")";
    }
    surface.function = std::move(element.polynomial);
    result_.surfaces.push_back(std::move(surface));
  }
}

/// Equal ones are one surface; nothing else is known of what they have in common.
void SurfaceEncaser::separate_others() {
  const std::size_t first = result_.surfaces.size();
  for (std::size_t k = 0; k < result_.input.size(); ++k) {
    const NamedSurface& from = result_.input[k];
    if (from.function.is_polynomial()) continue;
    const auto same = std::find_if(
        result_.surfaces.begin() + static_cast<std::ptrdiff_t>(first), result_.surfaces.end(),
        [&](const Surface& surface) { return surface.function == from.function; });
    if (same == result_.surfaces.end()) {
      result_.surfaces.push_back({from.name, from.function, {static_cast<int>(k)}});
    } else {
      same->name += " & " + from.name;
      same->sources.push_back(static_cast<int>(k));
    }
  }
  for (std::size_t s = first; s < result_.surfaces.size(); ++s) {
    const Surface& surface = result_.surfaces[s];
    if (surface.sources.size() < 2) continue;
    UnresolvedInSpace note;
    note.kind = Unresolved::Kind::SharedComponent;
    note.proved = true;
    note.surfaces = surface.sources;
    note.reason = "surfaces '" + surface.name + "' are the same; they are encased as one surface";
    result_.degenerate.push_back(std::move(note));
  }
  if (first < result_.surfaces.size())
    std::stable_sort(
        result_.surfaces.begin(), result_.surfaces.end(),
        [](const Surface& a, const Surface& b) { return a.sources[0] < b.sources[0]; });
}

}  // namespace encase
