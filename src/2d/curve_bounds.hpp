// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/expression_program.hpp"
#include "common/filtered_inclusion.hpp"
#include "common/interval.hpp"
#include "encase/function.hpp"
#include "encase/geometry.hpp"

namespace encase {

/// Bounds on a curve's function f on boxes, in doubles: its inclusion function. Nothing is
/// allocated but by the constructor. Boxes are closed and may be segments or points.
class CurveBounds {
 public:
  explicit CurveBounds(const Function<2>& function);

  /// Bounds on the partial derivatives; they claim nothing unless f is proved to be continuously
  /// differentiable on the box.
  struct Slopes {
    std::array<Interval, 2> slope;
    bool smooth = false;
  };

  /// What is known of f on a box.
  struct Look {
    bool absent = false;  ///< proved: f is zero nowhere on the box
    /// Proved: f has this sign (never Zero) wherever it has a value on the box.
    std::optional<Sign> sign;
    bool continuous = false;  ///< proved: f has a value everywhere on the box and is continuous
    bool changes = false;     ///< proved: f is zero somewhere on the box
    Slopes slopes;            ///< on the box, unless it is proved to be absent without them
  };
  Look look(const Box<2>& box);

  Slopes slopes(const Box<2>& box);

  /// The sign f is proved to have at a point where it has a value.
  std::optional<Sign> sign_at(const Point<2>& point);

  Interval value_at(const Point<2>& point);

  std::int64_t evaluations() const { return evaluations_; }

 private:
  struct Values {
    Interval range;
    bool continuous, nowhere;
  };
  Values values(const Box<2>& box);

  std::optional<Inclusion<2>> inclusion_;  ///< what f is, else:
  ExpressionProgram<2> program_;
  ExpressionProgram<2>::Workspace<Interval> workspace_;
  std::int64_t evaluations_ = 0;
};

/// The axis (0: x, 1: y) along which the curve is, in a box with these slopes, proved to be the
/// graph of a smooth function, since the other partial derivative is not zero; -1: neither.
int graph_axis(const CurveBounds::Slopes& slopes);

/// Whether a curve has a point in a box: it has if its function has both signs on a part on which
/// it is continuous, and has none if it keeps a sign on each of some parts. Nothing if neither is
/// proved after some parts, or at parts with both widths at most `smallest`. `look` is what the
/// curve's bounds say of the box.
std::optional<bool> has_point(CurveBounds& curve, const Box<2>& box, const CurveBounds::Look& look,
                              double smallest);

}  // namespace encase
