// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "2d/critical_regions.hpp"
#include "2d/encaser.hpp"
#include "2d/infinity.hpp"
#include "2d/locate.hpp"
#include "2d/saddles.hpp"
#include "2d/shared_leaves.hpp"
#include "common/analytic_gaps.hpp"
#include "common/components.hpp"
#include "common/isolate_roots.hpp"
#include "common/parallel.hpp"
#include "common/perturb.hpp"
#include "common/plane_subdivision.hpp"

namespace encase {
namespace {

/// Whether two of the boxes share a point.
bool any_meet(std::vector<Box<2>> boxes) {
  std::sort(boxes.begin(), boxes.end(),
            [](const Box<2>& a, const Box<2>& b) { return a.lo[0] < b.lo[0]; });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].lo[0] <= boxes[i].hi[0]; ++j)
      if (boxes[i].meets(boxes[j])) return true;
  return false;
}

std::string decimal(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

/// The part of the region's width beyond which boxes are not halved. Curves a tiny gap apart take
/// boxes of its size; where several branches of one curve meet, smaller boxes only become more.
double smallest_part(Unresolved::Kind kind) {
  return kind == Unresolved::Kind::Contact ? 0x1p-44 : 0x1p-40;
}

/// Whether to look for the common zeros of a pair only in its open leaves. A few leaves leave
/// little out of the box around them, and very many are small, and tell little.
bool leaves_tell(const MeetingPair& pair) {
  constexpr std::size_t kFew = 8, kMany = 1024;
  return pair.open() == 0 || (pair.meetings.size() > kFew && pair.meetings.size() <= kMany);
}

}  // namespace

Encaser::Encaser(const std::vector<NamedCurve>& input, const Region& region,
                 const EncaseOptions& options)
    : options_(options), threads_(std::max(options.threads, 1)), clock_(threads_) {
  kernel_.start_bits = std::max(options.start_bits, Kernel::kDoubleBits);
  kernel_.max_bits = std::max(options.max_bits, kernel_.start_bits);
  result_.input = input;
  result_.region = region;
  result_.seed = options.seed;
  result_.perturbation = options.perturbation;
}

Encaser::Encaser(const Encasement& earlier, const std::vector<NamedCurve>& more,
                 const EncaseOptions& options)
    : Encaser(earlier.input, earlier.region, options) {
  earlier_ = EarlierEncasement(earlier);
  perturbed_ = earlier.input.size();
  result_.input.insert(result_.input.end(), more.begin(), more.end());
  result_.seed = earlier.seed;
  result_.perturbation = earlier.perturbation;
}

void Encaser::use_up_budget(const std::string& reason) {
  std::lock_guard lock(budget_mutex_);
  if (is_used_up_) return;
  budget_ = reason;
  is_used_up_ = true;
}

void Encaser::progress(const char* stage, double done) {
  if (!options_.progress || is_used_up_) return;
  const std::unique_lock lock(progress_mutex_, std::try_to_lock);
  if (!lock || is_used_up_) return;  // another thread is telling, or was told to stop
  if (!options_.progress(stage, done)) use_up_budget("the computation was cancelled");
}

std::function<bool()> Encaser::stop(const char* stage) {
  return [this, stage] {
    progress(stage, -1);
    return out_of_budget();
  };
}

void Encaser::run(Tasks& tasks, const std::function<void(int)>& task) {
  if (threads_ == 1 || tasks.count <= 1) {
    for (int i = 0; i < tasks.count; ++i, ++tasks.done) task(i);
    return;
  }
  const RunClock::SharedOut shared_out(clock_);
  parallel_for(tasks.count, threads_, [&](int i) {
    const RunClock::Shift shift(clock_);
    try {
      task(i);
    } catch (...) {
      use_up_budget(
          "something failed");  // so that the others end soon; what was thrown is the answer
      throw;
    }
    ++tasks.done;
  });
}

SubdivisionLimits Encaser::limits(Tasks& tasks, Unresolved::Kind kind, const Box<2>& root) {
  SubdivisionLimits limits;
  // A root may be smaller than the whole; the smallest boxes are not.
  const double whole = tiled_.front().box().largest_width();
  limits.smallest = smallest_part(kind) * (whole / root.largest_width());
  limits.stop = [this, &tasks] {
    progress(tasks.stage, tasks.count > 2 ? tasks.part_done() : -1);
    return out_of_budget();
  };
  return limits;
}

bool Encaser::out_of_budget() {
  if (is_used_up_) return true;
  if (clock_.exceeds(options_.max_seconds))
    use_up_budget("the limit of " + decimal(options_.max_seconds) + " CPU seconds was reached");
  return is_used_up_;
}

namespace {

Status bad_input(std::string message) {
  return Status(Error{Error::Code::BadInput, std::move(message)});
}

Status check_polynomial(const NamedCurve& curve) {
  const Polynomial<2>& polynomial = curve.function.polynomial();
  if (polynomial.is_zero())
    return bad_input("curve '" + curve.name + "' is the zero polynomial: every point lies on it");
  if (polynomial.is_constant())
    return bad_input("curve '" + curve.name + "' is a constant: no point lies on it");
  if (polynomial.degree() > kMaxDegree)
    return bad_input("curve '" + curve.name + "' has degree " +
                     std::to_string(polynomial.degree()) + ", above the limit of " +
                     std::to_string(kMaxDegree));
  return std::nullopt;
}

}  // namespace

Status Encaser::check_other(const NamedCurve& curve) const {
  if (curve.function.is_inclusion()) {
    const Box<2> box = result_.region.bounding_box();
    if (const auto trouble = complaint(curve.function.inclusion(), box))
      return bad_input("the inclusion function of curve '" + curve.name + "' " + *trouble);
  } else {
    const Expression& expression = curve.function.expression();
    if (!expression.uses(0) && !expression.uses(1))
      return bad_input("curve '" + curve.name + "' is a constant: it has no x and no y");
    if (expression.uses(2))
      return bad_input("curve '" + curve.name + "' has a z: a curve in the plane has x and y only");
  }
  if (result_.region.plane)
    return bad_input("curve '" + curve.name +
                     "' is no polynomial: it can be encased in a bounded region, not in the plane");
  if (result_.perturbation > 0)
    return bad_input("curve '" + curve.name + "' is no polynomial: only those can be perturbed");
  return std::nullopt;
}

Status Encaser::check_input() const {
  if (!result_.region.plane && result_.region.corners.size() < 3)
    return bad_input("the region has fewer than three corners");
  for (const NamedCurve& curve : result_.input)
    if (const Status status =
            curve.function.is_polynomial() ? check_polynomial(curve) : check_other(curve))
      return status;
  if (!(result_.perturbation >= 0) || !std::isfinite(result_.perturbation))
    return bad_input("the perturbation must be a number that is not negative");
  return std::nullopt;
}

void Encaser::separate_components() {
  if (result_.perturbation > 0) {
    std::mt19937_64 generator(result_.seed);
    for (std::size_t k = 0; k < result_.input.size(); ++k) {
      // Also for those that are perturbed already: the others get what they would all together.
      Function<2>& function = result_.input[k].function;
      Polynomial<2> perturbed = perturb(function.polynomial(), result_.perturbation, generator);
      if (k >= perturbed_) function = std::move(perturbed);
    }
  }
  separate_polynomials();
  separate_others();
  for (const Curve& curve : result_.curves) polynomials_.emplace_back(curve.function);
}

void Encaser::take_curves(const std::vector<const FilteredFunction<2>*>& prepared) {
  for (std::size_t k = 0; k < prepared.size(); ++k) {
    const NamedCurve& curve = result_.input[k];
    result_.curves.push_back({curve.name, curve.function, {static_cast<int>(k)}});
    polynomials_.push_back(*prepared[k]);
  }
}

void Encaser::separate_polynomials() {
  std::vector<Polynomial<2>> inputs;
  std::vector<int> input_of;
  for (std::size_t k = 0; k < result_.input.size(); ++k)
    if (result_.input[k].function.is_polynomial()) {
      inputs.push_back(result_.input[k].function.polynomial());
      input_of.push_back(static_cast<int>(k));
    }
  std::vector<int> used(result_.input.size(), 0);
  for (BaseElement<2>& element : coprime_square_free_base(inputs)) {
    for (auto& source : element.sources) source.index = input_of[source.index];
    Curve curve;
    Unresolved note;
    note.proved = true;
    for (const auto& source : element.sources) {
      const NamedCurve& from = result_.input[source.index];
      curve.sources.push_back(source.index);
      curve.name += (curve.name.empty() ? "" : " & ") + from.name;
      note.curves.push_back(source.index);
      if (source.multiplicity > 1) {
        Unresolved repeated = note;
        repeated.kind = Unresolved::Kind::RepeatedComponent;
        repeated.curves = {source.index};
        repeated.reason = "curve '" + from.name + "' contains the component " +
                          element.polynomial.to_string() + " = 0 " +
                          std::to_string(source.multiplicity) + " times; it is encased once";
        result_.degenerate.push_back(std::move(repeated));
      }
    }
    if (element.sources.size() > 1) {
      note.kind = Unresolved::Kind::SharedComponent;
      note.reason = "curves '" + curve.name + "' share the component " +
                    element.polynomial.to_string() + " = 0; it is encased as one curve";
      result_.degenerate.push_back(std::move(note));
    } else if (++used[element.sources[0].index] > 1) {
      curve.name += " (" + std::to_string(used[element.sources[0].index]) + ")";
    }
    curve.function = std::move(element.polynomial);
    result_.curves.push_back(std::move(curve));
  }
}

/// Equal ones are one curve; nothing else is known of what they have in common.
void Encaser::separate_others() {
  const std::size_t first = result_.curves.size();
  for (std::size_t k = 0; k < result_.input.size(); ++k) {
    const NamedCurve& from = result_.input[k];
    if (from.function.is_polynomial()) continue;
    const int index = static_cast<int>(k);
    const auto same = std::find_if(
        result_.curves.begin() + static_cast<std::ptrdiff_t>(first), result_.curves.end(),
        [&](const Curve& curve) { return curve.function == from.function; });
    if (same == result_.curves.end()) {
      Curve curve;
      curve.name = from.name;
      curve.function = from.function;
      curve.sources = {index};
      result_.curves.push_back(std::move(curve));
    } else {
      same->name += " & " + from.name;
      same->sources.push_back(index);
    }
  }
  for (std::size_t c = first; c < result_.curves.size(); ++c) {
    const Curve& curve = result_.curves[c];
    if (curve.sources.size() < 2) continue;
    Unresolved note;
    note.kind = Unresolved::Kind::SharedComponent;
    note.proved = true;
    note.curves = curve.sources;
    note.reason = "curves '" + curve.name + "' are the same; they are encased as one curve";
    result_.degenerate.push_back(std::move(note));
  }
  if (first < result_.curves.size())
    std::stable_sort(result_.curves.begin(), result_.curves.end(),
                     [](const Curve& a, const Curve& b) { return a.sources[0] < b.sources[0]; });
}

void Encaser::use_region(const Region& region) {
  result_.region_used = region;
  bounds_ = region.bounding_box();
  sides_.clear();
  for (int k = 0; k < region.side_count(); ++k) sides_.push_back(region.side(k));
  const Box<2> root = subdivision_root(bounds_);
  tiled_.clear();
  tile_kernels_.resize(polynomials_.size(), kernel_.fresh());
  for (std::size_t c = 0; c < polynomials_.size(); ++c)
    tiled_.emplace_back(polynomials_[c], root, tile_kernels_[c]);
  if (tiles_) tiles_->add_counts_to(&kernel_);
  // (For one pair inner tiles are not worth their making.)
  tiles_ = std::make_unique<NestedTiles>(polynomials_, tiled_, bounds_.center(),
                                         polynomials_.size() > 2, kernel_);
  features_ = {};
  partition_ = std::make_unique<Partition>(polynomials_, *tiles_, features_, kernel_);
  earlier_.match(result_.curves, region);
}

bool Encaser::open_region() {
  if (result_.region.plane) return open_plane();
  // The region itself, or one of some slightly larger polygons in which every curve meets the sides
  // in simple points, none of them a corner or shared (design of the boundary: docs/encasement.md).
  for (int attempt = 0; attempt < 6; ++attempt) {
    if (attempt == 0) {
      use_region(result_.region);
    } else if (const auto used = enlarged(result_.region, attempt)) {
      use_region(*used);
    } else {
      continue;
    }
    if (open_polygon()) return true;
  }
  return false;
}

bool Encaser::open_region_as_asked() {
  use_region(result_.region);
  return open_polygon();
}

/// Whether the polygon to be used is generic for the curves.
bool Encaser::open_polygon() {
  auto cell = partition_->open(sides_);
  if (!cell) return false;
  first_cell_ = std::move(*cell);
  isolate_crossings();
  // Every crossing box must lie on one side of every side's line.
  bool clear = true;
  for (const Crossing& crossing : features_.crossings) {
    const Place place(crossing.box);
    for (const Line& line : sides_) clear = clear && side(line, place, kernel_).has_value();
  }
  return clear;
}

/// In place of the plane a rectangle outside of which the curves are known, as far as that can be.
bool Encaser::open_plane() {
  std::vector<Polynomial<2>> curves;
  for (const Curve& curve : result_.curves) curves.push_back(curve.function.polynomial());
  Surroundings surroundings = find_surroundings(curves, stop("looking for a rectangle"), kernel_);
  const Rational x(surroundings.half[0]), y(surroundings.half[1]);
  use_region(make_region(-x, x, -y, y).value());
  for (Surroundings::Open& open : surroundings.open) {
    Unresolved entry;
    entry.kind = Unresolved::Kind::Infinity;
    std::sort(open.curves.begin(), open.curves.end());
    std::string names;
    for (const int c : open.curves)
      names += (names.empty() ? "'" : " and '") + result_.curves[c].name + "'";
    const double v = 0.5 * (open.lo + open.hi), ratio = surroundings.half[1] / surroundings.half[0];
    const Point<2> direction = open.chart == 0 ? Point<2>{1, v * ratio} : Point<2>{v / ratio, 1};
    entry.reason =
        (open.curves.size() == 1
             ? "curve " + names + " touches the line at infinity, or nearly,"
             : "curves " + names + " touch the line at infinity or meet on it, or nearly,") +
        " in the direction (" + decimal(direction[0]) + ", " + decimal(direction[1]) + ")";
    entry.curves = std::move(open.curves);
    result_.degenerate.push_back(std::move(entry));
  }
  if (surroundings.open.empty()) result_.infinity = std::move(surroundings.pieces);
  return open_polygon();
}

void Encaser::give_up_on_region() {
  if (!result_.region.plane) use_region(result_.region);
  partition_->lines = sides_;
  isolate_crossings();
  find_critical_regions();
  OpenCell cell;
  const int n = static_cast<int>(partition_->lines.size());
  for (int k = 0; k < n; ++k) {
    cell.vertices.push_back(meet(partition_->lines[(k + n - 1) % n], partition_->lines[k]));
    cell.edges.push_back({k, false, {}});
  }
  const SplittingTask task{options_, earlier_, bounds_, result_.undecided, {}, {}};
  CellSplitter splitter(*partition_, task);
  splitter.add(std::move(cell));
  splitter.give_up();
  take_cells(&splitter);
  budget_ = "the curves' crossings with the region's sides could not be told apart";
  is_used_up_ = true;
  finish_cells();
}

std::vector<Box<2>> Encaser::clusters_of(const std::vector<Box<2>>& unresolved) const {
  // Boxes that nearly touch are one place.
  std::vector<Box<2>> grown = unresolved;
  for (Box<2>& box : grown) {
    const double margin = 4 * box.largest_width();
    for (int i = 0; i < 2; ++i) {
      box.lo[i] -= margin;
      box.hi[i] += margin;
    }
  }
  std::vector<Box<2>> clusters;
  const std::vector<int> component = connected_components(grown);
  for (std::size_t i = 0; i < unresolved.size(); ++i) {
    const std::size_t k = component[i];
    if (k == clusters.size())
      clusters.push_back(unresolved[i]);
    else
      clusters[k] = hull(clusters[k], unresolved[i]);
  }
  return clusters;
}

/// Where curves are not known to be zero sets of analytic functions.
void Encaser::report_gaps() {
  for (std::size_t c = 0; c < tiled_.size(); ++c) {
    std::vector<Box<2>> zones;
    for (const Box<2>& gap : tiled_[c].gaps())
      if (lies_inside(zone_of(gap), sides_) != false) zones.push_back(zone_of(gap));
    for (const Box<2>& box : gathered(std::move(zones), tiled_[c].box())) {
      Unresolved entry;
      entry.kind = Unresolved::Kind::NotAnalytic;
      entry.box = box;
      entry.has_box = true;
      entry.curves = {static_cast<int>(c)};
      entry.reason = result_.curves[c].function.is_inclusion()
                         ? "the inclusion function of curve '" + result_.curves[c].name +
                               "' tells nothing here"
                         : "the function of curve '" + result_.curves[c].name +
                               "' is not defined, has a pole or is not differentiable here, or "
                               "nearly";
      result_.degenerate.push_back(std::move(entry));
    }
  }
}

void Encaser::report(Leftover left, Unresolved::Kind kind, std::vector<int> curves) {
  // What lies in gaps is reported already.
  std::erase_if(left.unresolved, [&](const Box<2>& box) {
    return std::any_of(curves.begin(), curves.end(),
                       [&](int c) { return relation(box, tiled_[c].gaps()) == Relation::Within; });
  });
  if (left.unresolved.empty()) return;
  std::string names;
  for (const int c : curves)
    names += (names.empty() ? "'" : " and '") + result_.curves[c].name + "'";
  for (const Box<2>& box : clusters_of(left.unresolved)) {
    Unresolved entry;
    entry.box = box;
    entry.has_box = true;
    entry.curves = curves;
    // Halved as far as sizes go, as opposed to left over when the number of boxes ran out.
    bool at_cap = true;
    for (const Box<2>& leaf : left.unresolved)
      if (box.contains(leaf))
        at_cap = at_cap && (leaf.width(0) <= left.smallest * left.root.width(0) ||
                            leaf.width(1) <= left.smallest * left.root.width(1));
    if (at_cap) {
      entry.kind = kind;
      entry.reason = kind == Unresolved::Kind::Contact
                         ? "curves " + names + " touch, nearly touch or meet at a singular point"
                         : "curve " + names + " is singular or nearly singular";
      result_.degenerate.push_back(std::move(entry));
    } else {
      entry.kind = Unresolved::Kind::Budget;
      entry.reason = (left.stopped ? budget_ : "the limit on boxes was reached") +
                     (kind == Unresolved::Kind::Contact
                          ? " before curves " + names + " were told apart"
                          : " before the critical points of curve " + names + " were settled");
      result_.undecided.push_back(std::move(entry));
    }
  }
}

void Encaser::isolate_crossings() {
  result_.crossing_covers.clear();
  result_.degenerate.erase(std::remove_if(result_.degenerate.begin(), result_.degenerate.end(),
                                          [](const Unresolved& u) { return u.has_box; }),
                           result_.degenerate.end());
  result_.undecided.clear();
  report_gaps();
  const int n = static_cast<int>(polynomials_.size());
  std::int64_t& isolated = result_.statistics.pairs_isolated = n == 2;
  result_.shared_cover = {};
  curve_roots_.clear();
  if (n > 2) {
    SharedLeaves shared = share_leaves(*tiles_, sides_, stop("telling which curves meet"), kernel_);
    result_.statistics.root_boxes += shared.visited;
    const Box<2> whole = tiled_[0].box();
    for (const Box<2>& box : shared.unresolved) {
      Unresolved entry;
      entry.box = box;
      entry.has_box = true;
      entry.reason = budget_ + " before it was told which curves meet";
      result_.undecided.push_back(std::move(entry));
    }
    curve_roots_ = hulls_of_curves(shared, n);
    for (Box<2>& box : curve_roots_)
      if (box.width(0) > 0) box = root_around(box, whole);
    std::vector<Pair> pairs;
    const bool complete = shared.unresolved.empty();
    for (const MeetingPair& pair : meeting_pairs(shared)) {
      isolated += !complete || pair.open() > 0;
      const Box<2> box = hull(shared, pair);
      if (earlier_.append_crossings(pair.curves, box, &features_.crossings,
                                    &result_.crossing_covers))
        continue;
      pairs.push_back({pair.curves, root_around(box, whole), complete ? &shared : nullptr, pair});
    }
    isolate_pairs(pairs);
    result_.shared_cover = std::move(shared.cover);
  } else {
    for (const TiledFunction& f : tiled_) curve_roots_.push_back(f.box());
    if (n == 2) isolate_pairs({{{0, 1}, tiled_[0].box(), nullptr, {}}});
  }
  report_concurrency();
}

/// In the box around the leaves in which the pair meets, or in those that are open.
RootIsolation<2> Encaser::isolate_pair(const Pair& pair, SubdivisionLimits* limits,
                                       Kernel* kernel) {
  if (!pair.leaves || !leaves_tell(pair.meeting)) {
    const auto [i, j] = pair.curves;
    return isolate_roots(tiles_->about(i, pair.root), tiles_->about(j, pair.root), pair.root,
                         sides_, *limits, *kernel);
  }
  Sought<2> sought = sought_in(*pair.leaves, pair.meeting, *tiles_);
  limits->smallest *= pair.root.largest_width() / sought.root.largest_width();
  return isolate_roots(std::move(sought), sides_, *limits, *kernel);
}

/// All common zeros of pairs of curves, each in the part of a box that lies in the region.
void Encaser::isolate_pairs(const std::vector<Pair>& pairs) {
  struct Isolated {
    RootIsolation<2> roots;
    double smallest;
    bool stopped;
    Kernel kernel;
  };
  std::vector<Isolated> isolated(pairs.size());
  Tasks tasks{"isolating crossings", static_cast<int>(pairs.size())};
  run(tasks, [&](int index) {
    Isolated& result = isolated[index];
    result.kernel = kernel_.fresh();
    SubdivisionLimits pair_limits = limits(tasks, Unresolved::Kind::Contact, pairs[index].root);
    result.roots = isolate_pair(pairs[index], &pair_limits, &result.kernel);
    result.smallest = pair_limits.smallest;
    result.stopped = is_used_up_;
  });
  for (std::size_t index = 0; index < pairs.size(); ++index) {
    const std::array<int, 2>& curves = pairs[index].curves;
    Isolated& from = isolated[index];
    RootIsolation<2>& roots = from.roots;
    kernel_.add(from.kernel);
    result_.statistics.root_boxes += roots.boxes;
    const int first = static_cast<int>(features_.crossings.size());
    for (std::size_t k = 0; k < roots.roots.size(); ++k) {
      Crossing crossing;
      crossing.curves = curves;
      crossing.box = roots.roots[k];
      crossing.point = crossing.box.center();
      crossing.rounded = roots.rounded[k];
      features_.crossings.push_back(crossing);
    }
    for (int& token : roots.tokens)
      if (token >= 0) token += first;
    report({roots.unresolved, roots.root_box, from.smallest, from.stopped},
           Unresolved::Kind::Contact, {curves[0], curves[1]});
    result_.crossing_covers.push_back({curves, roots.root_box, std::move(roots.tokens)});
  }
}

void Encaser::report_concurrency() {
  // Boxes of different pairs that meet: three curves through one point, as far as can be told.
  std::vector<Box<2>> boxes;
  boxes.reserve(features_.crossings.size());
  for (const Crossing& crossing : features_.crossings) boxes.push_back(crossing.box);
  if (!any_meet(boxes)) return;
  const std::vector<int> component = connected_components(boxes);
  std::vector<std::vector<int>> groups(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
    groups[component[k]].push_back(static_cast<int>(k));
  for (const auto& group : groups) {
    if (group.size() < 2) continue;
    Unresolved entry;
    entry.kind = Unresolved::Kind::Concurrency;
    entry.has_box = true;
    entry.box = boxes[group[0]];
    for (const int k : group) {
      entry.box = hull(entry.box, boxes[k]);
      for (const int c : features_.crossings[k].curves)
        if (std::find(entry.curves.begin(), entry.curves.end(), c) == entry.curves.end())
          entry.curves.push_back(c);
    }
    std::sort(entry.curves.begin(), entry.curves.end());
    entry.reason = "three or more curves meet or nearly meet in a point";
    result_.degenerate.push_back(std::move(entry));
  }
}

void Encaser::find_critical_regions() {
  std::vector<int> curves;
  for (int c = 0; c < static_cast<int>(polynomials_.size()); ++c)
    if (curve_roots_[c].width(0) > 0 &&  // others have no zero in the region
        !earlier_.append_critical_regions(c, curve_roots_[c], &features_.critical_regions,
                                          &result_.critical_covers))
      curves.push_back(c);
  struct Found {
    CriticalRegions regions;
    std::vector<Saddle> saddles;
    double smallest;
    bool stopped;
    Kernel kernel;
  };
  std::vector<Found> found(curves.size());
  Tasks tasks{"finding critical regions", static_cast<int>(curves.size())};
  run(tasks, [&](int index) {
    const int c = curves[index];
    const Box<2>& root = curve_roots_[c];
    Found& result = found[index];
    result.kernel = kernel_.fresh();
    const SubdivisionLimits curve_limits = limits(tasks, Unresolved::Kind::SingularPoint, root);
    result.regions = critical_regions(tiled_[c], c, root, sides_, curve_limits, result.kernel);
    append_saddles(tiled_[c], c, result.regions.other_points, &result.saddles);
    result.smallest = curve_limits.smallest;
    result.stopped = is_used_up_;
  });
  std::vector<Saddle>& saddles = features_.saddles;
  for (std::size_t index = 0; index < curves.size(); ++index) {
    const int c = curves[index];
    CriticalRegions& regions = found[index].regions;
    kernel_.add(found[index].kernel);
    result_.statistics.critical_boxes += regions.boxes;
    const int first = static_cast<int>(features_.critical_regions.size());
    for (int& token : regions.tokens)
      if (token >= 0) token += first;
    for (CriticalRegion& region : regions.regions)
      features_.critical_regions.push_back(std::move(region));
    saddles.insert(saddles.end(), found[index].saddles.begin(), found[index].saddles.end());
    report({regions.unresolved, regions.root_box, found[index].smallest, found[index].stopped},
           Unresolved::Kind::SingularPoint, {c});
    result_.critical_covers.push_back({c, regions.root_box, std::move(regions.tokens)});
  }
  std::stable_sort(saddles.begin(), saddles.end(),
                   [](const Saddle& a, const Saddle& b) { return a.reach < b.reach; });
}

void Encaser::collect_zones() {
  // Boxes that touch make one zone.
  std::vector<Box<2>> boxes;
  for (const auto* list : {&result_.degenerate, &result_.undecided})
    for (const Unresolved& entry : *list)
      if (entry.has_box && entry.kind != Unresolved::Kind::NotAnalytic) boxes.push_back(entry.box);
  for (std::size_t before = 0; before != boxes.size();) {
    before = boxes.size();
    boxes = clusters_of(boxes);
  }
  const double diameter = bounds_.largest_width();
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Box<2>& box = boxes[k];
    // Wide enough to be cheap to surround, but clear of every other feature.
    double margin = 0x1p-6 * diameter;
    const auto keep_off = [&](const Box<2>& other) {
      double gap = 0;
      for (int i = 0; i < 2; ++i)
        gap = std::max({gap, other.lo[i] - box.hi[i], box.lo[i] - other.hi[i]});
      if (gap > 0) margin = std::min(margin, 0.3 * gap);
    };
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (j != k) keep_off(boxes[j]);
    for (const Crossing& crossing : features_.crossings) keep_off(crossing.box);
    margin = std::max(margin, 2 * box.largest_width());
    Zone zone{box, box};
    for (int i = 0; i < 2; ++i) {
      zone.clearance.lo[i] -= margin;
      zone.clearance.hi[i] += 1.07 * margin;
    }
    features_.zones.push_back(zone);
  }
  for (const Unresolved& entry : result_.degenerate) {
    if (entry.kind != Unresolved::Kind::NotAnalytic) continue;
    Zone zone{entry.box, entry.box, true};
    for (int i = 0; i < 2; ++i) {
      const bool tiny = entry.box.largest_width() < 0x1p-8 * diameter;
      const double margin =
          tiny ? 0x1p-6 * diameter
               : 0x1p-10 * diameter +
                     0.5 * std::min({entry.box.width(0), entry.box.width(1), 0x1p-8 * diameter});
      zone.clearance.lo[i] -= margin;
      zone.clearance.hi[i] += 1.07 * margin;
    }
    features_.zones.push_back(zone);
  }
}

void Encaser::count_pairs() {
  Statistics& s = result_.statistics;
  s.pairs_met = static_cast<std::int64_t>(result_.crossing_covers.size());
  s.filter_failures = s.pairs_isolated;
  for (const CrossingCover& cover : result_.crossing_covers)
    s.filter_failures -= std::any_of(cover.tokens.begin(), cover.tokens.end(), [&](int token) {
      return token == cover::kUnresolved ||
             (token >= 0 && result_.crossings[token].location != Location::Outside);
    });
}

void Encaser::decide_outcome() {
  locate_crossings(result_, kernel_);
  count_pairs();
  result_.outcome = !result_.undecided.empty()    ? Outcome::Undecided
                    : !result_.degenerate.empty() ? Outcome::Degenerate
                                                  : Outcome::Certified;
  for (const Cell& cell : result_.cells)
    if (cell.state == CellState::Undecided) result_.outcome = Outcome::Undecided;
  for (const Kernel& kernel : tile_kernels_) kernel_.add(kernel);
  tiles_->add_counts_to(&kernel_);
  Statistics& s = result_.statistics;
  s.candidate_lines = partition_->lines_tried;
  s.decisions = kernel_.decisions;
  s.restrictions = kernel_.restrictions;
  s.expansions = kernel_.expansions;
  s.mpfr_expansions = kernel_.mpfr_expansions;
  result_.seconds = clock_.seconds();
}

}  // namespace encase
