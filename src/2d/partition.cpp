// SPDX-License-Identifier: MIT
#include "2d/partition.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

constexpr int kMaxNodesOnSide = 8000;  // subdivisions a side of the region is worth
constexpr int kMaxRefinements = 80;    // of a root interval before a line is given up

/// Narrows a root's interval until it is disjoint from a vertex's enclosure; false if the curve may
/// pass through the vertex.
bool clear_of(TiledFunction& f, const Line& line, const Interval& vertex, LineRoot* root,
              Kernel& kernel) {
  if (root->hi < vertex.lo || root->lo > vertex.hi) return true;
  // Points a little off the enclosure leave the intervals open towards it.
  const double margin = 4 * vertex.width() + 0x1p-50 * std::fabs(vertex.hi) + 0x1p-1000;
  for (const double at : {vertex.lo - margin, vertex.hi + margin})
    if (!narrow_on_line(f, line, at, root, kernel)) return false;
  return root->hi < vertex.lo || root->lo > vertex.hi;
}

}  // namespace

Partition::Partition(const std::vector<FilteredFunction<2>>& curves, NestedTiles& tiles,
                     Features& features, Kernel& kernel)
    : crossings(features.crossings),
      crossing_places(features.crossing_places),
      critical_regions(features.critical_regions),
      zones(features.zones),
      saddles(features.saddles),
      curves_(curves),
      tiles_(tiles),
      kernel_(kernel) {}

bool Partition::order_on_line(const Line& line, std::vector<Cut::Root>* roots) {
  // Refine neighbours until all intervals are disjoint.
  for (int round = 0; round < kMaxRefinements; ++round) {
    std::sort(roots->begin(), roots->end(), [](const Cut::Root& a, const Cut::Root& b) {
      return a.root.lo != b.root.lo ? a.root.lo < b.root.lo : a.curve < b.curve;
    });
    bool disjoint = true;
    for (std::size_t i = 0; i + 1 < roots->size(); ++i) {
      Cut::Root &a = (*roots)[i], &b = (*roots)[i + 1];
      if (a.root.hi < b.root.lo) continue;
      if (a.root.hi == b.root.lo && a.curve == b.curve) continue;
      disjoint = false;
      for (Cut::Root* r : {&a, &b}) {
        TiledFunction& f = tiles_.about(r->curve, line, r->root.lo, r->root.hi);
        if (!refine_on_line(f, line, &r->root, kernel_)) return false;
      }
    }
    if (disjoint) return true;
  }
  return false;
}

/// Appends the roots to those found, each part of the line with the tiles that see it best.
bool Partition::isolate_in_parts(int curve, const Line& line, double from, double to,
                                 int max_nodes) {
  const auto isolate = [&](double lo, double hi) {
    TiledFunction& f = tiles_.about(curve, line, lo, hi);
    return isolate_on_line(f, line, lo, hi, max_nodes, kernel_, &found_);
  };
  stops_.clear();
  TiledFunction& whole = tiles_.about(curve, line, from, to);
  if (!tiles_.is_innermost(curve, whole)) tiles_.append_stops(curve, line, from, to, &stops_);
  if (stops_.empty()) return isolate_on_line(whole, line, from, to, max_nodes, kernel_, &found_);
  stops_.push_back(to);
  double last = from;
  bool proved = true;
  for (std::size_t k = 0; proved && k < stops_.size(); ++k) {
    proved = isolate(last, stops_[k]);
    last = stops_[k];
  }
  if (proved) return true;
  // The curve may pass through a stop.
  found_.clear();
  return isolate(from, to);
}

bool Partition::isolate_between(int curve, const Line& line, const Interval& from,
                                const Interval& to, int max_nodes, std::vector<Cut::Root>* roots) {
  found_.clear();
  if (!isolate_in_parts(curve, line, from.lo, to.hi, max_nodes)) return false;
  if (found_.empty()) return true;
  TiledFunction& f = tiles_.about(curve, line, from.lo, to.hi);
  for (LineRoot& root : found_) {
    // The vertices must be free of the curve: no root in their enclosures.
    if (!clear_of(f, line, from, &root, kernel_) || !clear_of(f, line, to, &root, kernel_) ||
        root.hi < from.hi || root.lo > to.lo)
      return false;
    roots->push_back({curve, root});
  }
  return true;
}

void Partition::add_line_crossings(int line, const std::vector<Cut::Root>& roots) {
  for (const auto& [curve, root] : roots) {
    line_crossings.push_back({line, curve, root.lo, root.hi});
    spots_.emplace_back().parameter = root.at;
  }
}

std::optional<OpenCell> Partition::open(const std::vector<Line>& sides) {
  lines = sides;
  line_crossings.clear();
  spots_.clear();
  OpenCell cell(&memory_);
  const int n = static_cast<int>(sides.size());
  for (int k = 0; k < n; ++k) {
    cell.vertices.push_back(meet(sides[(k + n - 1) % n], sides[k]));
    if (!cell.vertices.back().finite()) return std::nullopt;
  }
  std::vector<Cut::Root> roots;
  for (int k = 0; k < n; ++k) {
    const Line& side = sides[k];
    const int axis = parameter_axis(side);
    Interval from = cell.vertices[k].range(axis), to = cell.vertices[(k + 1) % n].range(axis);
    const bool ascending = from.hi < to.lo;
    if (!ascending) std::swap(from, to);
    if (!(from.hi < to.lo)) return std::nullopt;
    roots.clear();
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (!isolate_between(static_cast<int>(c), side, from, to, kMaxNodesOnSide, &roots))
        return std::nullopt;
    if (!order_on_line(side, &roots)) return std::nullopt;
    if (!ascending) std::reverse(roots.begin(), roots.end());
    for (std::size_t i = 0; i < roots.size(); ++i)
      cell.word.push_back(static_cast<int>(line_crossings.size() + i));
    add_line_crossings(k, roots);
    cell.edges.push_back({k, false, static_cast<int>(cell.word.size())});
  }
  return cell;
}

void Partition::fill(OpenCell* cell) {
  // The sides of the opened polygon are its edges' lines; their inside is negative.
  const auto all_sides = [&](auto&& holds) {
    return std::all_of(cell->edges.begin(), cell->edges.end(),
                       [&](const OpenCell::Edge& edge) { return holds(lines[edge.line]); });
  };
  crossing_places.clear();
  crossing_places.reserve(crossings.size());
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const Place& place = crossing_places.emplace_back(crossings[k].box);
    if (all_sides([&](const Line& line) { return side(line, place, kernel_) == Sign::Negative; }))
      cell->crossings.push_back(static_cast<int>(k));
    else
      crossings[k].location = Location::Outside;
  }
  for (std::size_t k = 0; k < critical_regions.size(); ++k)
    if (all_sides(
            [&](const Line& line) { return side_of(critical_regions[k], line) == Sign::Negative; }))
      cell->critical_regions.push_back(static_cast<int>(k));
  for (std::size_t k = 0; k < zones.size(); ++k)
    if (all_sides(
            [&](const Line& line) { return side(line, zones[k].box, kernel_) != Sign::Positive; }))
      cell->zones.push_back(static_cast<int>(k));
  for (std::size_t k = 0; k < saddles.size(); ++k)
    if (all_sides([&](const Line& line) { return height(line, saddles[k].at) < 0; }))
      cell->saddles.push_back(static_cast<int>(k));
}

void Partition::reserve(std::size_t cuts) {
  constexpr std::size_t kCrossingsPerCut = 3;
  lines.reserve(lines.size() + cuts);
  line_crossings.reserve(line_crossings.size() + kCrossingsPerCut * cuts);
  spots_.reserve(spots_.size() + kCrossingsPerCut * cuts);
  history.reserve(cuts);
}

void Partition::forget_cuts(const OpenCell& opened) {
  lines.resize(opened.edges.size());
  line_crossings.resize(opened.word.size());
  spots_.resize(opened.word.size());
  history.clear();
}

OpenCell Partition::begin(const Partition& whole, const OpenCell& cell) {
  OpenCell first(&memory_);
  first = cell;
  first.parent = first.sketches = -1;
  int next = 0;
  for (int k = 0; k < first.size(); ++k) {
    OpenCell::Edge& edge = first.edges[k];
    lines.push_back(whole.lines[edge.line]);
    edge.line = k;
    for (; next < edge.end; ++next) {
      const int id = cell.word[next];
      line_crossings.push_back(whole.line_crossings[id]);
      line_crossings.back().line = k;
      spots_.push_back(whole.spots_[id]);
      first.word[next] = next;
    }
  }
  return first;
}

Partition::Numbers Partition::join(const OpenCell& cell, const Partition& part, int first_cell) {
  Numbers numbers;
  numbers.lines.reserve(part.lines.size());
  numbers.line_crossings.reserve(part.line_crossings.size());
  lines.reserve(lines.size() + part.lines.size());
  line_crossings.reserve(line_crossings.size() + part.line_crossings.size());
  spots_.reserve(line_crossings.size() + part.line_crossings.size());
  history.reserve(history.size() + part.history.size());
  for (const OpenCell::Edge& edge : cell.edges) numbers.lines.push_back(edge.line);
  for (std::size_t k = cell.edges.size(); k < part.lines.size(); ++k) {
    numbers.lines.push_back(static_cast<int>(lines.size()));
    lines.push_back(part.lines[k]);
  }
  numbers.line_crossings.assign(cell.word.begin(), cell.word.end());
  for (std::size_t k = 0; k < cell.word.size(); ++k) {
    LineCrossing& c = line_crossings[cell.word[k]];
    c.lo = std::max(c.lo, part.line_crossings[k].lo);
    c.hi = std::min(c.hi, part.line_crossings[k].hi);
  }
  for (std::size_t k = cell.word.size(); k < part.line_crossings.size(); ++k) {
    numbers.line_crossings.push_back(static_cast<int>(line_crossings.size()));
    line_crossings.push_back(part.line_crossings[k]);
    line_crossings.back().line = numbers.lines[line_crossings.back().line];
    spots_.push_back(part.spots_[k]);
  }
  const int first_cut = static_cast<int>(history.size());
  const auto child = [&](int c) { return c >= 0 ? c + first_cut : ~(~c + first_cell); };
  if (cell.parent >= 0) {
    Split& above = history[cell.parent];
    (cell.positive ? above.positive : above.negative) = child(part.history.empty() ? ~0 : 0);
  }
  for (const Split& split : part.history)
    history.push_back({numbers.lines[split.line], child(split.negative), child(split.positive)});
  lines_tried += part.lines_tried;
  return numbers;
}

std::optional<int> Partition::crossings_before(const OpenCell& cell, int edge,
                                               const Interval& parameter) {
  const OpenCell::Edge& e = cell.edges[edge];
  if (cell.begin_of(edge) == e.end) return 0;
  const Line& line = lines[e.line];
  const bool ascending = parameter_grows(line, e.positive);
  int before = 0;
  for (int i = cell.begin_of(edge); i < e.end; ++i) {
    LineCrossing& c = line_crossings[cell.word[i]];
    LineRoot root{c.lo, c.hi, spots_[cell.word[i]].parameter};
    TiledFunction& f = tiles_.about(c.curve, line, c.lo, c.hi);
    if (!clear_of(f, line, parameter, &root, kernel_)) return std::nullopt;
    c.lo = root.lo;
    c.hi = root.hi;
    if ((root.hi < parameter.lo) == ascending) ++before;
  }
  return before;
}

const Partition::Spot& Partition::spot(int line_crossing) {
  Spot& spot = spots_[line_crossing];
  if (spot.known) return spot;
  const LineCrossing& c = line_crossings[line_crossing];
  const Line& line = lines[c.line];
  const int p = parameter_axis(line), q = 1 - p;
  spot.at[p] = spot.parameter;
  spot.at[q] = -(line.normal[p] * spot.parameter + line.offset) / line.normal[q];
  const auto [value, g] = value_and_gradient(tiles_.about(c.curve, {spot.at, spot.at}), spot.at);
  const double length = std::sqrt(g[0] * g[0] + g[1] * g[1]);
  if (length > 0) spot.normal = {g[0] / length, g[1] / length};
  spot.known = true;
  return spot;
}

ValueAndGradient value_and_gradient(TiledFunction& f, const Point<2>& at) {
  const Tile& tile = f.at(at);
  const Point<2> scale{1 / tile.half[0], 1 / tile.half[1]};
  const auto [value, slope_0, slope_1] = value_and_gradient(
      tile, Point<2>{(at[0] - tile.center[0]) * scale[0], (at[1] - tile.center[1]) * scale[1]});
  return {value, {slope_0 * scale[0], slope_1 * scale[1]}};
}

Box<2> bounds_of(const OpenCell& cell) {
  Box<2> bounds{cell.vertices[0].center, cell.vertices[0].center};
  for (const Place& v : cell.vertices) bounds = hull(bounds, Box<2>{v.center, v.center});
  return bounds;
}

void OpenCell::clear() {
  edges.clear();
  vertices.clear();
  word.clear();
  crossings.clear();
  critical_regions.clear();
  zones.clear();
  saddles.clear();
  earlier_cut = sketches = -1;
}

std::optional<Sign> Partition::side_of(const CriticalRegion& region, const Line& line) {
  std::optional<Sign> all;
  for (const Box<2>& box : region.boxes) {
    const auto s = side(line, Place(box), kernel_);
    if (!s || (all && *all != *s)) return std::nullopt;
    all = s;
  }
  return all;
}

void Partition::build_child(const OpenCell& cell, const Cut& cut, int first_root, OpenCell* child) {
  // From the cut on edge `begin` around to the cut on edge `end`, then back along the line.
  const bool positive = child->positive;
  const int begin = positive ? cut.out : cut.in, end = positive ? cut.in : cut.out;
  const int word_begin = positive ? cut.word_at_out : cut.word_at_in;
  const int word_end = positive ? cut.word_at_in : cut.word_at_out;
  const int n = cell.size(), word_size = static_cast<int>(cell.word.size());
  const auto word_at = [&](int place) { return cell.word.begin() + place; };
  const int count = static_cast<int>(cut.roots.size());
  child->edges.reserve(cell.edges.size() + 2);
  child->vertices.reserve(cell.vertices.size() + 2);
  child->word.reserve(cell.word.size() + cut.roots.size());
  child->vertices.push_back(positive ? cut.vertex_out : cut.vertex_in);
  int before = -word_begin;  // crossings of the child's word before the first one of the cell's
  for (int k = begin; k != end; child->vertices.push_back(cell.vertices[k])) {
    const OpenCell::Edge& edge = cell.edges[k];
    child->edges.push_back({edge.line, edge.positive, before + edge.end});
    if (++k < n) continue;
    k = 0;
    before += word_size;
  }
  const OpenCell::Edge& last = cell.edges[end];
  child->edges.push_back({last.line, last.positive, before + word_end});
  if (begin < end) {
    child->word.assign(word_at(word_begin), word_at(word_end));
  } else {
    child->word.assign(word_at(word_begin), cell.word.end());
    child->word.insert(child->word.end(), cell.word.begin(), word_at(word_end));
  }
  child->vertices.push_back(positive ? cut.vertex_in : cut.vertex_out);
  const bool ascending = parameter_grows(cut.line, positive);
  for (int i = 0; i < count; ++i)
    child->word.push_back(first_root + (ascending ? i : count - 1 - i));
  child->edges.push_back(
      {static_cast<int>(lines.size()) - 1, positive, static_cast<int>(child->word.size())});

  child->depth = cell.depth + 1;
  child->parent = static_cast<int>(history.size());
  child->crossings.resize(cell.crossings.size());
  auto next = child->crossings.begin();
  for (std::size_t i = 0; i < cell.crossings.size(); ++i) {
    *next = cell.crossings[i];
    next += (cut.positive[i] != 0) == positive;  // a branch could not be foreseen
  }
  child->crossings.erase(next, child->crossings.end());
  const int least = cut.least_cells[positive];
  child->least_cells = std::min(least, cell.least_cells);
  child->stall = least < cell.least_cells ? 0 : cell.stall + 1;
}

bool Partition::apply(const OpenCell& cell, Cut* cut, OpenCell* negative, OpenCell* positive) {
  if (!order_on_line(cut->line, &cut->roots)) return false;
  const int id = static_cast<int>(lines.size()),
            first_root = static_cast<int>(line_crossings.size());
  lines.push_back(cut->line);
  add_line_crossings(id, cut->roots);
  for (OpenCell* child : {negative, positive}) {
    child->clear();
    child->positive = child == positive;
    build_child(cell, *cut, first_root, child);
  }
  // A critical region that the line meets is inside neither child nor any cell below.
  for (const int k : cell.critical_regions)
    if (const auto s = side_of(critical_regions[k], cut->line))
      (*s == Sign::Negative ? negative : positive)->critical_regions.push_back(k);
  for (const int k : cell.zones) {
    const auto s = side(cut->line, zones[k].box, kernel_);
    if (!s || *s == Sign::Negative) negative->zones.push_back(k);
    if (!s || *s == Sign::Positive) positive->zones.push_back(k);
  }
  for (const int k : cell.saddles)
    (height(cut->line, saddles[k].at) < 0 ? negative : positive)->saddles.push_back(k);
  history.push_back({id, 0, 0});
  if (cell.parent >= 0)
    (cell.positive ? history[cell.parent].positive : history[cell.parent].negative) =
        static_cast<int>(history.size()) - 1;
  return true;
}

}  // namespace encase
