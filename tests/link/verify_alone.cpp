// SPDX-License-Identifier: MIT
//
// Links encase_verify, encase_arrangement and encase_common, and nothing of the search:
// verification stands alone.
#include <cstdio>

#include "3d/facet_places.hpp"
#include "encase/surface_encasement.hpp"
#include "encase/verify.hpp"
#include "hand_made_encasement.hpp"

namespace {

using namespace encase;

/// Of no surfaces, in a box that is one cell.
SurfaceEncasement empty_box() {
  SurfaceEncasement e;
  e.outcome = Outcome::Certified;
  e.region = e.region_used = make_box({-1, -1, -1}, {1, 1, 1}).value();
  for (const HalfSpace& side : e.region.sides) e.planes.push_back(Plane::from_rationals(side));
  SpaceCell cell;
  cell.state = CellState::Certified;
  cell.box = e.region.bounding_box();
  PlaneCharts charts(e.planes);
  const BoxPartition whole{e.planes, e.history, cell.box, {0, 1, 2, 3, 4, 5}};
  for (FacetPlace& place : facet_places(whole, {e.region, true}, charts)) {
    Facet facet;
    facet.plane = place.plane;
    facet.cells = place.cells;
    facet.polygon = std::move(place.polygon);
    facet.side_planes = std::move(place.side_planes);
    cell.facets.push_back(static_cast<int>(e.facets.size()));
    e.facets.push_back(std::move(facet));
  }
  e.cells.push_back(std::move(cell));
  return e;
}

}  // namespace

int main() {
  // The lines x = y / 3 + 1 / 7 and x = -y / 5 - 1 / 9.
  hand_made::Recipe recipe;
  recipe.curves = {
      hand_made::polynomial({{{1, 0}, 1}, {{0, 1}, Rational(-1, 3)}, {{0, 0}, Rational(-1, 7)}}),
      hand_made::polynomial({{{1, 0}, 1}, {{0, 1}, Rational(1, 5)}, {{0, 0}, Rational(1, 9)}})};
  recipe.corners = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  recipe.crossings = {{{0, 1}, {-1.0 / 63, -10.0 / 21}}};
  Encasement encasement = hand_made::build(recipe);

  const Verification verification = verify(encasement);
  for (const std::string& objection : verification.objections) std::puts(objection.c_str());
  if (!verification.ok()) return 1;
  // And it does look: the same result with another word is refused.
  std::swap(encasement.cells[0].word[0], encasement.cells[0].word[1]);
  if (verify(encasement).ok()) return 1;

  SurfaceEncasement in_space = empty_box();
  for (const std::string& objection : verify(in_space).objections) std::puts(objection.c_str());
  if (!verify(in_space).ok()) return 1;
  in_space.facets.pop_back();
  return verify(in_space).ok() ? 1 : 0;
}
