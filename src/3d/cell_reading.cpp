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

/// A cut through the smallest loop of a surface with holes in the cell: it opens one of them.
std::optional<CutHint> cut_through(const std::vector<BoundaryLoop>& loops,
                                   const std::vector<FacetPoint>& points) {
  std::optional<Box<3>> smallest;
  for (const BoundaryLoop& loop : loops) {
    std::optional<Box<3>> box;
    for (const int p : loop.points) {
      if (p < 0) continue;
      const Point<3>& at = points[static_cast<std::size_t>(p)].point;
      box = box ? hull(*box, Box<3>{at, at}) : Box<3>{at, at};
    }
    if (box && (!smallest || box->largest_width() < smallest->largest_width())) smallest = box;
  }
  if (!smallest) return std::nullopt;
  CutHint hint;
  for (int i = 1; i < 3; ++i)
    if (smallest->width(i) > smallest->width(hint.axis)) hint.axis = i;
  const double quarter = 0.25 * smallest->width(hint.axis);
  hint.lo = smallest->lo[hint.axis] + quarter;
  hint.hi = smallest->hi[hint.axis] - quarter;
  if (!(hint.lo < hint.hi)) return std::nullopt;
  return hint;
}

/// Where to cut a cell in which a closed sphere is not alone: between the poles of two spheres, at
/// the widest gap, or through a sphere's pole. (A plane through the pole is made of field lines, so
/// it is transversal to the sphere and cuts it into two discs.)
CutHint cut_by_poles(const std::vector<RationalPoint<3>>& poles, const Box<3>& box) {
  CutHint hint;
  double widest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> places;
    for (const RationalPoint<3>& pole : poles)
      places.push_back(nearest_double(pole[static_cast<std::size_t>(axis)]));
    std::sort(places.begin(), places.end());
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const double gap = places[k + 1] - places[k];
      if (!(gap > widest)) continue;
      widest = gap;
      hint = {axis, places[k] + 0.25 * gap, places[k + 1] - 0.25 * gap};
    }
  }
  if (widest > 0x1p-10 * box.largest_width()) return hint;
  for (int axis = 1; axis < 3; ++axis)
    if (box.width(axis) > box.width(hint.axis)) hint.axis = axis;
  const double at = nearest_double(poles.front()[static_cast<std::size_t>(hint.axis)]);
  const double reach = 0x1p-10 * box.width(hint.axis);
  return {hint.axis, at - reach, at + reach};
}

class CellReader {
 public:
  CellReader(const ReadingScene& scene, int cell, const SpacePartition::Leaf& leaf,
             const std::vector<int>& facets)
      : scene_(scene), leaf_(leaf), boundary_(scene.complex, cell, facets) {}

  Reading run() {
    std::vector<BoundaryLoop> all_loops;
    std::vector<RationalPoint<3>> poles;  // of closed spheres
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
        Reading result = failed(Reading::Kind::Ambiguous, "a patch has a hole");
        result.hint = cut_through(*loops, scene_.points);
        return result;
      }
      if (is_sphere) {
        reading.patches.push_back({graph.surface, {}});
        all_loops.emplace_back();
        poles.push_back(FieldLines(graph).pole());
      }
      for (BoundaryLoop& loop : *loops) {
        reading.patches.push_back({graph.surface, loop.edges});
        all_loops.push_back(std::move(loop));
      }
    }
    if (!poles.empty() && reading.patches.size() > 1) {
      Reading result = failed(Reading::Kind::Ambiguous,
                              "a closed sphere shares its cell with another piece of a surface");
      result.hint = cut_by_poles(poles, leaf_.box);
      return result;
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
