// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "3d/box_clusters.hpp"
#include "3d/surface_encaser.hpp"

namespace encase {

void SurfaceEncaser::report(const std::vector<Box<3>>& boxes, UnresolvedInSpace entry,
                            const std::string& diagnosis) {
  // Boxes that nearly touch are one place.
  std::vector<Box<3>> grown = boxes;
  for (Box<3>& box : grown) {
    const double margin = box.largest_width();
    for (int i = 0; i < 3; ++i) {
      box.lo[i] -= margin;
      box.hi[i] += margin;
    }
  }
  const std::vector<int> component = box_components(grown);
  std::vector<Box<3>> clusters;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto c = static_cast<std::size_t>(component[k]);
    if (c == clusters.size())
      clusters.push_back(boxes[k]);
    else
      clusters[c] = hull(clusters[c], boxes[k]);
  }
  entry.has_box = true;
  if (is_stopped_) entry.kind = Unresolved::Kind::Budget;
  entry.reason = is_stopped_ ? budget_ + " before it was told whether " + diagnosis : diagnosis;
  for (const Box<3>& box : clusters) {
    entry.box = box;
    (entry.kind == Unresolved::Kind::Budget ? result_.undecided : result_.degenerate)
        .push_back(entry);
  }
}

/// Why a leaf has not got its certificates.
SurfaceEncaser::Diagnosis SurfaceEncaser::diagnose(int index) const {
  const SpacePartition::Leaf& leaf = partition_->leaves()[static_cast<std::size_t>(index)];
  std::set<int> without_graph, without_pair;
  for (std::size_t s = 0; s < leaf.signs.size(); ++s)
    if (leaf.signs[s] == Sign::Zero) without_graph.insert(static_cast<int>(s));
  const std::set<int> alive = without_graph;
  for (const int g : leaf.graphs)
    without_graph.erase(partition_->graphs()[static_cast<std::size_t>(g)].surface);
  std::set<std::array<int, 2>> pairs;
  for (const int f : alive)
    for (const int g : alive)
      if (f < g) pairs.insert({f, g});
  for (const int p : leaf.pairs)
    pairs.erase(partition_->pairs()[static_cast<std::size_t>(p)].surfaces);
  for (const auto& [f, g] : pairs) without_pair.insert({f, g});
  const auto names = [&](const std::set<int>& surfaces) {
    std::string text;
    for (const int s : surfaces)
      text +=
          (text.empty() ? "'" : ", '") + result_.surfaces[static_cast<std::size_t>(s)].name + "'";
    return text;
  };
  if (without_graph.size() == 1)
    return {Unresolved::Kind::SingularPoint,
            {without_graph.begin(), without_graph.end()},
            "surface " + names(without_graph) + " is singular or nearly singular"};
  if (!without_pair.empty())
    return {Unresolved::Kind::Contact,
            {without_pair.begin(), without_pair.end()},
            "surfaces " + names(without_pair) + " touch, nearly touch or are singular"};
  return {Unresolved::Kind::Concurrency,
          {alive.begin(), alive.end()},
          "the common points of surfaces " + names(alive) + " are not told"};
}

/// Reports what resists; cells that resist for the same reason and touch are one place.
void SurfaceEncaser::report_cells() {
  const auto& leaves = partition_->leaves();
  std::vector<std::pair<UnresolvedInSpace, std::vector<Box<3>>>> places;
  const auto add = [&](UnresolvedInSpace entry, const Box<3>& box) {
    auto same = std::find_if(places.begin(), places.end(), [&](const auto& place) {
      return place.first.kind == entry.kind && place.first.surfaces == entry.surfaces &&
             place.first.reason == entry.reason;
    });
    if (same == places.end()) same = places.insert(places.end(), {std::move(entry), {}});
    same->second.push_back(box);
  };
  const double smallest =
      2 * PartitionLimits().smallest * region_.polyhedron.bounding_box().largest_width();
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    const Cell& cell = cells_[k];
    SpaceCell& result = result_.cells[k];
    if (result.state == CellState::Certified) continue;
    UnresolvedInSpace entry;
    if (cell.trouble) {
      entry.kind = *cell.trouble == Outcome::Degenerate ? Unresolved::Kind::Contact
                                                        : Unresolved::Kind::Budget;
      entry.reason = cell.reason;
      for (std::size_t s = 0; s < leaves[k].signs.size(); ++s)
        if (leaves[k].signs[s] == Sign::Zero) entry.surfaces.push_back(static_cast<int>(s));
    } else {
      Diagnosis diagnosis = diagnose(static_cast<int>(k));
      entry.surfaces = std::move(diagnosis.surfaces);
      entry.reason = std::move(diagnosis.reason);
      if (leaves[k].box.largest_width() <= smallest) entry.kind = diagnosis.kind;
    }
    if (entry.kind == Unresolved::Kind::Budget) {
      if (!cell.trouble)
        entry.reason = (budget_.empty() ? "the limit on cells was reached" : budget_) +
                       " before it was told whether " + entry.reason;
    } else {
      result.state = CellState::Degenerate;
    }
    add(std::move(entry), leaves[k].box);
  }
  for (auto& [entry, boxes] : places) {
    const std::string reason = entry.reason;
    report(boxes, std::move(entry), reason);
  }
}

void SurfaceEncaser::take_cells() {
  const auto& leaves = partition_->leaves();
  for (std::size_t k = 0; k < leaves.size(); ++k) {
    const SpacePartition::Leaf& leaf = leaves[k];
    Cell& from = cells_[k];
    SpaceCell cell;
    cell.state = from.trouble ? CellState::Undecided : leaf.state;
    cell.box = leaf.box;
    cell.depth = leaf.depth;
    cell.facets = std::move(from.facets);
    cell.signs = leaf.signs;
    cell.absences = leaf.absences;
    cell.graphs = leaf.graphs;
    cell.pairs = leaf.pairs;
    if (cell.state == CellState::Certified) {
      cell.patches = std::move(from.reading.patches);
      cell.arcs = std::move(from.reading.arcs);
    }
    for (const int t : leaf.triple_points)
      if (cell.state == CellState::Certified && inside_[static_cast<std::size_t>(t)])
        result_.triple_points[static_cast<std::size_t>(t)].cell = static_cast<int>(k);
    result_.cells.push_back(std::move(cell));
  }
  result_.planes = partition_->planes();
  result_.history = partition_->history();
  result_.absence_certificates = partition_->absences();
  result_.graph_certificates = partition_->graphs();
  result_.pair_certificates = partition_->pairs();
  result_.facet_points = std::move(points_);
  for (EncasedFacet& encased : facets_) result_.facets.push_back(std::move(encased.facet));
}

void SurfaceEncaser::finish() {
  take_cells();
  report_cells();
  result_.region_used = std::move(region_.polyhedron);
  result_.outcome = !result_.undecided.empty()    ? Outcome::Undecided
                    : !result_.degenerate.empty() ? Outcome::Degenerate
                                                  : Outcome::Certified;
  SpaceStatistics& s = result_.statistics;
  s.decisions = kernel_.decisions;
  s.decisions += encaser_->decisions();
  s.certificate_tests = partition_->tests();
  s.facets_encased = encaser_->encased();
  result_.seconds = clock_.seconds();
}

}  // namespace encase
