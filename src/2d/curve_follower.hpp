// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "2d/curve_piece.hpp"

/// Walking along a curve.
namespace encase {

/// Points along a curve and the pieces between them, one fewer.
struct CurvePath {
  std::vector<CurvePoint> points;
  std::vector<CurvePiece> pieces;

  /// Whether all pieces are.
  bool is_proved() const;
  /// The same path from its end.
  void reverse();
  /// Goes on along a path that begins where this one ends.
  void append(const CurvePath& path);
};

/// Walks along one curve by pieces that are proved.
class CurveFollower {
 public:
  /// `size`: the largest coordinate, in absolute value, in the region. All outlive the follower.
  CurveFollower(TiledFunction& f, Kernel& kernel, double size)
      : f_(f), prover_(f, kernel), size_(size) {}

  /// The path from a point of the curve, in a direction (see CurvePiece), to where it first meets
  /// another one; both have boxes. Every piece is proved, and within `goal` or what doubles allow;
  /// where no proof is found, or with more than `most` pieces, a last piece without proof leads to
  /// the end.
  CurvePath follow(const CurvePoint& from, const CurvePoint& to, int direction, double goal,
                   int most);

  /// Below this (input units) no distance is proved: some units in the last place of coordinates.
  double least_goal() const { return 0x1p-46 * size_; }

 private:
  struct Step {
    bool found = false;
    int axis = 0;
    CurvePoint to;
  };
  Step step_from(const Point<2>& at, int direction, double length);
  int axis_between(const Point<2>& from, const Point<2>& to);

  TiledFunction& f_;
  PieceProver prover_;
  double size_;
};

}  // namespace encase
