// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "3d/surface_bounds.hpp"
#include "common/kernel.hpp"
#include "encase/geometry.hpp"

/// Polylines along the curve in which two surfaces meet, with a proved distance.
/// docs/meshes.md has the argument.
namespace encase {

/// A point near a curve and a box around it that holds the curve's point which it stands for.
struct SpacePoint {
  Point<3> point{};
  Box<3> box;
};

/// A part of a curve, from one known point to another.
struct SpacePath {
  std::vector<SpacePoint> points;
  /// One fewer than points: neither the chord nor the piece of the curve between two points has a
  /// point farther than this from the other. Infinite: nothing is proved.
  std::vector<double> distances;
};

/// Follows the curve f = g = 0 of two surfaces, oriented along grad f x grad g.
class ArcTracer {
 public:
  /// All are to outlive the tracer. `size`: of the region.
  ArcTracer(const SurfaceBounds& f, const SurfaceBounds& g, double size, Kernel& kernel)
      : f_(f), g_(g), size_(size), kernel_(kernel) {}

  /// The sign of (grad f x grad g) . w on the box: Zero if none is proved.
  Sign sense(const Box<3>& box, const Point<3>& w);

  /// The curve from one of its points to another that lies ahead in its direction (`sense`: 1) or
  /// in the opposite one (-1). Pieces are within `tolerance` if doubles allow it; at most `most` of
  /// them. What cannot be proved becomes one chord to the end.
  SpacePath trace(const SpacePoint& from, const SpacePoint& to, int sense, double tolerance,
                  int most);

  /// The unit tangent along grad f x grad g; zero where the gradients are parallel.
  Point<3> tangent(const Point<3>& point) const;

 private:
  struct Chord;
  struct Attempt;
  Attempt prove(const SpacePoint& from, const SpacePoint& to, bool free, const SpacePoint* beyond,
                int sense, double tolerance, int bits);
  Attempt prove(const SpacePoint& from, const SpacePoint& to, bool free, const SpacePoint* beyond,
                int sense, double tolerance);
  Point<3> on_curve(Point<3> point, const Point<3>& along) const;

  const SurfaceBounds& f_;
  const SurfaceBounds& g_;
  double size_;
  Kernel& kernel_;
};

}  // namespace encase
