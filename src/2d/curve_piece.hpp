// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "2d/partition.hpp"
#include "common/interval.hpp"
#include "common/kernel.hpp"
#include "common/tile.hpp"
#include "encase/geometry.hpp"

/// What proves that a chord stands for a piece of a curve. docs/tracing.md has the argument.
namespace encase {

/// A point near a curve and a box around it that holds the curve's point which it stands for.
struct CurvePoint {
  Point<2> point{};
  Box<2> box;
};

/// A parallelogram beside a chord, with the coordinates s and t in [-1, 1]: the coordinate along
/// `axis` is center + half s there, the other one center + half t + slope half s (with the half
/// width of the axis). In it a curve is a graph t = g(s) for all s, within `delta` of the line t =
/// alpha + beta s.
struct Tube {
  int axis = 0;
  Point<2> center{}, half{};
  double slope = 0;
  double alpha = 0, beta = 0, delta = 0;
  double from = 0, to = 0;  ///< the piece lies over [from, to] of s, or less

  /// Whether the piece may have a point in the box; false is proved.
  bool may_meet(const Box<2>& box) const;
  /// Whether the parallelogram contains the box; true is proved.
  bool holds(const Box<2>& box) const;

 private:
  /// Enclosures of s and t on a box.
  Interval along(const Box<2>& box) const;
  Interval across(const Box<2>& box) const;
};

/// A piece of a curve from one point to the next, beside its chord.
struct CurvePiece {
  /// Both run strictly monotonically along this coordinate.
  int axis = 0;
  /// 1: with positive values to the left; -1: to the right.
  int direction = 1;
  /// Neither has a point farther than this from the other; infinite if nothing is proved.
  double distance = 0;
};

/// The answer to one attempt.
struct Attempt {
  bool proved = false;
  CurvePiece piece;
  Tube tube;
  CurvePoint to;      ///< the end, with its box
  double factor = 0;  ///< by which the chord's length is to be multiplied: to have the distance
                      ///< wished, or for another attempt
};

/// Proves pieces of one curve.
class PieceProver {
 public:
  /// Both are to outlive the prover.
  PieceProver(TiledFunction& f, Kernel& kernel) : f_(f), kernel_(kernel) {}

  /// That a chord along `axis` stands for a piece of the curve in a direction, within `goal`.
  /// `free`: the end is only a point near the curve and gets its box here.
  Attempt prove(const CurvePoint& from, const CurvePoint& to, bool free, int axis, int direction,
                double goal);

  /// About the value and gradient at a point, from the best tile at hand.
  ValueAndGradient look_at(const Point<2>& point);

 private:
  struct Question;
  class Trial;
  /// Whether another tile may do better: this one's errors are too large, or it is too small.
  enum class Fit { Good, Noisy, Outside };
  Fit try_with(const Tile& tile, const Question& question, Attempt* attempt) const;
  bool own_holds(const Point<2>& point) const;
  bool expand_around(const Question& question, double reach, int bits);

  TiledFunction& f_;
  Kernel& kernel_;
  Tile own_;  ///< where the tiles of f are not precise enough; degree -1 for none
};

}  // namespace encase
