// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <tuple>
#include <vector>

#include "common/elementary.hpp"
#include "common/kernel.hpp"
#include "common/mpfr_interval.hpp"
#include "encase/expression.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// Ranges of a function of D variables on a box, of its first derivatives (Order 1 and 2) and of
/// its second ones (Order 2). Real is Interval or MpfrInterval.
template <class Real, int D, int Order>
struct IntervalJet {
  static constexpr int kSize = Order == 0 ? 1 : Order == 1 ? 1 + D : 1 + D + D * (D + 1) / 2;

  /// The value, then one derivative per variable, then the second derivatives: xx, xy, yy, or
  /// xx, xy, xz, yy, yz, zz.
  std::array<Real, kSize> part;

  const Real& value() const { return part[0]; }
  const Real& first(int i) const { return part[static_cast<std::size_t>(1 + i)]; }
  const Real& second(int i, int j) const { return part[second_index(i, j)]; }
  static constexpr std::size_t second_index(int i, int j) {
    if (i > j) return second_index(j, i);
    return static_cast<std::size_t>(1 + D + i * D - i * (i - 1) / 2 + (j - i));
  }
};

/// What is known of an expression on a closed box.
template <class Real, int D, int Order>
struct JetOnBox {
  /// The value's range holds every value that the function has on the box; those of derivatives
  /// every derivative where the function has derivatives. Bounds may be infinite, and are not NaN;
  /// the whole line where the function has no value anywhere.
  IntervalJet<Real, D, Order> jet;
  Regularity regularity = Regularity::Smooth;

  const Real& range() const { return jet.value(); }
  /// No point of the box has a value.
  bool nowhere() const { return regularity == Regularity::Nowhere; }
  /// Every point of the box has one, and they depend continuously on the point.
  bool continuous() const { return regularity >= Regularity::Continuous; }
  /// The function is analytic on the box: then differences of its values obey the mean value
  /// theorem with the ranges of its derivatives.
  bool smooth() const { return regularity == Regularity::Smooth; }
};

/// The sign of an expression at a point.
enum class PointSign { Negative, Zero, Positive, NoValue, Unknown };

/// An expression made ready to be evaluated on boxes, in double or MPFR intervals. Every evaluation
/// costs one pass over the steps. A value; it can be shared between threads, workspaces cannot.
template <int D>
class ExpressionProgram {
 public:
  struct Step {
    Operation operation = Operation::Constant;
    int first = -1;   ///< the operands, earlier steps
    int second = -1;  ///
    int number = 0;   ///< the axis of a variable, the exponent of a power
    int axes = 0;     ///< a bit for every variable it depends on
    Rational constant;
    Interval enclosure;  ///< of a constant, pi or e
  };

  /// What an evaluation writes to; it keeps its memory for the next one, of any expression.
  template <class Real>
  class Workspace {
   public:
    template <int Order>
    std::vector<IntervalJet<Real, D, Order>>& jets() {
      return std::get<Order>(jets_);
    }

   private:
    std::tuple<std::vector<IntervalJet<Real, D, 0>>, std::vector<IntervalJet<Real, D, 1>>,
               std::vector<IntervalJet<Real, D, 2>>>
        jets_;
  };

  /// A constant if the expression uses no variable; of the D first variables it may use all.
  explicit ExpressionProgram(const Expression& expression);

  const std::vector<Step>& steps() const { return steps_; }

  /// Ranges on a box of which one interval per axis is given. MPFR works at the precision of the
  /// first of them.
  template <int Order, class Real>
  JetOnBox<Real, D, Order> evaluate(const std::array<Real, D>& box,
                                    Workspace<Real>& workspace) const;

  template <class Real>
  JetOnBox<Real, D, 0> value(const std::array<Real, D>& box, Workspace<Real>& workspace) const {
    return evaluate<0>(box, workspace);
  }
  template <class Real>
  JetOnBox<Real, D, 1> value_and_gradient(const std::array<Real, D>& box,
                                          Workspace<Real>& workspace) const {
    return evaluate<1>(box, workspace);
  }

  /// The sign at a point: in doubles, then in MPFR up to the kernel's cap, then, where all values
  /// on the way are rational, exactly. Zero and NoValue are proved; Unknown is what is not told
  /// apart from zero, or from the edge of where the expression has a value. The kernel counts it.
  PointSign sign_at(const RationalPoint<D>& point, Kernel& kernel) const;

 private:
  std::optional<PointSign> exact_sign(const RationalPoint<D>& point) const;

  std::vector<Step> steps_;
};

/// The intervals of a box.
template <int D>
std::array<Interval, D> intervals(const Box<D>& box) {
  std::array<Interval, D> sides;
  for (std::size_t i = 0; i < D; ++i) sides[i] = {box.lo[i], box.hi[i]};
  return sides;
}
template <int D>
std::array<MpfrInterval, D> intervals(const Box<D>& box, int bits) {
  std::array<MpfrInterval, D> sides;
  for (std::size_t i = 0; i < D; ++i) sides[i] = MpfrInterval(bits, box.lo[i], box.hi[i]);
  return sides;
}
template <int D>
std::array<MpfrInterval, D> intervals(const RationalPoint<D>& point, int bits) {
  std::array<MpfrInterval, D> sides;
  for (std::size_t i = 0; i < D; ++i) sides[i] = MpfrInterval(bits, point[i]);
  return sides;
}

}  // namespace encase
