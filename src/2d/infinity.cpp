// SPDX-License-Identifier: MIT
#include "2d/infinity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "common/box_tests.hpp"
#include "common/substitute.hpp"

namespace encase {
namespace {

constexpr int kLeastPower = -20, kMostPower = 40;  // of two, the rectangles' half widths
constexpr double kNarrowest = 0x1p-16;             // pieces are halved down to this
constexpr double kWidest = 0.5;  // what may stay open around one direction: it is to be far away
// Of the sides: curves that go to infinity along a diagonal of one rectangle do not along others'.
constexpr std::array<double, 4> kRatios{1, 0.75, 1.375, 0.625};

/// A curve outside of a rectangle with the half width 1, in a chart, and its derivative along v,
/// made when it is first asked for. Outside of the same rectangle t times as large: |u| <= 1 / t.
class Outside {
 public:
  Outside(const Polynomial<2>& p, const Point<2>& half, int chart)
      : p_(outside_of_rectangle(p, half, chart)), f_(p_) {}
  const FilteredFunction<2>& f() const { return f_; }
  const FilteredFunction<2>& slope() {
    if (!slope_) slope_.emplace(p_.derivative(1));
    return *slope_;
  }

 private:
  Polynomial<2> p_;
  FilteredFunction<2> f_;
  std::optional<FilteredFunction<2>> slope_;
};

/// What the search asks about.
struct Question {
  const std::vector<Polynomial<2>>& curves;
  const std::function<bool()>& stop;
  Kernel& kernel;
};

/// The curves in one chart, for rectangles of one ratio.
class Charting {
 public:
  Charting(const Question& question, double ratio, int chart) : question_(question), chart_(chart) {
    outside_.reserve(question.curves.size());
    for (const Polynomial<2>& p : question.curves)
      outside_.emplace_back(p, Point<2>{1, ratio}, chart);
  }

  /// The pieces for the rectangle with the half width 2^power. False as soon as there are more than
  /// `most` open directions, one is too wide, or it is stopped.
  bool run(int power, std::size_t most, Surroundings* result) {
    reach_ = std::ldexp(1.0, -power);
    most_ = most;
    std::vector<int> all(outside_.size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    return divide(-1, 1, all, result);
  }

 private:
  bool keeps_sign(const FilteredFunction<2>& f, double lo, double hi) const {
    return f.degree() >= 0 && !(question_.curves.size() > 2 && changes_sign(f, lo, hi)) &&
           sign_on_box(f, {{-reach_, lo}, {reach_, hi}}, question_.kernel).has_value();
  }

  /// Whether f is proved to have different signs at some points of a box. (Of many curves most
  /// boxes are asked about in vain, and values cost less than nets.)
  bool changes_sign(const FilteredFunction<2>& f, double lo, double hi) const {
    bool positive = false, negative = false;
    for (const Point<2>& at :
         {Point<2>{0, lo}, Point<2>{0, hi}, Point<2>{reach_, lo}, Point<2>{-reach_, hi},
          Point<2>{-reach_, lo}, Point<2>{reach_, hi}}) {
      const auto v = f.evaluate(at, Kernel::kDoubleBits);
      positive = positive || v.value > v.error;
      negative = negative || v.value < -v.error;
      if (positive && negative) return true;
    }
    return false;
  }

  bool divide(double lo, double hi, const std::vector<int>& curves, Surroundings* result) {
    if (question_.stop && question_.stop()) return false;
    std::vector<int> here;
    for (const int c : curves)
      if (!keeps_sign(outside_[c].f(), lo, hi)) here.push_back(c);
    const bool at_corner = lo == -1 || hi == 1;
    if (here.empty() ||
        (here.size() == 1 && !at_corner && keeps_sign(outside_[here[0]].slope(), lo, hi))) {
      result->pieces.push_back({chart_, lo, hi, here.empty() ? -1 : here[0]});
      return true;
    }
    if (hi - lo <= kNarrowest) {
      auto& open = result->open;
      const bool more = !open.empty() && open.back().chart == chart_ && open.back().hi == lo;
      if (!more && open.size() >= most_) return false;
      if (!more) open.push_back({chart_, lo, lo, {}});
      open.back().hi = hi;
      if (open.back().hi - open.back().lo > kWidest) return false;
      for (const int c : here)
        if (std::find(open.back().curves.begin(), open.back().curves.end(), c) ==
            open.back().curves.end())
          open.back().curves.push_back(c);
      return true;
    }
    const double middle = 0.5 * (lo + hi);
    return divide(lo, middle, here, result) && divide(middle, hi, here, result);
  }

  const Question& question_;
  std::vector<Outside> outside_;
  int chart_;
  double reach_ = 1;  ///< of u
  std::size_t most_ = 0;
};

/// The rectangles of one ratio.
class Rectangles {
 public:
  Rectangles(const Question& question, double ratio)
      : ratio_(ratio), charts_{Charting(question, ratio, 0), Charting(question, ratio, 1)} {}

  /// The one with the half width 2^power, if it has at most so many open directions.
  std::optional<Surroundings> at(int power, std::size_t most_open) {
    const double x = std::ldexp(1.0, power);
    Surroundings result;
    result.half = {x, ratio_ * x};
    for (Charting& chart : charts_)
      if (!chart.run(power, most_open, &result)) return std::nullopt;
    return result;
  }

  /// The smallest such.
  std::optional<Surroundings> smallest(std::size_t most_open) {
    int power = 0;
    std::optional<Surroundings> best = at(power, most_open);
    if (best) {
      while (power > kLeastPower) {
        auto smaller = at(--power, most_open);
        if (!smaller) break;
        best = std::move(smaller);
      }
    } else {
      while (!best && power < kMostPower) best = at(++power, most_open);
    }
    return best;
  }

 private:
  double ratio_;
  std::array<Charting, 2> charts_;
};

}  // namespace

Surroundings find_surroundings(const std::vector<Polynomial<2>>& curves,
                               const std::function<bool()>& stop, Kernel& kernel) {
  const Question question{curves, stop, kernel};
  for (const double ratio : kRatios)
    if (auto found = Rectangles(question, ratio).smallest(0)) return *std::move(found);
  // There are directions in which nothing helps: as few as in a large rectangle.
  constexpr std::size_t kMany = 1000;
  std::optional<Surroundings> best;
  double best_ratio = 1;
  for (const int large : {24, kMostPower}) {
    for (const double ratio : kRatios) {
      auto found = Rectangles(question, ratio).at(large, kMany);
      if (!found || (best && best->open.size() <= found->open.size())) continue;
      best = std::move(found);
      best_ratio = ratio;
    }
    if (best) break;
  }
  if (!best) {
    std::vector<int> all(curves.size());
    std::iota(all.begin(), all.end(), 0);
    return {{1, 0.75}, {}, {{0, -1, 1, all}, {1, -1, 1, all}}};
  }
  auto small = Rectangles(question, best_ratio).smallest(best->open.size());
  return small ? *std::move(small) : *std::move(best);
}

}  // namespace encase
