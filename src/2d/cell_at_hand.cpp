// SPDX-License-Identifier: MIT
#include "2d/cell_at_hand.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "common/sketch.hpp"
#include "common/tile_samples.hpp"

namespace encase {
namespace {

constexpr int kMaxNodes = 400;  // subdivisions that a chord is worth

// How many cells a cell becomes, fitted to what cells of random curves became: about kPerCrossing
// for each crossing inside and kPerBranch for each branch; more for a branch that probably no
// crossing lies on; and fewer in large cells, whose branches inside are shared by more crossings.
// What all parts of a cell have in common (kPerCrossing) has no influence; that a cell without
// crossings counts more than its share leaves lines that finish a crossing's cell preferred.
constexpr double kPerCrossing = 1.8;
constexpr double kPerBranch = 0.8;
constexpr double kPerUncrossedBranch = 1.4;
constexpr double kPerRootOfCrossings = -2;
constexpr double kWithCrossings = -1.8;
constexpr double kFinishedCrossing = -0.4;
constexpr double kFinishedBranch = 1;
constexpr double kEmpty = 1.5;
constexpr double kFurtherBranchOfOneCurve = 1.4;
constexpr double kFurtherBranchOfCurves = 1.7;

// What a line is worth besides.
constexpr double kSliver = 0.045;  // for each halving of the distance to what is closest
constexpr double kBalance = 0.05;
constexpr double kTie = 1e-9;

constexpr std::size_t kFewCurves = 2;  // the single branches of which are looked at in full
constexpr int kMostGroups = 80;        // of marks, that are worth bits of their own

// How much larger than the cell the box of its sketches may be: on average, and one side of it.
constexpr double kLarger = 2.5, kMostLarger = 64;

/// About log2(x), for normal x > 0: exact at powers of two, linear between.
double rough_logarithm(double x) {
  constexpr double kUnit = 0x1p-52;  // of the exponent
  return static_cast<double>(std::bit_cast<std::int64_t>(x)) * kUnit - 1023;
}

/// What a number of crossings inside adds to the cells to be expected.
double cells_for_crossings(int crossings) {
  return kPerCrossing * crossings + kPerRootOfCrossings * std::sqrt(crossings) + kWithCrossings;
}

/// If `crossings` crossings fall on `branches` branches at random: how many branches get none.
double uncrossed(int branches, int crossings) {
  return branches * std::pow(1 - 1.0 / branches, crossings);
}

/// The branches of a curve in a part, or at least so many while it is not known where a line
/// crosses the curve: one if the curve has crossings there.
int branches_in_part(int ends, int crossings) {
  return std::max<int>(crossings > 0, (ends + 1) >> 1);
}

Branches branches_of_curve(int ends, int crossings) {
  const int count = branches_in_part(ends, crossings);
  if (count == 0) return {};
  return {1, count, kPerBranch * count + kPerUncrossedBranch * uncrossed(count, crossings)};
}

void add(const Branches& more, Branches* all) {
  all->curves += more.curves;
  all->count += more.count;
  all->cells += more.cells;
}

void remove(const Branches& less, Branches* all) {
  all->curves -= less.curves;
  all->count -= less.count;
  all->cells -= less.cells;
}

bool is_among(const Line& line, const std::vector<Line>& lines) {
  return std::any_of(lines.begin(), lines.end(), [&](const Line& other) {
    return line.normal == other.normal && line.offset == other.offset;
  });
}

struct Expectations {
  static constexpr int kCrossings = 64, kEnds = 32;  // in tables

  Expectations() {
    for (int r = 0; r < kCrossings; ++r) {
      crossings[r] = cells_for_crossings(r);
      for (int e = 0; e < kEnds; ++e) branches[r][e] = branches_of_curve(e, r);
    }
  }
  double for_crossings(int r) const {
    return r < kCrossings ? crossings[r] : cells_for_crossings(r);
  }
  Branches of_curve(int ends, int r) const {
    return ends < kEnds && r < kCrossings ? branches[r][ends] : branches_of_curve(ends, r);
  }

  std::array<double, kCrossings> crossings;
  std::array<std::array<Branches, kEnds>, kCrossings> branches;
};
const Expectations expectations;

}  // namespace

CellAtHand::CellAtHand(Partition& partition) : partition_(partition) {
  slot_.resize(partition.curves().size(), -1);
}

void CellAtHand::take(const OpenCell& cell) {
  cell_ = &cell;
  avoided_ = nullptr;
  start_again();
  find_curves();
  points_.clear();
  is_prepared_ = false;
}

/// The curves that may meet the cell, and their slots. (Of many curves few do: nothing is done for
/// the others.)
void CellAtHand::find_curves() {
  for (const Presence& p : curves_) slot_[p.curve] = -1;
  curves_.clear();
  const auto note = [&](int curve) {
    int& slot = slot_[curve];
    if (slot < 0) {
      slot = static_cast<int>(curves_.size());
      curves_.push_back({curve, 0, 0});
    }
    return slot;
  };
  for (const int id : cell_->word) ++curves_[note(partition_.line_crossings[id].curve)].ends;
  for (const int k : cell_->critical_regions) note(partition_.critical_regions[k].curve);
  if (!cell_->zones.empty())
    for (std::size_t c = 0; c < slot_.size(); ++c) note(static_cast<int>(c));
  std::sort(curves_.begin(), curves_.end(),
            [](const Presence& a, const Presence& b) { return a.curve < b.curve; });
  for (std::size_t s = 0; s < curves_.size(); ++s) slot_[curves_[s].curve] = static_cast<int>(s);
}

void CellAtHand::find_crossings() {
  crossings_.clear();
  for (const int id : cell_->crossings) {
    const Crossing& crossing = partition_.crossings[id];
    // Curves that cross in the cell without crossing its boundary are present by their loops,
    // unless a splitting line has met the critical region: then they count for nothing.
    const std::array<int, 2> slots{slot_[crossing.curves[0]], slot_[crossing.curves[1]]};
    crossings_.push_back({&partition_.crossing_places[id], slots});
    for (const int s : slots)
      if (s >= 0) ++curves_[s].crossings;
  }
}

/// What is needed to weigh lines, once for every cell that is cut.
void CellAtHand::prepare() {
  if (is_prepared_) return;
  is_prepared_ = true;
  find_crossings();
  Branches all;
  for (const Presence& p : curves_) add(expectations.of_curve(p.ends, p.crossings), &all);
  expected_cells_ = expected_cells(static_cast<int>(crossings_.size()), all);
  shares_.resize(curves_.size());
  mark();
  bounds_ = bounds_of(*cell_);
  extent_ = std::sqrt(bounds_.width(0) * bounds_.width(0) + bounds_.width(1) * bounds_.width(1));
  provide_sketches();
}

/// Takes over the sketches of an ancestor unless the cell has become much smaller. Cells are worked
/// on depth first: what was made for an ancestor is still there.
void CellAtHand::provide_sketches() {
  const auto is_far_larger = [&](const Box<2>& box) {
    const double x = box.width(0) / bounds_.width(0), y = box.width(1) / bounds_.width(1);
    return std::max(x, y) > kMostLarger || x * y > kLarger * kLarger;
  };
  const std::vector<Presence>& here = curves_;
  sketch_of_slot_.resize(here.size());
  last_sketches_ = cell_->sketches;
  if (last_sketches_ >= 0 && sketches_[last_sketches_].serve &&
      !is_far_larger(sketches_[last_sketches_].box)) {
    // The curves of a cell are among those of its ancestors, and both lists ascend.
    const std::vector<int>& known = sketches_[last_sketches_].curves;
    std::size_t k = 0;
    for (std::size_t s = 0; s < here.size(); ++s) {
      while (known[k] != here[s].curve) ++k;
      sketch_of_slot_[s] = static_cast<int>(k);
    }
    return;
  }
  if (++last_sketches_ == static_cast<int>(sketches_.size())) sketches_.emplace_back();
  Sketches& made = sketches_[last_sketches_];
  made.box = bounds_;
  made.serve = true;
  made.curves.clear();
  for (const Presence& p : here) made.curves.push_back(p.curve);
  made.states.assign(here.size(), Sketches::State::Missing);
  if (made.sketches.size() < here.size()) made.sketches.resize(here.size());
  std::iota(sketch_of_slot_.begin(), sketch_of_slot_.end(), 0);
}

/// A curve's polynomial about the cell, or null if it has no sketch.
const Sketch* CellAtHand::sketch(int slot) {
  Sketches& all = sketches_[last_sketches_];
  const auto k = static_cast<std::size_t>(sketch_of_slot_[static_cast<std::size_t>(slot)]);
  if (all.states[k] == Sketches::State::Missing) {
    const bool serves =
        make_sketch(partition_.tiles().about(all.curves[k], all.box), all.box, &all.sketches[k]);
    all.states[k] = serves ? Sketches::State::Serves : Sketches::State::Useless;
    all.serve = all.serve && serves;
  }
  return all.states[k] == Sketches::State::Serves ? &all.sketches[k] : nullptr;
}

void CellAtHand::find_points() {
  for (Presence& p : curves_) p.ends = 0;  // counted again, for the indices
  for (const int id : cell_->word) {
    const int c = partition_.line_crossings[id].curve;
    const Partition::Spot& spot = partition_.spot(id);
    points_.push_back({c, curves_[slot_[c]].ends++, spot.at, spot.normal});
  }
}

void CellAtHand::mark() {
  const int groups = 1 + 2 * static_cast<int>(curves_.size());
  has_all_groups_ = groups <= kMostGroups;
  first_crossing_mark_ = cell_->size();
  near_marks_ = (first_crossing_mark_ + static_cast<int>(crossings_.size()) + 7) / 8 * 8;
  marks_.reset(has_all_groups_ ? groups : 1, near_marks_ + static_cast<int>(points().size()),
               cell_->vertices[0].center);
  int k = 0;
  for (const Place& vertex : cell_->vertices) marks_.place(k++, vertex.center);
  for (const InnerCrossing& crossing : crossings_) {
    marks_.place(k, crossing.place->center);
    marks_.join(0, k);
    if (has_all_groups_)
      for (const int s : crossing.slots)
        if (s >= 0) marks_.join(1 + 2 * s, k);
    ++k;
  }
  k = near_marks_;
  for (const BoundaryPoint& point : points_) {
    marks_.place(k, point.at);
    if (has_all_groups_) marks_.join(2 + 2 * slot_[point.curve], k);
    ++k;
  }
  heights_.resize(near_marks_);
  positive_.resize(groups);
}

/// Counts the marks on the positive side of a line, and returns how close it comes to a near one.
double CellAtHand::divide_marks(const Line& line) {
  const double least = divide(marks_, line, near_marks_, heights_.data(), positive_.data());
  if (has_all_groups_) return least;
  std::fill(positive_.begin() + 1, positive_.end(), 0);
  const double* of_crossings = &heights_[first_crossing_mark_];
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    if (!(of_crossings[i] > 0)) continue;
    for (const int s : crossings_[i].slots)
      if (s >= 0) ++positive_[1 + 2 * s];
  }
  for (const BoundaryPoint& point : points_)
    if (height(line, point.at) > 0) ++positive_[2 + 2 * slot_[point.curve]];
  return least;
}

bool CellAtHand::is_simple(int part) const {
  int branches = 0;
  for (const Shares& curve : shares_) {
    if (curve.ends[part] > 2) return false;
    branches += curve.ends[part] > 0;
  }
  return branches <= 1 || (branches == 2 && crossings_in_[part] == 1);
}

double CellAtHand::expected_cells(int crossings, const Branches& branches) {
  if (crossings > 1) return expectations.for_crossings(crossings) + branches.cells;
  if (crossings == 0) {
    if (branches.count == 0) return kEmpty;
    const double further = branches.curves == 1 ? kFurtherBranchOfOneCurve : kFurtherBranchOfCurves;
    return kFinishedBranch + further * (branches.count - 1);
  }
  return branches.count == 2 ? kFinishedCrossing : expectations.for_crossings(1) + branches.cells;
}

int CellAtHand::least_cells(int part) const {
  // Every crossing needs a cell of its own, and every branch that no crossing of its curve lies on.
  int total = crossings_in_[part];
  for (const Shares& curve : shares_) {
    const int crossings = curve.crossings[part];
    total += branches_in_part(curve.ends[part], crossings) - (crossings > 0 ? 1 : 0);
  }
  return std::max(1, total);
}

double CellAtHand::score() const {
  const double negative = expected_cells(crossings_in_[0], branches_[0]),
               positive = expected_cells(crossings_in_[1], branches_[1]);
  return negative + positive + slivers_ -
         kBalance * std::min(negative, positive) / (negative + positive);
}

void CellAtHand::count_branches() {
  for (int k = 0; k < 2; ++k) {
    Branches all;
    for (const Shares& curve : shares_)
      add(expectations.of_curve(curve.ends[k], curve.crossings[k]), &all);
    branches_[k] = all;
  }
}

/// The curve of a slot has so many roots on the line.
void CellAtHand::add_roots(std::size_t slot, int roots) {
  Shares& curve = shares_[slot];
  for (int k = 0; k < 2; ++k) {
    remove(expectations.of_curve(curve.ends[k], curve.crossings[k]), &branches_[k]);
    curve.ends[k] += roots;
    add(expectations.of_curve(curve.ends[k], curve.crossings[k]), &branches_[k]);
  }
}

/// Whether the line cannot become better than the best. Counts only grow, so this may be asked
/// before all curves are restricted to it.
bool CellAtHand::is_beaten(double score) const {
  return has_cut_ && !(score < best_->score - kTie);
}

void CellAtHand::set_slivers(const Line& line, double clearance) {
  const Point<2>& normal = line.normal;
  const double square = normal[0] * normal[0] + normal[1] * normal[1];
  const double part = clearance * clearance / (square * extent_ * extent_);
  slivers_ = kSliver * std::max(0.0, -5 - 0.5 * rough_logarithm(std::max(0x1p-80, part)));
}

/// Where a line meets the boundary, about, given the heights of the vertices; false if it seems to
/// miss the cell.
bool CellAtHand::guess_chord(const double* heights, std::array<Point<2>, 2>* ends) const {
  const auto& vertices = cell_->vertices;
  const int n = cell_->size();
  // Which sides the vertices are on cannot be foreseen: without branches.
  std::array<int, 3>
      crossed{};  // edges, by the vertices that they lead to; the last ones do not count
  int count = 0;
  bool was_positive = heights[n - 1] > 0;
  for (int k = 0; k < n; ++k) {
    const bool is_positive = heights[k] > 0;
    crossed[std::min(count, 2)] = k;
    count += is_positive != was_positive;
    was_positive = is_positive;
  }
  if (count != 2) return false;
  for (int i = 0; i < 2; ++i) {
    const int k = crossed[i], last = k > 0 ? k - 1 : n - 1;
    const double w = heights[last] / (heights[last] - heights[k]);
    const Point<2>&a = vertices[last].center, &b = vertices[k].center;
    (*ends)[i] = {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1])};
  }
  return true;
}

/// Counts what seems to be on either side, given how many marks of each group are on the positive
/// one.
void CellAtHand::guess_division(const int* positive) {
  crossings_in_ = {static_cast<int>(crossings_.size()) - positive[0], positive[0]};
  for (std::size_t s = 0; s < curves_.size(); ++s) {
    const int crossings = positive[1 + 2 * s], ends = positive[2 + 2 * s];
    shares_[s] = {{curves_[s].ends - ends, ends}, {curves_[s].crossings - crossings, crossings}};
  }
  count_branches();
}

void CellAtHand::values_and_gradients(const std::array<BoundaryPoint, 16>& points,
                                      std::array<ValueAndGradient, 16>* result) {
  std::uint32_t left = 0xffff;
  while (left != 0) {
    const int curve = points[std::countr_zero(left)].curve;
    const Sketch* f = sketch(slot_[curve]);
    SketchSlopes at_points;
    if (f) {
      alignas(64) Sketch::Lanes s, t;
      for (std::size_t k = 0; k < points.size(); ++k) {
        s[k] = (points[k].at[0] - f->center[0]) * f->scale[0];
        t[k] = (points[k].at[1] - f->center[1]) * f->scale[1];
      }
      slopes(*f, s, t, &at_points);
    }
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (points[k].curve != curve) continue;
      left &= ~(1u << k);
      if (f)
        (*result)[k] = {at_points.value[k],
                        {at_points.s[k] * f->scale[0], at_points.t[k] * f->scale[1]}};
      else
        (*result)[k] = value_and_gradient(partition_.tiles().whole(curve), points[k].at);
    }
  }
}

/// The number of roots that a curve seems to have on a chord.
int CellAtHand::guess_roots_of(int slot, const std::array<Point<2>, 2>& ends) {
  const int old = shares_[slot].ends[0];
  if (curves_.size() > kFewCurves && curves_[slot].ends == 2) {
    // A branch, a short one as a rule: it goes where its crossings are, and nowhere else.
    if (old == 1) return 1;
    return shares_[slot].crossings[old == 0 ? 0 : 1] > 0 ? 2 : 0;
  }
  const Sketch* f = sketch(slot);
  const int roots = f ? count_sign_changes(*f, ends[0], ends[1])
                      : count_sign_changes(partition_.tiles().about(curves_[slot].curve, bounds_),
                                           ends[0], ends[1]);
  // A curve enters a cell as often as it leaves it.
  return roots + (roots + old) % 2;
}

/// Adds the roots that the curves seem to have on a chord, and returns the score; stops once that
/// reaches the limit.
double CellAtHand::guess_roots(const std::array<Point<2>, 2>& ends, double limit) {
  double reached = score();
  for (std::size_t s = 0; s < curves_.size() && reached < limit; ++s) {
    const int roots = guess_roots_of(static_cast<int>(s), ends);
    if (roots == 0) continue;
    add_roots(s, roots);
    reached = score();
  }
  return reached;
}

/// Guesses the score of a line; false if it seems not to cut the cell. The roots on the line are
/// left out where the score reaches the limit without them.
bool CellAtHand::weigh(double limit, Proposal* proposal) {
  const Line& line = proposal->line;
  const double square = line.normal[0] * line.normal[0] + line.normal[1] * line.normal[1];
  if (!(square > 1e-200 && square < 1e200) || !std::isfinite(line.offset)) return false;
  const double clearance = divide_marks(line);
  std::array<Point<2>, 2> ends;
  if (!guess_chord(heights_.data(), &ends)) return false;
  guess_division(positive_.data());
  set_slivers(line, clearance);
  proposal->score = guess_roots(ends, limit);
  proposal->sampled = proposal->score < limit;
  return true;
}

void CellAtHand::propose(const Line& line) {
  ++partition_.lines_tried;
  if (avoided_ && is_among(line, *avoided_)) return;
  prepare();
  Proposal proposal{line, 0, false};
  if (!weigh(best_score_ - kTie, &proposal)) return;
  proposals_.push_back(proposal);
  if (!proposal.sampled) return;
  best_score_ = proposal.score;
  seems_finished_ = leaves_simple_parts();
}

void CellAtHand::start_again() {
  proposals_.clear();
  best_score_ = HUGE_VAL;
  seems_finished_ = has_cut_ = false;
}

/// The edges where the line enters and leaves, and how close it comes to a vertex.
bool CellAtHand::cross_boundary(const Line& line, double* clearance) {
  const int n = cell_->size();
  sides_.resize(n);
  for (int k = 0; k < n; ++k) {
    const Place& vertex = cell_->vertices[k];
    const LineValue at = value_at(line, vertex);
    if (std::fabs(at.value) > at.error) {
      sides_[k] = at.value > 0;
    } else {
      const auto s = side(line, vertex.box, partition_.kernel());
      if (!s) return false;
      sides_[k] = *s == Sign::Positive;
    }
    *clearance = std::min(*clearance, std::fabs(at.value));
  }
  trial_->out = trial_->in = -1;
  for (int k = 0; k < n; ++k) {
    const bool here = sides_[k], there = sides_[k + 1 < n ? k + 1 : 0];
    if (here != there) (there ? trial_->out : trial_->in) = k;
  }
  return trial_->out >= 0 && trial_->in >= 0;
}

bool CellAtHand::divide_crossings(const Line& line, double* clearance) {
  shares_.assign(curves_.size(), {});
  crossings_in_ = {};
  trial_->positive.resize(crossings_.size());
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    const LineValue at = value_at(line, *crossings_[i].place);
    bool positive = at.value > 0;
    if (!(std::fabs(at.value) > at.error)) {
      const auto s = side(line, crossings_[i].place->box, partition_.kernel());
      if (!s) return false;
      positive = *s == Sign::Positive;
    }
    trial_->positive[i] = positive;
    *clearance = std::min(*clearance, std::fabs(at.value));
    ++crossings_in_[positive];
    for (const int s : crossings_[i].slots)
      if (s >= 0) ++shares_[s].crossings[positive];
  }
  for (const int id : cell_->zones)
    if (const Zone& zone = partition_.zones[id];
        !zone.crossable && !side(line, zone.box, partition_.kernel()))
      return false;
  return true;
}

bool CellAtHand::count_old_crossings(const Line& line) {
  const auto cut_edge = [&](int edge, Place* vertex, int* word_at) {
    const Line& other = partition_.lines[cell_->edges[edge].line];
    *vertex = meeting_place(line, other);
    if (!vertex->finite()) return false;
    const auto before =
        partition_.crossings_before(*cell_, edge, vertex->range(parameter_axis(other)));
    if (!before) return false;
    *word_at = cell_->begin_of(edge) + *before;
    return true;
  };
  if (!cut_edge(trial_->out, &trial_->vertex_out, &trial_->word_at_out) ||
      !cut_edge(trial_->in, &trial_->vertex_in, &trial_->word_at_in))
    return false;
  // The boundary is positive from `out` to `in`.
  const bool wraps = trial_->out > trial_->in;
  for (int i = 0; i < static_cast<int>(cell_->word.size()); ++i) {
    const bool after_out = i >= trial_->word_at_out, before_in = i < trial_->word_at_in;
    const bool positive = wraps ? after_out || before_in : after_out && before_in;
    ++shares_[slot_[partition_.line_crossings[cell_->word[i]].curve]].ends[positive];
  }
  return true;
}

bool CellAtHand::add_new_crossings(const Line& line) {
  const int axis = parameter_axis(line);
  Interval from = trial_->vertex_out.range(axis), to = trial_->vertex_in.range(axis);
  if (!(from.hi < to.lo)) std::swap(from, to);
  if (!(from.hi < to.lo)) return false;
  trial_->roots.clear();
  const bool may_end = std::any_of(cell_->zones.begin(), cell_->zones.end(),
                                   [&](int id) { return partition_.zones[id].crossable; });
  for (std::size_t s = 0; s < curves_.size(); ++s) {
    const std::size_t before = trial_->roots.size();
    if (!partition_.isolate_between(curves_[s].curve, line, from, to, kMaxNodes, &trial_->roots))
      return false;
    const int roots = static_cast<int>(trial_->roots.size() - before);
    if (roots > 0) add_roots(s, roots);
    // A curve enters a cell as often as it leaves it: a free check of all the above. (But it may
    // end where its function is not analytic.)
    for (const int ends : shares_[s].ends)
      if (ends % 2 != 0 && !may_end) return false;
    if (roots > 0 && is_beaten(score())) return false;
  }
  return true;
}

bool CellAtHand::cuts_well(const Line& line) {
  double clearance = HUGE_VAL;
  if (!cross_boundary(line, &clearance) || !divide_crossings(line, &clearance)) return false;
  set_slivers(line, clearance);
  if (!count_old_crossings(line)) return false;
  count_branches();
  return !is_beaten(score()) && add_new_crossings(line);
}

/// Proves what a line does, and keeps the cut if it is the best.
void CellAtHand::prove(const Line& line) {
  if (!cuts_well(line)) return;
  trial_->line = line;
  trial_->score = score();
  for (int k = 0; k < 2; ++k) trial_->least_cells[k] = least_cells(k);
  std::swap(trial_, best_);
  is_finished_ = leaves_simple_parts();
  has_cut_ = true;
}

bool CellAtHand::prove_best() {
  while (!proposals_.empty()) {
    const auto next =
        std::min_element(proposals_.begin(), proposals_.end(),
                         [](const Proposal& a, const Proposal& b) { return a.score < b.score; });
    if (has_cut_ && !(next->score < best_->score - kTie)) break;
    if (!next->sampled && weigh(HUGE_VAL, &*next)) continue;
    prove(next->line);
    proposals_.erase(next);
  }
  proposals_.clear();
  best_score_ = has_cut_ ? best_->score : HUGE_VAL;
  seems_finished_ = has_cut_ && is_finished_;
  return has_cut_;
}

}  // namespace encase
