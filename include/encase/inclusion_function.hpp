// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "encase/geometry.hpp"
#include "encase/number.hpp"

/// Curves and surfaces given by a function of the caller's own that encloses f, its gradient and
/// its Hessian matrix on boxes. docs/surfaces.md says what is made of them.
namespace encase {

/// The numbers from lo to hi. Unless set it claims nothing; nor does one with an infinite end, an
/// end that is not a number, or lo > hi.
struct ClosedInterval {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
};

/// What is known of a function f of D coordinates on a closed box. Results of f's arithmetic are to
/// be rounded outward: everything that is proved of f rests on these intervals.
template <int D>
struct Enclosure {
  /// Holds f(x) for every x in the box: f has a value at each.
  ClosedInterval value;
  /// Intervals all of which claim something: f is differentiable on the box, and interval i holds
  /// its derivative along coordinate i at every point.
  std::array<ClosedInterval, D> gradient;
  /// Likewise: f is twice differentiable, and [i][k] holds the derivative along i and k. Only those
  /// with i <= k are read. Without them nothing is known of f on the box but for its sign.
  std::array<std::array<ClosedInterval, D>, D> hessian;
};

/// Encloses a function on a box, which may be a point and lie outside of the region. The closer it
/// is on small boxes, the fewer cells are needed: widths should be proportional to the box's.
/// Called by several threads at once, unless one is asked for; equal boxes are to give equal
/// results. If it throws, nothing is known on that box.
template <int D>
using InclusionFunction = std::function<Enclosure<D>(const Box<D>&)>;

/// A function that is known by its inclusion function. A value: copies share it, and only these are
/// equal (and their restrictions to one plane).
template <int D>
class Inclusion {
 public:
  explicit Inclusion(InclusionFunction<D> enclose)
      : enclose_(std::make_shared<const InclusionFunction<D>>(std::move(enclose))),
        whole_(enclose_) {}
  /// `of` with an affine map into its coordinates, which together say what the function is.
  template <int K>
  Inclusion(InclusionFunction<D> enclose, const Inclusion<K>& of, std::vector<Rational> map)
      : enclose_(std::make_shared<const InclusionFunction<D>>(std::move(enclose))),
        whole_(of.identity()),
        map_(std::move(map)) {}

  /// As it was given, with all its exceptions.
  const InclusionFunction<D>& function() const { return *enclose_; }
  const std::shared_ptr<const void>& identity() const { return whole_; }
  bool operator==(const Inclusion& other) const {
    return whole_ == other.whole_ && map_ == other.map_;
  }
  std::string to_string() const { return "(an inclusion function)"; }

 private:
  std::shared_ptr<const InclusionFunction<D>> enclose_;
  std::shared_ptr<const void> whole_;
  std::vector<Rational> map_;
};

}  // namespace encase
