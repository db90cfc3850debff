// SPDX-License-Identifier: MIT
#include "2d/curve_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace encase {
namespace {

double magnitude(const Interval& a) { return std::max(std::fabs(a.lo), std::fabs(a.hi)); }

}  // namespace

CurveBounds::CurveBounds(const Function<2>& function) {
  const Expression e =
      function.is_polynomial() ? Expression(function.polynomial()) : function.expression();
  steps_ = e.steps();
  for (const auto& step : steps_)
    constants_.push_back(step.operation == Operation::Constant ? Interval::enclose(step.constant)
                                                               : Interval(0));
  value_.resize(steps_.size());
  for (auto& s : slope_) s.resize(steps_.size());
}

// STANDIN
void CurveBounds::run(const Box<2>& box, bool with_slopes) {
  ++evaluations_;
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const auto& s = steps_[k];
    const auto a = static_cast<std::size_t>(s.first), b = static_cast<std::size_t>(s.second);
    switch (s.operation) {
      case Operation::Constant:
        value_[k] = constants_[k];
        for (auto& d : slope_) d[k] = 0;
        break;
      case Operation::Variable:
        value_[k] = {box.lo[s.number], box.hi[s.number]};
        for (int i = 0; i < 2; ++i) slope_[i][k] = i == s.number ? 1 : 0;
        break;
      case Operation::Negate:
        value_[k] = -value_[a];
        for (auto& d : slope_) d[k] = -d[a];
        break;
      case Operation::Add:
        value_[k] = value_[a] + value_[b];
        for (auto& d : slope_) d[k] = d[a] + d[b];
        break;
      case Operation::Subtract:
        value_[k] = value_[a] - value_[b];
        for (auto& d : slope_) d[k] = d[a] - d[b];
        break;
      case Operation::Multiply:
        value_[k] = value_[a] * value_[b];
        for (auto& d : slope_) d[k] = d[a] * value_[b] + value_[a] * d[b];
        break;
      case Operation::Power: {
        Interval power = 1, before = 1;
        for (int i = 0; i < s.number; ++i) {
          before = power;
          power = power * value_[a];
        }
        if (s.number % 2 == 0 && power.lo < 0) power.lo = 0;
        value_[k] = power;
        for (auto& d : slope_) d[k] = Interval(s.number) * before * d[a];
        break;
      }
      default:
        value_[k] = {-INFINITY, INFINITY};
        for (auto& d : slope_) d[k] = {-INFINITY, INFINITY};
    }
    if (!with_slopes) continue;
  }
}

CurveBounds::Range CurveBounds::range(const Box<2>& box) {
  run(box, false);
  return {value_.back(), true};
}

CurveBounds::Slopes CurveBounds::slopes(const Box<2>& box) {
  run(box, true);
  return {{slope_[0].back(), slope_[1].back()}, true};
}
// END STANDIN

Interval CurveBounds::value_at(const Point<2>& point) { return range({point, point}).value; }

std::optional<Sign> CurveBounds::sign_at(const Point<2>& point) {
  const std::optional<Sign> sign = value_at(point).sign();
  return sign == Sign::Zero ? std::nullopt : sign;
}

/// The natural extension, and where that is not enough the mean value form; along an axis along
/// which f is monotone the ends in place of that (then nothing is lost).
CurveBounds::Look CurveBounds::look(const Box<2>& box) {
  const Range natural = range(box);
  Look result;
  result.continuous = natural.continuous;
  if (natural.value.lo > 0) result.sign = Sign::Positive;
  if (natural.value.hi < 0) result.sign = Sign::Negative;
  if (result.sign) return result;
  const Slopes s = slopes(box);
  if (!s.smooth) return result;
  result.graph_axis = graph_axis(s);
  Point<2> low = box.center(), high = low;
  double spread = 0;
  for (int i = 0; i < 2; ++i) {
    if (s.slope[i].lo >= 0 || s.slope[i].hi <= 0) {
      const bool rises = s.slope[i].lo >= 0;
      low[i] = rises ? box.lo[i] : box.hi[i];
      high[i] = rises ? box.hi[i] : box.lo[i];
    } else {
      const double half = round_up(std::max(box.hi[i] - low[i], low[i] - box.lo[i]));
      spread = round_up(spread + round_up(half * magnitude(s.slope[i])));
    }
  }
  const Interval at_low = value_at(low), at_high = low == high ? at_low : value_at(high);
  if (round_down(at_low.lo - spread) > 0) result.sign = Sign::Positive;
  if (round_up(at_high.hi + spread) < 0) result.sign = Sign::Negative;
  result.changes = at_low.hi < 0 && at_high.lo > 0;
  return result;
}

int graph_axis(const CurveBounds::Slopes& slopes) {
  if (!slopes.smooth) return -1;
  const auto steepness = [&](int i) {
    const Interval& d = slopes.slope[i];
    return d.lo > 0 ? d.lo : d.hi < 0 ? -d.hi : 0;
  };
  const double x = steepness(0), y = steepness(1);
  if (!(x > 0) && !(y > 0)) return -1;
  return y >= x ? 0 : 1;
}

}  // namespace encase
