// SPDX-License-Identifier: MIT
#include "3d/surface_models.hpp"

#include <algorithm>
#include <cmath>

namespace encase {

namespace {

/// A cube of the grid is this many times as wide as the boxes it serves, at least.
constexpr double kWider = 4;
constexpr double kUp = 1 + 0x1p-40;

}  // namespace

SurfaceModel::SurfaceModel(const ModelDerivatives& derivatives) : d_(derivatives) {
  double square = 0;
  for (const auto& matrix : d_.third)
    for (const IntervalVector& row : matrix)
      for (const Interval& entry : row) square += magnitude(entry) * magnitude(entry);
  third_ = std::sqrt(square) * kUp;
}

IntervalVector SurfaceModel::gradient(const Point<3>& at) const {
  IntervalVector way, result = d_.first;
  for (int i = 0; i < 3; ++i) way[i] = Interval(at[i]) - Interval(d_.center[i]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result[i] = result[i] + (d_.second[i][j] + Interval(0.5) * dot(d_.third[i][j], way)) * way[j];
  return result;
}

std::array<IntervalVector, 3> SurfaceModel::second(const Box<3>& box) const {
  IntervalVector way;
  for (int i = 0; i < 3; ++i) way[i] = Interval(box.lo[i], box.hi[i]) - Interval(d_.center[i]);
  std::array<IntervalVector, 3> result = d_.second;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      result[i][j] = result[j][i] = d_.second[i][j] + dot(d_.third[i][j], way);
  return result;
}

std::size_t SurfaceModels::Hash::operator()(const Place& place) const {
  std::size_t hash = 0;
  for (const long k : place) hash = (hash ^ static_cast<std::size_t>(k)) * 0x9E3779B97F4A7C15u;
  return hash ^ hash >> 32;
}

const SurfaceModel& SurfaceModels::around(const Box<3>& box) {
  int exponent = 0;
  std::frexp(kWider * box.largest_width(), &exponent);
  const double width = std::ldexp(1.0, exponent);
  Place place{exponent, 0, 0, 0};
  Box<3> cube;
  for (int i = 0; i < 3; ++i) {
    const double k = std::floor((0.5 * (box.lo[i] + box.hi[i])) / width);
    place[i + 1] = static_cast<long>(std::clamp(k, -0x1p52, 0x1p52));
    // The middle is in the grid's cube but for roundings: this holds the box.
    cube.lo[i] = width * (k - 0.625 / kWider);
    cube.hi[i] = width * (k + 1 + 0.625 / kWider);
  }
  const auto found = models_.find(place);
  return found != models_.end()
             ? found->second
             : models_.emplace(place, SurfaceModel(f_.model(cube, kernel_))).first->second;
}

}  // namespace encase
