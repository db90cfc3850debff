// SPDX-License-Identifier: MIT
#include "common/subdivision.hpp"

#include <gtest/gtest.h>

#include "common/box_tests.hpp"
#include "written.hpp"

namespace encase {
namespace {

using written::polynomial;

template <int D>
Rational volume(const Box<D>& box) {
  Rational product = 1;
  for (int i = 0; i < D; ++i) product *= Rational(box.hi[i]) - Rational(box.lo[i]);
  return product;
}

template <int D>
bool overlap(const Box<D>& a, const Box<D>& b) {
  for (int i = 0; i < D; ++i)
    if (a.hi[i] <= b.lo[i] || b.hi[i] <= a.lo[i]) return false;
  return true;
}

constexpr int kInside = 7, kLeaf = 9;

/// The octree of a sphere of radius 1: excluded where f has a sign, down to boxes of width 1/4.
Subdivision<3> sphere_octree(const Box<3>& root, const std::vector<Hyperplane<3>>& half_spaces,
                             const SubdivisionLimits& limits) {
  const FilteredFunction<3> f(polynomial<3>("x^2 + y^2 + z^2 - 1"));
  Kernel kernel;
  return subdivide<3, 1>({&f}, root, half_spaces, limits, kernel,
                         [](const std::array<Bernstein<3>, 1>& nets, const Box<3>& box) {
                           if (const auto sign = sign_on_cube(nets[0]))
                             return *sign == Sign::Negative ? kInside : cover::kExcluded;
                           int axis = 0;
                           for (int i = 1; i < 3; ++i)
                             if (box.width(i) > box.width(axis)) axis = i;
                           return box.width(axis) > 0.25 ? cover::kSplitX - axis : kLeaf;
                         });
}

TEST(Subdivide, OctreeLeavesTileTheRoot) {
  const Box<3> root{{-1.5, -1.25, -1.25}, {1.5, 1.5, 1.75}};
  const Subdivision<3> tree = sphere_octree(root, {}, {});
  const std::vector<int> tokens = tree.tokens();
  EXPECT_EQ(tokens.size(), static_cast<std::size_t>(tree.size()));
  const auto f = polynomial<3>("x^2 + y^2 + z^2 - 1");
  std::vector<Box<3>> all;
  Rational sum = 0;
  for (const int token : {kInside, kLeaf, cover::kExcluded, cover::kUnresolved, cover::kOutside}) {
    const auto boxes = leaves<3>(root, tokens, token);
    EXPECT_EQ(boxes.empty(), token == cover::kUnresolved || token == cover::kOutside);
    for (const Box<3>& box : boxes) {
      EXPECT_TRUE(root.contains(box));
      sum += volume<3>(box);
      // The net that a leaf was settled by was the net on that leaf.
      const Point<3> c = box.center();
      const int sign = sgn(f({Rational(c[0]), Rational(c[1]), Rational(c[2])}));
      if (token == kInside) {
        EXPECT_LT(sign, 0);
      }
      if (token == cover::kExcluded) {
        EXPECT_GT(sign, 0);
      }
      if (token == kLeaf) {
        EXPECT_LE(box.largest_width(), 0.25);
      }
    }
    all.insert(all.end(), boxes.begin(), boxes.end());
  }
  EXPECT_EQ(sum, volume<3>(root));
  // A binary tree: one leaf more than inner nodes.
  EXPECT_EQ(2 * all.size(), tokens.size() + 1);
  int overlaps = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) overlaps += overlap<3>(all[i], all[j]);
  EXPECT_EQ(overlaps, 0);
  EXPECT_GT(all.size(), 500u);
}

TEST(Subdivide, BoxesBeyondAHalfSpaceAreOutside) {
  const Box<3> root{{-1.5, -1.25, -1.25}, {1.5, 1.5, 1.75}};
  const auto plane =
      Hyperplane<3>::from_rationals({1, Rational(1, 3), Rational(-1, 7), Rational(-1, 10)});
  const std::vector<int> tokens = sphere_octree(root, {plane}, {}).tokens();
  const auto value = [&](const Box<3>& box, bool largest) {
    const auto c = plane.exact();
    Rational sum = c[3];
    for (int i = 0; i < 3; ++i)
      sum += c[i] * Rational((c[i] > 0) == largest ? box.hi[i] : box.lo[i]);
    return sum;
  };
  const auto outside = leaves<3>(root, tokens, cover::kOutside);
  EXPECT_FALSE(outside.empty());
  for (const Box<3>& box : outside) EXPECT_GT(value(box, false), 0);
  // What lies outside by more than a trifle is not looked at.
  for (const int token : {kInside, kLeaf, cover::kExcluded})
    for (const Box<3>& box : leaves<3>(root, tokens, token)) EXPECT_LT(value(box, false), 1e-12);
}

TEST(Subdivide, LimitsLeaveBoxesUnresolved) {
  const Box<3> root{{-2, -2, -2}, {2, 2, 2}};
  SubdivisionLimits few;
  few.max_boxes = 20;
  const Subdivision<3> tree = sphere_octree(root, {}, few);
  EXPECT_LT(tree.size(), 2 * few.max_boxes + 2);
  EXPECT_FALSE(leaves<3>(root, tree.tokens(), cover::kUnresolved).empty());

  SubdivisionLimits coarse;
  coarse.smallest = 0.25;
  for (const Box<3>& box :
       leaves<3>(root, sphere_octree(root, {}, coarse).tokens(), cover::kUnresolved))
    EXPECT_EQ(box.largest_width(), 1);
}

TEST(Subdivide, NetsStaySharpDownToTinyBoxes) {
  // (x - 1/3)^2 + (y - 1/3)^2 = 2^-60: the values on the way down are far below rounding errors of
  // the root's net.
  const FilteredFunction<2> f(polynomial<2>("(x - 1/3)^2 + (y - 1/3)^2 - 1/2^60"));
  const Box<2> root{{0, 0}, {1, 1}};
  Kernel kernel;
  const auto tree = subdivide<2, 1>(
      {&f}, root, {}, {}, kernel, [](const std::array<Bernstein<2>, 1>& nets, const Box<2>& box) {
        if (const auto sign = sign_on_cube(nets[0]))
          return *sign == Sign::Negative ? kInside : cover::kExcluded;
        const int axis = box.width(0) >= box.width(1) ? 0 : 1;
        return box.width(axis) > 0x1p-33 ? cover::kSplitX - axis : kLeaf;
      });
  EXPECT_FALSE(leaves<2>(root, tree.tokens(), kInside).empty());
  EXPECT_LT(leaves<2>(root, tree.tokens(), kLeaf).size(), 200u);
  EXPECT_TRUE(leaves<2>(root, tree.tokens(), cover::kUnresolved).empty());
  EXPECT_GT(kernel.expansions, 1);
  EXPECT_GT(kernel.mpfr_expansions, 0);
}

TEST(Subdivision, TokensAreInPreorderLowerHalfFirst) {
  Subdivision<3> tree({{0, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(tree.tokens(), std::vector<int>{cover::kUnresolved});
  const int z = tree.split(0, 2);
  const int x = tree.split(z + 1, 0);
  tree.settle(z, 1);
  tree.settle(x, 2);
  const int y = tree.split(x + 1, 1);
  tree.settle(y, 3);
  tree.settle(y + 1, cover::kExcluded);
  EXPECT_EQ(tree.tokens(), (std::vector<int>{cover::kSplitZ, 1, cover::kSplitX, 2, cover::kSplitY,
                                             3, cover::kExcluded}));
  const auto leaf = [&](int token) {
    const auto boxes = leaves<3>(tree.root(), tree.tokens(), token);
    EXPECT_EQ(boxes.size(), 1u);
    return boxes[0];
  };
  EXPECT_EQ(leaf(1), (Box<3>{{0, 0, 0}, {1, 1, 0.5}}));
  EXPECT_EQ(leaf(2), (Box<3>{{0, 0, 0.5}, {0.5, 1, 1}}));
  EXPECT_EQ(leaf(3), (Box<3>{{0.5, 0, 0.5}, {1, 0.5, 1}}));
  EXPECT_EQ(leaf(cover::kExcluded), (Box<3>{{0.5, 0.5, 0.5}, {1, 1, 1}}));
}

TEST(HalveBox, CutsExactlyOrNotAtAll) {
  Box<2> lower, upper;
  const double e = 0x1p-52;
  EXPECT_TRUE(halve_box<2>({{1, 0}, {1 + 2 * e, 1}}, 0, &lower, &upper));
  EXPECT_EQ(lower, (Box<2>{{1, 0}, {1 + e, 1}}));
  EXPECT_EQ(upper, (Box<2>{{1 + e, 0}, {1 + 2 * e, 1}}));
  EXPECT_FALSE(halve_box<2>({{1, 0}, {1 + e, 1}}, 0, &lower, &upper));
  EXPECT_FALSE(halve_box<2>({{1, 0}, {1 + 3 * e, 1}}, 0, &lower, &upper));
  EXPECT_FALSE(halve_box<2>({{1, 0}, {1, 1}}, 0, &lower, &upper));
}

TEST(SubdivisionRoot, ContainsTheBoxAndHalvesExactly) {
  for (const Box<2>& box : {Box<2>{{-1, -1}, {1, 1}}, Box<2>{{0.1, -0.3}, {0.7, 1e-3}},
                            Box<2>{{1e6, -1e-9}, {1e6 + 1, 1e-9}}}) {
    Box<2> root = subdivision_root<2>(box);
    EXPECT_TRUE(root.contains(box));
    for (int i = 0; i < 2; ++i) EXPECT_LT(root.width(i), 1.1 * box.width(i));
    Box<2> lower, upper;
    for (int level = 0; level < 20; ++level)
      for (int axis = 0; axis < 2; ++axis) {
        ASSERT_TRUE(halve_box<2>(root, axis, &lower, &upper));
        root = level % 2 ? lower : upper;
      }
  }
}

}  // namespace
}  // namespace encase
