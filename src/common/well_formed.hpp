// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/number.hpp"

/// What `verify` asks of a stored result first, so that all else may follow its indices and compute
/// with its numbers.
namespace encase::verification {

inline bool finite(double a) { return std::isfinite(a); }
template <std::size_t D>
bool finite(const std::array<double, D>& p) {
  return std::all_of(p.begin(), p.end(), [](double a) { return finite(a); });
}

template <int D>
bool ordered(const Box<D>& b) {
  bool is_ordered = finite(b.lo) && finite(b.hi);
  for (std::size_t i = 0; i < D; ++i) is_ordered = is_ordered && b.lo[i] <= b.hi[i];
  return is_ordered;
}

template <int D>
bool has_interior(const Box<D>& b) {
  bool is_open = ordered(b);
  for (std::size_t i = 0; i < D; ++i) is_open = is_open && b.lo[i] < b.hi[i];
  return is_open;
}

template <class T>
bool in_range(int index, const std::vector<T>& list) {
  return index >= 0 && static_cast<std::size_t>(index) < list.size();
}
template <class T>
bool all_in_range(const std::vector<int>& indices, const std::vector<T>& list) {
  return std::all_of(indices.begin(), indices.end(), [&](int i) { return in_range(i, list); });
}

/// Strictly.
template <class List>
bool ascending(const List& list) {
  return std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
}

/// A fraction with a positive denominator.
inline bool proper(const Rational& q) { return mpz_sgn(mpq_denref(q.get_mpq_t())) > 0; }

}  // namespace encase::verification
