// SPDX-License-Identifier: MIT
#include "3d/triangles_apart.hpp"

#include <algorithm>
#include <cmath>

#include "3d/box_tree.hpp"
#include "3d/space_vectors.hpp"

namespace encase {

namespace {

using Triangle = std::array<Point<3>, 3>;

/// Whether all of one triangle is proved to be farther than the margin before all of the other
/// along n, which need not be of length 1. Corners are differences, rounded, from one of them. They
/// and their heights, sums of three products, are off by a few 2^-53 of |n| times what the corners
/// are apart, far less than half of the margin.
bool before(const Triangle& p, const Triangle& q, const Point<3>& n, double margin) {
  const double gap = std::min({dot(n, q[0]), dot(n, q[1]), dot(n, q[2])}) -
                     std::max({dot(n, p[0]), dot(n, p[1]), dot(n, p[2])});
  return gap > 1.5 * margin * (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]));
}

bool divided(const Triangle& p, const Triangle& q, const Point<3>& n, double margin) {
  return before(p, q, n, margin) || before(q, p, n, margin);
}

Triangle edges(const Triangle& p) { return {p[1] - p[0], p[2] - p[1], p[0] - p[2]}; }

/// Disjoint triangles are divided by a plane along a side of either, or along an edge of each; if
/// they lie in one plane, by one across it along an edge.
bool apart(const Triangle& p, const Triangle& q, double margin) {
  const Triangle along_p = edges(p), along_q = edges(q);
  const Point<3> p_normal = cross(along_p[0], along_p[1]), q_normal = cross(along_q[0], along_q[1]);
  if (divided(p, q, p_normal, margin) || divided(p, q, q_normal, margin)) return true;
  for (const Point<3>& a : along_p)
    for (const Point<3>& b : along_q)
      if (divided(p, q, cross(a, b), margin)) return true;
  for (int k = 0; k < 3; ++k)
    if (divided(p, q, cross(p_normal, along_p[k]), margin) ||
        divided(p, q, cross(q_normal, along_q[k]), margin))
      return true;
  return false;
}

bool share_a_corner(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](int p) { return p == b[0] || p == b[1] || p == b[2]; });
}

template <class Compared>
TrianglePairs find(const std::vector<Point<3>>& points,
                   const std::vector<std::array<int, 3>>& triangles, double margin,
                   const Compared& compared) {
  std::vector<Box<3>> boxes;
  boxes.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) {
    Box<3> box;
    for (int i = 0; i < 3; ++i) {
      const auto [lo, hi] = std::minmax({points[a][i], points[b][i], points[c][i]});
      box.lo[i] = lo - margin;
      box.hi[i] = hi + margin;
    }
    boxes.push_back(box);
  }
  TrianglePairs found;
  BoxTree(boxes).for_each_meeting_pair([&](int i, int j) {
    if (!compared(i, j) || share_a_corner(triangles[i], triangles[j])) return;
    const Point<3>& origin = points[triangles[i][0]];
    const auto corners = [&](int t) -> Triangle {
      return {points[triangles[t][0]] - origin, points[triangles[t][1]] - origin,
              points[triangles[t][2]] - origin};
    };
    if (!apart(corners(i), corners(j), margin)) found.emplace_back(i, j);
  });
  return found;
}

}  // namespace

TrianglePairs near_triangles(const std::vector<Point<3>>& points,
                             const std::vector<std::array<int, 3>>& triangles, double margin) {
  return find(points, triangles, margin, [](int, int) { return true; });
}

TrianglePairs near_triangles(const std::vector<Point<3>>& points,
                             const std::vector<std::array<int, 3>>& triangles, double margin,
                             int first) {
  return find(points, triangles, margin, [&](int i, int j) { return i < first && first <= j; });
}

}  // namespace encase
