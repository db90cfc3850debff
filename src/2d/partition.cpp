// SPDX-License-Identifier: MIT
#include "2d/partition.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

constexpr int kMaxNodes = 400;       // subdivisions a restriction to a line is worth
constexpr int kMaxRefinements = 80;  // of a root interval before a line is given up

bool finite(const std::array<Interval, 2>& at) {
  return std::isfinite(at[0].lo) && std::isfinite(at[0].hi) && std::isfinite(at[1].lo) &&
         std::isfinite(at[1].hi);
}

/// Narrows a root's interval until it is disjoint from a vertex's enclosure; false if the curve may
/// pass through the vertex.
bool clear_of(const FilteredPolynomial<2>& f, const Line& line, const Interval& vertex,
              RootInterval* root, Kernel& kernel) {
  // Points a little off the enclosure leave the intervals open towards it.
  const double margin = 4 * vertex.width() + 0x1p-50 * std::fabs(vertex.hi) + 0x1p-1000;
  for (const double at : {vertex.lo - margin, vertex.hi + margin})
    if (!narrow_on_line(f, line, at, root, kernel)) return false;
  return root->hi < vertex.lo || root->lo > vertex.hi;
}

}  // namespace

Partition::Partition(const std::vector<FilteredPolynomial<2>>& curves, Kernel& kernel)
    : curves_(curves), kernel_(kernel) {
  for (const FilteredPolynomial<2>& f : curves)
    partials_.push_back({FilteredPolynomial<2>(f.exact().derivative(0)),
                         FilteredPolynomial<2>(f.exact().derivative(1))});
}

bool Partition::order_on_line(const Line& line, std::vector<Cut::Root>* roots) {
  // Refine neighbours until all intervals are disjoint.
  for (int round = 0; round < kMaxRefinements; ++round) {
    std::sort(roots->begin(), roots->end(), [](const Cut::Root& a, const Cut::Root& b) {
      return a.interval.lo != b.interval.lo ? a.interval.lo < b.interval.lo : a.curve < b.curve;
    });
    bool disjoint = true;
    for (std::size_t i = 0; i + 1 < roots->size(); ++i) {
      Cut::Root &a = (*roots)[i], &b = (*roots)[i + 1];
      if (a.interval.hi < b.interval.lo) continue;
      if (a.interval.hi == b.interval.lo && a.curve == b.curve) continue;
      disjoint = false;
      for (Cut::Root* r : {&a, &b})
        if (!refine_on_line(curves_[r->curve], line, &r->interval, kernel_)) return false;
    }
    if (disjoint) return true;
  }
  return false;
}

std::optional<OpenCell> Partition::open(const std::vector<Line>& sides) {
  lines = sides;
  side_count_ = static_cast<int>(sides.size());
  line_crossings.clear();
  spots_.clear();
  OpenCell cell;
  const int n = static_cast<int>(sides.size());
  for (int k = 0; k < n; ++k) {
    cell.vertices.push_back(meet(sides[(k + n - 1) % n], sides[k]));
    if (!finite(cell.vertices.back())) return std::nullopt;
  }
  for (int k = 0; k < n; ++k) {
    const Line& side = sides[k];
    const int axis = parameter_axis(side);
    Interval from = cell.vertices[k][axis], to = cell.vertices[(k + 1) % n][axis];
    const bool ascending = from.hi < to.lo;
    if (!ascending) std::swap(from, to);
    if (!(from.hi < to.lo)) return std::nullopt;
    std::vector<Cut::Root> roots;
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const auto found = isolate_on_line(curves_[c], side, from.lo, to.hi, 20 * kMaxNodes, kernel_);
      if (!found) return std::nullopt;
      for (RootInterval root : *found) {
        if (!clear_of(curves_[c], side, from, &root, kernel_) ||
            !clear_of(curves_[c], side, to, &root, kernel_) || root.hi < from.hi || root.lo > to.lo)
          return std::nullopt;
        roots.push_back({static_cast<int>(c), root});
      }
    }
    if (!order_on_line(side, &roots)) return std::nullopt;
    if (!ascending) std::reverse(roots.begin(), roots.end());
    OpenCell::Edge edge;
    edge.line = k;
    for (const Cut::Root& root : roots) {
      edge.crossings.push_back(static_cast<int>(line_crossings.size()));
      line_crossings.push_back({k, root.curve, root.interval.lo, root.interval.hi});
    }
    cell.edges.push_back(std::move(edge));
  }
  return cell;
}

std::optional<int> Partition::crossings_before(const OpenCell& cell, int edge,
                                               const Interval& parameter) {
  const OpenCell::Edge& e = cell.edges[edge];
  const Line& line = lines[e.line];
  const bool ascending = parameter_grows(line, e.positive);
  int before = 0;
  for (const int id : e.crossings) {
    LineCrossing& c = line_crossings[id];
    RootInterval root{c.lo, c.hi};
    if (!clear_of(curves_[c.curve], line, parameter, &root, kernel_)) return std::nullopt;
    c.lo = root.lo;
    c.hi = root.hi;
    if ((root.hi < parameter.lo) == ascending) ++before;
  }
  return before;
}

std::vector<int> Partition::crossing_counts(const OpenCell& cell) const {
  std::vector<int> counts(curves_.size(), 0);
  for (const auto& edge : cell.edges)
    for (const int id : edge.crossings) ++counts[line_crossings[id].curve];
  return counts;
}

std::vector<int> Partition::alive(const OpenCell& cell) const {
  std::vector<int> counts = crossing_counts(cell), result;
  if (!cell.zones.empty()) counts.assign(counts.size(), 1);
  for (const int k : cell.critical_regions) ++counts[critical_regions[k].curve];
  for (std::size_t c = 0; c < counts.size(); ++c)
    if (counts[c] > 0) result.push_back(static_cast<int>(c));
  return result;
}

std::vector<int> Partition::word(const OpenCell& cell) const {
  std::vector<int> result;
  for (const auto& edge : cell.edges)
    result.insert(result.end(), edge.crossings.begin(), edge.crossings.end());
  return result;
}

const Partition::Spot& Partition::spot(int line_crossing) {
  while (static_cast<int>(spots_.size()) <= line_crossing) {
    const LineCrossing& c = line_crossings[spots_.size()];
    const FilteredPolynomial<2>& f = curves_[c.curve];
    const Line& line = lines[c.line];
    const int p = parameter_axis(line), q = 1 - p;
    const auto point = [&](double t) {
      Point<2> at;
      at[p] = t;
      at[q] = -(line.normal[p] * t + line.offset) / line.normal[q];
      return at;
    };
    // The Illinois variant of the secant method.
    double lo = c.lo, hi = c.hi, at_lo = f.approximate(point(lo)), at_hi = f.approximate(point(hi));
    double t = lo + 0.5 * (hi - lo);
    for (int i = 0, last = 0; i < 12 && hi - lo > 1e-9 * (c.hi - c.lo); ++i) {
      t = lo - at_lo * (hi - lo) / (at_hi - at_lo);
      if (!(t > lo && t < hi)) t = lo + 0.5 * (hi - lo);
      const double value = f.approximate(point(t));
      if (value == 0 || std::fabs(value) < 1e-7 * std::fabs(at_hi - at_lo)) break;
      if ((value > 0) == (at_lo > 0)) {
        lo = t;
        at_lo = value;
        if (last == -1) at_hi *= 0.5;
        last = -1;
      } else {
        hi = t;
        at_hi = value;
        if (last == 1) at_lo *= 0.5;
        last = 1;
      }
    }
    const Point<2> at = point(t), g = f.gradient(at);
    const double length = std::hypot(g[0], g[1]);
    spots_.push_back({at, length > 0 ? Point<2>{g[0] / length, g[1] / length} : Point<2>{0, 0}});
  }
  return spots_[line_crossing];
}

double Partition::estimate(const std::vector<int>& counts, const std::vector<int>& inside) const {
  // Every crossing needs a cell of its own, and every branch that no crossing of its curve lies on.
  double total = static_cast<double>(inside.size());
  for (std::size_t c = 0; c < counts.size(); ++c) {
    const int branches = (counts[c] + 1) / 2;
    const bool crossed = std::any_of(inside.begin(), inside.end(), [&](int k) {
      return crossings[k].curves[0] == static_cast<int>(c) ||
             crossings[k].curves[1] == static_cast<int>(c);
    });
    total += std::max(0, branches - (crossed ? 1 : 0));
  }
  return std::max(1.0, total);
}

bool Partition::inside(const CriticalRegion& region) {
  // The sides come first among the lines; their inside is negative.
  for (int k = 0; k < side_count_; ++k)
    for (const auto& box : region.boxes)
      if (side(lines[k], box, kernel_) != Sign::Negative) return false;
  return true;
}

bool parameter_grows(const Line& line, bool positive) {
  // With the inside to the left, the direction is (-b, a) on the negative side of a x + b y + c.
  const double along = parameter_axis(line) == 0 ? -line.normal[1] : line.normal[0];
  return (along > 0) != positive;
}

std::optional<Cut> Partition::try_line(const OpenCell& cell, const Line& line, double enough) {
  ++lines_tried;
  const double size = std::fabs(line.normal[0]) + std::fabs(line.normal[1]);
  if (!(size > 1e-100 && size < 1e100) || !std::isfinite(line.offset)) return std::nullopt;
  Cut cut;
  cut.line = line;
  const int n = static_cast<int>(cell.edges.size());

  // The vertices' sides; distances relative to the cell for the score.
  thread_local std::vector<int> sides;
  sides.resize(n);
  const double length = std::hypot(line.normal[0], line.normal[1]);
  double nearest = HUGE_VAL, farthest = 0;
  for (int k = 0; k < n; ++k) {
    const Interval d = Interval(line.normal[0]) * cell.vertices[k][0] +
                       Interval(line.normal[1]) * cell.vertices[k][1] + Interval(line.offset);
    const auto s = d.sign();
    if (!s || *s == Sign::Zero) return std::nullopt;
    sides[k] = static_cast<int>(*s);
    nearest = std::min(nearest, std::fabs(d.mid()) / length);
    farthest = std::max(farthest, std::fabs(d.mid()) / length);
  }
  for (int k = 0; k < n; ++k) {
    if (sides[k] < 0 && sides[(k + 1) % n] > 0) cut.out = k;
    if (sides[k] > 0 && sides[(k + 1) % n] < 0) cut.in = k;
  }
  if (cut.out < 0 || cut.in < 0) return std::nullopt;
  double extent = 0;
  for (int k = 0; k < n; ++k) {
    const auto a = middle(cell.vertices[k]), b = middle(cell.vertices[0]);
    extent = std::max(extent, std::hypot(a[0] - b[0], a[1] - b[1]));
  }
  double clearance = nearest;

  // Crossing boxes and zones must lie on one side.
  for (const int id : cell.crossings) {
    const auto s = side(line, crossings[id].box, kernel_);
    if (!s) return std::nullopt;
    cut.crossings[*s == Sign::Positive].push_back(id);
    const Point<2>& p = crossings[id].point;
    clearance = std::min(
        clearance, std::fabs(line.normal[0] * p[0] + line.normal[1] * p[1] + line.offset) / length);
  }
  for (const int id : cell.zones)
    if (!side(line, zones[id].box, kernel_)) return std::nullopt;

  // Old crossings on both sides, and a bound on the score before anything is restricted.
  cut.vertex_out = meet(line, lines[cell.edges[cut.out].line]);
  cut.vertex_in = meet(line, lines[cell.edges[cut.in].line]);
  if (!finite(cut.vertex_out) || !finite(cut.vertex_in)) return std::nullopt;
  const auto before_out = crossings_before(
      cell, cut.out, cut.vertex_out[parameter_axis(lines[cell.edges[cut.out].line])]);
  const auto before_in =
      crossings_before(cell, cut.in, cut.vertex_in[parameter_axis(lines[cell.edges[cut.in].line])]);
  if (!before_out || !before_in) return std::nullopt;
  cut.before_out = *before_out;
  cut.before_in = *before_in;
  for (auto& counts : cut.counts) counts.assign(curves_.size(), 0);
  for (int k = 0; k < n; ++k) {
    const auto& list = cell.edges[k].crossings;
    for (int i = 0; i < static_cast<int>(list.size()); ++i) {
      const bool positive = k == cut.out  ? i >= cut.before_out
                            : k == cut.in ? i < cut.before_in
                                          : sides[k] > 0;
      ++cut.counts[positive][line_crossings[list[i]].curve];
    }
  }
  const double slivers =
      0.15 * std::max(0.0, std::log10(0.03 / std::max(1e-12, clearance / extent)));
  const auto score = [&] {
    const double a = estimate(cut.counts[0], cut.crossings[0]);
    const double b = estimate(cut.counts[1], cut.crossings[1]);
    return a + b + slivers - 0.05 * std::min(a, b) / (a + b);
  };
  if (score() > enough) return std::nullopt;

  // The curves alive on the chord.
  const int axis = parameter_axis(line);
  Interval from = cut.vertex_out[axis], to = cut.vertex_in[axis];
  if (!(from.hi < to.lo)) std::swap(from, to);
  if (!(from.hi < to.lo)) return std::nullopt;
  for (const int c : alive(cell)) {
    const auto found = isolate_on_line(curves_[c], line, from.lo, to.hi, kMaxNodes, kernel_);
    if (!found) return std::nullopt;
    for (RootInterval root : *found) {
      // The new vertices must be free of the curve: no root in their enclosures.
      if (!clear_of(curves_[c], line, from, &root, kernel_) ||
          !clear_of(curves_[c], line, to, &root, kernel_) || root.hi < from.hi || root.lo > to.lo)
        return std::nullopt;
      cut.roots.push_back({c, root});
      ++cut.counts[0][c];
      ++cut.counts[1][c];
    }
    // A curve enters a cell as often as it leaves it: a free check of all the above.
    if (cut.counts[0][c] % 2 != 0 || cut.counts[1][c] % 2 != 0) return std::nullopt;
    if (score() > enough) return std::nullopt;
  }
  cut.score = score();
  return cut;
}

bool Partition::apply(const OpenCell& cell, Cut cut, OpenCell* negative, OpenCell* positive) {
  if (!order_on_line(cut.line, &cut.roots)) return false;
  const int n = static_cast<int>(cell.edges.size());
  const int id = static_cast<int>(lines.size());
  lines.push_back(cut.line);
  const int first = static_cast<int>(line_crossings.size());
  for (const Cut::Root& root : cut.roots)
    line_crossings.push_back({id, root.curve, root.interval.lo, root.interval.hi});

  // From the cut on edge `begin` around to the cut on edge `end`, then back along the line.
  const auto build = [&](OpenCell* child, int begin, int skip, const std::array<Interval, 2>& start,
                         int end, int keep, const std::array<Interval, 2>& stop) {
    *child = OpenCell{};
    child->vertices.push_back(start);
    OpenCell::Edge first_part = cell.edges[begin];
    first_part.crossings.erase(first_part.crossings.begin(), first_part.crossings.begin() + skip);
    child->edges.push_back(std::move(first_part));
    for (int k = (begin + 1) % n; k != end; k = (k + 1) % n) {
      child->vertices.push_back(cell.vertices[k]);
      child->edges.push_back(cell.edges[k]);
    }
    OpenCell::Edge last_part = cell.edges[end];
    last_part.crossings.resize(keep);
    child->vertices.push_back(cell.vertices[end]);
    child->edges.push_back(std::move(last_part));
    child->vertices.push_back(stop);
    OpenCell::Edge edge;
    edge.line = id;
    edge.positive = child == positive;
    for (std::size_t i = 0; i < cut.roots.size(); ++i)
      edge.crossings.push_back(first + static_cast<int>(i));
    if (!parameter_grows(cut.line, edge.positive))
      std::reverse(edge.crossings.begin(), edge.crossings.end());
    child->edges.push_back(std::move(edge));
    child->depth = cell.depth + 1;
    child->parent = static_cast<int>(history.size());
  };
  build(negative, cut.in, cut.before_in, cut.vertex_in, cut.out, cut.before_out, cut.vertex_out);
  build(positive, cut.out, cut.before_out, cut.vertex_out, cut.in, cut.before_in, cut.vertex_in);
  positive->positive = true;
  negative->crossings = std::move(cut.crossings[0]);
  positive->crossings = std::move(cut.crossings[1]);
  for (const int k : cell.critical_regions) {
    // A region that the line meets is inside neither child nor any cell below.
    std::optional<Sign> all;
    bool cut_through = false;
    for (const auto& box : critical_regions[k].boxes) {
      const auto s = side(cut.line, box, kernel_);
      if (!s || (all && *all != *s)) {
        cut_through = true;
        break;
      }
      all = s;
    }
    if (!cut_through) (*all == Sign::Negative ? negative : positive)->critical_regions.push_back(k);
  }
  for (const int k : cell.zones) {
    const auto s = side(cut.line, zones[k].box, kernel_);
    if (!s || *s == Sign::Negative) negative->zones.push_back(k);
    if (!s || *s == Sign::Positive) positive->zones.push_back(k);
  }
  for (OpenCell* child : {negative, positive}) {
    const double e = estimate(cut.counts[child == positive], child->crossings);
    child->least_estimate = std::min(e, cell.least_estimate);
    child->stall = e < cell.least_estimate ? 0 : cell.stall + 1;
  }
  history.push_back({id, 0, 0});
  if (cell.parent >= 0)
    (cell.positive ? history[cell.parent].positive : history[cell.parent].negative) =
        static_cast<int>(history.size()) - 1;
  return true;
}

}  // namespace encase
