// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>

#include "3d/surface_bounds.hpp"

namespace encase {

/// A surface's function near a place, as ModelDerivatives describe it.
class SurfaceModel {
 public:
  explicit SurfaceModel(const ModelDerivatives& derivatives);

  /// Of p at a point of the model's box.
  IntervalVector gradient(const Point<3>& at) const;
  /// The second derivatives of p on a part of the model's box.
  std::array<IntervalVector, 3> second(const Box<3>& box) const;
  /// Bounds the norm of p's third derivatives on the model's box, as a vector of 27.
  double third() const { return third_; }
  /// What e adds to every component of the gradient, and to every second derivative, at most.
  double slope_error() const { return d_.slope_error; }
  double bend_error() const { return d_.bend_error; }

 private:
  ModelDerivatives d_;
  double third_ = 0;
};

/// The models of a surface, each made when it is first asked for. Which one serves a box depends on
/// the box alone.
class SurfaceModels {
 public:
  /// Both are to outlive this.
  SurfaceModels(const SurfaceBounds& f, Kernel& kernel) : f_(f), kernel_(kernel) {}

  const SurfaceBounds& surface() const { return f_; }
  /// The model of a cube some times as large as the box, which holds it. Valid until another one is
  /// asked for.
  const SurfaceModel& around(const Box<3>& box);

 private:
  using Place = std::array<long, 4>;  ///< a cube's size, a power of two, and place in a grid
  struct Hash {
    std::size_t operator()(const Place& place) const;
  };

  const SurfaceBounds& f_;
  Kernel& kernel_;
  std::unordered_map<Place, SurfaceModel, Hash> models_;
};

}  // namespace encase
