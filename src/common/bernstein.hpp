// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "encase/number.hpp"

namespace encase {

/// A polynomial on the cube [-1,1]^K in tensor Bernstein form: doubles and one proved error radius.
/// The exact Bernstein coefficients differ from `b` by at most `radius` each, so the polynomial's
/// values lie in [min b - radius, max b + radius]. An infinite or NaN radius claims nothing.
/// `b` is contiguous, the last axis running fastest.
template <int K>
struct Bernstein {
  std::array<int, K> degree{};
  std::vector<double> b;
  double radius = 0;

  int size() const {
    int n = 1;
    for (int d : degree) n *= d + 1;
    return n;
  }
};

/// The sign the polynomial is proved to have on the whole closed cube, if any (never Zero).
template <int K>
std::optional<Sign> sign_on_cube(const Bernstein<K>& net);

/// Whether the radius alone keeps the sign from being proved: no more than `radius` separates the
/// coefficients from one sign, so that a fresh expansion may help where subdivision would not.
template <int K>
bool drowned(const Bernstein<K>& net);

/// Restricts to the half cubes s_axis <= 0 and s_axis >= 0, each mapped to the full cube again.
template <int K>
void halve(const Bernstein<K>& net, int axis, Bernstein<K>* lower, Bernstein<K>* upper);

/// The partial derivative with respect to s_axis (degree 0: the zero polynomial of degree 0).
template <int K>
void differentiate(const Bernstein<K>& net, int axis, Bernstein<K>* out);

/// The same polynomial with its degree in s_axis raised by one.
template <int K>
void elevate(const Bernstein<K>& net, int axis, Bernstein<K>* out);

/// s_axis times the polynomial; its degree in s_axis grows by one.
template <int K>
void multiply_by_coordinate(const Bernstein<K>& net, int axis, Bernstein<K>* out);

/// The largest absolute value of a coefficient.
template <int K>
double largest_coefficient(const Bernstein<K>& net);

/// The largest absolute difference of coefficients that are neighbours along an axis; a heuristic
/// measure of how much the polynomial changes along it.
template <int K>
double variation(const Bernstein<K>& net, int axis);

/// alpha * f + beta * g, for nets of equal degrees.
template <int K>
void combine(double alpha, const Bernstein<K>& f, double beta, const Bernstein<K>& g,
             Bernstein<K>* out);

}  // namespace encase
