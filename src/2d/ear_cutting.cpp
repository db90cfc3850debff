// SPDX-License-Identifier: MIT
#include "2d/ear_cutting.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace encase {
namespace {

/// Twice the signed area of a triangle.
double area(const Point<2>& a, const Point<2>& b, const Point<2>& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A polygon from which ears are cut.
class Ears {
 public:
  Ears(const std::vector<Point<2>>& points, std::vector<int> polygon)
      : points_(points), polygon_(std::move(polygon)) {}

  std::vector<std::array<int, 3>> cut() {
    std::vector<std::array<int, 3>> triangles;
    std::size_t at = 0;
    while (polygon_.size() >= 3) {
      const std::size_t ear = next_ear(at);
      triangles.push_back(corner(ear));
      polygon_.erase(polygon_.begin() + static_cast<std::ptrdiff_t>(ear));
      // Not the neighbour, so that ears are cut all around and triangles do not become a fan.
      at = ear + 1;
    }
    return triangles;
  }

 private:
  std::array<int, 3> corner(std::size_t k) const {
    const std::size_t n = polygon_.size();
    return {polygon_[(k + n - 1) % n], polygon_[k], polygon_[(k + 1) % n]};
  }
  double turn(const std::array<int, 3>& t) const {
    return area(points_[t[0]], points_[t[1]], points_[t[2]]);
  }

  /// A convex corner whose triangle holds no other one, the first from `at` on. Where rounding
  /// leaves none, the flattest corner.
  std::size_t next_ear(std::size_t at) const {
    const std::size_t n = polygon_.size();
    for (std::size_t i = 0; i < n; ++i)
      if (is_ear((at + i) % n)) return (at + i) % n;
    std::size_t flattest = 0;
    for (std::size_t k = 1; k < n; ++k)
      if (std::fabs(turn(corner(k))) < std::fabs(turn(corner(flattest)))) flattest = k;
    return flattest;
  }

  bool is_ear(std::size_t k) const {
    const std::array<int, 3> t = corner(k);
    if (!(turn(t) > 0)) return false;
    const Point<2>&a = points_[t[0]], &b = points_[t[1]], &c = points_[t[2]];
    for (const int other : polygon_) {
      const Point<2>& p = points_[other];
      if (other != t[0] && other != t[1] && other != t[2] && area(a, b, p) >= 0 &&
          area(b, c, p) >= 0 && area(c, a, p) >= 0)
        return false;
    }
    return true;
  }

  const std::vector<Point<2>>& points_;
  std::vector<int> polygon_;
};

}  // namespace

std::vector<std::array<int, 3>> cut_ears(const std::vector<Point<2>>& points,
                                         std::vector<int> polygon) {
  return Ears(points, std::move(polygon)).cut();
}

}  // namespace encase
