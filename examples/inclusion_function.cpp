// SPDX-License-Identifier: MIT
//
// A surface given by an inclusion function of our own: two drops that merge,
//   exp(-|p - c|^2) + exp(-|p + c|^2) = 1/2,   c = (3/4, 0, 0),
// and the curves in which it meets a polynomial's surface.
#include <algorithm>
#include <cmath>
#include <encase/intersection_curves.hpp>
#include <iostream>

namespace {

using Interval = encase::ClosedInterval;

/// Holds [lo, hi] and what rounding may have lost of either: up to two units in the last place.
Interval outward(double lo, double hi) {
  for (int k = 0; k < 2; ++k) {
    lo = std::nextafter(lo, -HUGE_VAL);
    hi = std::nextafter(hi, HUGE_VAL);
  }
  return {lo, hi};
}
Interval operator+(const Interval& a, const Interval& b) {
  return outward(a.lo + b.lo, a.hi + b.hi);
}
Interval operator*(const Interval& a, const Interval& b) {
  const auto [least, largest] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return outward(least, largest);
}
Interval square(const Interval& a) {
  const Interval product = a * a;
  return a.lo <= 0 && a.hi >= 0 ? Interval{0, product.hi} : product;
}
// glibc's exponential errs by less than one unit.
Interval exp(const Interval& a) { return outward(std::exp(a.lo), std::exp(a.hi)); }

/// f = exp(-|p - c|^2) + exp(-|p + c|^2) - 1/2 and its derivatives on a box.
encase::Enclosure<3> drops(const encase::Box<3>& box) {
  encase::Enclosure<3> f;
  f.value = {-0.5, -0.5};
  for (auto& slope : f.gradient) slope = {0, 0};
  for (auto& row : f.hessian)
    for (auto& bend : row) bend = {0, 0};
  const Interval minus_two{-2, -2}, four{4, 4};
  for (const double c : {-0.75, 0.75}) {
    std::array<Interval, 3> q;  // p - c
    Interval distance{0, 0};    // its square
    for (int i = 0; i < 3; ++i) {
      q[i] = Interval{box.lo[i], box.hi[i]} + Interval{i == 0 ? -c : 0, i == 0 ? -c : 0};
      distance = distance + square(q[i]);
    }
    const Interval e = exp({-distance.hi, -distance.lo});
    f.value = f.value + e;
    for (int i = 0; i < 3; ++i) {
      f.gradient[i] = f.gradient[i] + minus_two * q[i] * e;
      for (int k = i; k < 3; ++k)
        f.hessian[i][k] =
            f.hessian[i][k] + (i == k ? four * square(q[i]) + minus_two : four * q[i] * q[k]) * e;
    }
  }
  return f;
}

}  // namespace

int main() {
  const auto x = encase::Polynomial<3>::variable(0), z = encase::Polynomial<3>::variable(2);
  const auto sheet = z - encase::Polynomial<3>::constant(encase::Rational(1, 4)) * x * x;
  const auto region = encase::make_box({-3, -2, -2}, {3, 2, 2}).value();
  const encase::Function<3> surface{encase::InclusionFunction<3>(drops)};
  const auto result = encase::intersect(surface, sheet, region, 1e-3).value();
  for (const auto& curve : result.curves)
    std::cout << (curve.curve.closed ? "closed, " : "open, ") << curve.points.size() << " points\n";
  const bool certified = result.encasement.outcome == encase::Outcome::Certified;
  const bool proved = certified && result.within_tolerance && verify(result.encasement).ok();
  std::cout << (proved ? "proved\n" : "not proved\n");
  return proved && result.curves.size() == 1 ? 0 : 1;
}
