// SPDX-License-Identifier: MIT
// Steps 2 and 3: crossings and critical regions.
#include "2d/encaser.hpp"

#include <algorithm>
#include <utility>

#include "2d/critical_regions.hpp"
#include "2d/saddles.hpp"
#include "common/isolate_roots.hpp"

namespace encase {
namespace {

/// Whether to look for the common zeros of a pair only in its open leaves. A few leaves leave
/// little out of the box around them, and very many are small, and tell little.
bool leaves_tell(const MeetingPair& pair) {
  constexpr std::size_t kFew = 8, kMany = 1024;
  return pair.open() == 0 || (pair.meetings.size() > kFew && pair.meetings.size() <= kMany);
}

}  // namespace

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

}  // namespace encase
