// SPDX-License-Identifier: MIT
#include "3d/singular_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "3d/box_clusters.hpp"
#include "3d/space_vectors.hpp"

namespace encase {
namespace {

/// What vanishes where surfaces are not in general position: their functions, and the minors of
/// their gradients.
using Values = std::vector<double>;

Values values_at(const std::vector<const FilteredFunction<3>*>& surfaces, const Point<3>& p) {
  Values values;
  std::vector<Point<3>> gradients;
  for (const FilteredFunction<3>* f : surfaces) {
    const auto at = f->value_and_gradient(p);
    values.push_back(at.value);
    gradients.push_back(at.gradient);
  }
  if (surfaces.size() == 3) {
    values.push_back(dot(cross(gradients[0], gradients[1]), gradients[2]));
    return values;
  }
  const Point<3> minors = surfaces.size() == 1 ? gradients[0] : cross(gradients[0], gradients[1]);
  values.insert(values.end(), minors.begin(), minors.end());
  return values;
}

/// The columns of the derivative, by the box's widths, from central differences.
std::array<Values, 3> derivative(const std::vector<const FilteredFunction<3>*>& surfaces,
                                 const Point<3>& p, const Box<3>& box) {
  constexpr double kStep = 0x1p-12;
  std::array<Values, 3> columns;
  for (std::size_t i = 0; i < 3; ++i) {
    Point<3> above = p, below = p;
    above[i] += kStep * box.width(static_cast<int>(i));
    below[i] -= kStep * box.width(static_cast<int>(i));
    columns[i] = values_at(surfaces, above);
    const Values low = values_at(surfaces, below);
    for (std::size_t k = 0; k < low.size(); ++k)
      columns[i][k] = (columns[i][k] - low[k]) / (2 * kStep);
  }
  return columns;
}

/// How large the values are in the box, each by itself.
Values sizes_in(const std::vector<const FilteredFunction<3>*>& surfaces, const Box<3>& box) {
  Values sizes;
  for (int corner = 0; corner < 8; ++corner) {
    Point<3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = corner >> i & 1 ? box.hi[i] : box.lo[i];
    const Values values = values_at(surfaces, p);
    sizes.resize(values.size(), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k)
      sizes[k] = std::max(sizes[k], std::fabs(values[k]));
  }
  for (double& size : sizes)
    if (!(size > 0)) size = 1;
  return sizes;
}

/// The step of Levenberg and Marquardt, in parts of the box's widths, damped by the square of the
/// values: so it converges fast to curves of zeros too (Yamashita and Fukushima 2001).
Point<3> least_squares_step(const Values& values, const std::array<Values, 3>& columns,
                            const Values& sizes) {
  std::array<Point<3>, 3> m{};
  Point<3> right{};
  double square = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double weight = 1 / (sizes[k] * sizes[k]);
    square += weight * values[k] * values[k];
    for (std::size_t i = 0; i < 3; ++i) {
      right[i] -= weight * columns[i][k] * values[k];
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += weight * columns[i][k] * columns[j][k];
    }
  }
  const double damping = (0.1 * square + 1e-14) * (m[0][0] + m[1][1] + m[2][2]) + 1e-300;
  for (std::size_t i = 0; i < 3; ++i) m[i][i] += damping;
  const double det = dot(cross(m[0], m[1]), m[2]);
  Point<3> step{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<Point<3>, 3> replaced = m;  // (symmetric: rows are columns)
    replaced[i] = right;
    step[i] = dot(cross(replaced[0], replaced[1]), replaced[2]) / det;
  }
  return step;
}

}  // namespace

bool seem_singular(const std::vector<const FilteredFunction<3>*>& surfaces, const Box<3>& box) {
  constexpr int kMostSteps = 32;
  constexpr double kZero = 1e-5;   // of the values' sizes in the box
  constexpr double kMargin = 0.5;  // of the box's widths
  const Values sizes = sizes_in(surfaces, box);
  const Point<3> center = box.center();
  Point<3> p = center;
  const auto is_near = [&](double reach) {
    for (int i = 0; i < 3; ++i)
      if (!(std::fabs(p[static_cast<std::size_t>(i)] - center[static_cast<std::size_t>(i)]) <=
            reach * box.width(i)))
        return false;
    return true;
  };
  for (int step = 0; step < kMostSteps; ++step) {
    const Values values = values_at(surfaces, p);
    bool zero = true;
    for (std::size_t k = 0; k < values.size(); ++k)
      zero = zero && std::fabs(values[k]) <= kZero * sizes[k];
    if (zero) return is_near(0.5 + kMargin);
    const Point<3> move = least_squares_step(values, derivative(surfaces, p, box), sizes);
    for (std::size_t i = 0; i < 3; ++i) p[i] += move[i] * box.width(static_cast<int>(i));
    if (!is_near(2)) return false;
  }
  return false;
}

std::vector<bool> in_rows(const std::vector<Box<3>>& boxes, const std::vector<Box<3>>& known) {
  constexpr double kLength = 8;  // of a row, in widths of its boxes
  std::vector<Box<3>> all = boxes;
  all.insert(all.end(), known.begin(), known.end());
  const std::vector<int> component = box_components(all);
  struct Extent {
    std::optional<Box<3>> hull;
    double widest = 0;
    bool is_known = false;
  };
  std::vector<Extent> extents(all.size());
  for (std::size_t k = boxes.size(); k < all.size(); ++k)
    extents[static_cast<std::size_t>(component[k])].is_known = true;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    Extent& extent = extents[static_cast<std::size_t>(component[k])];
    extent.hull = extent.hull ? hull(*extent.hull, boxes[k]) : boxes[k];
    extent.widest = std::max(extent.widest, boxes[k].largest_width());
  }
  std::vector<bool> result;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const Extent& extent = extents[static_cast<std::size_t>(component[k])];
    result.push_back(extent.is_known || extent.hull->largest_width() >= kLength * extent.widest);
  }
  return result;
}

}  // namespace encase
