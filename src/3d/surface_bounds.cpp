// SPDX-License-Identifier: MIT
#include "3d/surface_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/bernstein.hpp"

namespace encase {

namespace {

Interval range(const Bernstein<3>& net) {
  const auto [least, largest] = std::minmax_element(net.b.begin(), net.b.end());
  return Interval(*least, *largest) + Interval(-net.radius, net.radius);
}

/// The value in the middle of the cube. The weights add up to 1; a weight passes two
/// roundings a degree, and a term then three products, and sums as many as there are coefficients.
Interval middle(const Bernstein<3>& net) {
  std::array<std::vector<double>, 3> weights;
  for (int i = 0; i < 3; ++i) {
    const int n = net.degree[i];
    double weight = std::ldexp(1.0, -n);
    for (int k = 0; k <= n; weight *= static_cast<double>(n - k) / (k + 1), ++k)
      weights[i].push_back(weight);
  }
  double sum = 0;
  std::size_t at = 0;
  for (const double x : weights[0])
    for (const double y : weights[1])
      for (const double z : weights[2]) sum += x * y * z * net.b[at++];
  const double roundings =
      8.0 * (8 + net.degree[0] + net.degree[1] + net.degree[2]) + static_cast<double>(net.b.size());
  const double error = net.radius + roundings * 0x1p-52 * largest_coefficient(net);
  return Interval(sum) + Interval(-error, error);
}

}  // namespace

Interval DerivativeRanges::second_along(const IntervalVector& u) const {
  Interval sum(0);
  for (int i = 0; i < 3; ++i) sum = sum + dot(second[i], u) * u[i];
  return sum;
}

Box<3> inflated(const Box<3>& box, double by) {
  Box<3> larger;
  for (int i = 0; i < 3; ++i) {
    larger.lo[i] = round_down(box.lo[i] - by);
    larger.hi[i] = round_up(box.hi[i] + by);
  }
  return larger;
}

Interval SurfaceBounds::value(const Point<3>& point, int bits) const {
  const auto [value, error] = f_->evaluate(point, bits);
  return Interval(value) + Interval(-error, error);
}

/// A net with the factors that take derivatives in its coordinates to those in input coordinates.
struct SurfaceBounds::Net {
  Bernstein<3> net;
  Point<3> center;
  IntervalVector per_unit;

  Bernstein<3> derivative(const Bernstein<3>& of, int axis) const {
    Bernstein<3> result;
    differentiate(of, axis, &result);
    return result;
  }
};

namespace {

Interval common_part(const Interval& a, const Interval& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}

/// The ranges that an inclusion function gives, those of first derivatives also by the mean value
/// theorem.
DerivativeRanges derivatives_of(const Inclusion<3>& f, const Box<3>& box) {
  const Point<3> center = box.center();
  const EnclosedJet<3> on_box = enclosed(f, box), at = enclosed(f, Box<3>{center, center});
  DerivativeRanges result{on_box.gradient, on_box.hessian};
  if (!on_box.has_gradient || !on_box.has_hessian || !at.has_gradient) return result;
  for (std::size_t i = 0; i < 3; ++i) {
    Interval range = at.gradient[i];
    for (std::size_t j = 0; j < 3; ++j)
      range = range + on_box.hessian[i][j] * (Interval(box.lo[j], box.hi[j]) - Interval(center[j]));
    result.first[i] = common_part(result.first[i], range);
  }
  return result;
}

}  // namespace

SurfaceBounds::Net SurfaceBounds::expand(const Box<3>& box, int bits, Kernel& kernel) const {
  // A net's rounding errors are about 2^-bits of the function's terms; second derivatives divide
  // them by the square of the box's width.
  const double least = std::ldexp(size_, bits <= 64 ? -16 : -bits / 3);
  Box<3> large = box;
  Net result;
  for (int i = 0; i < 3; ++i) {
    const double missing = least - 0.5 * box.width(i);
    if (missing > 0) {
      large.lo[i] = box.lo[i] - missing;
      large.hi[i] = box.hi[i] + missing;
    }
    // The net's coordinates have a half width that is this one up to roundings (Centered).
    const auto [center, half, exact] = centered(large.lo[i], large.hi[i]);
    result.center[i] = center;
    result.per_unit[i] = Interval(1) / Interval(half * (1 - 0x1p-48), half * (1 + 0x1p-48));
  }
  f_->expand(large, f_->degree(), bits, kernel, &result.net);
  return result;
}

IntervalVector SurfaceBounds::gradient(const Box<3>& box, int bits, Kernel& kernel) const {
  if (f_->is_inclusion()) return derivatives_of(f_->inclusion().exact(), box).first;
  const Net f = expand(box, bits, kernel);
  IntervalVector result;
  for (int i = 0; i < 3; ++i) result[i] = range(f.derivative(f.net, i)) * f.per_unit[i];
  return result;
}

DerivativeRanges SurfaceBounds::derivatives(const Box<3>& box, int bits, Kernel& kernel) const {
  if (f_->is_inclusion()) return derivatives_of(f_->inclusion().exact(), box);
  const Net f = expand(box, bits, kernel);
  DerivativeRanges result;
  for (int i = 0; i < 3; ++i) {
    const Bernstein<3> slope = f.derivative(f.net, i);
    result.first[i] = range(slope) * f.per_unit[i];
    for (int j = i; j < 3; ++j)
      result.second[i][j] = result.second[j][i] =
          range(f.derivative(slope, j)) * (f.per_unit[i] * f.per_unit[j]);
  }
  return result;
}

/// e is what the net's radius allows for: docs/error-bounds.md (sections 4 and 14) bounds its
/// derivatives by those of a net of such coefficients.
ModelDerivatives SurfaceBounds::model(const Box<3>& box, Kernel& kernel) const {
  Net f = expand(box, Kernel::kDoubleBits, kernel);
  const double radius = f.net.radius, n = f_->degree();
  f.net.radius = 0;
  ModelDerivatives result;
  result.center = f.center;
  double steepest = 0;
  for (int i = 0; i < 3; ++i) {
    steepest = std::max(steepest, f.per_unit[i].hi);
    const Bernstein<3> slope = f.derivative(f.net, i);
    result.first[i] = middle(slope) * f.per_unit[i];
    for (int j = i; j < 3; ++j) {
      const Bernstein<3> bend = f.derivative(slope, j);
      const Interval per_unit = f.per_unit[i] * f.per_unit[j];
      result.second[i][j] = result.second[j][i] = middle(bend) * per_unit;
      for (int k = j; k < 3; ++k) {
        const Interval third = range(f.derivative(bend, k)) * (per_unit * f.per_unit[k]);
        for (const auto& [a, b, c] : {std::array{i, j, k}, {j, k, i}, {k, i, j}}) {
          result.third[a][b][c] = result.third[a][c][b] = third;
        }
      }
    }
  }
  constexpr double kUp = 1 + 0x1p-20;
  result.slope_error = n * radius * steepest * kUp;
  result.bend_error = n * n * radius * steepest * steepest * kUp;
  return result;
}

}  // namespace encase
