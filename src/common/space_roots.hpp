// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "common/box_tests.hpp"
#include "common/kernel.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// A polynomial in three variables, for values about twice as precise as doubles.
class PreciseSpacePolynomial {
 public:
  explicit PreciseSpacePolynomial(const FilteredPolynomial<3>& f);

  /// The (scaled) value at a point where the sum of the absolute values of its terms is at most
  /// `absolute`, with a proved bound on its error (docs/error-bounds.md).
  FilteredPolynomial<3>::Value value(const Point<3>& point, double absolute) const;

 private:
  int degree_;
  /// Those of x^i y^j z^k with i + j + k <= degree_, highest powers first, i before j before k; the
  /// exact ones within 2^-104, and what doubles lack of them.
  std::vector<double> coefficients_, low_;
};

/// The common zeros of three functions, found one at a time from boxes that hold at most one.
class SpaceRoots {
 public:
  /// They are looked for in `root`. Keeps references.
  SpaceRoots(const System<3>& system, const Box<3>& root, Kernel& kernel);

  /// Nothing less contracting is used: a checker that recomputes a contraction on a somewhat
  /// different box has room, and radii are at most some times the residual.
  static constexpr double kQuality = 0.7;

  /// The contraction on a box, as box_tests' on nets.
  using Contract = std::function<std::optional<Contraction<3>>(const Box<3>&)>;

  /// The number of the zero in the box `leaf`, which has the contraction `c`, if it is found there
  /// from `guess`: a box that holds the leaf and the zero's box then holds at most one zero.
  /// Nothing where halves of the leaf are to be asked: the zero is elsewhere, or lies at the leaf's
  /// border. For those `contract` is asked.
  std::optional<int> root_near(const Box<3>& leaf, const Contraction<3>& c, const Point<3>& guess,
                               const Contract& contract);

  /// Boxes that do not meet, with one zero each, and whether their centres are proved to be the
  /// zeros, correctly rounded.
  std::vector<Box<3>> boxes;
  std::vector<bool> rounded;

 private:
  struct Approximation;
  struct Enclosure {
    Box<3> box;
    bool rounded = false;
  };
  std::optional<Approximation> iterate(const Point<3>& start, double reach, bool precise) const;
  std::optional<Approximation> newton(const Point<3>& start, double reach) const;
  std::optional<Enclosure> enclose(const Box<3>& around, const Contraction<3>& c,
                                   const Approximation& a) const;
  std::optional<Enclosure> tight_box(const Box<3>& around, Approximation a) const;
  std::optional<Enclosure> tight_box_at(const Box<3>& around, const Approximation& a,
                                        Point<3>* step) const;

  const System<3>& system_;
  Kernel& kernel_;
  std::vector<Box<3>> alone_;  ///< boxes around `boxes` with at most one zero each
  Point<3> margin_;            ///< around points, to bound derivatives by values
  std::vector<PreciseSpacePolynomial> precise_;  ///< unless one is no polynomial
};

}  // namespace encase
