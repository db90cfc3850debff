// SPDX-License-Identifier: MIT
#include "3d/arc_matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "common/box_tests.hpp"
#include "common/interval.hpp"

namespace encase {

namespace {

/// From so many arcs of a pair on a cell is split without a look at how its ends could be paired.
constexpr std::size_t kManyArcs = 8;

/// Where a pair's curve enters or leaves a cell.
struct ArcEnd {
  int point = -1;
  bool enters = false;      ///< with w growing
  Sign along = Sign::Zero;  ///< of (grad f x grad g) . w
  Interval height;          ///< w . x
  std::array<int, 2> patches{-1, -1};
  std::array<int, 2> places{};  ///< on the patches' loops
};

Interval dot(const Point<3>& w, const std::array<Interval, 3>& x) {
  Interval sum;
  for (std::size_t i = 0; i < 3; ++i) sum = sum + Interval(w[i]) * x[i];
  return sum;
}

/// The sign of grad f x grad g along the normal of a facet's plane, at a crossing of the facet's
/// curves of f and g: that of the Jacobian in the chart, which turns like (u, v) seen from where
/// the normal points. If it is positive, then around the crossing, counter-clockwise, behind the
/// face where both are positive comes that with f < 0 < g, as for f = u, g = v.
Sign turning(const Arrangement& a, int vertex, int f, int g) {
  const std::vector<int> faces = a.faces_around(vertex);
  const auto sign = [&](std::size_t k, int curve) {
    const int face = faces[k % faces.size()];
    return a.faces[static_cast<std::size_t>(face)].signs[static_cast<std::size_t>(curve)];
  };
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (sign(k, f) == Sign::Positive && sign(k, g) == Sign::Positive)
      return sign(k + 1, f) == Sign::Negative ? Sign::Positive : Sign::Negative;
  return Sign::Zero;
}

/// The points of a box in a plane, in space.
std::array<Interval, 3> lift(const Box<2>& box, const PlaneChart& chart) {
  const auto [u, v] = chart.axes();
  const int solved = 3 - u - v;
  const auto& plane = chart.plane();
  std::array<Interval, 3> lifted;
  lifted[static_cast<std::size_t>(u)] = {box.lo[0], box.hi[0]};
  lifted[static_cast<std::size_t>(v)] = {box.lo[1], box.hi[1]};
  Interval height = Interval::enclose(Rational(-plane[3] / plane[solved]));
  for (const int i : {u, v}) {
    if (plane[i] == 0) continue;
    height = height + Interval::enclose(Rational(-plane[i] / plane[solved])) *
                          lifted[static_cast<std::size_t>(i)];
  }
  lifted[static_cast<std::size_t>(solved)] = height;
  return lifted;
}

class ArcMatcher {
 public:
  ArcMatcher(const PatchedCell& cell, Reading* reading) : cell_(cell), reading_(reading) {
    for (std::size_t p = 0; p < cell.loops.size(); ++p)
      for (std::size_t k = 0; k < cell.loops[p].points.size(); ++k)
        if (const int point = cell.loops[p].points[k]; point >= 0)
          place_of_[{reading->patches[p].surface, point}] = {static_cast<int>(p),
                                                             static_cast<int>(k)};
  }

  void run() {
    for (const int index : cell_.leaf.pairs) {
      const PairCertificate& pair = cell_.scene.pairs[static_cast<std::size_t>(index)];
      if (!match(index, pair)) return;
    }
    place_triple_points();
  }

 private:
  bool fail(Reading::Kind kind, const char* reason) {
    *reading_ = {};
    reading_->kind = kind;
    reading_->reason = reason;
    return false;
  }

  bool match(int index, const PairCertificate& pair) {
    std::vector<ArcEnd> in, out;
    for (const int f : cell_.boundary.facets())
      if (!collect_ends(f, pair, &in, &out)) return false;
    if (in.size() != out.size() || (!in.empty() && pair.kind == PairCertificate::Kind::Apart))
      return fail(Reading::Kind::Inconsistent, "a curve enters a cell more often than it leaves");
    if (in.size() > kManyArcs)
      return fail(Reading::Kind::Ambiguous, "many arcs of a curve pass through a cell");
    partners_.assign(in.size(), -1);
    found_ = 0;
    search(in, out, 0);
    if (found_ == 0)
      return fail(Reading::Kind::Inconsistent, "the ends of a curve cannot be paired");
    if (found_ > 1)
      return fail(Reading::Kind::Ambiguous, "the ends of a curve can be paired in several ways");
    for (std::size_t i = 0; i < in.size(); ++i) {
      SurfaceArc arc;
      arc.surfaces = pair.surfaces;
      arc.patches = in[i].patches;
      arc.ends = {in[i].point, out[static_cast<std::size_t>(best_[i])].point};
      arc.certificate = index;
      reading_->arcs.push_back(std::move(arc));
    }
    return true;
  }

  bool collect_ends(int facet_index, const PairCertificate& pair, std::vector<ArcEnd>* in,
                    std::vector<ArcEnd>* out) {
    const Facet& facet = cell_.boundary.facet(facet_index);
    const int f = cell_.boundary.curve_of(facet_index, pair.surfaces[0]),
              g = cell_.boundary.curve_of(facet_index, pair.surfaces[1]);
    if (f < 0 || g < 0) return true;
    const Arrangement& a = facet.arrangement;
    for (std::size_t v = 0; v < a.vertices.size(); ++v) {
      const Arrangement::Vertex& vertex = a.vertices[v];
      if (vertex.kind != Arrangement::Vertex::Kind::Crossing) continue;
      const Crossing& crossing = facet.encasement.crossings[static_cast<std::size_t>(vertex.index)];
      if (crossing.curves != std::array{f, g}) continue;
      ArcEnd end;
      end.point = facet.points[v];
      for (std::size_t i = 0; i < 2; ++i) {
        const auto place = place_of_.find({pair.surfaces[i], end.point});
        if (place == place_of_.end())
          return fail(Reading::Kind::Inconsistent, "the end of a curve lies on no loop");
        end.patches[i] = place->second[0];
        end.places[i] = place->second[1];
      }
      const auto at = lift(crossing.box, cell_.scene.complex.charts.of(facet.plane));
      end.height = dot(pair.direction, at);
      end.along = sign_along(pair, at);
      if (end.along == Sign::Zero)
        return fail(Reading::Kind::Ambiguous, "a curve runs across its direction on a facet");
      const Sign through = turning(a, static_cast<int>(v), f, g);
      const bool outward = (through == Sign::Positive) == cell_.boundary.is_below(facet_index);
      end.enters = outward != (end.along == Sign::Positive);
      (end.enters ? in : out)->push_back(end);
    }
    return true;
  }

  /// The sign of (grad f x grad g) . w; Zero if it is not told.
  Sign sign_along(const PairCertificate& pair, const std::array<Interval, 3>& at) const {
    if (pair.kind == PairCertificate::Kind::Local) return Sign::Positive;
    if (pair.kind == PairCertificate::Kind::Apart) return Sign::Positive;
    Box<3> box;
    for (std::size_t i = 0; i < 3; ++i) {
      // With some extent in every direction.
      box.lo[i] = round_down(at[i].lo);
      box.hi[i] = round_up(at[i].hi);
    }
    const auto sign = sign_on_box(cell_.scene.directions[static_cast<std::size_t>(pair.critical)],
                                  box, cell_.scene.complex.kernel);
    return sign.value_or(Sign::Zero);
  }

  /// Whether the ends of two arcs alternate on the loop of a patch.
  static bool alternate(const ArcEnd& a, const ArcEnd& b, const ArcEnd& c, const ArcEnd& d) {
    for (std::size_t i = 0; i < 2; ++i) {
      if (a.patches[i] != c.patches[i]) continue;
      const auto between = [&](int x) {
        const auto [lo, hi] = std::minmax(a.places[i], b.places[i]);
        return lo < x && x < hi;
      };
      if (between(c.places[i]) != between(d.places[i])) return true;
    }
    return false;
  }

  /// All ways to pair the ends from `first` on; stops at the second one that is found.
  void search(const std::vector<ArcEnd>& in, const std::vector<ArcEnd>& out, std::size_t first) {
    if (first == in.size()) {
      best_ = partners_;
      ++found_;
      return;
    }
    for (std::size_t j = 0; j < out.size() && found_ < 2; ++j) {
      const ArcEnd &a = in[first], &b = out[j];
      const int partner = static_cast<int>(j);
      const auto last = partners_.begin() + static_cast<std::ptrdiff_t>(first);
      if (a.patches != b.patches || a.along != b.along || a.height.lo >= b.height.hi ||
          std::find(partners_.begin(), last, partner) != last)
        continue;
      bool crosses = false;
      for (std::size_t i = 0; i < first; ++i)
        crosses = crosses || alternate(a, b, in[i], out[static_cast<std::size_t>(partners_[i])]);
      if (crosses) continue;
      partners_[first] = partner;
      search(in, out, first + 1);
      partners_[first] = -1;
    }
  }

  /// A triple point lies on an arc of each of its pairs; along the arc w tells their order.
  void place_triple_points() {
    struct Placed {
      Interval height;
      int point;
    };
    std::vector<std::vector<Placed>> on_arc(reading_->arcs.size());
    for (const int t : cell_.leaf.triple_points) {
      if (!cell_.scene.inside[static_cast<std::size_t>(t)]) continue;
      const TriplePoint& triple = cell_.scene.triple_points[static_cast<std::size_t>(t)];
      const auto& [f, g, h] = triple.surfaces;
      for (const auto& pair : {std::array{f, g}, std::array{f, h}, std::array{g, h}}) {
        int arc = -1;
        for (std::size_t k = 0; k < reading_->arcs.size(); ++k) {
          if (reading_->arcs[k].surfaces != pair) continue;
          if (arc >= 0) {
            fail(Reading::Kind::Ambiguous, "a triple point could lie on several arcs");
            return;
          }
          arc = static_cast<int>(k);
        }
        if (arc < 0) {
          fail(Reading::Kind::Inconsistent, "a triple point lies on no arc");
          return;
        }
        const PairCertificate& certificate = cell_.scene.pairs[static_cast<std::size_t>(
            reading_->arcs[static_cast<std::size_t>(arc)].certificate)];
        std::array<Interval, 3> at;
        for (std::size_t i = 0; i < 3; ++i) at[i] = {triple.box.lo[i], triple.box.hi[i]};
        on_arc[static_cast<std::size_t>(arc)].push_back({dot(certificate.direction, at), t});
      }
    }
    for (std::size_t k = 0; k < on_arc.size(); ++k) {
      auto& placed = on_arc[k];
      std::sort(placed.begin(), placed.end(),
                [](const Placed& a, const Placed& b) { return a.height.lo < b.height.lo; });
      for (std::size_t i = 0; i < placed.size(); ++i) {
        if (i > 0 && placed[i - 1].height.hi >= placed[i].height.lo) {
          fail(Reading::Kind::Ambiguous, "the order of triple points on an arc is not told");
          return;
        }
        reading_->arcs[k].triple_points.push_back(placed[i].point);
      }
    }
  }

  const PatchedCell& cell_;
  Reading* reading_;
  std::map<std::pair<int, int>, std::array<int, 2>> place_of_;  ///< by surface and point
  std::vector<int> partners_, best_;
  int found_ = 0;
};

}  // namespace

void match_arcs(const PatchedCell& cell, Reading* reading) { ArcMatcher(cell, reading).run(); }

}  // namespace encase
