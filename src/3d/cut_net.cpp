// SPDX-License-Identifier: MIT
#include "3d/cut_net.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/interval.hpp"

namespace encase {

CutPlace cut_place(double lo, double hi, double at) {
  const bool exact = centered(lo, hi).exact && centered(lo, at).exact && centered(at, hi).exact;
  const double inexact = exact ? 0.0 : 0x1p-49 * (std::fabs(lo) + std::fabs(hi)) / (hi - lo);
  return {(at - lo) / (hi - lo), 0x1p-51 + inexact};
}

namespace {

/// De Casteljau's algorithm at t: `upper`, of n + 1 rows of `inner`, becomes the upper part. After
/// step r its row j holds the j-th point of the r-th generation.
void cut_block(double* upper, double* lower, int n, int inner, double t) {
  const double s = 1 - t;
  for (int i = 0; i < inner; ++i) lower[i] = upper[i];
  for (int r = 1; r <= n; ++r) {
    const int end = (n - r + 1) * inner;
    for (int j = 0; j < end; ++j) upper[j] = s * upper[j] + t * upper[j + inner];
    for (int i = 0; i < inner; ++i) lower[r * inner + i] = upper[i];
  }
}

}  // namespace

void cut(const Bernstein<3>& net, const Box<3>& box, int axis, double at, Bernstein<3>* lower,
         Bernstein<3>* upper) {
  const CutPlace place = cut_place(box.lo[axis], box.hi[axis], at);
  int inner = 1;
  for (int i = axis + 1; i < 3; ++i) inner *= net.degree[i] + 1;
  const int n = net.degree[axis];
  const std::size_t block = static_cast<std::size_t>(n + 1) * static_cast<std::size_t>(inner);
  lower->degree = upper->degree = net.degree;
  lower->b.resize(net.b.size());
  upper->b = net.b;
  for (std::size_t first = 0; first < net.b.size(); first += block)
    cut_block(upper->b.data() + first, lower->b.data() + first, n, inner, place.t);
  // A coefficient is the blossom at n numbers, each at most `deviation` from 0, t or 1, and affine
  // in each of them; every generation rounds by at most 3 u.
  const double size = largest_coefficient(net), moved = 2.1 * n * place.deviation;
  const double radius =
      (net.radius * (1 + moved) + (moved + 3.03 * n * 0x1p-53) * size + 0x1p-1000) * (1 + 0x1p-50);
  lower->radius = upper->radius = moved < 0.01 ? radius : std::numeric_limits<double>::infinity();
}

}  // namespace encase
