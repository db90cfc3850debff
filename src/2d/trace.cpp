// SPDX-License-Identifier: MIT
#include "2d/trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "2d/curve_tracer.hpp"
#include "common/filtered_function.hpp"

namespace encase {
namespace {

constexpr int kMostPieces = 100000;  // of a polyline

/// What pictures may ask for.
double sensible(const Encasement& encasement, double tolerance) {
  const Box<2> box = encasement.region_used.bounding_box();
  double size = 0;
  for (int axis = 0; axis < 2; ++axis)
    size = std::max({size, std::fabs(box.lo[axis]), std::fabs(box.hi[axis])});
  return tolerance > 0x1p-30 * size ? tolerance : 0x1p-30 * size;
}

Polyline polyline_of(const CurvePath& path) {
  Polyline line;
  for (const CurvePoint& p : path.points) line.push_back(p.point);
  return line;
}

/// Joins branches of one curve that go on in each other.
class Chains {
 public:
  using Strand = Arrangement::Strand;

  void add(const Strand& strand) {
    const int id = static_cast<int>(strands_.size());
    strands_.push_back(strand);
    used_.push_back(false);
    at_[strand.from].push_back(id);
    at_[strand.to].push_back(id);
  }

  std::vector<std::vector<Strand>> join() {
    std::vector<std::vector<Strand>> chains;
    for (int id = 0; id < static_cast<int>(strands_.size()); ++id) {
      if (used_[id]) continue;
      // Back to the beginning of the chain, or around a loop to where we are; then forwards.
      int first = id, end = 0;
      while (true) {
        const auto before = neighbour(first, end);
        if (!before || before->first == id) break;
        first = before->first;
        end = 1 - before->second;
      }
      chains.push_back(walk(first, end));
    }
    return chains;
  }

 private:
  int end_of(int id, int end) const { return end == 0 ? strands_[id].from : strands_[id].to; }

  /// The strand that goes on at an end of a strand, with its own end there.
  std::optional<std::pair<int, int>> neighbour(int id, int end) const {
    const int crossing = end_of(id, end);
    const std::vector<int>& here = at_.at(crossing);
    if (here.size() != 2 || here[0] == here[1]) return std::nullopt;
    const int other = here[0] == id ? here[1] : here[0];
    return std::pair(other, end_of(other, 0) == crossing ? 0 : 1);
  }

  std::vector<Strand> walk(int id, int start) {
    std::vector<Strand> chain;
    while (true) {
      used_[id] = true;
      chain.push_back(strands_[id]);
      if (start == 1) std::swap(chain.back().from, chain.back().to);
      const auto next = neighbour(id, 1 - start);
      if (!next || used_[next->first]) return chain;
      id = next->first;
      start = next->second;
    }
  }

  std::vector<Strand> strands_;
  std::vector<bool> used_;
  std::map<int, std::vector<int>> at_;  ///< strands that end at a line crossing
};

}  // namespace

Polyline trace_branch(const Encasement& encasement, int cell, const Branch& branch,
                      double tolerance) {
  return polyline_of(CurveTracer(encasement, branch.curve, sensible(encasement, tolerance))
                         .edge({{cell, -1, branch.from, branch.to}}, kMostPieces));
}

std::vector<Polyline> trace_curve(const Encasement& encasement, int curve, double tolerance) {
  Chains chains;
  for (std::size_t k = 0; k < encasement.cells.size(); ++k)
    for (const Branch& branch : encasement.cells[k].branches)
      if (branch.curve == curve) chains.add({static_cast<int>(k), -1, branch.from, branch.to});
  CurveTracer tracer(encasement, curve, sensible(encasement, tolerance));
  std::vector<Polyline> lines;
  for (const auto& chain : chains.join())
    lines.push_back(polyline_of(tracer.edge(chain, kMostPieces)));
  return lines;
}

std::vector<Polyline> trace_edges(const Encasement& encasement, const Arrangement& arrangement,
                                  double tolerance) {
  std::vector<std::unique_ptr<CurveTracer>> tracers(encasement.curves.size());
  const auto tracer = [&](int curve) -> CurveTracer& {
    auto& made = tracers[curve];
    if (!made)
      made = std::make_unique<CurveTracer>(encasement, curve, sensible(encasement, tolerance));
    return *made;
  };
  const auto end_of_side = [&](int vertex) {
    const Arrangement::Vertex& v = arrangement.vertices[vertex];
    if (v.kind == Arrangement::Vertex::Kind::Corner) return v.point;
    return tracer(encasement.line_crossings[v.index].curve).at_line_crossing(v.index).point;
  };
  std::vector<Polyline> lines;
  for (std::size_t k = 0; k < arrangement.edges.size(); ++k) {
    const Arrangement::Edge& edge = arrangement.edges[k];
    Polyline& line = lines.emplace_back();
    if (edge.curve < 0)
      for (const std::size_t h : {2 * k, 2 * k + 1})
        line.push_back(end_of_side(arrangement.half_edges[h].origin));
    for (const Arrangement::Strand& strand : edge.strands) {
      const CurvePath path = tracer(edge.curve).edge({strand}, kMostPieces);
      const bool goes_on = !line.empty();
      for (std::size_t i = goes_on ? 1 : 0; i < path.points.size(); ++i)
        line.push_back(path.points[i].point);
    }
  }
  return lines;
}

std::vector<Polyline> sketch_curve(const Encasement& encasement, int cell, int curve,
                                   double spacing) {
  constexpr int kMostSteps = 200;
  Polyline polygon;
  for (const Vertex& vertex : encasement.cells[cell].vertices) polygon.push_back(vertex.point);
  if (polygon.empty()) return {};
  Box<2> box{polygon.front(), polygon.front()};
  for (const Point<2>& p : polygon) box = hull(box, {p, p});
  std::array<int, 2> steps;
  for (int axis = 0; axis < 2; ++axis)
    steps[axis] = static_cast<int>(std::clamp(box.width(axis) / spacing, 4.0, 1.0 * kMostSteps));
  const auto at = [&](double i, double j) {
    return Point<2>{box.lo[0] + i / steps[0] * box.width(0),
                    box.lo[1] + j / steps[1] * box.width(1)};
  };
  const auto inside = [&](const Point<2>& p) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Point<2>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      if ((b[0] - a[0]) * (p[1] - a[1]) < (b[1] - a[1]) * (p[0] - a[0])) return false;
    }
    return true;
  };
  const FilteredFunction<2> f(encasement.curves[curve].function);
  std::vector<double> values;
  for (int j = 0; j <= steps[1]; ++j)
    for (int i = 0; i <= steps[0]; ++i) values.push_back(f.approximate(at(i, j)));
  const auto value = [&](int i, int j) { return values[j * (steps[0] + 1) + i]; };

  // In each triangle of the grid the linear interpolant's zero set is one segment or none.
  std::vector<Polyline> segments;
  const auto add = [&](const std::array<std::array<int, 2>, 3>& corners) {
    Polyline ends;
    for (int k = 0; k < 3; ++k) {
      const auto &p = corners[k], &q = corners[(k + 1) % 3];
      const double vp = value(p[0], p[1]), vq = value(q[0], q[1]);
      if ((vp < 0) == (vq < 0)) continue;
      const double t = vp / (vp - vq);
      ends.push_back(at(p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])));
    }
    if (ends.size() == 2 && inside(ends[0]) && inside(ends[1])) segments.push_back(ends);
  };
  for (int j = 0; j < steps[1]; ++j)
    for (int i = 0; i < steps[0]; ++i) {
      add({{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
      add({{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
    }
  return segments;
}

}  // namespace encase
