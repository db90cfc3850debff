// SPDX-License-Identifier: MIT
#include "3d/facets.hpp"

#include <algorithm>
#include <utility>

#include "2d/encaser.hpp"
#include "common/filtered_function.hpp"
#include "encase/arrangement.hpp"

namespace encase {

const FacetEncaser::OnPlane& FacetEncaser::restricted(int plane, int surface) {
  const auto [entry, is_new] = restricted_.try_emplace({plane, surface});
  OnPlane& result = entry->second;
  if (!is_new) return result;
  result.function =
      on_facet(charts_.of(plane), surfaces_[static_cast<std::size_t>(surface)].function);
  const Function<2>& f = result.function;
  const bool is_constant =
      f.is_polynomial() ? f.polynomial().is_constant()
                        : f.is_expression() && !f.expression().uses(0) && !f.expression().uses(1);
  if (is_constant && f.is_polynomial() && f.polynomial().is_zero())
    result.constant = Sign::Zero;
  else if (is_constant)
    result.constant = FilteredFunction<2>(f).sign_at({0, 0}, kernel_);
  else
    result.filtered.emplace(f);
  return result;
}

EncasedFacet FacetEncaser::facet_at(FacetPlace place, const std::vector<int>& surfaces) {
  std::vector<int> with_curves;
  std::optional<FacetTrouble> trouble;
  for (const int s : surfaces) {
    const std::optional<Sign>& constant = restricted(place.plane, s).constant;
    if (!constant) with_curves.push_back(s);
    if (constant == Sign::Zero)
      trouble = {Outcome::Degenerate, "surface '" + surfaces_[static_cast<std::size_t>(s)].name +
                                          "' contains a plane of the partition"};
  }
  Key key{place.plane, place.extent.lo, place.extent.hi, with_curves};
  EncasedFacet result;
  if (const auto found = earlier_.find(key); found != earlier_.end()) {
    result = std::move(found->second);
    earlier_.erase(found);
    result.facet.cells = place.cells;
    return result;
  }
  result.extent = place.extent;
  result.trouble = std::move(trouble);
  Facet& facet = result.facet;
  facet.plane = place.plane;
  facet.cells = place.cells;
  facet.polygon = std::move(place.polygon);
  facet.side_planes = std::move(place.side_planes);
  facet.surfaces = std::move(with_curves);
  result.is_open = !result.trouble && !facet.surfaces.empty();
  return result;
}

void FacetEncaser::encase(
    std::vector<EncasedFacet>& facets,
    const std::function<void(int, const std::function<void(int)>&)>& for_all) {
  std::vector<EncasedFacet*> open;
  for (EncasedFacet& facet : facets)
    if (facet.is_open) open.push_back(&facet);
  std::vector<DecisionCounts> decisions(open.size());
  for_all(static_cast<int>(open.size()), [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    open[k]->trouble = encase(&open[k]->facet, &decisions[k]);
    open[k]->is_open = false;
  });
  for (const DecisionCounts& counts : decisions) decisions_ += counts;
  encased_ += static_cast<std::int64_t>(open.size());
}

std::optional<FacetTrouble> FacetEncaser::encase(Facet* facet, DecisionCounts* decisions) const {
  std::vector<NamedCurve> curves;
  std::vector<const FilteredFunction<2>*> prepared;
  for (const int s : facet->surfaces) {
    const OnPlane& on_plane = restricted_.at({facet->plane, s});
    curves.emplace_back();
    curves.back().name = surfaces_[static_cast<std::size_t>(s)].name;
    curves.back().function = on_plane.function;
    prepared.push_back(&*on_plane.filtered);
  }
  // As `encase`, but of the polygon itself, whatever meets its sides.
  Encaser run(curves, facet->polygon, options_);
  run.take_curves(prepared);
  if (!run.open_region_as_asked())
    return FacetTrouble{
        Outcome::Degenerate,
        "a surface touches an edge or passes through a corner of a cell, or nearly"};
  run.find_critical_regions();
  run.collect_zones();
  run.split_cells();
  run.finish_cells();
  run.decide_outcome();
  Encasement e = run.take_result();
  *decisions = e.statistics.decisions;
  if (e.outcome == Outcome::Undecided)
    return FacetTrouble{Outcome::Undecided, e.undecided.empty() ? "a facet was left undecided"
                                                                : e.undecided.front().reason};
  if (e.outcome == Outcome::Degenerate && !e.degenerate.empty())
    return FacetTrouble{Outcome::Degenerate, e.degenerate.front().reason};
  ArrangeOptions without_points;
  without_points.boundary_points = false;
  auto arrangement = arrange(e, without_points);
  if (!arrangement) return FacetTrouble{Outcome::Undecided, arrangement.error().message};
  facet->encasement = std::move(e);
  facet->arrangement = std::move(arrangement).value();
  return std::nullopt;
}

void FacetEncaser::recycle(std::vector<EncasedFacet> facets) {
  for (EncasedFacet& encased : facets) {
    Key key{encased.facet.plane, encased.extent.lo, encased.extent.hi, encased.facet.surfaces};
    encased.facet.points.clear();
    earlier_.insert_or_assign(std::move(key), std::move(encased));
  }
}

}  // namespace encase
