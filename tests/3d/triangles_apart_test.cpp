// SPDX-License-Identifier: MIT
#include "3d/triangles_apart.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "3d/box_tree.hpp"
#include "encase/number.hpp"

namespace encase {
namespace {

using Pairs = std::set<std::pair<int, int>>;

TEST(BoxTree, FindsAllPairsOnce) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1), width(0, 0.3);
  for (const int count : {0, 1, 5, 6, 7, 50, 400}) {
    std::vector<Box<3>> boxes;
    for (int k = 0; k < count; ++k) {
      Box<3> box;
      for (int i = 0; i < 3; ++i) {
        box.lo[i] = k % 7 == 3 ? 0 : coordinate(random);  // some in one place
        box.hi[i] = box.lo[i] + width(random);
      }
      boxes.push_back(box);
    }
    Pairs found, expected;
    BoxTree(boxes).for_each_meeting_pair([&](int i, int j) {
      EXPECT_LT(i, j);
      EXPECT_TRUE(found.emplace(i, j).second);
    });
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j)
        if (boxes[i].meets(boxes[j])) expected.emplace(i, j);
    EXPECT_EQ(found, expected) << count;
  }
}

using Exact = std::array<Rational, 3>;

/// Six times the volume.
int turn(const Exact& a, const Exact& b, const Exact& c, const Exact& d) {
  std::array<Exact, 3> m;
  for (int i = 0; i < 3; ++i) {
    m[0][i] = b[i] - a[i];
    m[1][i] = c[i] - a[i];
    m[2][i] = d[i] - a[i];
  }
  const Rational volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                          m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                          m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  return sgn(volume);
}

/// Whether an edge meets a closed triangle; nothing if they lie in one plane.
std::optional<bool> meet(const Exact& p, const Exact& q, const std::array<Exact, 3>& t) {
  const int before = turn(t[0], t[1], t[2], p), behind = turn(t[0], t[1], t[2], q);
  if (before == 0 && behind == 0) return std::nullopt;
  if (before * behind > 0) return false;
  std::set<int> turns;
  for (int i = 0; i < 3; ++i) turns.insert(turn(p, q, t[i], t[(i + 1) % 3]));
  return !(turns.contains(1) && turns.contains(-1));
}

bool none(const std::vector<Point<3>>& points, const std::vector<std::array<int, 3>>& triangles,
          double margin) {
  return near_triangles(points, triangles, margin).empty();
}

TEST(NearTriangles, AreThoseThatMeet) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> coordinate(0, 6);
  int met = 0, apart = 0;
  for (int round = 0; round < 4000; ++round) {
    std::vector<Point<3>> points;
    std::array<std::array<Exact, 3>, 2> exact;
    for (int k = 0; k < 6; ++k) {
      Point<3> p;
      for (int i = 0; i < 3; ++i) {
        p[i] = coordinate(random) + (k < 3 ? 0.0 : 0.5 * (round % 2));
        exact[k / 3][k % 3][i] = Rational(p[i]);
      }
      points.push_back(p);
    }
    bool meeting = false, in_one_plane = false;
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 3; ++i) {
        const auto m = meet(exact[side][i], exact[side][(i + 1) % 3], exact[1 - side]);
        in_one_plane = in_one_plane || !m;
        meeting = meeting || (m && *m);
      }
    if (in_one_plane) continue;
    EXPECT_EQ(none(points, {{0, 1, 2}, {3, 4, 5}}, 0x1p-40), !meeting) << round;
    ++(meeting ? met : apart);
  }
  EXPECT_GT(met, 300);
  EXPECT_GT(apart, 300);
}

TEST(NearTriangles, InOnePlaneToo) {
  const std::vector<Point<3>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},     {1, 1, 0},
                                     {2, 1, 0}, {1, 2, 0}, {0.5, 0.25, 0}};
  EXPECT_TRUE(none(points, {{0, 1, 2}, {3, 4, 5}}, 0x1p-40));
  EXPECT_FALSE(none(points, {{0, 1, 2}, {6, 4, 5}}, 0x1p-40));
  // Those that share a corner are not compared.
  EXPECT_TRUE(none(points, {{0, 1, 2}, {2, 6, 4}}, 0x1p-40));
}

TEST(NearTriangles, OfTwoListsAreFound) {
  const std::vector<Point<3>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},   {0, 0, 1},    {1, 0, 1},
                                     {0, 1, 1}, {0, 0, 2}, {0.2, 0, 0}, {0.2, 1, 0.1}};
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {6, 7, 8}, {3, 4, 5}};
  EXPECT_EQ(near_triangles(points, triangles, 0x1p-40), (TrianglePairs{{0, 1}, {1, 2}}));
  EXPECT_EQ(near_triangles(points, triangles, 0x1p-40, 1), (TrianglePairs{{0, 1}}));
  EXPECT_EQ(near_triangles(points, triangles, 0x1p-40, 2), (TrianglePairs{{1, 2}}));
}

TEST(NearTriangles, AreToldApartUpToTheMargin) {
  std::vector<Point<3>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  for (const double gap : {0x1p-20, 0x1p-30, 0x1p-38}) {
    for (int k = 3; k < 6; ++k) points[k][2] = gap;
    EXPECT_TRUE(none(points, {{0, 1, 2}, {3, 4, 5}}, gap / 4));
    EXPECT_FALSE(none(points, {{0, 1, 2}, {3, 4, 5}}, gap));
  }
}

}  // namespace
}  // namespace encase
