// SPDX-License-Identifier: MIT
#include "2d/curve_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "2d/partition.hpp"
#include "common/line_roots.hpp"
#include "common/segments.hpp"
#include "encase/crossing.hpp"

namespace encase {
namespace {

/// Room for what stands out of the region.
Box<2> around(const Box<2>& box) {
  Box<2> result = box;
  for (int i = 0; i < 2; ++i) {
    result.lo[i] -= 0x1p-5 * box.width(i);
    result.hi[i] += 0x1p-5 * box.width(i);
  }
  return result;
}

}  // namespace

CurveTracer::CurveTracer(const Encasement& encasement, int curve, double tolerance)
    : encasement_(encasement),
      tolerance_(tolerance),
      polynomial_(encasement.curves[curve].function) {
  const Box<2> box = encasement.region_used.bounding_box();
  for (int i = 0; i < 2; ++i) size_ = std::max({size_, std::fabs(box.lo[i]), std::fabs(box.hi[i])});
  tiles_ = std::make_unique<TiledFunction>(polynomial_, around(box), kernel_);
  follower_ = std::make_unique<CurveFollower>(*tiles_, kernel_, size_);
}

const CurvePoint& CurveTracer::at_line_crossing(int line_crossing) {
  const auto [found, is_new] = ends_.try_emplace(line_crossing);
  if (is_new) {
    const LineCrossing& c = encasement_.line_crossings[line_crossing];
    const Line& line = encasement_.lines[c.line];
    LineRoot root{c.lo, c.hi, c.lo + 0.5 * (c.hi - c.lo)};
    const double goal = std::max(tolerance_, follower_->least_goal());
    const double width = std::max(0x1p-50 * size_, std::min(0x1p-43 * size_, 0x1p-10 * goal));
    for (int k = 0; k < 100 && root.hi - root.lo > width; ++k)
      if (!refine_on_line(*tiles_, line, &root, kernel_)) break;
    const auto at = point_on_line(line, Interval(root.lo, root.hi));
    found->second = {{at[0].mid(), at[1].mid()}, {{at[0].lo, at[1].lo}, {at[0].hi, at[1].hi}}};
  }
  return found->second;
}

CurvePoint CurveTracer::at_crossing(int crossing) const {
  const Crossing& c = encasement_.crossings[crossing];
  CurvePoint result{c.point, c.box};
  constexpr int kFraction = 48;
  if (c.box.largest_width() > std::ldexp(size_, 2 - kFraction)) {
    const auto finer = refine(encasement_, crossing, kFraction - std::ilogb(size_));
    if (finer)
      for (int i = 0; i < 2; ++i) {
        result.box.lo[i] = Interval::enclose(finer.value().lo[i]).lo;
        result.box.hi[i] = Interval::enclose(finer.value().hi[i]).hi;
      }
  }
  return result;
}

/// The direction of a branch (see CurvePiece) that enters a cell at a line crossing; 0 if it is not
/// told: the cell has no corner to tell the side of the line, or the sign at the interval's end is
/// not proved.
int CurveTracer::direction_into(int cell, int line_crossing) {
  const LineCrossing& c = encasement_.line_crossings[line_crossing];
  const Line& line = encasement_.lines[c.line];
  Sign where = Sign::Zero;
  for (const Vertex& v : encasement_.cells[cell].vertices)
    if (where == Sign::Zero && v.line_in != v.line_out && v.line_in != c.line &&
        v.line_out != c.line)
      where = side(line, encasement_.lines[v.line_in], encasement_.lines[v.line_out], kernel_);
  if (where == Sign::Zero) return 0;
  // Who enters has the boundary that lies ahead, counter-clockwise, to the right.
  const Sign at_end = sign_on_line(*tiles_, line, c.hi, kernel_);
  if (at_end == Sign::Zero) return 0;
  const bool grows = at_end == Sign::Positive;
  return grows == parameter_grows(line, where == Sign::Positive) ? -1 : 1;
}

CurvePath CurveTracer::into_cell(int cell, int from, const CurvePoint& to, int most) {
  const CurvePoint& start = at_line_crossing(from);
  const int direction = direction_into(cell, from);
  return follower_->follow(start, to, direction, tolerance_, direction == 0 ? 0 : most);
}

CurvePath CurveTracer::strand(const Arrangement::Strand& strand, int most) {
  const int start = strand.from >= 0 ? strand.from : strand.to;
  const int end = start == strand.from ? strand.to : strand.from;
  CurvePath path = into_cell(strand.cell, start, at_end(strand, end), most);
  if (start != strand.from) path.reverse();
  return path;
}

/// Where a strand begins or ends.
CurvePoint CurveTracer::at_end(const Arrangement::Strand& strand, int line_crossing) {
  return line_crossing >= 0 ? at_line_crossing(line_crossing)
                            : at_crossing(encasement_.cells[strand.cell].crossing);
}

CurvePath CurveTracer::edge(const std::vector<Arrangement::Strand>& strands, int most) {
  const Arrangement::Strand &first = strands.front(), &last = strands.back();
  const int direction = first.from >= 0 ? direction_into(first.cell, first.from)
                                        : -direction_into(first.cell, first.to);
  std::vector<CurvePoint> stations = {at_end(first, first.from), at_end(last, last.to)};
  // A loop is walked in two parts, so that no part ends where it begins.
  if (first.from >= 0 && first.from == last.to && strands.size() > 1)
    stations.insert(stations.begin() + 1, at_line_crossing(strands[strands.size() / 2].from));
  CurvePath path;
  for (std::size_t k = 1; k < stations.size(); ++k) {
    const int rest = most - static_cast<int>(path.pieces.size());
    path.append(follower_->follow(stations[k - 1], stations[k], direction, tolerance_,
                                  direction == 0 ? 0 : rest));
  }
  if (path.is_proved()) return path;
  // Then as much as can be.
  path = {};
  for (const Arrangement::Strand& part : strands)
    path.append(strand(part, most - static_cast<int>(path.pieces.size())));
  return path;
}

CurvePath CurveTracer::finer(const CurvePoint& from, const CurvePoint& to, int direction,
                             double goal, int most) {
  return follower_->follow(from, to, direction, goal, most);
}

}  // namespace encase
