// SPDX-License-Identifier: MIT
#include "2d/curve_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "encase/caps.hpp"

namespace encase {
namespace {

/// So many parts of a box are looked at for the proof that a curve meets it.
constexpr std::size_t kMostParts = 64;

double magnitude(const Interval& a) { return std::max(std::fabs(a.lo), std::fabs(a.hi)); }

}  // namespace

CurveBounds::CurveBounds(const Function<2>& function)
    : program_(function.is_polynomial()   ? Expression(function.polynomial())
               : function.is_expression() ? function.expression()
                                          : Expression()) {
  if (function.is_inclusion()) inclusion_ = function.inclusion();
}

CurveBounds::Values CurveBounds::values(const Box<2>& box) {
  ++evaluations_;
  if (inclusion_) {
    const EnclosedJet<2> jet = enclosed(*inclusion_, box);
    return {jet.value, jet.has_value && jet.has_gradient, false};
  }
  const auto natural = program_.value(intervals(box), workspace_);
  return {natural.range(), natural.continuous(), natural.nowhere()};
}

CurveBounds::Slopes CurveBounds::slopes(const Box<2>& box) {
  ++evaluations_;
  if (inclusion_) {
    const EnclosedJet<2> jet = enclosed(*inclusion_, box);
    return {jet.gradient, jet.has_gradient && jet.has_hessian};
  }
  const auto on_box = program_.value_and_gradient(intervals(box), workspace_);
  return {{on_box.jet.first(0), on_box.jet.first(1)}, on_box.smooth()};
}

Interval CurveBounds::value_at(const Point<2>& point) { return values(Box<2>{point, point}).range; }

std::optional<Sign> CurveBounds::sign_at(const Point<2>& point) {
  const std::optional<Sign> sign = value_at(point).sign();
  return sign == Sign::Zero ? std::nullopt : sign;
}

/// The natural extension, and where that is not enough the mean value form; along an axis along
/// which f is monotone the ends in place of that (then nothing is lost).
CurveBounds::Look CurveBounds::look(const Box<2>& box) {
  const Values natural = values(box);
  Look result;
  result.continuous = natural.continuous;
  if (natural.nowhere) {
    result.absent = true;
    return result;
  }
  if (natural.range.lo > 0) result.sign = Sign::Positive;
  if (natural.range.hi < 0) result.sign = Sign::Negative;
  result.absent = result.sign.has_value();
  if (result.absent) return result;
  result.slopes = slopes(box);
  const Slopes& s = result.slopes;
  if (!s.smooth) return result;
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
  result.absent = result.sign.has_value();
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

std::optional<bool> has_point(CurveBounds& f, const Box<2>& box, const CurveBounds::Look& look,
                              double smallest) {
  bool open = false;
  std::array<bool, 2> whole{};  // the signs met, if it is continuous on the box
  thread_local std::vector<Box<2>> parts;
  parts.assign(1, box);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Box<2> part = parts[k];
    const CurveBounds::Look seen = k == 0 ? look : f.look(part);
    if (seen.changes) return true;
    std::array<bool, 2> own{};
    std::array<bool, 2>& met = look.continuous ? whole : own;
    const auto meet = [&](std::optional<Sign> sign) {
      if (sign) met[*sign == Sign::Positive] = true;
      return met[0] && met[1];
    };
    if (meet(seen.sign)) return true;
    if (seen.absent) continue;
    if (seen.continuous)
      for (const Point<2>& p :
           {part.center(), part.lo, part.hi, {part.lo[0], part.hi[1]}, {part.hi[0], part.lo[1]}})
        if (meet(f.sign_at(p))) return true;
    if (part.largest_width() <= smallest || parts.size() + 4 > kMostParts) {
      open = true;
      continue;
    }
    for (const Box<2>& quarter : caps_quarters(part)) parts.push_back(quarter);
  }
  if (open) return std::nullopt;
  return false;
}

}  // namespace encase
