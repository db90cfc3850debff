// SPDX-License-Identifier: MIT
#include "common/segment_chart.hpp"

#include <cmath>
#include <limits>
#include <type_traits>

#include "common/interval.hpp"
#include "common/mpfr_number.hpp"

namespace encase {
namespace {

/// r = a line's coefficient (0, 1: normal, 2: offset); at most two roundings.
template <class Number>
void line_coefficient(const Line& line, int i, Number& r) {
  if constexpr (!std::is_same_v<Number, double>) {
    if (line.rational) {
      assign(r, (*line.rational)[i]);
      return;
    }
  }
  assign(r, i < 2 ? line.normal[i] : line.offset);
}

}  // namespace

SegmentChart SegmentChart::of_line(const Line& line, double lo, double hi) {
  SegmentChart chart;
  chart.line_ = line;
  chart.on_line_ = true;
  chart.lo_ = lo;
  chart.hi_ = hi;
  return chart;
}

SegmentChart SegmentChart::between(const Point<2>& from, const Point<2>& to) {
  SegmentChart chart;
  chart.from_ = from;
  chart.to_ = to;
  return chart;
}

SegmentChart SegmentChart::part(double lo, double hi) const {
  SegmentChart chart = *this;
  chart.lo_ = lo;
  chart.hi_ = hi;
  return chart;
}

double reach_across(const Line& line, double reach) {
  const int p = parameter_axis(line), q = 1 - p;
  const double b = std::fabs(line.normal[q]);
  if (!(b >= 0x1p-900)) return std::numeric_limits<double>::infinity();
  // Underflow loses less than 2^-1070 in a coefficient or product: nothing beside 2^-1000.
  return ((std::fabs(line.normal[p]) + 0x1p-1000) * reach + std::fabs(line.offset) + 0x1p-1000) /
             b * (1 + 0x1p-40) +
         0x1p-1000;
}

Point<2> SegmentChart::reach() const {
  // Sums of absolute values of the terms that make up a coordinate on the chart: of m + h s, and of
  // (from + to) / 2 + (to - from) / 2 (m + h s), where |s| <= 1.
  const Centered parameter = centered(lo_, hi_);
  const double extent = (std::fabs(parameter.center) + parameter.half) * (1 + 0x1p-40);
  Point<2> reach;
  if (on_line_) {
    const int p = parameter_axis(line_), q = 1 - p;
    reach[p] = extent;
    reach[q] = reach_across(line_, reach[p]);
  } else {
    for (int i = 0; i < 2; ++i)
      reach[i] = 0.5 * (std::fabs(from_[i]) + std::fabs(to_[i])) * (1 + extent) * (1 + 0x1p-40);
  }
  return reach;
}

int SegmentChart::roundings() const {
  // On a line: a p, + c, / b, and two more for each of three rational coefficients that are
  // rounded; between two points: sum or difference, times the middle, sum.
  return on_line_ ? (line_.rational ? 9 : 3) : 5;
}

template <class Number>
void SegmentChart::origin_and_direction(std::array<Number, 2>* origin,
                                        std::array<Number, 2>* direction) const {
  // The parameter p = m + h s.
  const double m = centered(lo_, hi_).center, h = centered(lo_, hi_).half;
  Number half = (*origin)[0];
  if (!on_line_) {
    // (from + to) / 2 + (to - from) / 2 (m + h s)
    Number middle = half, reach = half;
    assign(half, 0.5);
    assign(middle, m);
    assign(reach, h);
    for (int i = 0; i < 2; ++i) {
      Number from = half, to = half;
      assign(from, from_[i]);
      assign(to, to_[i]);
      (*origin)[i] = from;
      add((*origin)[i], to);
      multiply((*origin)[i], half);
      negate(from);
      add(to, from);
      multiply(to, half);
      add_product((*origin)[i], to, middle);
      multiply(to, reach);
      (*direction)[i] = to;
    }
    return;
  }
  // The other coordinate is -(a p + c) / b.
  const int p = parameter_axis(line_), q = 1 - p;
  assign((*origin)[p], m);
  assign((*direction)[p], h);
  Number a = half, b = half, c = half;
  line_coefficient(line_, p, a);
  line_coefficient(line_, q, b);
  line_coefficient(line_, 2, c);
  negate(b);
  add_product(c, a, (*origin)[p]);
  divide(c, b);
  (*origin)[q] = c;
  multiply(a, (*direction)[p]);
  divide(a, b);
  (*direction)[q] = a;
}

template void SegmentChart::origin_and_direction(std::array<double, 2>*,
                                                 std::array<double, 2>*) const;
template void SegmentChart::origin_and_direction(std::array<long double, 2>*,
                                                 std::array<long double, 2>*) const;
template void SegmentChart::origin_and_direction(std::array<Mpfr, 2>*, std::array<Mpfr, 2>*) const;

}  // namespace encase
