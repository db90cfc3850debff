// SPDX-License-Identifier: MIT
#include "encase/intersection_curves.hpp"

#include <algorithm>
#include <optional>

namespace encase {

namespace {

/// One end of an arc; `end` as in SurfaceArc::ends.
struct ArcEnd {
  int cell = -1;
  int arc = -1;
  int end = 0;
};

/// The arcs of an encasement, joined at their ends.
class ArcGraph {
 public:
  explicit ArcGraph(const SurfaceEncasement& encasement)
      : encasement_(encasement), ends_(encasement.facet_points.size()) {
    for (std::size_t c = 0; c < encasement.cells.size(); ++c) {
      const auto& arcs = encasement.cells[c].arcs;
      used_.emplace_back(arcs.size(), false);
      for (std::size_t k = 0; k < arcs.size(); ++k)
        for (int end = 0; end < 2; ++end)
          ends_[arcs[k].ends[end]].push_back({static_cast<int>(c), static_cast<int>(k), end});
    }
  }

  std::vector<IntersectionCurve> curves() {
    std::vector<IntersectionCurve> result;
    for (const bool closed : {false, true})
      for (std::size_t c = 0; c < used_.size(); ++c)
        for (std::size_t k = 0; k < used_[c].size(); ++k)
          for (int end = 0; end < 2; ++end) {
            const ArcEnd start{static_cast<int>(c), static_cast<int>(k), end};
            if (!used_[c][k] && (closed || !other_at(start)))
              result.push_back(follow(start, closed));
          }
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.surfaces < b.surfaces; });
    return result;
  }

 private:
  const SurfaceArc& arc_of(const ArcEnd& e) const { return encasement_.cells[e.cell].arcs[e.arc]; }

  /// The end of another arc at the same facet point.
  std::optional<ArcEnd> other_at(const ArcEnd& e) const {
    for (const ArcEnd& other : ends_[arc_of(e).ends[e.end]])
      if (other.cell != e.cell || other.arc != e.arc) return other;
    return std::nullopt;
  }

  /// Whether the facet point lies between two cells.
  bool between_cells(int facet_point) const {
    const int plane = encasement_.facet_points[facet_point].planes[0];
    return plane >= static_cast<int>(encasement_.region_used.sides.size());
  }

  IntersectionCurve follow(ArcEnd from, bool closed) {
    IntersectionCurve curve;
    curve.surfaces = arc_of(from).surfaces;
    curve.closed = closed;
    curve.facet_points.push_back(arc_of(from).ends[from.end]);
    for (std::optional<ArcEnd> next = from; next && !used_[next->cell][next->arc];) {
      from = *next;
      used_[from.cell][from.arc] = true;
      curve.arcs.push_back({from.cell, from.arc, from.end == 0});
      const ArcEnd far{from.cell, from.arc, 1 - from.end};
      curve.facet_points.push_back(arc_of(far).ends[far.end]);
      next = other_at(far);
    }
    if (!closed)
      curve.cut_off = {between_cells(curve.facet_points.front()),
                       between_cells(curve.facet_points.back())};
    return curve;
  }

  const SurfaceEncasement& encasement_;
  std::vector<std::vector<ArcEnd>> ends_;  ///< at every facet point
  std::vector<std::vector<bool>> used_;    ///< every cell's arcs
};

}  // namespace

std::vector<IntersectionCurve> intersection_curves(const SurfaceEncasement& encasement) {
  return ArcGraph(encasement).curves();
}

}  // namespace encase
