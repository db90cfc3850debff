// SPDX-License-Identifier: MIT
#include "2d/splitting_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

namespace encase {
namespace {

constexpr double kMiddle = 0.35;     // where the middle of the projections begins
constexpr int kMostProjected = 256;  // crossings; of more every other, every third, and so on
constexpr int kFewProjected = 8;     // which are sorted as a whole
// Of more than two curves: crossings from which on a cell is halved whatever the branches of one
// curve do.
constexpr int kManyCrossings = 16;
constexpr int kMaxBisected = 6;    // crossings up to which pairs of them are bisected
constexpr int kBisectedPairs = 3;  // of crossings
constexpr int kSaddles = 4;        // of a curve
constexpr int kBranchPairs = 12;   // of boundary points of a curve, on different branches
constexpr int kBranchPairsWhenFast = 6;
constexpr int kSplitCurves = 4;        // curves the branches of which are told apart
constexpr int kCurvePairs = 4;         // of neighbours on the boundary, of different curves
constexpr int kApproachedPairs = 8;    // of boundary points
constexpr int kMostApproached = 2000;  // points, of all pairs of which the closest are taken
constexpr int kApproachSteps = 2;
constexpr int kProjections = 2;  // onto the curve, in each
// Expected cells that a cut has to save, so that no better one is looked for. (Of two curves, not
// fast: as many as can be.)
constexpr double kEnoughWhenFast = -0.5;
constexpr double kEnoughOfMany = 1;
constexpr double kPoor = 1;  // a cut that does not save so many calls for closest approach
constexpr double kPoorWhenFastOrMany = -1;
constexpr double kPoorWhenStalled = 0;  // and in the first levels without progress for fans
constexpr int kFanLevels = 2;
constexpr int kFanPairs = 4;  // of boundary points
constexpr int kFanLines = 12;

double dot(const Point<2>& a, const Point<2>& b) { return a[0] * b[0] + a[1] * b[1]; }
Point<2> minus(const Point<2>& a, const Point<2>& b) { return {a[0] - b[0], a[1] - b[1]}; }
Point<2> halfway(const Point<2>& a, const Point<2>& b) {
  return {a[0] + 0.5 * (b[0] - a[0]), a[1] + 0.5 * (b[1] - a[1])};
}
double square_distance(const Point<2>& a, const Point<2>& b) {
  const Point<2> d = minus(a, b);
  return dot(d, d);
}
Point<2> unit(const Point<2>& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Point<2>{v[0] / length, v[1] / length} : Point<2>{0, 0};
}

/// The line between two points along the mean of the curves' normals there, each turned to point
/// from a to b. Where a chord joins two points of one branch its midpoint's tangent is the chord
/// itself; the mean normal has no such weakness (docs/encasement.md).
Line between(const CellAtHand::BoundaryPoint& a, const CellAtHand::BoundaryPoint& b) {
  const Point<2> direction = minus(b.at, a.at);
  Point<2> normal{0, 0};
  for (const auto* p : {&a, &b}) {
    const double s = dot(p->normal, direction) < 0 ? -1 : 1;
    normal[0] += s * p->normal[0];
    normal[1] += s * p->normal[1];
  }
  if (dot(normal, normal) < 1e-12) normal = direction;
  return line_through(halfway(a.at, b.at), normal);
}

/// Unit vectors in directions spread over half a turn, none of them along an axis.
template <int N>
std::array<Point<2>, N> half_turn() {
  std::array<Point<2>, N> directions;
  for (int k = 0; k < N; ++k) {
    const double angle = (k + 0.37) * std::numbers::pi / N;
    directions[k] = {std::cos(angle), std::sin(angle)};
  }
  return directions;
}

}  // namespace

Line line_through(const Point<2>& point, const Point<2>& normal) {
  Line line;
  line.normal = unit(normal);
  line.offset = -dot(line.normal, point);
  return line;
}

void SplittingLines::keep_closest(std::size_t count) {
  const auto is_closer = [](const Pair& p, const Pair& q) {
    return p.gap != q.gap ? p.gap < q.gap : p.a != q.a ? p.a < q.a : p.b < q.b;
  };
  if (count < pairs_.size()) {
    std::nth_element(pairs_.begin(), pairs_.begin() + static_cast<std::ptrdiff_t>(count),
                     pairs_.end(), is_closer);
    pairs_.resize(count);
  }
  std::sort(pairs_.begin(), pairs_.end(), is_closer);
}

SplittingLines::SplittingLines(CellAtHand& cell, bool fast)
    : cell_(cell), partition_(cell.partition()), fast_(fast) {}

/// Whether the best line is proved to be good enough.
bool SplittingLines::is_good_enough() {
  const double enough = fast_ ? kEnoughWhenFast : of_many() ? kEnoughOfMany : HUGE_VAL;
  const auto seems_good = [&] { return cell_.seems_finished() || seems_to_save(enough); };
  return seems_good() && cell_.prove_best() && seems_good();
}

/// The widest gap in the middle of the projections of the crossings at hand.
SplittingLines::Gap SplittingLines::widest_gap(const Point<2>& direction) {
  const int last_place = static_cast<int>(projected_.size()) - 1;
  const int from = static_cast<int>(kMiddle * last_place);
  const int to = std::max(from + 1, static_cast<int>(std::ceil((1 - kMiddle) * last_place)));
  projections_.clear();
  for (const Point<2>& at : projected_) projections_.push_back(dot(at, direction));
  if (last_place < kFewProjected) {
    // Their order cannot be foreseen: without branches.
    for (int i = 1; i <= last_place; ++i)
      for (int k = i; k > 0; --k) {
        double &below = projections_[k - 1], &above = projections_[k];
        std::tie(below, above) = std::pair(std::min(below, above), std::max(below, above));
      }
  } else {
    // Only the middle has to be in order.
    const auto first = projections_.begin() + from, last = projections_.begin() + to;
    std::nth_element(projections_.begin(), first, projections_.end());
    std::nth_element(first, last, projections_.end());
    std::sort(first, last);
  }
  int best = from;
  for (int i = from; i < to; ++i)
    if (projections_[i + 1] - projections_[i] > projections_[best + 1] - projections_[best])
      best = i;
  const double below = projections_[best], above = projections_[best + 1];
  return {direction, above - below, 0.5 * (below + above)};
}

void SplittingLines::propose_between_crossings() {
  const auto& crossings = cell_.cell().crossings;
  const int n = static_cast<int>(crossings.size());
  if (n < 2) return;
  const auto point = [&](int i) -> const Point<2>& {
    return partition_.crossings[crossings[i]].point;
  };
  projected_.clear();
  const int step = (n + kMostProjected - 1) / kMostProjected;
  for (int i = 0; i < n; i += step) projected_.push_back(point(i));
  std::array<Gap, 4> gaps{widest_gap({1, 0}), widest_gap({0, 1}), widest_gap({0.7071, 0.7072}),
                          widest_gap({0.7072, -0.7071})};
  // The first line that is not bad will do: the most promising one first.
  if (fast_)
    std::sort(gaps.begin(), gaps.end(),
              [](const Gap& a, const Gap& b) { return a.width > b.width; });
  for (const Gap& gap : gaps) {
    const Point<2>& d = gap.direction;
    cell_.propose(line_through({gap.middle * d[0], gap.middle * d[1]}, d));
    if (is_good_enough()) return;
  }
  if (n > kMaxBisected) return;
  pairs_.clear();
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) pairs_.push_back({i, j, square_distance(point(i), point(j))});
  keep_closest(kBisectedPairs);
  for (const Pair& p : pairs_) {
    cell_.propose(line_through(halfway(point(p.a), point(p.b)), minus(point(p.b), point(p.a))));
    if (is_good_enough()) return;
  }
}

void SplittingLines::propose_through_saddles(int curve) {
  int left = kSaddles;
  for (const int k : cell_.cell().saddles) {
    const Saddle& saddle = partition_.saddles[k];
    if (saddle.curve != curve) continue;
    cell_.propose(line_through(saddle.at, saddle.normal));
    if (--left == 0 || is_good_enough()) return;
  }
}

void SplittingLines::propose_between_branches() {
  const auto& points = cell_.points();
  const int n = static_cast<int>(points.size());
  int left = kSplitCurves;
  for (const auto& presence : cell_.curves()) {
    if (presence.ends < 4) continue;
    if (left-- == 0) return;
    const int c = presence.curve;
    propose_through_saddles(c);
    if (is_good_enough()) return;
    pairs_.clear();
    for (int i = 0; i < n; ++i) {
      if (points[i].curve != c) continue;
      // In the cyclic order of a curve's simple crossings, two of the same parity are never the
      // ends of one branch: between them would lie an odd number of others (thesis 3.2).
      for (int j = i + 1; j < n; ++j)
        if (points[j].curve == c && (points[j].index - points[i].index) % 2 == 0)
          pairs_.push_back({i, j, square_distance(points[i].at, points[j].at)});
    }
    keep_closest(fast_ ? kBranchPairsWhenFast : kBranchPairs);
    for (const Pair& p : pairs_) {
      cell_.propose(between(points[p.a], points[p.b]));
      if (is_good_enough()) return;
    }
    // Where a line has cut off the tip of a bend, the branches that leave the tip on both sides are
    // neighbours of different parity, and told apart by the bisector of their ends.
    Pair closest{-1, -1, HUGE_VAL};
    int last = -1;
    for (int i = n - 1; i >= 0 && last < 0; --i)
      if (points[i].curve == c) last = i;
    for (int i = 0; i < n; ++i) {
      if (points[i].curve != c) continue;
      const double gap = square_distance(points[last].at, points[i].at);
      if (gap < closest.gap) closest = {last, i, gap};
      last = i;
    }
    const Point<2>&a = points[closest.a].at, &b = points[closest.b].at;
    cell_.propose(line_through(halfway(a, b), minus(b, a)));
  }
}

void SplittingLines::propose_between_curves() {
  const auto& points = cell_.points();
  const int n = static_cast<int>(points.size());
  pairs_.clear();
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    if (points[i].curve != points[j].curve)
      pairs_.push_back({i, j, square_distance(points[i].at, points[j].at)});
  }
  keep_closest(kCurvePairs);
  for (const Pair& p : pairs_) {
    cell_.propose(between(points[p.a], points[p.b]));
    if (is_good_enough()) return;
  }
}

/// Moves the approached points towards their curves by a step of Newton's iteration.
void SplittingLines::project(double reach) {
  std::array<ValueAndGradient, 16> values;
  cell_.values_and_gradients(approached_, &values);
  for (std::size_t i = 0; i < approached_.size(); ++i) {
    BoundaryPoint& p = approached_[i];
    const auto& [value, g] = values[i];
    const double square = dot(g, g), step = value / square;
    for (int k = 0; k < 2; ++k) p.at[k] -= std::clamp(step * g[k], -reach, reach);
    const double scale = 1 / std::sqrt(square);
    p.normal = {g[0] * scale, g[1] * scale};
  }
}

/// Of two branches, from points 0 to 1 and from 2 to 3, some points are found on the way; proposes
/// the line with the widest gap between those of either branch, if there is one that separates
/// them.
void SplittingLines::separate(const std::array<int, 4>& ends) {
  constexpr int kOnBranch = 8, kCoarse = 16, kDirections = 256;
  static const auto directions = half_turn<kDirections>();
  const auto& points = cell_.points();
  const Box<2>& bounds = cell_.bounds();
  const Point<2> center = bounds.center();
  for (int branch = 0; branch < 2; ++branch) {
    const BoundaryPoint &a = points[ends[2 * branch]], &b = points[ends[2 * branch + 1]];
    // The tangents in the direction from a to b; at a it leads into the cell, at b out of it.
    Point<2> s{-a.normal[1], a.normal[0]}, t{-b.normal[1], b.normal[0]};
    const double length = std::sqrt(square_distance(a.at, b.at)),
                 inwards = dot(s, minus(center, a.at)) - dot(t, minus(center, b.at)),
                 scale = inwards < 0 ? -length : length;
    for (int i = 0; i < kOnBranch; ++i) {
      const double w = (i + 0.5) / kOnBranch, v = 1 - w;
      BoundaryPoint& p = approached_[branch * kOnBranch + i];
      p = a;
      for (int k = 0; k < 2; ++k)
        p.at[k] = v * v * (1 + 2 * w) * a.at[k] + w * w * (1 + 2 * v) * b.at[k] +
                  scale * v * w * (v * s[k] - w * t[k]);
    }
  }
  const double reach = 0.25 * (bounds.width(0) + bounds.width(1));
  for (int i = 0; i < kProjections; ++i) project(reach);
  double widest = 0, middle = 0;
  int best = 0;
  const auto try_direction = [&](int index) {
    const Point<2>& d = directions[index % kDirections];
    std::array<double, 2> least, most;
    for (int branch = 0; branch < 2; ++branch) {
      const double from = dot(d, points[ends[2 * branch]].at),
                   to = dot(d, points[ends[2 * branch + 1]].at);
      least[branch] = std::min(from, to);
      most[branch] = std::max(from, to);
      for (int i = 0; i < kOnBranch; ++i) {
        const double h = dot(d, approached_[branch * kOnBranch + i].at);
        least[branch] = std::min(least[branch], h);
        most[branch] = std::max(most[branch], h);
      }
    }
    for (int above = 0; above < 2; ++above) {
      const double gap = least[above] - most[1 - above];
      if (!(gap > widest)) continue;
      widest = gap;
      middle = most[1 - above] + 0.5 * gap;
      best = index;
    }
  };
  int step = kDirections / kCoarse;
  for (int i = 0; i < kCoarse; ++i) try_direction(i * step);
  if (!(widest > 0)) return;
  while ((step /= 2) > 0) {
    const int around = best;
    try_direction(around + step);
    try_direction(around + kDirections - step);
  }
  const Point<2>& normal = directions[best % kDirections];
  cell_.propose(line_through({middle * normal[0], middle * normal[1]}, normal));
}

/// Long branches that bend beside each other.
void SplittingLines::propose_between_two_branches() {
  const auto& points = cell_.points();
  if (points.size() != 4 || !cell_.cell().crossings.empty()) return;
  // Neighbours on the boundary are the ends of a branch.
  if (points[0].curve == points[1].curve && points[2].curve == points[3].curve)
    separate({0, 1, 2, 3});
  if (points[1].curve == points[2].curve && points[3].curve == points[0].curve)
    separate({1, 2, 3, 0});
}

/// Moves the points of pairs along their curves towards each other (thesis 6.1): tangential steps
/// that minimise the distance to first order, then back towards the curve. Two steps do: what
/// matters is a line that both branches leave on their own sides, not the closest pair.
void SplittingLines::approach() {
  const Box<2>& bounds = cell_.bounds();
  const double reach = 0.25 * (bounds.width(0) + bounds.width(1));
  for (int step = 0; step < kApproachSteps; ++step) {
    for (int i = 0; i < kApproachedPairs; ++i) {
      BoundaryPoint &a = approached_[i], &b = approached_[i + kApproachedPairs];
      const Point<2> d = minus(b.at, a.at);
      const Point<2> s{-a.normal[1], a.normal[0]}, t{-b.normal[1], b.normal[0]};
      // Minimise |d + v t - u s|^2.
      const double c = dot(s, t), p = dot(d, s), q = dot(d, t), det = 1 - c * c;
      double u, v;
      if (det > 1e-4) {
        const double inverse = 1 / det;
        u = (p - c * q) * inverse;
        v = (c * p - q) * inverse;
      } else {
        u = 0.5 * p;
        v = -0.5 * q;
      }
      u = std::clamp(u, -reach, reach);
      v = std::clamp(v, -reach, reach);
      a.at = {a.at[0] + u * s[0], a.at[1] + u * s[1]};
      b.at = {b.at[0] + v * t[0], b.at[1] + v * t[1]};
    }
    for (int i = 0; i < kProjections; ++i) project(reach);
    for (BoundaryPoint& p : approached_)
      for (int k = 0; k < 2; ++k) p.at[k] = std::clamp(p.at[k], bounds.lo[k], bounds.hi[k]);
  }
}

void SplittingLines::propose_closest_approach() {
  const auto& points = cell_.points();
  const int n = static_cast<int>(points.size());
  if (n > kMostApproached) return;
  pairs_.clear();
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      if (points[i].curve != points[j].curve || (points[j].index - points[i].index) % 2 == 0)
        pairs_.push_back({i, j, square_distance(points[i].at, points[j].at)});
  keep_closest(kApproachedPairs);
  if (pairs_.empty()) return;
  for (std::size_t i = 0; i < kApproachedPairs; ++i) {
    const Pair& pair = pairs_[std::min(i, pairs_.size() - 1)];
    approached_[i] = points[pair.a];
    approached_[i + kApproachedPairs] = points[pair.b];
  }
  approach();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    cell_.propose(between(approached_[i], approached_[i + kApproachedPairs]));
    if (is_good_enough()) return;
  }
}

/// The longest chord between two crossings of one curve; a < 0 if there is none.
SplittingLines::Pair SplittingLines::longest_chord() {
  const auto& points = cell_.points();
  Pair longest{-1, -1, -1};
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(points.size()); ++j) {
      if (points[i].curve != points[j].curve) continue;
      const double gap = square_distance(points[i].at, points[j].at);
      if (gap > longest.gap) longest = {i, j, gap};
    }
  return longest;
}

/// The longest chord, bisected at right angles.
bool SplittingLines::find_bisector() {
  const Pair longest = longest_chord();
  if (longest.a < 0) return false;
  const Point<2> a = cell_.points()[longest.a].at, b = cell_.points()[longest.b].at;
  for (const double w : {0.5, 0.43, 0.57}) {
    cell_.propose(line_through({a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1])}, minus(b, a)));
    if (cell_.prove_best()) return true;
  }
  return false;
}

/// Lines that hug a branch (thesis 3.5): past the point where the bisector of its longest chord
/// meets the curve, along the curve; and past the chord on the other side, along the chord.
void SplittingLines::propose_refinement() {
  const auto& points = cell_.points();
  const Pair longest = longest_chord();
  if (longest.a < 0) return;
  const Point<2> a = points[longest.a].at, b = points[longest.b].at, middle_point = halfway(a, b);
  const Point<2> along = unit(minus(b, a)), across{-along[1], along[0]};
  TiledFunction& f = partition_.tiles().about(points[longest.a].curve, cell_.bounds());
  const double length = std::sqrt(longest.gap);
  const auto at = [&](double t) {
    return Point<2>{middle_point[0] + t * across[0], middle_point[1] + t * across[1]};
  };
  // Newton's iteration along the bisector.
  double t = 0;
  for (int i = 0; i < 8; ++i) {
    const auto [value, gradient] = value_and_gradient(f, at(t));
    const double slope = dot(gradient, across);
    if (!(std::fabs(slope) > 0)) return;
    t -= value / slope;
    if (!(std::fabs(t) < length)) return;
  }
  const double side = t < 0 ? -1 : 1, margin = 0.1 * std::fabs(t) + 0.01 * length;
  const Point<2> beyond = at(t + side * margin);
  cell_.propose(line_through(beyond, value_and_gradient(f, beyond).gradient));
  cell_.propose(line_through(at(-side * margin), across));
}

/// Lines in all directions halfway between the closest boundary points. Of all these some line
/// often separates two long branches that bend beside each other, where no line derived from them
/// does.
void SplittingLines::propose_fans() {
  static const auto normals = half_turn<kFanLines>();
  const auto& points = cell_.points();
  const int n = static_cast<int>(points.size());
  pairs_.clear();
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      pairs_.push_back({i, j, square_distance(points[i].at, points[j].at)});
  keep_closest(kFanPairs);
  for (const Pair& p : pairs_) {
    const Point<2> middle = halfway(points[p.a].at, points[p.b].at);
    for (const Point<2>& normal : normals) cell_.propose(line_through(middle, normal));
  }
}

bool SplittingLines::seems_to_save(double cells) const {
  return cell_.best_score() <= cell_.expected_cells() - cells;
}

bool SplittingLines::find_best() {
  cell_.start_again();
  const auto& curves = cell_.curves();
  // Levels without progress: halve the longest branch, then give separation another chance.
  const bool pair_only =
      cell_.cell().crossings.empty() && cell_.points().size() == 4 &&
      std::count_if(curves.begin(), curves.end(), [](const auto& p) { return p.ends == 2; }) == 2;
  const int patience = pair_only ? 2 : 4, stall = cell_.cell().stall;
  if (stall > 0 && stall % (patience + 1) == patience) {
    // Subdivide; every third time, refine.
    if (stall / (patience + 1) % 3 == 2) propose_refinement();
    if (cell_.prove_best() || find_bisector()) return true;
  }
  propose_between_crossings();
  const bool crowded = of_many() && cell_.cell().crossings.size() >= kManyCrossings;
  if (!crowded && !is_good_enough()) propose_between_branches();
  if (!is_good_enough()) propose_between_curves();
  if (!is_good_enough()) propose_between_two_branches();
  if (!seems_to_save(fast_ || of_many() ? kPoorWhenFastOrMany : kPoor)) propose_closest_approach();
  if (!fast_ && stall > 0 && stall <= kFanLevels && !seems_to_save(kPoorWhenStalled))
    propose_fans();
  return cell_.prove_best() || find_bisector();
}

bool SplittingLines::find_through(const Point<2>& point) {
  cell_.start_again();
  // Normals 30 degrees apart, none of them along an axis.
  static const Point<2> normals[] = {{0.99916, 0.04091},  {0.84485, 0.53500},  {0.46416, 0.88575},
                                     {-0.04091, 0.99916}, {-0.53500, 0.84485}, {-0.88575, 0.46416}};
  for (const Point<2>& normal : normals) cell_.propose(line_through(point, normal));
  return cell_.prove_best();
}

bool SplittingLines::find_along(const Box<2>& box) {
  cell_.start_again();
  for (int axis = 0; axis < 2; ++axis) {
    Point<2> normal{0, 0};
    normal[axis] = 1;
    const double shift = 0.011 * box.width(axis);
    for (const double at :
         {box.lo[axis], box.hi[axis], box.lo[axis] - shift, box.hi[axis] + shift}) {
      Point<2> point{0, 0};
      point[axis] = at;
      cell_.propose(line_through(point, normal));
    }
  }
  return cell_.prove_best();
}

bool SplittingLines::find_any() {
  cell_.start_again();
  const auto& vertices = cell_.cell().vertices;
  Point<2> center{0, 0};
  for (const Place& v : vertices)
    for (int i = 0; i < 2; ++i) center[i] += v.center[i] / static_cast<double>(vertices.size());
  for (int i = 0; i < 40; ++i) {
    // Directions by the golden angle, points on spokes from the centre to the vertices.
    const double angle = 2.399963 * (i + 1);
    const Point<2>& corner = vertices[i % vertices.size()].center;
    const double w = 0.08 * (i % 7);
    const Point<2> at{center[0] + w * (corner[0] - center[0]),
                      center[1] + w * (corner[1] - center[1])};
    cell_.propose(line_through(at, {std::cos(angle), std::sin(angle)}));
    if (cell_.prove_best()) return true;
  }
  return false;
}

}  // namespace encase
