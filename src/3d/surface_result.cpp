// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "3d/box_clusters.hpp"
#include "3d/surface_encaser.hpp"
#include "common/wording.hpp"

namespace encase {

namespace {

/// Numbers of clusters: boxes that touch or nearly touch are one place.
std::vector<int> clusters_of(std::vector<Box<3>> boxes) {
  for (Box<3>& box : boxes) {
    const double margin = box.largest_width();
    for (int i = 0; i < 3; ++i) {
      box.lo[i] -= margin;
      box.hi[i] += margin;
    }
  }
  return box_components(boxes);
}

}  // namespace

void SurfaceEncaser::add_unresolved(UnresolvedInSpace entry) {
  (entry.kind == Unresolved::Kind::Budget ? result_.undecided : result_.degenerate)
      .push_back(std::move(entry));
}

/// Where an inclusion function tells no more, nothing is known to be degenerate.
void SurfaceEncaser::leave_open(UnresolvedInSpace* entry) const {
  const bool given = std::any_of(entry->surfaces.begin(), entry->surfaces.end(), [&](int s) {
    return surfaces_[static_cast<std::size_t>(s)].is_inclusion();
  });
  if (!given || entry->kind == Unresolved::Kind::Budget) return;
  entry->kind = Unresolved::Kind::Budget;
  entry->reason += ", or an inclusion function tells too little";
}

/// The boxes were halved as far as sizes go, unless a budget ran out.
void SurfaceEncaser::report_boxes(const std::vector<Box<3>>& boxes, UnresolvedInSpace entry,
                                  const std::string& diagnosis) {
  const std::vector<int> cluster = clusters_of(boxes);
  std::vector<Box<3>> hulls;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto c = static_cast<std::size_t>(cluster[k]);
    if (c == hulls.size())
      hulls.push_back(boxes[k]);
    else
      hulls[c] = hull(hulls[c], boxes[k]);
  }
  entry.has_box = true;
  if (is_stopped_) entry.kind = Unresolved::Kind::Budget;
  entry.reason = is_stopped_ ? budget_ + " before it was told whether " + diagnosis : diagnosis;
  leave_open(&entry);
  for (const Box<3>& box : hulls) {
    entry.box = box;
    add_unresolved(entry);
  }
}

/// Why a leaf has not got its certificates.
SurfaceEncaser::Diagnosis SurfaceEncaser::diagnose(int index) const {
  const SpacePartition::Leaf& leaf = partition_->leaves()[static_cast<std::size_t>(index)];
  if (const int s = leaf.without_model; s >= 0)
    return {Unresolved::Kind::NotAnalytic,
            {s},
            "the function of surface '" + result_.surfaces[static_cast<std::size_t>(s)].name +
                "' is not defined, has a pole or is not differentiable here, or nearly"};
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

UnresolvedInSpace SurfaceEncaser::why_not_certified(int index) const {
  const auto k = static_cast<std::size_t>(index);
  const SpacePartition::Leaf& leaf = partition_->leaves()[k];
  const Cell& cell = cells_[k];
  UnresolvedInSpace entry;
  entry.has_box = true;
  entry.box = leaf.box;
  if (cell.trouble) {
    entry.kind =
        *cell.trouble == Outcome::Degenerate ? Unresolved::Kind::Contact : Unresolved::Kind::Budget;
    entry.reason = cell.reason;
    for (std::size_t s = 0; s < leaf.signs.size(); ++s)
      if (leaf.signs[s] == Sign::Zero) entry.surfaces.push_back(static_cast<int>(s));
    leave_open(&entry);
    return entry;
  }
  Diagnosis diagnosis = diagnose(index);
  const double size = region_.polyhedron.bounding_box().largest_width();
  const bool at_cap = leaf.in_row || leaf.without_model >= 0 ||
                      leaf.box.largest_width() <= 2 * PartitionLimits().smallest * size;
  entry.surfaces = std::move(diagnosis.surfaces);
  entry.kind = at_cap ? diagnosis.kind : Unresolved::Kind::Budget;
  entry.reason = at_cap ? diagnosis.reason
                        : (budget_.empty() ? "the limit on cells was reached" : budget_) +
                              " before it was told whether " + diagnosis.reason;
  leave_open(&entry);
  return entry;
}

/// Reports what resists; cells that touch are one place, those in rows with the same diagnosis.
void SurfaceEncaser::report_cells() {
  std::vector<OpenCell> singles;
  std::map<std::pair<Unresolved::Kind, std::vector<int>>, std::vector<OpenCell>> rows;
  for (std::size_t k = 0; k < result_.cells.size(); ++k) {
    if (result_.cells[k].state == CellState::Certified) continue;
    const int cell = static_cast<int>(k);
    UnresolvedInSpace entry = why_not_certified(cell);
    if (partition_->leaves()[k].in_row || partition_->leaves()[k].without_model >= 0) {
      auto& row = rows[{entry.kind, entry.surfaces}];
      row.push_back({cell, std::move(entry)});
    } else {
      singles.push_back({cell, std::move(entry)});
    }
  }
  for (const auto& [diagnosis, row] : rows) report_places(row);
  report_places(singles);
}

/// One entry for all that touch. Of these, what is undecided tells the reason, else what has no
/// certificates, else what has a facet that failed.
void SurfaceEncaser::report_places(const std::vector<OpenCell>& open) {
  std::vector<Box<3>> boxes;
  for (const OpenCell& cell : open) boxes.push_back(cell.why.box);
  const auto weight = [&](std::size_t i) {
    return (open[i].why.kind == Unresolved::Kind::Budget ? 2 : 0) +
           (cells_[static_cast<std::size_t>(open[i].cell)].trouble ? 0 : 1);
  };
  const std::vector<int> cluster = clusters_of(boxes);
  std::vector<std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto c = static_cast<std::size_t>(cluster[i]);
    if (c == members.size()) members.emplace_back();
    members[c].push_back(i);
  }
  for (const std::vector<std::size_t>& place : members) {
    const std::size_t first =
        *std::max_element(place.begin(), place.end(),
                          [&](std::size_t i, std::size_t j) { return weight(i) < weight(j); });
    UnresolvedInSpace entry = open[first].why;
    std::set<int> surfaces;
    double widest = 0;
    for (const std::size_t i : place) {
      entry.box = hull(entry.box, boxes[i]);
      entry.cells.push_back(open[i].cell);
      widest = std::max(widest, boxes[i].largest_width());
      surfaces.insert(open[i].why.surfaces.begin(), open[i].why.surfaces.end());
      if (entry.kind != Unresolved::Kind::Budget)
        result_.cells[static_cast<std::size_t>(open[i].cell)].state = CellState::Degenerate;
    }
    if (partition_->leaves()[static_cast<std::size_t>(entry.cells.front())].in_row)
      entry.reason += " along a curve, which is left in " + std::to_string(place.size()) +
                      " cells at most " + decimal(widest) + " wide";
    entry.surfaces.assign(surfaces.begin(), surfaces.end());
    add_unresolved(std::move(entry));
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
