// SPDX-License-Identifier: MIT
#include "common/filtered_inclusion.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <vector>

#include "common/bernstein.hpp"
#include "common/kernel.hpp"
#include "common/taylor_to_bernstein.hpp"

namespace encase {
namespace {

constexpr double kUp = 1 + 0x1p-40;  // outweighs the few roundings of the sums it multiplies
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kTiny = 0x1p-960;
constexpr double kReach = 1 + 0x1p-10;  // how far models reach, in their coordinates

bool is_bounded(const Interval& a) {
  return std::isfinite(a.lo) && std::isfinite(a.hi) && a.lo <= a.hi && std::isfinite(a.hi - a.lo);
}

/// An interval that is bounded, or all numbers.
Interval read(const ClosedInterval& from, bool* bounded) {
  const Interval a(from.lo, from.hi);
  if (is_bounded(a)) return a;
  *bounded = false;
  return {-kInfinite, kInfinite};
}

template <int D>
EnclosedJet<D> read(const Enclosure<D>& from) {
  EnclosedJet<D> jet;
  jet.has_value = jet.has_gradient = jet.has_hessian = true;
  jet.value = read(from.value, &jet.has_value);
  for (std::size_t i = 0; i < D; ++i) {
    jet.gradient[i] = read(from.gradient[i], &jet.has_gradient);
    for (std::size_t k = i; k < D; ++k)
      jet.hessian[i][k] = jet.hessian[k][i] = read(from.hessian[i][k], &jet.has_hessian);
  }
  return jet;
}

template <int D>
Box<D> point_box(const Point<D>& point) {
  return {point, point};
}

bool is_interval(const ClosedInterval& a) { return a.lo <= a.hi; }

}  // namespace

template <int D>
EnclosedJet<D> enclosed(const Inclusion<D>& f, const Box<D>& box) {
  try {
    return read<D>(f.function()(box));
  } catch (...) {
    return read<D>(Enclosure<D>{});
  }
}

template <int D>
std::optional<std::string> complaint(const Inclusion<D>& f, const Box<D>& box) {
  for (const Box<D>& at : {box, point_box<D>(box.center())}) {
    Enclosure<D> e;
    try {
      e = f.function()(at);
    } catch (const std::exception& error) {
      return std::string("throws: ") + error.what();
    } catch (...) {
      return "throws";
    }
    bool proper = is_interval(e.value);
    for (std::size_t i = 0; i < D; ++i) {
      proper = proper && is_interval(e.gradient[i]);
      for (std::size_t k = i; k < D; ++k) proper = proper && is_interval(e.hessian[i][k]);
    }
    if (!proper) return "gives an interval that is empty or has an end that is not a number";
  }
  return std::nullopt;
}

namespace {

template <int K, int D>
using AffineIntervals = std::array<std::array<Interval, K + 1>, D>;

bool is_zero(const Interval& a) { return a.lo == 0 && a.hi == 0; }

/// The chain rule; the Hessian of an affine map is zero.
template <int K, int D>
Enclosure<K> pulled_back(const EnclosedJet<D>& f, const AffineIntervals<K, D>& map) {
  const auto closed = [](const Interval& a) { return ClosedInterval{a.lo, a.hi}; };
  Enclosure<K> result;
  result.value = closed(f.value);
  if (!f.has_gradient) return result;
  for (std::size_t i = 0; i < K; ++i) {
    Interval sum(0);
    for (std::size_t p = 0; p < D; ++p)
      if (!is_zero(map[p][i])) sum = sum + f.gradient[p] * map[p][i];
    result.gradient[i] = closed(sum);
  }
  if (!f.has_hessian) return result;
  for (std::size_t i = 0; i < K; ++i)
    for (std::size_t k = i; k < K; ++k) {
      Interval sum(0);
      for (std::size_t p = 0; p < D; ++p)
        for (std::size_t q = 0; q < D; ++q)
          if (!is_zero(map[p][i]) && !is_zero(map[q][k]))
            sum = sum + f.hessian[p][q] * (map[p][i] * map[q][k]);
      result.hessian[i][k] = closed(sum);
    }
  return result;
}

/// The range of an affine function on a box; exact if it is one of the coordinates.
Interval range(const std::array<Interval, 3>& row, const Box<2>& box) {
  const auto is = [](const Interval& a, double value) { return a.lo == value && a.hi == value; };
  for (std::size_t i = 0; i < 2; ++i)
    if (is(row[i], 1) && is(row[1 - i], 0) && is(row[2], 0)) return {box.lo[i], box.hi[i]};
  Interval sum = row[2];
  for (std::size_t i = 0; i < 2; ++i)
    if (!is_zero(row[i])) sum = sum + row[i] * Interval(box.lo[i], box.hi[i]);
  return sum;
}

}  // namespace

Inclusion<2> restricted(const Inclusion<3>& f, const PlaneMap& map) {
  AffineIntervals<2, 3> rows;
  std::vector<Rational> entries;
  for (std::size_t p = 0; p < 3; ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      rows[p][i] = Interval::enclose(map[p][i]);
      entries.push_back(map[p][i]);
    }
  const auto enclose = [f, rows](const Box<2>& box) {
    Box<3> image;
    for (std::size_t p = 0; p < 3; ++p) {
      const Interval coordinate = range(rows[p], box);
      image.lo[p] = coordinate.lo;
      image.hi[p] = coordinate.hi;
    }
    return pulled_back<2, 3>(enclosed(f, image), rows);
  };
  return Inclusion<2>(enclose, f, std::move(entries));
}

namespace {

/// A range in the coordinates of a model as a coefficient and its error.
struct Coefficient {
  double value, error;
  explicit Coefficient(const Interval& range) {
    const Centered c = centered(range.lo, range.hi);
    value = c.center;
    error = c.half;
  }
};

/// f(center + s) for |s_k| <= kReach from the value and gradient at the centre and the Hessian
/// there, all in these coordinates.
template <int D>
void fill_model(const Interval& value, const std::array<Interval, D>& gradient,
                const std::array<std::array<Interval, D>, D>& hessian, Point<D>* slope_error,
                TaylorModel<D, double>* model) {
  constexpr double kSquare = kReach * kReach * kUp;
  model->degree = 2;
  model->stride = 3;
  model->span.fill(2);
  model->undefined = false;
  std::array<std::size_t, D> place;  // of the coefficients of s_i
  std::size_t size = 1;
  for (std::size_t i = D; i-- > 0; size *= 3) place[i] = size;
  model->c.assign(size, 0.0);
  const Coefficient constant(value);
  model->c[0] = constant.value;
  double error = constant.error, linear = 0, square = 0;
  slope_error->fill(0.0);
  for (std::size_t i = 0; i < D; ++i) {
    const Coefficient slope(gradient[i]);
    model->c[place[i]] = slope.value;
    linear += std::fabs(slope.value);
    error += kReach * slope.error;
    (*slope_error)[i] += slope.error;
    for (std::size_t k = i; k < D; ++k) {
      const Coefficient bend(hessian[i][k]);
      const double factor = i == k ? 0.5 : 1;
      model->c[place[i] + place[k]] = factor * bend.value;
      square += factor * std::fabs(bend.value);
      error += kSquare * factor * bend.error;
      (*slope_error)[i] += kReach * bend.error;
      if (i != k) (*slope_error)[k] += kReach * bend.error;
    }
  }
  using Model = TaylorModel<D, double>;
  model->norm.fill(0.0);
  model->norm[0] = std::fabs(constant.value);
  model->norm[1] = linear * Model::kRadius * kUp;
  model->norm[2] = square * Model::kRadius * Model::kRadius * kUp;
  model->error = error * kUp + kTiny;
  for (double& e : *slope_error) e = e * kUp + kTiny;
  if (!std::isfinite(model->error) || !std::isfinite(model->polynomial_norm()))
    model->claim_nothing();
}

template <int K>
void make_net(const TaylorModel<K, double>& model, int net_degree, Bernstein<K>* net) {
  static const std::vector<double> nothing(static_cast<std::size_t>(K == 3 ? 27 : K == 2 ? 9 : 3));
  taylor_to_bernstein<K>(model.exists() ? model.c : nothing, 2, model.error, net_degree, net);
}

}  // namespace

template <int D>
const typename FilteredInclusion<D>::Local& FilteredInclusion<D>::local(const Point<D>& center,
                                                                        const Point<D>& half,
                                                                        Kernel& kernel) const {
  ++kernel.expansions;
  thread_local Local result;
  Box<D> box;
  for (std::size_t i = 0; i < D; ++i) {
    const double reach = round_up(half[i] * kReach);
    box.lo[i] = round_down(center[i] - reach);
    box.hi[i] = round_up(center[i] + reach);
  }
  EnclosedJet<D> around = enclosed(exact_, box), at = around;
  if (around.has_hessian) at = enclosed(exact_, point_box<D>(center));
  if (!around.has_hessian || !at.has_value || !at.has_gradient) {
    result.model.claim_nothing();
    return result;
  }
  for (std::size_t i = 0; i < D; ++i) {
    at.gradient[i] = at.gradient[i] * Interval(half[i]);
    for (std::size_t k = i; k < D; ++k)
      around.hessian[i][k] = around.hessian[i][k] * Interval(half[i]) * Interval(half[k]);
  }
  fill_model<D>(at.value, at.gradient, around.hessian, &result.slope_error, &result.model);
  return result;
}

template <int D>
void FilteredInclusion<D>::expand(const Box<D>& box, int net_degree, int, Kernel& kernel,
                                  Bernstein<D>* net) const {
  Point<D> center, half;
  for (std::size_t i = 0; i < D; ++i) {
    const Centered chart = centered(box.lo[i], box.hi[i]);
    center[i] = chart.center;
    half[i] = chart.half;
  }
  make_net<D>(local(center, half, kernel).model, net_degree, net);
}

template <int D>
void FilteredInclusion<D>::restrict_to(const SegmentChart& segment, int, Kernel& kernel,
                                       Bernstein<1>* net) const requires(D == 2) {
  ++kernel.restrictions;
  std::array<double, 2> origin, direction;
  segment.origin_and_direction(&origin, &direction);
  const Point<2> reach = segment.reach();
  AffineIntervals<1, 2> map;
  Box<2> start, all;
  for (std::size_t i = 0; i < 2; ++i) {
    // Of the origin and the direction together, so of each.
    const double error =
        1.01 * 0x1p-53 * (segment.roundings() + 1) * reach[i] * kReach * kUp + kTiny;
    map[i] = {Interval(direction[i]) + Interval(-error, error),
              Interval(origin[i]) + Interval(-error, error)};
    const Interval range = map[i][1] + map[i][0] * Interval(-kReach, kReach);
    start.lo[i] = map[i][1].lo;
    start.hi[i] = map[i][1].hi;
    all.lo[i] = range.lo;
    all.hi[i] = range.hi;
  }
  thread_local TaylorModel<1, double> result;
  Point<1> slope_error;
  result.claim_nothing();
  const EnclosedJet<1> around = read<1>(pulled_back<1, 2>(enclosed(exact_, all), map));
  if (around.has_hessian) {
    const EnclosedJet<1> at = read<1>(pulled_back<1, 2>(enclosed(exact_, start), map));
    if (at.has_value && at.has_gradient)
      fill_model<1>(at.value, at.gradient, around.hessian, &slope_error, &result);
  }
  make_net<1>(result, kDegree, net);
}

namespace {

template <int D>
typename FilteredPolynomial<D>::Value value_on(const Inclusion<D>& f, const Box<D>& box) {
  const EnclosedJet<D> jet = enclosed(f, box);
  if (!jet.has_value) return {0.0, kInfinite};
  const Centered c = centered(jet.value.lo, jet.value.hi);
  return {c.center, c.half};
}

}  // namespace

template <int D>
typename FilteredInclusion<D>::Value FilteredInclusion<D>::evaluate(const Point<D>& point,
                                                                    int) const {
  return value_on(exact_, point_box<D>(point));
}

template <int D>
typename FilteredInclusion<D>::Value FilteredInclusion<D>::evaluate_rounded(
    const Point<D>& point, const Point<D>& magnitude, int roundings) const {
  Box<D> box;
  for (std::size_t i = 0; i < D; ++i) {
    const double error = 1.01 * 0x1p-53 * roundings * magnitude[i] * kUp + kTiny;
    box.lo[i] = round_down(point[i] - error);
    box.hi[i] = round_up(point[i] + error);
  }
  return value_on(exact_, box);
}

template <int D>
double FilteredInclusion<D>::precise_value(const Point<D>& point, double error, int) const {
  const Value v = evaluate(point, Kernel::kDoubleBits);
  if (v.error <= std::max(error, 0x1p-53 * std::fabs(v.value))) return v.value;
  return std::numeric_limits<double>::quiet_NaN();
}

template <int D>
double FilteredInclusion<D>::approximate(const Point<D>& point) const {
  return enclosed(exact_, point_box<D>(point)).value.mid();
}

template <int D>
Point<D> FilteredInclusion<D>::gradient(const Point<D>& point) const {
  return value_and_gradient(point).gradient;
}

template <int D>
typename FilteredInclusion<D>::ValueAndGradient FilteredInclusion<D>::value_and_gradient(
    const Point<D>& point) const {
  const EnclosedJet<D> jet = enclosed(exact_, point_box<D>(point));
  ValueAndGradient result{jet.value.mid(), {}};
  for (std::size_t i = 0; i < D; ++i) result.gradient[i] = jet.gradient[i].mid();
  return result;
}

template <int D>
Jet FilteredInclusion<D>::jet(const Point<D>& point) const requires(D == 2) {
  const EnclosedJet<D> jet = enclosed(exact_, point_box<D>(point));
  return {jet.value.mid(),
          {jet.gradient[0].mid(), jet.gradient[1].mid()},
          jet.hessian[0][0].mid(),
          jet.hessian[0][1].mid(),
          jet.hessian[1][1].mid()};
}

template <int D>
Sign FilteredInclusion<D>::sign_at(const RationalPoint<D>& point, Kernel& kernel) const {
  Box<D> box;
  for (std::size_t i = 0; i < D; ++i) {
    const Interval coordinate = Interval::enclose(point[i]);
    box.lo[i] = coordinate.lo;
    box.hi[i] = coordinate.hi;
  }
  const std::optional<Sign> sign = enclosed(exact_, box).value.sign();
  if (!sign || *sign == Sign::Zero) {
    ++kernel.decisions.undecided;
    return Sign::Zero;
  }
  kernel.count(Kernel::kDoubleBits);
  return *sign;
}

template EnclosedJet<2> enclosed(const Inclusion<2>& f, const Box<2>& box);
template EnclosedJet<3> enclosed(const Inclusion<3>& f, const Box<3>& box);
template std::optional<std::string> complaint(const Inclusion<2>& f, const Box<2>& box);
template std::optional<std::string> complaint(const Inclusion<3>& f, const Box<3>& box);
template class FilteredInclusion<1>;
template class FilteredInclusion<2>;
template class FilteredInclusion<3>;

}  // namespace encase
