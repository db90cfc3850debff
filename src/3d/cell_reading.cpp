// SPDX-License-Identifier: MIT
#include "3d/cell_reading.hpp"

#include <algorithm>
#include <utility>

#include "3d/arc_matching.hpp"

namespace encase {

namespace {

Reading failed(Reading::Kind kind, std::string reason) {
  Reading reading;
  reading.kind = kind;
  reading.reason = std::move(reason);
  return reading;
}

/// The lines of a graph certificate: along V(x) = direction + spread (x - center), parallel, or
/// through a pole.
class FieldLines {
 public:
  explicit FieldLines(const GraphCertificate& certificate) {
    for (std::size_t i = 0; i < 3; ++i) direction_[i] = Rational(certificate.direction[i]);
    spread_ = Rational(certificate.spread);
    if (spread_ == 0) return;
    for (std::size_t i = 0; i < 3; ++i)
      pole_[i] = Rational(certificate.center[i]) - direction_[i] / spread_;
  }

  bool parallel() const { return spread_ == 0; }
  /// Only of lines that are not parallel.
  const RationalPoint<3>& pole() const { return pole_; }
  Sign spread() const { return sign_of(sgn(spread_)); }

  /// Whether the pole lies in the interior of the half space on the inner side of a plane.
  bool pole_is_inside(const Plane& plane, bool is_below) const {
    const auto c = plane.exact();
    const int side = sgn(Rational(c[0] * pole_[0] + c[1] * pole_[1] + c[2] * pole_[2] + c[3]));
    return is_below ? side < 0 : side > 0;
  }

  /// Whether V points out of the cell where it meets a plane; the pole is not in the interior of
  /// the cell. What the plane is parallel to is moved off it: parallel lines in the direction (1,
  /// e, e^2), a pole out of the cell. A small enough e keeps the certificate valid, and serves all
  /// planes.
  bool leaves_through(const Plane& plane, bool is_below) const {
    if (!parallel()) return pole_is_inside(plane, is_below) ? spread_ > 0 : spread_ < 0;
    const auto c = plane.exact();
    int side = sgn(Rational(c[0] * direction_[0] + c[1] * direction_[1] + c[2] * direction_[2]));
    for (std::size_t i = 0; i < 3 && side == 0; ++i) side = sgn(c[i]);
    return is_below ? side > 0 : side < 0;
  }

 private:
  std::array<Rational, 3> direction_, pole_;
  Rational spread_;
};

/// A cut between two loops that lie apart along a coordinate, where they are farthest apart.
std::optional<CutHint> cut_between(const std::vector<BoundaryLoop>& loops,
                                   const std::vector<FacetPoint>& points) {
  std::vector<Box<3>> boxes;
  for (const BoundaryLoop& loop : loops) {
    std::optional<Box<3>> box;
    for (const int p : loop.points) {
      if (p < 0) continue;
      const Point<3>& at = points[static_cast<std::size_t>(p)].point;
      box = box ? hull(*box, Box<3>{at, at}) : Box<3>{at, at};
    }
    if (box) boxes.push_back(*box);
  }
  std::optional<CutHint> best;
  for (const Box<3>& a : boxes)
    for (const Box<3>& b : boxes)
      for (int i = 0; i < 3; ++i)
        if (a.hi[i] < b.lo[i] && (!best || b.lo[i] - a.hi[i] > best->hi - best->lo))
          best = {i, a.hi[i], b.lo[i]};
  return best;
}

class CellReader {
 public:
  CellReader(const ReadingScene& scene, int cell, const SpacePartition::Leaf& leaf,
             const std::vector<int>& facets)
      : scene_(scene), leaf_(leaf), boundary_(scene.complex, cell, facets) {}

  Reading run() {
    std::vector<BoundaryLoop> all_loops;
    Reading reading;
    for (const int index : leaf_.graphs) {
      const GraphCertificate& graph = scene_.graphs[static_cast<std::size_t>(index)];
      auto loops = boundary_.loops(graph.surface);
      if (!loops) return failed(Reading::Kind::Inconsistent, "a surface's arcs do not form loops");
      bool is_sphere = false;
      if (loops->empty()) {
        const auto sphere = is_closed_sphere(graph);
        if (!sphere) return failed(Reading::Kind::Ambiguous, "a pole lies on a surface");
        is_sphere = *sphere;
      } else if (loops->size() > 1 && !all_discs(graph, static_cast<int>(loops->size()))) {
        Reading result = failed(Reading::Kind::Ambiguous, "a patch is no disc");
        result.hint = cut_between(*loops, scene_.points);
        return result;
      }
      if (is_sphere) {
        reading.patches.push_back({graph.surface, {}});
        all_loops.emplace_back();
      }
      for (BoundaryLoop& loop : *loops) {
        reading.patches.push_back({graph.surface, loop.edges});
        all_loops.push_back(std::move(loop));
      }
    }
    match_arcs({scene_, leaf_, boundary_, all_loops}, &reading);
    return reading;
  }

 private:
  const Plane& plane_of(int facet) const {
    return scene_.complex.planes[static_cast<std::size_t>(boundary_.facet(facet).plane)];
  }

  bool pole_is_inside(const FieldLines& lines) const {
    const std::vector<int>& facets = boundary_.facets();
    return !lines.parallel() && std::all_of(facets.begin(), facets.end(), [&](int f) {
      return lines.pole_is_inside(plane_of(f), boundary_.is_below(f));
    });
  }

  /// Of a surface without loops: whether it is a closed sphere; else it is absent.
  std::optional<bool> is_closed_sphere(const GraphCertificate& graph) const {
    const FieldLines lines(graph);
    if (!pole_is_inside(lines)) return false;
    const Sign at_pole = scene_.complex.surfaces[static_cast<std::size_t>(graph.surface)].sign_at(
        lines.pole(), scene_.complex.kernel);
    if (at_pole == Sign::Zero) return std::nullopt;
    const Sign at_boundary = boundary_.sign_at_corner(graph.surface, boundary_.facets().front());
    return at_pole == -lines.spread() && at_boundary == lines.spread();
  }

  /// Whether a surface with several loops is as many discs.
  bool all_discs(const GraphCertificate& graph, int loops) const {
    const FieldLines lines(graph);
    if (pole_is_inside(lines))
      return boundary_.components(graph.surface, lines.spread(), [](int) { return true; }) == loops;
    const auto leaves = [&](int f) {
      return lines.leaves_through(plane_of(f), boundary_.is_below(f));
    };
    const int above = boundary_.components(graph.surface, Sign::Positive, leaves);
    const int below =
        boundary_.components(graph.surface, Sign::Negative, [&](int f) { return !leaves(f); });
    return above + below - 1 == loops;
  }

  const ReadingScene& scene_;
  const SpacePartition::Leaf& leaf_;
  CellBoundary boundary_;
};

}  // namespace

Reading read_cell(const ReadingScene& scene, int cell, const SpacePartition::Leaf& leaf,
                  const std::vector<int>& facets) {
  return CellReader(scene, cell, leaf, facets).run();
}

}  // namespace encase
